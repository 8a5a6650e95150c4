#pragma once
// Where a blade is met first: from there a cut follows it.

#include "cutting/crossings.h"

namespace dsw {

/** A cell that the blade meets: the first one in a search from `hint`, always on from the cell that is nearest to the
 * blade; without a hint that of the first point of the blade that is in any. Invalid: there is none. Adds the cells
 * that were looked at in vain to *visited. O(simplices) for each cell between hint and blade; all that hang together
 * with the hint where the blade meets none; without a hint as locate(). Throws std::bad_alloc. */
template <int D>
Cell find_start(const Environment<D>& env, const Blade<D>& blade, Cell hint, uint32_t* visited);

}  // namespace dsw
