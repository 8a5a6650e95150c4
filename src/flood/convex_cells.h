#pragma once
// Cells that are exactly convex, as what goes from facet to facet of them asks for.

#include "flood/sequence.h"
#include "walk/standard_facets.h"

namespace dsw {

/** Exactly convex cells with flat facets. A ridge is an edge of them, in the plane a vertex. */
template <int D>
struct ConvexCells {
  const Map<D>& map;

  bool suits(Cell c) const noexcept { return map.convex(c); }
  /** Calls visit(a, b) for the ridges of a facet: their vertices, in the plane twice the same. */
  template <class Visit>
  void for_each_ridge(HalfFacet facet, Visit visit) const;
  /** Whether a facet has a ridge of its cell. */
  bool has(uint32_t facet, const Pivot<D>& pivot) const noexcept;
  /** The facet of `c` that has the pivot, as the one has that was entered. */
  HalfFacet other(Cell c, HalfFacet entered, const Pivot<D>& pivot) const noexcept;
};

template <int D>
template <class Visit>
void ConvexCells<D>::for_each_ridge(HalfFacet facet, Visit visit) const {
  const Cell c = map.cell_of(facet);
  const uint32_t local = map.local_of(facet, c);
  if constexpr (D == 2) {
    const uint32_t a = map.vertex(c, local), b = map.vertex(c, local + 1 == map.vertices_of(c) ? 0 : local + 1);
    visit(a, a);
    visit(b, b);
  } else if (has_standard_facets(map.form(c))) {
    uint32_t v[4];
    standard_corners(map.record(c), local, v);
    visit(v[0], v[1]);
    visit(v[1], v[2]);
    if (v[2] != v[3]) visit(v[2], v[3]);
    visit(v[3], v[0]);
  } else {
    const Shape shape = map.shape(c);
    for (uint32_t d = shape.facet_first(local); d < shape.facet_first(local + 1); ++d) {
      visit(map.vertex(c, shape.dart_vertex(d)), map.vertex(c, shape.dart_vertex(shape.beta1(d))));
    }
  }
}

template <int D>
bool ConvexCells<D>::has(uint32_t facet, const Pivot<D>& pivot) const noexcept {
  uint32_t found = 0;  // bits of the pivot's vertices
  for_each_ridge({facet}, [&](uint32_t a, uint32_t) {
    for (int i = 0; i < D - 1; ++i) found |= a == pivot.vertices[i] ? 1u << i : 0u;
  });
  return found == (1u << (D - 1)) - 1;
}

template <int D>
HalfFacet ConvexCells<D>::other(Cell c, HalfFacet entered, const Pivot<D>& pivot) const noexcept {
  if (D == 2 || map.form(c) == Form::kSimplex) return other_at(map, c, entered, pivot);
  for (uint32_t f = 0, count = map.facets_of(c); f < count; ++f) {
    const HalfFacet h = map.half_facet(c, f);
    if (h != entered && has(h.word, pivot)) return h;
  }
  return {};
}

}  // namespace dsw
