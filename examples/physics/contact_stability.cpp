#include "contact_stability.h"

#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "contact_scene.h"

namespace physics {
namespace {

constexpr Integrator kAllIntegrators[] = {Integrator::kSymplecticEuler, Integrator::kImplicitEuler, Integrator::kXpbd};
const std::vector<double> kContactStiffnesses = {1e-2, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12},
                          kContactSteps = {1e-5, 1e-4, 1e-2, 1e-1}, kRatios = {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6},
                          kFrictions = {0, 0.1, 1, 10}, kAspects = {1e1, 1e3, 1e6, 1e9};
constexpr double kPatience = 0.5;  // s: what has exploded meets so much that a row has its contacts long before

// What may be the cause, in this order: an axis, and how to set it to its default.
struct Axis {
  const char* name;
  std::function<bool(ContactCase*)> ease;  // false: it is already
};

std::vector<Axis> axes() {
  const ContactCase easy;
  const auto number = [easy](double ContactCase::*member) {
    return [easy, member](ContactCase* asked) { return std::exchange(asked->*member, easy.*member) != easy.*member; };
  };
  return {{"stiffness", number(&ContactCase::stiffness)},
          {"mass ratio", number(&ContactCase::mass_ratio)},
          {"aspect ratio", number(&ContactCase::aspect)},
          {"friction", number(&ContactCase::friction)},
          {"time step", number(&ContactCase::dt)},
          {"integrator", [easy](ContactCase* asked) {
             return std::exchange(asked->integrator, easy.integrator) != easy.integrator;
           }}};
}

}  // namespace

const char* name_of(ContactScene scene) {
  static constexpr const char* kNames[] = {
      "posts", "walls", "walls, END_STATE", "bodies", "bodies together", "self", "thick", "rigid", "all"};
  return kNames[static_cast<std::size_t>(scene)];
}

bool is_stable(const ContactRow& row) {
  return row.outcome.refused + row.outcome.nonfinite == 0 && row.energy_largest > 0 && row.energy_largest <= 2;
}

ContactRow run_contacts(const ContactCase& asked, int least_steps, int most_steps, std::size_t contacts) {
  ContactRow row;
  row.asked = asked;
  ContactWorld world(asked);
  for (int step = 0; step < most_steps; ++step) {
    world.step(&row);
    const bool enough = row.outcome.contacts >= contacts;
    if (enough && (step + 1 >= least_steps || row.outcome.seconds > kPatience)) {
      break;
    }
  }
  return row;
}

ContactRow run_contacts_with_cause(const ContactCase& asked, int least_steps, int most_steps, std::size_t contacts) {
  ContactRow row = run_contacts(asked, least_steps, most_steps, contacts);
  if (is_stable(row)) {
    return row;
  }
  for (const Axis& axis : axes()) {
    ContactCase eased = asked;
    if (axis.ease(&eased) && is_stable(run_contacts(eased, least_steps, most_steps, contacts))) {
      row.cause += (row.cause.empty() ? "" : " or ") + std::string(axis.name);
    }
  }
  if (row.cause.empty()) {  // no single one: the first ones that do together
    ContactCase eased = asked;
    for (const Axis& axis : axes()) {
      if (axis.ease(&eased)) {
        row.cause += (row.cause.empty() ? "" : " and ") + std::string(axis.name);
        if (is_stable(run_contacts(eased, least_steps, most_steps, contacts))) {
          return row;
        }
      }
    }
    row.cause.clear();
  }
  return row;
}

std::vector<ContactCase> contact_cases(int corners, std::size_t every) {
  std::vector<ContactCase> cases;
  std::mt19937 random(7);
  const auto any = [&random](const std::vector<double>& values) { return values[random() % values.size()]; };
  const std::pair<double ContactCase::*, const std::vector<double>*> numbers[] = {
      {&ContactCase::stiffness, &kContactStiffnesses},
      {&ContactCase::dt, &kContactSteps},
      {&ContactCase::mass_ratio, &kRatios},
      {&ContactCase::friction, &kFrictions},
      {&ContactCase::aspect, &kAspects}};
  for (const ContactScene scene : kContactScenes) {
    for (const Integrator integrator : kAllIntegrators) {
      ContactCase easy;
      easy.scene = scene;
      easy.integrator = integrator;
      cases.push_back(easy);
      for (const auto& [member, values] : numbers) {
        for (std::size_t i = 0; i < values->size(); i += every) {
          cases.push_back(easy);
          cases.back().*member = (*values)[i];
        }
      }
      for (int corner = 0; corner < corners; ++corner) {
        cases.push_back(easy);
        for (const auto& [member, values] : numbers) {
          cases.back().*member = any(*values);
        }
      }
    }
  }
  return cases;
}

}  // namespace physics
