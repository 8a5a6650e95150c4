// Where simulations break: each case with what happened.
#ifndef DARTSWEEP_PHYSICS_EXTREMES_H
#define DARTSWEEP_PHYSICS_EXTREMES_H

#include <string>

#include "outcome.h"

namespace physics {

struct Extreme {
  std::string name;
  Outcome outcome;       // of all steps, those after the case included
  double largest = 0;    // coordinate that any point came to
  bool goes_on = false;  // five ordinary steps after it, the body moves
};

// In words: what the library said or did.
std::string what_happened(const Extreme& extreme);

// `many`: number of steps of the longest run, and of cells that the longest step crosses; a million for the report.
// O(many).
std::vector<Extreme> run_extremes(int many);

}  // namespace physics

#endif
