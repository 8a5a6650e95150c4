#include "stability.h"

#include <gtest/gtest.h>

#include <sstream>

#include "extremes.h"
#include "table.h"

namespace physics {
namespace {

void expect_promise(const Outcome& outcome, const std::string& what) {
  EXPECT_EQ(outcome.nonfinite, 0u) << what;
  EXPECT_EQ(outcome.not_free, 0u) << what;
  EXPECT_EQ(outcome.lost, 0u) << what;
}

TEST(Stability, ThePromiseHoldsWhateverPhysicsDoes) {
  for (const Integrator method : {Integrator::kSymplecticEuler, Integrator::kImplicitEuler, Integrator::kXpbd}) {
    for (const double stiffness : {1e-2, 1e12}) {
      for (const double dt : {1e-5, 1e-1}) {
        const StabilityRow row = run_stability(method, stiffness, dt, 30);
        const std::string what = std::string(name_of(method)) + " " + std::to_string(stiffness);
        expect_promise(row.all(), what);
        for (const Outcome* outcome : {&row.posts, &row.pressed, &row.surface, &row.walls}) {
          EXPECT_GT(outcome->contacts, 0u) << what << ": or nothing was tested";
        }
        EXPECT_GT(row.all().rubbing, 0u) << what;
        if (method == Integrator::kImplicitEuler) {
          EXPECT_TRUE(is_stable(row)) << stiffness << ' ' << dt;
          EXPECT_LE(row.energy_largest, 1 + 1e-6) << stiffness << ' ' << dt;
        }
      }
    }
  }
}

TEST(Stability, SymplecticEulerIsSeenToFail) {
  EXPECT_FALSE(is_stable(run_stability(Integrator::kSymplecticEuler, 1e4, 1e-3, 20)));
}

TEST(Extremes, EachKeepsThePromiseAndGoesOn) {
  for (const Extreme& extreme : run_extremes(2000)) {
    expect_promise(extreme.outcome, extreme.name);
    EXPECT_TRUE(extreme.goes_on) << extreme.name;
    const bool is_no_number = extreme.name == "force_nan" || extreme.name == "force_infinite";
    EXPECT_EQ(!extreme.outcome.message.empty(), is_no_number) << extreme.name << ": the library says so";
    EXPECT_EQ(extreme.outcome.refused > 0, is_no_number || extreme.name == "time_step_zero") << extreme.name;
    if (extreme.name == "target_1e300" || extreme.name == "time_step_1e100") {
      EXPECT_GT(extreme.outcome.contacts, 0u);
      // The room's wall, and the post before it.
      EXPECT_NEAR(extreme.largest, extreme.name == "target_1e300" ? 8 : 3, 2e-9)
          << "next to a wall, but for the distance kept";
    }
  }
}

TEST(Table, WritesBothForms) {
  Table table(2);
  table[0].add("name", "a").add("value", 0.5);
  table[1].add("name", "b, \"c\"").add("value", 1.0 / 0.0);
  std::ostringstream csv, json;
  write_csv(table, csv);
  write_json(table, json);
  EXPECT_EQ(csv.str(), "name,value\na,0.5\n\"b, \"\"c\"\"\",\n");
  EXPECT_EQ(json.str(),
            "[\n    {\"name\": \"a\", \"value\": 0.5},\n    {\"name\": \"b, \\\"c\\\"\", \"value\": null}\n  ]");
}

}  // namespace
}  // namespace physics
