#include "outcome.h"

#include "verify.h"

namespace physics {

void take_step(World* world, double dt, bool with_proof, Outcome* outcome) {
  outcome->refused += world->step(dt);
  ++outcome->steps;
  bool finite = true;
  for (std::size_t i = 0; i < world->bodies().size(); ++i) {
    const SoftBody& body = *world->bodies()[i];
    finite = finite && is_finite(body.points);
    outcome->contacts += world->report(i).move.contact_count;
    if (with_proof) {
      const Verdict verdict = verify(world->scene(), body.id());
      outcome->not_free += verdict.not_free;
      outcome->lost += verdict.lost;
    }
  }
  outcome->nonfinite += finite ? 0 : 1;
}

}  // namespace physics
