#pragma once
// Darts and the involutions that link them, for code that follows orbits; casts work on half-facets and never come
// here. In space: beta1 next in face, beta2 other face of the same volume, beta3 other volume of the same face. In the
// plane: beta1 next in face, beta2 other face of the same edge. The last of them, which crosses a facet, is `cross`; at
// the outer boundary it is missing, and cross answers with an invalid cell.

#include "map/map.h"

namespace dsw {

template <int D>
uint32_t dart_vertex(const Map<D>& map, Dart d) {
  return map.vertex(d.cell, map.shape(d.cell).dart_vertex(d.local));
}

/** beta1 in a shape. */
template <int D>
uint32_t next_in_facet(const Shape& shape, uint32_t local) {
  if (D == 2) return local + 1 == shape.dart_count() ? 0 : local + 1;
  return shape.beta1(local);
}

template <int D>
Dart beta1(const Map<D>& map, Dart d) {
  return {d.cell, next_in_facet<D>(map.shape(d.cell), d.local)};
}

template <int D>
HalfFacet half_facet(const Map<D>& map, Dart d) {
  return map.half_facet(d.cell, map.shape(d.cell).dart_facet(d.local));
}

template <int D>
uint32_t dart_target(const Map<D>& map, Dart d) {
  return dart_vertex(map, beta1(map, d));
}

/** beta_D: the dart of the same edge, turned round, in the cell across the facet. */
template <int D>
Dart cross(const Map<D>& map, Dart d) {
  const Shape left = map.shape(d.cell);
  const HalfFacet o = map.opposite(map.half_facet(d.cell, left.dart_facet(d.local)));
  if (!o.valid()) return {};
  const Cell c = map.cell_of(o);
  const Shape shape = map.shape(c);
  const uint32_t facet = map.local_of(o, c),
                 wanted = map.vertex(d.cell, left.dart_vertex(next_in_facet<D>(left, d.local)));
  for (uint32_t e = shape.facet_first(facet); e < shape.facet_first(facet + 1); ++e) {
    if (map.vertex(c, shape.dart_vertex(e)) == wanted) return {c, e};
  }
  return {};
}

inline Dart beta2(const Map<3>& map, Dart d) { return {d.cell, map.shape(d.cell).dart_beta2(d.local)}; }
inline Dart beta2(const Map<2>& map, Dart d) { return cross(map, d); }
inline Dart beta3(const Map<3>& map, Dart d) { return cross(map, d); }

/** The dart of the cell's other facet at a ridge. In space that is beta2, of the same edge; in the plane the ridge is
 * the vertex where `d` starts, and the other side ends there. On its far side `cross` finds a dart of the same ridge in
 * the next cell round it. */
template <int D>
Dart across_ridge(const Map<D>& map, Dart d) {
  const Shape shape = map.shape(d.cell);
  if (D == 3) return {d.cell, shape.dart_beta2(d.local)};
  return {d.cell, d.local == 0 ? shape.dart_count() - 1 : d.local - 1};
}

/** Calls visit(from, to) for the vertices of each edge of a cell, both ways. */
template <int D, class Visit>
void for_each_edge_both_ways(const Map<D>& map, Cell c, Visit visit) {
  for (uint32_t d = 0, darts = map.shape(c).dart_count(); d < darts; ++d) {
    const uint32_t from = dart_vertex(map, Dart{c, d}), to = dart_target(map, Dart{c, d});
    visit(from, to);
    if (D == 2) visit(to, from);  // in space the facet on the other side does that
  }
}

/** Calls visit(dart) for one dart of every volume round the edge of `d`, starting at `d`: on through beta3 o beta2
 * until it closes or meets the outer boundary, then from `d` the other way. Stops when visit returns false. */
template <class Visit>
void for_each_volume_round_edge(const Map<3>& map, Dart d, Visit visit) {
  Dart e = d;
  do {
    if (!visit(e)) return;
    e = beta3(map, beta2(map, e));
    if (e == d) return;
  } while (e.cell.valid());
  for (e = beta3(map, d); e.cell.valid(); e = beta3(map, e)) {
    e = beta2(map, e);
    if (!visit(e)) return;
  }
}

/** Calls visit(dart) for a side of a polygon: for its dart, then for the dart on the other side unless that side is the
 * outside. */
template <class Visit>
void for_each_volume_round_edge(const Map<2>& map, Dart d, Visit visit) {
  if (!visit(d)) return;
  const Dart e = cross(map, d);
  if (e.cell.valid()) visit(e);
}

/** First dart of the edge number `edge` of a cell; in the plane of the side. */
template <int D>
Dart dart_of_edge(const Map<D>& map, Cell c, uint32_t edge) {
  const Shape shape = map.shape(c);
  uint32_t d = 0;
  while (shape.dart_edge(d) != edge) ++d;
  return {c, d};
}

}  // namespace dsw
