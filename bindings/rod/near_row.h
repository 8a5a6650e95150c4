// What is near a body, as rows of a contact solver.
#ifndef DARTSWEEP_ROD_NEAR_ROW_H
#define DARTSWEEP_ROD_NEAR_ROW_H

#include <cstdint>
#include <vector>

#include "positions.h"

namespace physics {

constexpr std::uint32_t kNoRow = 0xffffffffu;
constexpr std::uint32_t kNoRod = 0xffffffffu;

// A place where the distance to an obstacle has a local minimum.
struct NearRow {
  std::uint32_t vertices[3] = {0, 0, 0};
  double weights[3] = {1, 0, 0};                // of the near point between them; their sum is 1
  std::uint32_t count = 1;                      // of vertices; a rod has 1, or 2 neighbours; 0: the row does not count
  Vector3 normal = Vector3::UnitZ();            // unit, from the obstacle to the body
  double gap = 0;                               // distance less radius
  Vector3 obstacle_velocity = Vector3::Zero();  // of its near point
  std::uint32_t previous = kNoRow;              // the row of the last step with the same key
  // Where the obstacle is a rod of the same system (rod_system.h): its number and two of its vertices.
  std::uint32_t rod = kNoRod;
  std::uint32_t rod_vertices[2] = {0, 0};
  double rod_weights[2] = {1, 0};

  bool is_at_wall() const { return count > 0 && rod == kNoRod; }
  bool is_at_rod() const { return count > 0 && rod != kNoRod; }
};

using NearRows = std::vector<NearRow>;

}  // namespace physics

#endif
