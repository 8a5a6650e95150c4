#include "proximity/obstacles_near.h"

#include <algorithm>

#include "walk/standard_facets.h"

namespace dsw {

template <int D>
void ObstacleFlood<D>::find(const Cell* starts, size_t count, const NearRegion<D>& region, NearList<D>& found) {
  cells_.clear();
  are_open_ = true;
  for (size_t i = 0; i < count; ++i) {
    cells_.insert(starts[i]);
    are_open_ = are_open_ && !is_closed(env_, starts[i]);
  }
  std::fill_n(known_, kKnown, Known{kNoCell, 0});
  go_on(0, region, found);
}

template <int D>
void ObstacleFlood<D>::find_from(Cell start, const NearRegion<D>& region, NearList<D>& found) {
  const size_t before = cells_.size();
  are_open_ = are_open_ && !is_closed(env_, start);
  cells_.insert(start);
  go_on(before, region, found);
}

template <int D>
void ObstacleFlood<D>::go_on(size_t from, const NearRegion<D>& region, NearList<D>& found) {
  for (size_t i = from; i < cells_.size(); ++i) {
    const Cell c = cells_[i];
    if (D == 3 && env_.map.form(c) == Form::kSimplex) {
      visit_tetrahedron(c, region, found);
    } else {
      visit(c, region, found);
    }
  }
}

template <int D>
uint32_t ObstacleFlood<D>::find_outside(uint32_t vertex, const NearRegion<D>& region) noexcept {
  Known& known = known_[vertex % kKnown];
  known = {vertex, region.outside(env_.point(vertex))};
  if (next_ != nullptr && known.bits != 0) known.bits = region.outside(next_ + size_t{vertex} * D, known.bits);
  return known.bits;
}

template <int D>
void ObstacleFlood<D>::follow(Cell c, uint32_t facet, const uint32_t* outside, NearList<D>& found) {
  const HalfFacet h = env_.map.half_facet(c, facet);
  if (is_impassable(env_, h)) {
    add_triangles(c, facet, outside, found);
  } else {
    cells_.insert(env_.map.cell_of(env_.map.opposite(h)));
  }
}

/** Most cells of a flood are tetrahedra. Their shape is asked for at obstacles alone. */
template <int D>
void ObstacleFlood<D>::visit_tetrahedron(Cell c, const NearRegion<D>& region, NearList<D>& found) {
  const uint32_t* const w = env_.map.record(c);
  uint32_t bits[4];
  for (uint32_t i = 0; i < 4; ++i) bits[i] = outside(w[i] & kVertexMask, region);
  for (uint32_t f = 0; f < 4; ++f) {
    const uint8_t* const v = kTetrahedronFacets[f];
    if ((bits[v[0]] & bits[v[1]] & bits[v[2]]) != 0) continue;
    const HalfFacet beyond{w[4 + f]};  // an address below kNoFacet, unless the facet is marked or has no other side
    if (are_open_ && beyond.word < kNoFacet) {
      const Cell next = env_.map.cell_of(beyond);
      if (cells_.insert_if(next, [&] { return !is_closed(env_, next); })) continue;
    }
    follow(c, f, bits, found);
  }
  if (has_thin()) add_thin(c, bits, found);
}

template <int D>
void ObstacleFlood<D>::visit(Cell c, const NearRegion<D>& region, NearList<D>& found) {
  outside_.clear();
  env_.map.for_each_vertex(c, [&](uint32_t v) { outside_.push_back(outside(v, region)); });
  const Shape shape = env_.map.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    uint32_t all = ~0u;
    for_each_facet_vertex<D>(shape, f, [&](uint32_t local) { all &= outside_[local]; });
    if (all == 0) follow(c, f, outside_.data(), found);
  }
  if (has_thin()) add_thin(c, outside_.data(), found);
}

template <int D>
void ObstacleFlood<D>::add_triangles(Cell c, uint32_t facet, const uint32_t* outside, NearList<D>& found) const {
  const Shape shape = env_.map.shape(c);
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    const uint16_t* const local = shape.simplices() + size_t{s} * D;
    WallFeature o{{}, D, env_.map.half_facet(c, facet), {}};
    uint32_t all = ~0u;
    for (int i = 0; i < D; ++i) {
      all &= outside[local[i]];
      o.vertices[i] = env_.map.vertex(c, local[i]);
    }
    if (all == 0) found.add(o);
  }
}

template <int D>
void ObstacleFlood<D>::add_thin(Cell c, const uint32_t* outside, NearList<D>& found) const {
  const Shape shape = env_.map.shape(c);
  if constexpr (D == 3) {
    for_each_marked_edge(env_, c, shape, [&](uint32_t d) {
      const uint32_t a = shape.dart_vertex(d), b = shape.dart_vertex(shape.beta1(d));
      if ((outside[a] & outside[b]) == 0) found.add({{env_.map.vertex(c, a), env_.map.vertex(c, b)}, 2, {}, c});
    });
  }
  for (uint32_t i = 0; env_.marked_vertices != 0 && i < shape.vertex_count(); ++i) {
    const uint32_t v = env_.map.vertex(c, i);
    if (vertex_marked(env_, v) && outside[i] == 0) found.add({{v}, 1, {}, c});
  }
}

template class ObstacleFlood<2>;
template class ObstacleFlood<3>;

}  // namespace dsw
