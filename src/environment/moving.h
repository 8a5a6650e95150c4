#pragma once
// Environments whose points move.

#include "environment/environment.h"

namespace dsw {

/** From now on cells are looked at when they are first entered, and none is taken to be convex: that is known of cells that stay as they
 * are. The grid is given up. Throws std::bad_alloc before it changes anything. O(cells), once. */
template <int D>
void let_points_move(Environment<D>& env);

/** Gives back memory for points that the environment no longer reads. */
template <int D>
void release_owned_points(Environment<D>& env) noexcept;

/** Calls visit(cell) for the cells of `around` and those that can be reached from them through facets at a vertex, passable or not.
 * `around` keeps them. */
template <int D, class Queue, class Visit>
void for_each_cell_at_vertex(const Map<D>& map, uint32_t vertex, Queue& around, Visit visit) {
  for (size_t i = 0; i < around.size(); ++i) {
    const Cell at = around[i];
    visit(at);
    const Shape shape = map.shape(at);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (map.vertex(at, shape.dart_vertex(d)) != vertex) continue;
      const HalfFacet o = map.opposite(map.half_facet(at, shape.dart_facet(d)));
      if (o.valid()) around.insert(map.cell_of(o));
    }
  }
}

}  // namespace dsw
