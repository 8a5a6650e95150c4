#pragma once
// A closed surface of triangles, filled with parts: tetrahedra are taken off until what is left is a valid part.

#include "split/parts.h"

namespace dsw {

/** In which order tetrahedra are tried: at vertices with few triangles first; by their form; mixed by a number. */
enum class PeelOrder : uint32_t { kFewest, kRoundest, kLargest, kFlattest, kMixed };
constexpr uint32_t kPeelOrders = 16;  // those from kMixed on are mixed differently

/** Appends valid parts that fill `surface` to `parts`, between its vertices, and where that leads no further, if `may_add`,
 * round one new point for each piece that is left. False: there is no such way, and nothing is changed. Exact.
 * O(n^3) at worst for n triangles. Throws std::bad_alloc. */
bool peel(PartPoints<3>& at, const PartHull<3>& surface, uint32_t order, bool may_add, Array<PartHull<3>>& parts);

/** Appends tetrahedra from the triangles of a surface to a new point inside of it. False: no point that sees all of them was
 * found, and nothing is changed. Throws std::bad_alloc. */
bool fill_round_point(PartPoints<3>& at, const PartHull<3>& surface, Array<PartHull<3>>& parts);

/** Whether a surface meets itself elsewhere than at common vertices and edges. O(n^2). */
bool meets_itself(const PartPoints<3>& at, const PartHull<3>& surface);

}  // namespace dsw
