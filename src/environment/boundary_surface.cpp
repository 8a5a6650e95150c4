#include "environment/boundary_surface.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace dsw {
namespace {

/** Simplices of facets, so that a dart finds its simplex again. */
struct FacetStart {
  uint32_t word, first;
  bool operator<(const FacetStart& o) const { return word < o.word; }
};

uint32_t first_of(const Array<FacetStart>& starts, HalfFacet h) {
  return std::lower_bound(starts.begin(), starts.end(), FacetStart{h.word, 0})->first;
}

/** Edge of a facet's triangles that runs from local vertex u to v; the triangle's number in the shape by 3, plus k. */
uint32_t find_edge(const Shape& shape, uint32_t facet, uint32_t u, uint32_t v) {
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    const uint16_t* local = shape.simplices() + 3 * s;
    for (uint32_t k = 0; k < 3; ++k) {
      if (local[k] == u && local[(k + 1) % 3] == v) return 3 * s + k;
    }
  }
  return 0;
}

/** The boundary dart met by turning from the boundary dart d about its edge, through the cells behind it. */
Dart turn(const Map<3>& map, Dart d) {
  Dart e = beta2(map, d);
  for (Dart next = beta3(map, e); next.cell.valid(); next = beta3(map, e)) e = beta2(map, next);
  return e;
}

/** Sets the mates of a facet's triangles. */
void find_mates(const Map<3>& map, const Array<FacetStart>& starts, const FacetStart& start,
                BoundarySurface<3>& surface) {
  const Cell c = map.cell_of({start.word});
  const Shape shape = map.shape(c);
  const uint32_t f = map.local_of({start.word}, c), first = shape.simplex_first(f);
  for (uint32_t s = first; s < shape.simplex_first(f + 1); ++s) {
    const uint16_t* local = shape.simplices() + 3 * s;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t u = local[k], v = local[(k + 1) % 3];
      uint32_t& mate = surface.simplices[start.first + s - first].mate[k];
      uint32_t d = shape.facet_first(f);
      while (d < shape.facet_first(f + 1) && (shape.dart_vertex(d) != u || shape.dart_vertex(shape.beta1(d)) != v)) ++d;
      if (d == shape.facet_first(f + 1)) {  // a cut inside the facet
        mate = 3 * (start.first - first) + find_edge(shape, f, v, u);
        continue;
      }
      const Dart other = turn(map, {c, d});
      const Shape other_shape = map.shape(other.cell);
      const uint32_t g = other_shape.dart_facet(other.local);
      const uint32_t edge = find_edge(other_shape, g, other_shape.dart_vertex(other.local),
                                      other_shape.dart_vertex(other_shape.beta1(other.local)));
      mate = 3 * (first_of(starts, map.half_facet(other.cell, g)) - other_shape.simplex_first(g)) + edge;
    }
  }
}

/** Sets the mate at the end of a side, and at the start of the side that is met by turning about that vertex. */
void find_mates(const Map<2>& map, const Array<FacetStart>& starts, const FacetStart& start,
                BoundarySurface<2>& surface) {
  const Cell c = map.cell_of({start.word});
  Dart d = beta1(map, {c, map.local_of({start.word}, c)});
  for (Dart next = cross(map, d); next.cell.valid(); next = cross(map, d)) d = beta1(map, next);
  const uint32_t other = first_of(starts, half_facet(map, d));
  surface.simplices[start.first].mate[1] = 2 * other;
  surface.simplices[other].mate[0] = 2 * start.first + 1;
}

}  // namespace

template <int D>
BoundarySurface<D>::BoundarySurface(const Environment<D>& env) : simplices(env.memory), sheet(env.memory) {
  const Map<D>& map = env.map;
  Array<FacetStart> starts{env.memory};
  for_each_cell(map, [&](Cell c) {
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (map.opposite(h).valid()) continue;
      starts.push_back({h.word, static_cast<uint32_t>(simplices.size())});
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        BoundarySimplex<D> simplex{{}, {}, c};
        for (uint32_t k = 0; k < D; ++k) simplex.vertex[k] = map.vertex(c, shape.simplices()[D * s + k]);
        simplices.push_back(simplex);
      }
    }
  });
  dsw::sort(starts.begin(), starts.end());
  for (const FacetStart& start : starts) find_mates(map, starts, start, *this);
  const auto count = static_cast<uint32_t>(simplices.size());
  DisjointSets sheets(count, env.memory);
  for (uint32_t i = 0; i < count; ++i) {
    for (const uint32_t mate : simplices[i].mate) sheets.join(i, mate / D);
  }
  sheet.resize(count);
  for (uint32_t i = 0; i < count; ++i) sheet[i] = sheets.root(i);
}

template <int D>
BoxTree<D> tree_of(const Environment<D>& env, const BoundarySurface<D>& surface) {
  const auto box_of = [&](uint32_t i) {
    ClosedBox<D> box;
    for (const uint32_t v : surface.simplices[i].vertex) box.add(env.point(v));
    return box;
  };
  return BoxTree<D>(static_cast<uint32_t>(surface.simplices.size()), box_of, env.memory);
}

template struct BoundarySurface<2>;
template struct BoundarySurface<3>;
DSW_INSTANTIATE(tree_of);

}  // namespace dsw
