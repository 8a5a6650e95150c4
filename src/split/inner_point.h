#pragma once
// A point inside of a cell that sees all of its surface.

#include "split/parts.h"

namespace dsw {

/** Looks for a point of which a boundary is a star, far from its planes. False: none was found. That a point is one is exact;
 * it is looked for in rounded numbers, in O(s) for s triangles. Throws std::bad_alloc. */
bool find_inner_point(const PartPoints<3>& at, const PartHull<3>& boundary, double* out);

}  // namespace dsw
