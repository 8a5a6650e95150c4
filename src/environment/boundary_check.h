#pragma once
// Whether the outer boundary passes through itself. Cells that are valid one by one and linked facet to facet cover
// every point as often as the boundary winds round it, so they are a partition if that is nowhere more than once.

#include "environment/builder.h"

namespace dsw {

/** Whether some point lies in two cells. Exact, decided on the boundary alone. Touching is allowed: points, edges or
 * parts of faces in common, as long as no volume is. `offenders` may be null; it gets the first cells found at fault,
 * ascending. Expected O(n log n) for n boundary triangles of like size. May throw std::bad_alloc. */
template <int D>
bool boundary_crosses(const Environment<D>& env, Offenders* offenders);

}  // namespace dsw
