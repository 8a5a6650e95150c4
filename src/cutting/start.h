#pragma once
// Where a blade is met first: from there a cut follows it; and which cells are near it.

#include "cutting/blade_tree.h"
#include "cutting/crossings.h"

namespace dsw {

/** A cell that the blade meets: the first one in a search from `hint`, always on from the cell that is nearest to the
 * blade; without a hint that of the first point of the blade that is in any. Invalid: there is none. If there is one,
 * adds the cells that were looked at in vain to *visited. O(log simplices) for each cell between hint and blade; where
 * the blade meets no cell, what for_each_near() takes; without a hint as locate(). Throws std::bad_alloc. */
template <int D>
Cell find_start(const Environment<D>& env, const Blade<D>& blade, const BladeTree<D>& tree, Cell hint,
                uint32_t* visited);

/** Calls visit(cell, simplex) for valid cells and simplices of the blade whose boxes overlap, and for some others, in
 * any order, until it returns false; whether it never did. By the tree of cells O(simplices * log cells + pairs), where
 * there is none yet O(cells * log simplices + pairs). */
template <int D, class Visit>
bool for_each_near(const Environment<D>& env, const BladeTree<D>& tree, Visit visit) {
  bool go_on = true;
  const auto look_at_cell = [&](uint32_t index) {
    const Cell c = env.map.cell(index);
    if (!go_on || !c.valid() || !admits(env, c)) return;
    tree.for_each_in({env, c}, [&](uint32_t simplex) { go_on = go_on && visit(c, simplex); });
  };
  const auto ask = [&](const CellTree<D>& cells) {
    for (uint32_t simplex = 0; simplex < tree.simplex_count() && go_on; ++simplex) {
      const typename BladeTree<D>::Box box = tree.box(simplex);
      go_on = cells.visit_box(box.lower, box.upper, [&](uint32_t index) {
        const Cell c = env.map.cell(index);
        return !c.valid() || !admits(env, c) || visit(c, simplex);
      });
    }
  };
  if (env.index.ask(env, ask, look_at_cell)) return go_on;
  for (uint32_t i = 0, count = env.map.index_count(); i < count && go_on; ++i) look_at_cell(i);
  return go_on;
}

}  // namespace dsw
