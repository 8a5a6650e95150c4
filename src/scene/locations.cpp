#include "scene/locations.h"

#include "base/dimensions.h"
#include "contact/names.h"

namespace dsw {

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

DSW_INSTANTIATE(name_feature);

}  // namespace dsw
