#include "dartsweep/query.h"

#include <algorithm>
#include <limits>

#include "capi/convert.h"
#include "motion/classify.h"
#include "motion/nearest.h"
#include "predicates/plane_hit.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

template <int D>
dsw_place place_of(const dsw::Environment<D>& env, dsw::Cell c) noexcept {
  return !c.valid() ? DSW_PLACE_OUTSIDE : is_closed(env, c) ? DSW_PLACE_IMPASSABLE : DSW_PLACE_PASSABLE;
}

/** The public id of what classify and find_nearest name. */
template <int D>
dsw_cell to_public(const dsw::Environment<D>& env, const dsw::FeatureRef& feature) noexcept {
  const dsw::Map<D>& map = env.map;
  if (feature.dimension == 0) return capi::cell_of_vertex(map, map.vertex(feature.cell, feature.local));
  if constexpr (D == 3) {
    if (feature.dimension == 1)
      return capi::cell_of_edge(capi::edge_id(map, dart_of_edge(map, feature.cell, feature.local)));
  }
  if (feature.dimension == D - 1) {
    return capi::cell_of_face(face_id(map, canonical(map, map.half_facet(feature.cell, feature.local))));
  }
  return {DSW_CELL_VOLUME, map.index(feature.cell), map.generation(feature.cell), 0};
}

/** The side of a facet that a viewer in the direction of `normal` sees. Behind a marked cell there is no viewer. */
template <int D>
dsw::HalfFacet seen_side(const dsw::Environment<D>& env, const dsw::FeatureRef& facet, const double* normal) noexcept {
  const dsw::HalfFacet h = env.map.half_facet(facet.cell, facet.local), o = env.map.opposite(h);
  if (!o.valid() || is_closed(env, env.map.cell_of(o))) return h;
  if (is_closed(env, facet.cell)) return o;
  const dsw::Shape shape = env.map.shape(facet.cell);
  const double* simplex[D];
  simplex_points(env, facet.cell, shape, shape.simplex_first(facet.local), simplex);
  double outward[3] = {};
  dsw::unit_normal<D>(simplex, outward);
  return outward[0] * normal[0] + outward[1] * normal[1] + outward[2] * normal[2] > 0 ? o : h;
}

}  // namespace

void dsw_cast_options_init(dsw_cast_options* options, size_t size) {
  capi::init_struct(options, size, dsw_cast_options{});
}

dsw_status dsw_environment_locate(const dsw_environment* environment, const double* point, dsw_volume_id hint,
                                  dsw_volume_id* volume, dsw_place* place) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::require(volume, "volume");
    capi::check_point<D>(point, "point");
    capi::check_hint(env.map, hint, "hint");
    const dsw::Cell c = locate_point(env, point, hint);
    *volume = volume_id(env.map, c);
    if (place != nullptr) *place = place_of(env, c);
  });
}

dsw_status dsw_environment_locate_points(const dsw_environment* environment, const double* points, size_t count,
                                         size_t stride_bytes, const dsw_volume_id* hints, dsw_volume_id* volumes,
                                         dsw_place* places) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    const dsw::PointArray array = capi::to_points<D>(points, count, stride_bytes, "points");
    capi::require_array(volumes, count, "volumes");
    check_finite(array, count, D, {"points", true});
    capi::check_hints(env.map, hints, count, "hints");
    locate_points(env, environment->parallel, array, count, hints, volumes);
    for (size_t i = 0; places != nullptr && i < count; ++i) {
      places[i] = place_of(env, dsw::is_null(volumes[i]) ? dsw::Cell{} : env.map.cell(volumes[i].index));
    }
  });
}

dsw_status dsw_environment_classify(const dsw_environment* environment, const double* point, dsw_volume_id volume,
                                    dsw_cell* cell) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::check_point<D>(point, "point");
    const dsw::Cell c = capi::to_cell(env.map, volume, {"volume", false});
    capi::require(cell, "cell");
    bool inside = false;
    const dsw::FeatureRef feature = classify(env, point, c, &inside);
    if (!inside) {
      fail(DSW_STATUS_OUTSIDE, "point %s is not in the closure of volume %u", dsw::PointText(point, D).text,
           volume.index);
    }
    *cell = to_public(env, feature);
  });
}

