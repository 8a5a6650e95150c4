#include "outcome.h"

#include <algorithm>
#include <cmath>

#include "curve.h"
#include "verify.h"

namespace physics {
namespace {

bool has_friction(const Touch& touch) {
  return (touch.impulse - touch.impulse.dot(touch.normal) * touch.normal).norm() > 1e-9 * touch.impulse.norm();
}

bool are_finite(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

}  // namespace

void Outcome::add(const Outcome& more) {
  steps += more.steps;
  contacts += more.contacts;
  rubbing += more.rubbing;
  refused += more.refused;
  nonfinite += more.nonfinite;
  not_free += more.not_free;
  lost += more.lost;
  seconds += more.seconds;
  message = more.message.empty() ? message : more.message;
}

void take_step(World* world, double dt, bool with_proof, Outcome* outcome) {
  const double start = processor_seconds();
  outcome->refused += world->step(dt) > 0 ? 1 : 0;
  outcome->seconds += processor_seconds() - start;
  ++outcome->steps;
  bool finite = true;
  for (std::size_t i = 0; i < world->bodies().size(); ++i) {
    const SoftBody& body = *world->bodies()[i];
    finite = finite && is_finite(body.points);
    outcome->contacts += world->report(i).move.contact_count;
    outcome->rubbing +=
        static_cast<std::size_t>(std::count_if(body.touches().begin(), body.touches().end(), has_friction));
    if (!world->report(i).message.empty()) {
      outcome->message = world->report(i).message;
    }
    if (with_proof) {
      const Validation validation = verify(world->scene(), body.id());
      finite = finite && validation.nonfinite == 0;
      outcome->not_free += validation.not_free;
      outcome->lost += validation.lost;
    }
  }
  if (world->walls() != nullptr) {
    const double* points = nullptr;
    std::size_t count = 0;
    check(dsw_environment_get_points(dsw_scene_get_environment(world->scene()), &points, &count), "reading points");
    finite = finite && is_finite(world->walls()->points) && are_finite(points, 3 * count);
  }
  outcome->nonfinite += finite ? 0 : 1;
}

}  // namespace physics
