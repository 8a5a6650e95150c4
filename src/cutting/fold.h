#pragma once
// Cells can be valid one by one and overlap: where the outer boundary folds, those round one of its edges (in the plane
// vertices) take more than the space that there is.

#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

/** Whether the cells round an edge of the outer boundary, in the plane round a vertex, turn by more than all of the
 * way, or by all of it without being lips that lie on each other. `of` is a dart of the edge, or one that starts at the
 * vertex; false unless its facet, in the plane the vertex, is on the outer boundary. Cells are valid. Exact. O(cells
 * round it). Throws std::bad_alloc. */
template <int D>
bool is_folded(const Environment<D>& env, Dart of);

}  // namespace dsw
