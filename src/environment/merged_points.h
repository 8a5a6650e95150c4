#pragma once
// Points of a mesh that count as one.

#include "base/memory.h"
#include "base/points.h"

namespace dsw {

/** For each point the lowest index of those that it is one with: points at a distance of at most `distance` are one, and so
 * are points that a chain of such points joins. 0: points at exactly one place. Expected O(n) for few points within the
 * distance of one. Throws std::bad_alloc. */
template <int D>
Array<uint32_t> merged_points(const double* points, uint32_t count, double distance, const Memory* memory);

}  // namespace dsw
