// Counting what happens while a world steps on.
#ifndef DARTSWEEP_PHYSICS_OUTCOME_H
#define DARTSWEEP_PHYSICS_OUTCOME_H

#include "world.h"

namespace physics {

// What became of the points and of the library's promise, over a number of steps.
struct Outcome {
  std::size_t steps = 0;
  std::size_t contacts = 0;
  std::size_t nonfinite = 0;  // steps after which a position or velocity of the scene was no number
  std::size_t refused = 0;    // steps whose targets were no numbers: the library refused them, the scene went on
  std::size_t not_free = 0;   // edges, summed over the steps
  std::size_t lost = 0;       // vertices, likewise
};

// One step of a world; `with_proof`: every body is verified after it.
void take_step(World* world, double dt, bool with_proof, Outcome* outcome);

}  // namespace physics

#endif
