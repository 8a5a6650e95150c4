#pragma once
// The walls at a vertex or an edge.

#include "environment/environment.h"
#include "environment/marking.h"
#include "map/cell_queue.h"

namespace dsw {

/** The walls that have both corners (one corner twice: a vertex) and are reached from `front` round them without passing a
 * wall: visit(cell in front, number of the facet in it, the facet). Throws std::bad_alloc. */
template <int D, class Visit>
void for_each_wall_at(const Environment<D>& env, Cell front, const uint32_t (&corners)[2], Visit visit) {
  const Map<D>& map = env.map;
  CellQueue cells(env.memory);
  cells.insert(front);
  for (size_t i = 0; i < cells.size(); ++i) {
    const Cell c = cells[i];
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      bool has[2] = {};
      for_each_facet_vertex<D>(shape, f, [&](uint32_t local) {
        for (int k = 0; k < 2; ++k) has[k] = has[k] || map.vertex(c, local) == corners[k];
      });
      if (!has[0] || !has[1]) continue;
      const HalfFacet facet = map.half_facet(c, f);
      if (is_impassable(env, facet)) {
        visit(c, f, facet);
      } else {
        cells.insert(map.cell_of(map.opposite(facet)));
      }
    }
  }
}

}  // namespace dsw
