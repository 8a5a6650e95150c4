#include "contact_stability.h"

#include <gtest/gtest.h>

#include <set>

namespace physics {
namespace {

std::string words(const ContactCase& c) {
  return std::string(name_of(c.scene)) + ", " + name_of(c.integrator) + ", stiffness " + std::to_string(c.stiffness) +
         ", dt " + std::to_string(c.dt) + ", masses " + std::to_string(c.mass_ratio) + ", friction " +
         std::to_string(c.friction) + ", aspect " + std::to_string(c.aspect);
}

void expect_promise(const ContactRow& row) {
  const std::string what = words(row.asked);
  EXPECT_EQ(row.outcome.nonfinite, 0u) << what;
  EXPECT_EQ(row.outcome.not_free, 0u) << what;
  EXPECT_EQ(row.outcome.lost, 0u) << what;
  EXPECT_GE(row.outcome.contacts, 100u) << what << ": or nothing was tested";
}

// Corners of the table: each scene and integrator, at the ends of two axes.
TEST(ContactStability, ThePromiseHoldsAtTheCorners) {
  const std::vector<ContactCase> cases = contact_cases(1);
  std::set<std::pair<int, int>> seen;
  for (const ContactCase& c : cases) {
    const bool corner = c.mass_ratio != 1 && c.friction != 0.3 && c.aspect != 1;
    if (!corner) {
      continue;
    }
    expect_promise(run_contacts(c, 30, 600, 100));
    seen.emplace(static_cast<int>(c.scene), static_cast<int>(c.integrator));
  }
  EXPECT_EQ(seen.size(), 27u);
}

TEST(ContactStability, ImplicitEulerIsStableWhereNothingIsExtreme) {
  for (const ContactScene scene : kContactScenes) {
    ContactCase easy;
    easy.scene = scene;
    const ContactRow row = run_contacts(easy, 60, 600, 100);
    expect_promise(row);
    EXPECT_TRUE(is_stable(row)) << words(easy) << ": " << row.energy_largest;
  }
}

TEST(ContactStability, WhatIsUnstableHasACause) {
  ContactCase stiff;
  stiff.integrator = Integrator::kSymplecticEuler;
  stiff.stiffness = 1e6;
  const ContactRow row = run_contacts_with_cause(stiff, 60, 400, 100);
  EXPECT_FALSE(is_stable(row));
  EXPECT_EQ(row.cause, "stiffness or integrator");
  EXPECT_TRUE(run_contacts_with_cause(ContactCase(), 60, 400, 100).cause.empty());
}

TEST(ContactStability, TheTableHasAThousandRows) { EXPECT_GE(contact_cases(12).size(), 1000u); }

TEST(ContactStability, AShortTableHasEachEasyCase) {
  const ContactCase easy;
  const std::vector<ContactCase> cases = contact_cases(0, 3);
  std::set<std::pair<int, int>> seen;
  for (const ContactCase& c : cases) {
    if (c.stiffness == easy.stiffness && c.dt == easy.dt && c.mass_ratio == easy.mass_ratio &&
        c.friction == easy.friction && c.aspect == easy.aspect) {
      seen.emplace(static_cast<int>(c.scene), static_cast<int>(c.integrator));
    }
  }
  EXPECT_EQ(seen.size(), 27u);
  EXPECT_LT(cases.size(), contact_cases(0).size() / 2);
}

}  // namespace
}  // namespace physics
