// A box of cubes, some of which are impassable: the environment of tests and of the stability runs.
#ifndef DARTSWEEP_PHYSICS_CHANNEL_H
#define DARTSWEEP_PHYSICS_CHANNEL_H

#include <array>
#include <functional>
#include <vector>

#include "library.h"
#include "points.h"

namespace physics {

struct Channel {
  std::array<int, 3> cubes = {1, 1, 1};  // the last one 0: squares in the plane
  double scale = 1;                      // length of a cube
  double sliver = 0;                     // not 0: cubes go in pairs along x, and the first of a pair is only so long
  std::vector<std::array<int, 3>> obstacles;  // cubes that are impassable
  std::uint32_t tag = 0;                      // host tag of the obstacles
  std::function<Vector3(Vector3)> place;      // where the corner of a cube goes; none: it stays
};

// Cube (0, 0, 0) has a corner at the origin. Throws LibraryError.
Environment make_channel(const Channel& channel);

}  // namespace physics

#endif
