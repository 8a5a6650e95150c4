// Random directions, frames and phases, without libm but sqrt.
#ifndef DARTSWEEP_TESTS_SCENES_RANDOM_TURNS_H
#define DARTSWEEP_TESTS_SCENES_RANDOM_TURNS_H

#include "scenes/random.h"

#include <array>

namespace dsw::scenes {

std::array<double, 3> random_direction(Random& random);
/** Three orthogonal unit vectors. */
std::array<std::array<double, 3>, 3> random_frame(Random& random);
/** A point on the unit circle. */
std::array<double, 2> random_phase(Random& random);

}  // namespace dsw::scenes

#endif
