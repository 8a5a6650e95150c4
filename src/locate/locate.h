#pragma once
// Which cell contains a point: by a walk from a hint, by a tree of boxes, or by a scan.

#include "walk/cast.h"

namespace dsw {

struct LocateResult {
  Cell cell;  // invalid: the point lies in no cell
};

/** The cell that contains a point under the shift. With a valid hint: a walk from its centre through passable and
 * impassable cells alike, O(cells between); it can leave the environment although the point is inside, where that
 * is not convex. Then, and without a hint: the cell of lowest index that contains the point, by the tree of boxes
 * or by a scan of all cells. */
template <int D>
LocateResult locate(const Environment<D>& env, const double* point, Cell hint, CastCounters* counters) noexcept;

}  // namespace dsw
