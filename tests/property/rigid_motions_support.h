// Random rigid motions of bodies while an environment bends.
#pragma once

#include "together_deform_kinds.h"

namespace dsw::oracle {

class RigidMotionsTest : public BendingTest {
 protected:
  explicit RigidMotionsTest(uint64_t seed) : BendingTest(seed) {}

  dsw_rigid_motion motion_of(const Walker& of) {
    const double sizes[] = {3, 3, 1, 0.1, 1e-3, 1e-6};
    const double half = sizes[rng_.below(6u)] * rng_.range(0.05, 0.5), reach = rng_.chance(0.5) ? 0.3 : 0.01;
    Vec axis = dimension() == 2 ? Vec{0, 0, rng_.chance(0.5) ? 1.0 : -1.0} : beside({0, 0, 0}, 1);
    const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    dsw_rigid_motion motion = {};
    for (size_t k = 0; k < 3; ++k) motion.rotation[k] = axis[k] / length * std::sin(half);
    motion.rotation[3] = std::cos(half);
    const Vec centre = beside(of.state.at[0], 0.3), way = beside({0, 0, 0}, reach);
    std::copy(centre.begin(), centre.end(), motion.centre);
    std::copy(way.begin(), way.end(), motion.translation);
    return motion;
  }
  /// The motion in the numbers of dsw_sweep_rigid_pairs, normalised as the library does it.
  static std::vector<double> numbers_of(const dsw_rigid_motion& motion) {
    std::vector<double> n(17);
    double largest = 0;
    n[3] = 1;
    for (const double x : motion.rotation) largest = std::max(largest, std::fabs(x));
    for (size_t k = 0; k < 4; ++k) n[4 + k] = motion.rotation[k] / largest;
    const double size = std::sqrt((n[4] * n[4] + n[5] * n[5]) + (n[6] * n[6] + n[7] * n[7]));
    for (size_t k = 4; k < 8; ++k) n[k] /= size;
    for (size_t k = 0; k < 3; ++k) {
      n[8 + k] = n[11 + k] = motion.centre[k];
      n[14 + k] = motion.centre[k] + motion.translation[k];
    }
    return n;
  }
};

}  // namespace dsw::oracle
