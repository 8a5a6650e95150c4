// What is near a body, as rows of a contact solver.
#ifndef DARTSWEEP_PHYSICS_ROD_NEAR_ROW_H
#define DARTSWEEP_PHYSICS_ROD_NEAR_ROW_H

#include <cstdint>
#include <vector>

#include "points.h"

namespace physics {

constexpr std::uint32_t kNoRow = 0xffffffffu;

// A place where the distance to an obstacle has a local minimum.
struct NearRow {
  std::uint32_t vertices[3] = {0, 0, 0};
  double weights[3] = {1, 0, 0};                // of the near point between them; their sum is 1
  std::uint32_t count = 1;                      // of vertices; a rod has 1, or 2 neighbours
  Vector3 normal = Vector3::UnitZ();            // unit, from the obstacle to the body
  double gap = 0;                               // distance less radius
  Vector3 obstacle_velocity = Vector3::Zero();  // of its near point
  std::uint32_t previous = kNoRow;              // the row of the last step with the same key
};

using NearRows = std::vector<NearRow>;

}  // namespace physics

#endif