dsw_status dsw_environment_cast(const dsw_environment* environment, dsw_volume_id start, const double* from,
                                const double* to, const dsw_cast_options* options, dsw_flight* flight) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::check_point<D>(from, "from");
    capi::check_point<D>(to, "to");
    capi::require(flight, "flight");
    capi::check_hint(env.map, start, "start");
    cast_segments(env, environment->parallel, 1, &start, {from, D}, {to, D}, capi::to_options(options), flight);
  });
}

dsw_status dsw_environment_cast_segments(const dsw_environment* environment, size_t count, const dsw_volume_id* starts,
                                         const double* from, const double* to, size_t stride_bytes,
                                         const dsw_cast_options* options, dsw_flight* flights) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    const dsw::PointArray first = capi::to_points<D>(from, count, stride_bytes, "from");
    const dsw::PointArray last = capi::to_points<D>(to, count, stride_bytes, "to");
    capi::require_array(flights, count, "flights");
    const dsw::SegmentOptions settings = capi::to_options(options);
    check_finite(first, count, D, {"from", true});
    check_finite(last, count, D, {"to", true});
    capi::check_hints(env.map, starts, count, "starts");
    cast_segments(env, environment->parallel, count, starts, first, last, settings, flights);
  });
}

dsw_status dsw_environment_cast_path(const dsw_environment* environment, dsw_volume_id start, const double* from,
                                     const double* to, const dsw_cast_options* options, dsw_crossing* crossings,
                                     size_t capacity, size_t* count, dsw_flight* flight) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::check_point<D>(from, "from");
    capi::check_point<D>(to, "to");
    if (capacity != 0) capi::require(crossings, "crossings");
    capi::require(count, "count");
    capi::check_hint(env.map, start, "start");
    dsw_flight report;
    cast_path(env, start, from, to, capi::to_options(options), crossings, capacity, count, &report);
    if (capacity != 0 && capacity < *count) {
      fail(DSW_STATUS_BUFFER_TOO_SMALL, "capacity is %zu, must be 0 or at least %zu", capacity, *count);
    }
    if (flight != nullptr) *flight = report;
  });
}

dsw_status dsw_environment_find_nearest(const dsw_environment* environment, const double* point, dsw_volume_id volume,
                                        double radius, dsw_nearest* nearest) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    capi::check_point<D>(point, "point");
    capi::require(nearest, "nearest");
    if (!(radius >= 0)) fail(DSW_STATUS_OUT_OF_RANGE, "radius is %g, must be at least 0", radius);
    capi::check_hint(env.map, volume, "volume");
    const dsw::Cell c = dsw::is_null(volume) ? locate_point(env, point, volume) : env.map.cell(volume.index);
    if (!c.valid()) fail(DSW_STATUS_OUTSIDE, "point %s lies in no volume", dsw::PointText(point, D).text);
    if (is_closed(env, c)) {
      fail(DSW_STATUS_IMPASSABLE, "point %s lies in volume %u, which is impassable", dsw::PointText(point, D).text,
           env.map.index(c));
    }
    dsw::NearestResult found;
    dsw_nearest answer{};
    if (find_nearest(env, point, c, radius, found)) {
      answer.distance = found.distance;
      std::copy(found.point, found.point + 3, answer.point);
      std::copy(found.normal, found.normal + 3, answer.normal);
      answer.cell = to_public(env, found.feature);
      if (found.feature.dimension == D - 1) {
        const dsw::HalfFacet seen = seen_side(env, found.feature, found.normal);
        answer.tag = obstacle_tag(env, seen, env.map.cell_of(seen));
      }
    } else {
      answer.distance = std::numeric_limits<double>::infinity();
    }
    answer.cells_visited = found.cells_visited;
    *nearest = answer;
  });
}
