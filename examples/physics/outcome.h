// Counting what happens while a world steps on.
#ifndef DARTSWEEP_PHYSICS_OUTCOME_H
#define DARTSWEEP_PHYSICS_OUTCOME_H

#include <string>

#include "world.h"

namespace physics {

// What became of the points and of the library's promise, over a number of steps.
struct Outcome {
  std::size_t steps = 0;
  std::size_t contacts = 0;
  std::size_t rubbing = 0;  // touches in which friction did something
  // Steps in which physics handed over something that is no number: the library refused the positions, and what they belong to was put to
  // rest. This is what tells of an integrator.
  std::size_t refused = 0;
  // Steps after which something is no number all the same: positions of the library's, of bodies and of the environment's points, or what
  // physics goes on from. This is what tells of the library.
  std::size_t nonfinite = 0;
  std::size_t not_free = 0;  // edges and surfaces, summed over the steps
  std::size_t lost = 0;      // vertices, likewise
  double seconds = 0;        // of the processor, for the steps without the proof
  std::string message;       // of the last refusal

  void add(const Outcome& more);
};

// One step of a world; `with_proof`: every body is verified after it.
void take_step(World* world, double dt, bool with_proof, Outcome* outcome);

}  // namespace physics

#endif
