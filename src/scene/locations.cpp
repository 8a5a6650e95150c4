#include "scene/locations.h"

#include <algorithm>
#include <limits>

#include "contact/names.h"
#include "locate/nearest.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

/** The side of a facet that a viewer in the direction of `normal` sees. Behind a marked cell there is no viewer. */
template <int D>
HalfFacet seen_side(const Environment<D>& env, const FeatureRef& facet, const double* normal) noexcept {
  const HalfFacet h = env.map.half_facet(facet.cell, facet.local), o = env.map.opposite(h);
  if (!o.valid() || is_closed(env, env.map.cell_of(o))) return h;
  if (is_closed(env, facet.cell)) return o;
  const Shape shape = env.map.shape(facet.cell);
  const double* simplex[D];
  simplex_points(env, facet.cell, shape, shape.simplex_first(facet.local), simplex);
  double outward[3] = {};
  unit_normal<D>(simplex, outward);
  return outward[0] * normal[0] + outward[1] * normal[1] + outward[2] * normal[2] > 0 ? o : h;
}

}  // namespace

template <int D>
dsw_cell name_feature(const Environment<D>& env, const FeatureRef& feature) noexcept {
  const Map<D>& map = env.map;
  if (feature.dimension == 0) {
    const uint32_t v = map.vertex(feature.cell, feature.local);
    return {DSW_CELL_VERTEX, v, map.vertex_generation(v), 0};
  }
  if constexpr (D == 3) {
    if (feature.dimension == 1) {
      const dsw_edge_id id = edge_id(map, dart_of_edge(map, feature.cell, feature.local));
      return {DSW_CELL_EDGE, id.volume, id.generation, id.local};
    }
  }
  if (feature.dimension == D - 1) {
    const dsw_face_id id = face_id(map, canonical(map, map.half_facet(feature.cell, feature.local)));
    return {DSW_CELL_FACE, id.volume, id.generation, id.local};
  }
  return {DSW_CELL_VOLUME, map.index(feature.cell), map.generation(feature.cell), 0};
}

template <int D>
dsw_nearest report_nearest(const Environment<D>& env, const double* point, Cell c, double radius) {
  NearestResult found;
  dsw_nearest answer{};
  answer.distance = std::numeric_limits<double>::infinity();
  if (find_nearest_far(env, point, c, radius, found)) {
    answer.distance = found.distance;
    std::copy(found.point, found.point + 3, answer.point);
    std::copy(found.normal, found.normal + 3, answer.normal);
    answer.cell = name_feature(env, found.feature);
    if (found.feature.dimension == D - 1) {
      const HalfFacet seen = seen_side(env, found.feature, found.normal);
      answer.tag = obstacle_tag(env, seen, env.map.cell_of(seen));
    }
  }
  answer.volumes_visited = found.volumes_visited;
  return answer;
}

#define DSW_PLACES(D)                                                                \
  template dsw_cell name_feature(const Environment<D>&, const FeatureRef&) noexcept; \
  template dsw_nearest report_nearest(const Environment<D>&, const double*, Cell, double)
DSW_PLACES(2);
DSW_PLACES(3);
#undef DSW_PLACES

}  // namespace dsw
