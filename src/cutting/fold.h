#pragma once
// Cells can be valid one by one and overlap: where the outer boundary folds, those round one of its edges take more than the space
// that there is.

#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

/** Whether the cells round an edge of the outer boundary turn by more than all of the way, or by all of it without being lips that lie
 * on each other. `d` is a dart of a facet on the outer boundary; cells are valid. Exact. O(cells round the edge). Throws std::bad_alloc. */
bool is_folded(const Environment<3>& env, Dart d);

}  // namespace dsw
