#include "proximity/obstacles_near.h"

namespace dsw {

template <int D>
void ObstacleFlood<D>::find(Cell start, const NearRegion<D>& region, NearList<D>& found) {
  cells_.clear();
  cells_.insert(start);
  for (size_t i = 0; i < cells_.size(); ++i) visit(i, region, found);
}

template <int D>
void ObstacleFlood<D>::visit(size_t number, const NearRegion<D>& region, NearList<D>& found) {
  const Map<D>& map = env_.map;
  const Cell c = cells_[number];
  const Shape shape = map.shape(c);
  outside_.clear();
  map.for_each_vertex(c, [&](uint32_t v) { outside_.push_back(region.outside(env_.point(v))); });
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    uint32_t all = ~0u;
    for_each_facet_vertex<D>(shape, f, [&](uint32_t local) { all &= outside_[local]; });
    if (all != 0) continue;
    const HalfFacet h = map.half_facet(c, f);
    if (is_impassable(env_, h)) {
      add_triangles(c, shape, f, found);
    } else {
      cells_.insert(map.cell_of(map.opposite(h)));
    }
  }
  add_thin(c, shape, found);
}

template <int D>
void ObstacleFlood<D>::add_triangles(Cell c, const Shape& shape, uint32_t facet, NearList<D>& found) const {
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    const uint16_t* const local = shape.simplices() + size_t{s} * D;
    NearObstacle<D> o{{}, D, env_.map.half_facet(c, facet), {}};
    uint32_t all = ~0u;
    for (int i = 0; i < D; ++i) {
      all &= outside_[local[i]];
      o.vertices[i] = env_.map.vertex(c, local[i]);
    }
    if (all == 0) found.add(o);
  }
}

template <int D>
void ObstacleFlood<D>::add_thin(Cell c, const Shape& shape, NearList<D>& found) const {
  if constexpr (D == 3) {
    for_each_marked_edge(env_, c, shape, [&](uint32_t d) {
      const uint32_t a = shape.dart_vertex(d), b = shape.dart_vertex(shape.beta1(d));
      if ((outside_[a] & outside_[b]) == 0) found.add({{env_.map.vertex(c, a), env_.map.vertex(c, b)}, 2, {}, c});
    });
  }
  for (uint32_t i = 0; env_.marked_vertices != 0 && i < shape.vertex_count(); ++i) {
    const uint32_t v = env_.map.vertex(c, i);
    if (vertex_marked(env_, v) && outside_[i] == 0) found.add({{v}, 1, {}, c});
  }
}

template class ObstacleFlood<2>;
template class ObstacleFlood<3>;

}  // namespace dsw
