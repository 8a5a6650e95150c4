#pragma once
// Cells that are exactly convex, as what goes from facet to facet of them asks for.

#include "corridor/corridor.h"
#include "walk/standard_facets.h"

namespace dsw {

/** Exactly convex cells with flat facets. A ridge is an edge of them, in the plane a vertex. */
template <int D>
struct ConvexCells {
  const Map<D>& map;

  /** Calls visit(a, b) for the ridges of a facet, counter-clockwise seen from outside, until it returns false. a and b are
   * the ridge's vertices, in the plane both the same. Whether no call returned false. */
  template <class Visit>
  bool for_each_ridge(HalfFacet facet, Visit visit) const;
  /** Whether a facet has a ridge of its cell. */
  bool has(uint32_t facet, const RidgeName& pivot) const noexcept;
  /** The facet of `c` that has the pivot, as the one has that was entered. */
  HalfFacet other(Cell c, HalfFacet entered, const RidgeName& pivot) const noexcept;
};

template <int D>
template <class Visit>
bool ConvexCells<D>::for_each_ridge(HalfFacet facet, Visit visit) const {
  const Cell c = map.cell_of(facet);
  const uint32_t local = map.local_of(facet, c);
  if constexpr (D == 2) {
    const uint32_t a = map.vertex(c, local), b = map.vertex(c, local + 1 == map.vertices_of(c) ? 0 : local + 1);
    return visit(a, a) && visit(b, b);
  } else if (has_standard_facets(map.form(c))) {
    uint32_t v[4];
    standard_corners(map.record(c), local, v);
    return visit(v[0], v[1]) && visit(v[1], v[2]) && (v[2] == v[3] || visit(v[2], v[3])) && visit(v[3], v[0]);
  } else {
    const Shape shape = map.shape(c);
    for (uint32_t d = shape.facet_first(local); d < shape.facet_first(local + 1); ++d) {
      if (!visit(map.vertex(c, shape.dart_vertex(d)), map.vertex(c, shape.dart_vertex(shape.beta1(d))))) return false;
    }
    return true;
  }
}

template <int D>
bool ConvexCells<D>::has(uint32_t facet, const RidgeName& pivot) const noexcept {
  uint32_t missing = D - 1;  // of the pivot's vertices
  for_each_ridge({facet}, [&](uint32_t a, uint32_t) {
    for (int k = 0; k < D - 1; ++k) missing -= a == pivot.vertices[k] ? 1 : 0;
    return missing != 0;
  });
  return missing == 0;
}

template <int D>
HalfFacet ConvexCells<D>::other(Cell c, HalfFacet entered, const RidgeName& pivot) const noexcept {
  if (D == 2 || map.form(c) == Form::kSimplex) return other_at(map, c, entered, pivot);
  for (uint32_t f = 0, count = map.facets_of(c); f < count; ++f) {
    const HalfFacet h = map.half_facet(c, f);
    if (h != entered && has(h.word, pivot)) return h;
  }
  return {};
}

}  // namespace dsw
