#pragma once
// Faces of one polyhedron that are turned against each other.

#include <cstdint>
#include <vector>

namespace dsw {

/** Turns loops so that two loops run along a common edge in opposite directions, and as few as possible are turned. `first`
 * says where each loop starts in `vertices`, and where the last one ends. Returns how many were turned: 0 also if an edge
 * has not two loops, or no turning helps. O(n log n). Throws std::bad_alloc. */
uint32_t turn_loops(std::vector<uint16_t>& vertices, const std::vector<uint16_t>& first);

}  // namespace dsw
