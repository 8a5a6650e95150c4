#pragma once
// Cutting facets anew where the rule "from the lowest vertex" gives a star that is not positive.

#include "base/short_array.h"
#include "environment/environment.h"

namespace dsw {

constexpr uint32_t kMostTriangulated = 256;  // vertices of a loop that is worth a search of cubic time

/** Places in a loop, three for each triangle of it. */
using LoopPlaces = ShortArray<uint32_t, 12>;
/** Triangles that fill a loop of `size` points and are positive seen from a point, and negative from a point `beyond`
 * unless that is null. False: there are none. Exact. O(n^3). Throws std::bad_alloc. */
bool triangulate(const double* const* loop, uint32_t size, const double* apex, const double* beyond, LoopPlaces& out);

/** Cuts those facets of a cell anew that spoil its star, the same way for both sides, if a triangulation exists that is
 * positive seen from both centres. Adds the cells on the other side of changed facets to `changed`. */
void recut_cell(Environment<3>& env, Cell c, Array<Cell>& changed);
inline void recut_cell(Environment<2>&, Cell, Array<Cell>&) {}

}  // namespace dsw
