#include "query/locations.h"

#include <cstdio>

#include "base/dimensions.h"
#include "base/points.h"
#include "contact/names.h"
#include "locate/inside.h"

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

namespace {

/** A vertex, edge or face as messages give it. */
struct CellText {
  char text[64];
  explicit CellText(const dsw_cell& cell) noexcept {
    if (cell.kind == DSW_CELL_VERTEX) {
      std::snprintf(text, sizeof text, "vertex %u", cell.index);
    } else {
      const char* const kind = cell.kind == DSW_CELL_EDGE ? "edge" : "face";
      std::snprintf(text, sizeof text, "%s %u of volume %u", kind, cell.local, cell.index);
    }
  }
};

}  // namespace

template <int D>
void fail_not_free(const Environment<D>& env, const char* name, const double* point, Cell c) {
  const PointText at(point, D);
  const SeenObstacle seen = find_touched(env, point, c);
  if (seen.cell.valid()) {
    fail(
        c.valid() ? DSW_STATUS_IMPASSABLE : DSW_STATUS_OUTSIDE,
        "%s %s is on the boundary, at %s, where the shift puts it %s; dsw_environment_find_inside gives a place inside",
        name, at.text, CellText(name_feature(env, seen.feature)).text,
        c.valid() ? "in an impassable volume" : "outside");
  }
  if (!c.valid()) fail(DSW_STATUS_OUTSIDE, "%s %s lies in no volume", name, at.text);
  fail(DSW_STATUS_IMPASSABLE, "%s %s lies in volume %u, which is impassable", name, at.text, env.map.index(c));
}

DSW_INSTANTIATE(name_feature);
DSW_INSTANTIATE(fail_not_free);

}  // namespace dsw
