// A line that repeats: pseudo-random steps of about unit length.
#ifndef DARTSWEEP_PHYSICS_TESTS_RANDOM_LINE_H
#define DARTSWEEP_PHYSICS_TESTS_RANDOM_LINE_H

#include <random>

#include "points.h"

namespace physics {

inline Vector3 random_vector(std::mt19937* bits) {
  const auto number = [bits] { return 2 * static_cast<double>((*bits)()) / 4294967295.0 - 1; };
  const double x = number(), y = number(), z = number();
  return {x, y, z};
}

inline Positions random_line(std::size_t count, unsigned seed) {
  std::mt19937 bits(seed);
  Positions line = {random_vector(&bits)};
  while (line.size() < count) {
    line.push_back(line.back() + Vector3(1, 0, 0) + 0.5 * random_vector(&bits));
  }
  return line;
}

}  // namespace physics

#endif
