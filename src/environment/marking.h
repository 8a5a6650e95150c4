#pragma once
// Marks: what is impassable. A mark is set on one cell; what follows from it is derived here, never stored.
//
// Setting marks cannot fail once room has been made, so a caller reserves first and then changes all or nothing.

#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

/** Makes room for `more` marked edges. */
template <int D>
void reserve_edge_marks(Environment<D>& env, size_t more);
/** Makes room for marks of vertices. */
template <int D>
void reserve_vertex_marks(Environment<D>& env);

/** Each returns whether the mark changed. A facet's mark is kept on both sides; an edge is named by its vertices. */
template <int D>
bool set_cell_mark(Environment<D>& env, Cell c, bool marked) noexcept;
template <int D>
bool set_facet_mark(Environment<D>& env, HalfFacet h, bool marked) noexcept;
template <int D>
bool set_edge_mark(Environment<D>& env, uint32_t a, uint32_t b, bool marked) noexcept;
template <int D>
bool set_vertex_mark(Environment<D>& env, uint32_t vertex, bool marked) noexcept;

/** Calls visit(cell) for every cell with a region label. */
template <int D, class Visit>
void for_each_cell_of_region(const Environment<D>& env, int32_t region, Visit visit) {
  for_each_cell(env.map, [&](Cell c) {
    if (env.region(c) == region) visit(c);
  });
}

/** Calls visit(facet) for every facet between a cell of region `a` and one of region `b`, each once. */
template <int D, class Visit>
void for_each_facet_between(const Environment<D>& env, int32_t a, int32_t b, Visit visit) {
  const Map<D>& map = env.map;
  for_each_cell_of_region(env, a, [&](Cell c) {
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      if (!o.valid() || env.region(map.cell_of(o)) != b) continue;
      if (a != b || canonical(map, h) == h) visit(h);  // within one region every facet is met from both sides
    }
  });
}

template <int D>
bool edge_marked(const Environment<D>& env, uint32_t a, uint32_t b) noexcept {
  return env.edge_marks.contains(a, b);
}
template <int D>
bool vertex_marked(const Environment<D>& env, uint32_t vertex) noexcept {
  return !env.vertex_marks.empty() && ((env.vertex_marks[vertex / 64] >> (vertex % 64)) & 1u) != 0;
}

/** By its own mark, or because a facet round it is impassable. O(cells round the edge). For facets see map.h. */
bool edge_impassable(const Environment<3>& env, Dart d) noexcept;
/** By its own mark, or because a facet at it is impassable. O(cells). */
template <int D>
bool vertex_impassable(const Environment<D>& env, uint32_t vertex) noexcept;

}  // namespace dsw
