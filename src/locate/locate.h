#pragma once
// Which cell contains a point: by a walk from a hint, by a tree of boxes, or by a scan.

#include "walk/cast.h"

namespace dsw {

struct LocateResult {
  Cell cell;  // invalid: the point lies in no cell
};

/** Whether the closed box of a cell's vertices, which holds the cell, holds the point. */
template <int D>
bool box_holds(const Environment<D>& env, Cell c, const double* point) noexcept {
  const uint32_t n = env.map.vertices_of(c);
  bool above[D] = {}, below[D] = {};
  for (uint32_t i = 0; i < n; ++i) {
    const double* p = env.point(c, i);
    for (int k = 0; k < D; ++k) {
      above[k] = above[k] || p[k] >= point[k];
      below[k] = below[k] || p[k] <= point[k];
    }
  }
  for (int k = 0; k < D; ++k) {
    if (!above[k] || !below[k]) return false;
  }
  return true;
}

/** The cell that contains a point under the shift. With a valid hint: a walk from its centre through passable and
 * impassable cells alike, O(cells between); it can leave the environment although the point is inside, where that
 * is not convex. Then, and without a hint: the cell of lowest index that contains the point, by the tree of boxes
 * or by a scan of all cells. */
template <int D>
LocateResult locate(const Environment<D>& env, const double* point, Cell hint, CastCounters* counters) noexcept;

}  // namespace dsw
