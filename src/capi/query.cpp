#include "dartsweep/query.h"

#include <cmath>

#include "capi/convert.h"
#include "locate/classify.h"
#include "query/locations.h"
#include "query/nearest.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

void check_radius(double radius) {
  if (!(radius >= 0)) fail(DSW_STATUS_OUT_OF_RANGE, "radius is %g, must be at least 0", radius);
}

}  // namespace

dsw_status dsw_environment_locate(const dsw_environment* environment, const double* point, dsw_volume_id hint,
                                  dsw_volume_id* volume, dsw_location* location) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    dsw::require(volume, "volume");
    dsw::to_finite_point(env.kDimension, point, "point");
    capi::check_hint(env.map, hint, "hint");
    const dsw::Cell c = locate_point(env, point, hint);
    *volume = volume_id(env.map, c);
    if (location != nullptr) *location = location_of(env, c);
  });
}

dsw_status dsw_environment_locate_points(const dsw_environment* environment, const double* points, size_t count,
                                         size_t stride_bytes, const dsw_volume_id* hints, dsw_volume_id* volumes,
                                         dsw_location* locations) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray array = dsw::to_finite_points(env.kDimension, points, count, stride_bytes, "points");
    dsw::require_array(volumes, count, "volumes");
    capi::check_hints(env.map, hints, count, "hints");
    locate_points(env, environment->parallel, array, count, hints, volumes);
    for (size_t i = 0; locations != nullptr && i < count; ++i) {
      locations[i] = location_of(env, dsw::is_null(volumes[i]) ? dsw::Cell{} : env.map.cell(volumes[i].index));
    }
  });
}

dsw_status dsw_environment_classify(const dsw_environment* environment, const double* point, dsw_volume_id volume,
                                    dsw_cell* cell) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw::to_finite_point(env.kDimension, point, "point");
    const dsw::Cell c = capi::to_engine(env.map, volume, "volume");
    dsw::require(cell, "cell");
    bool inside = false;
    const dsw::FeatureRef feature = classify(env, point, c, &inside);
    if (!inside) {
      fail(DSW_STATUS_OUTSIDE, "point %s is not in the closure of volume %u", dsw::PointText(point, D).text,
           volume.index);
    }
    *cell = name_feature(env, feature);
  });
}

dsw_status dsw_environment_cast(const dsw_environment* environment, dsw_volume_id start, const double* from,
                                const double* to, const dsw_cast_options* options, dsw_flight* flight) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw::to_finite_point(env.kDimension, from, "from");
    dsw::to_finite_point(env.kDimension, to, "to");
    dsw::require(flight, "flight");
    capi::check_hint(env.map, start, "start");
    const dsw::SegmentOptions settings = capi::to_options(options, DSW_CAST_OPEN_ENDS);
    cast_segments(env, environment->parallel, 1, &start, {from, D}, {to, D}, settings, flight);
  });
}

dsw_status dsw_environment_cast_segments(const dsw_environment* environment, size_t count, const dsw_volume_id* starts,
                                         const double* from, const double* to, size_t stride_bytes,
                                         const dsw_cast_options* options, dsw_flight* flights) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray first = dsw::to_finite_points(env.kDimension, from, count, stride_bytes, "from");
    const dsw::PointArray last = dsw::to_finite_points(env.kDimension, to, count, stride_bytes, "to");
    dsw::require_array(flights, count, "flights");
    const dsw::SegmentOptions settings = capi::to_options(options, DSW_CAST_OPEN_ENDS);
    capi::check_hints(env.map, starts, count, "starts");
    cast_segments(env, environment->parallel, count, starts, first, last, settings, flights);
  });
}

dsw_status dsw_environment_cast_path(const dsw_environment* environment, dsw_volume_id start, const double* from,
                                     const double* to, const dsw_cast_options* options, dsw_crossing* crossings,
                                     size_t capacity, size_t* count, dsw_flight* flight) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    dsw::to_finite_point(env.kDimension, from, "from");
    dsw::to_finite_point(env.kDimension, to, "to");
    if (capacity != 0) dsw::require(crossings, "crossings");
    dsw::require(count, "count");
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
    dsw::to_finite_point(env.kDimension, point, "point");
    dsw::require(nearest, "nearest");
    check_radius(radius);
    capi::check_hint(env.map, volume, "volume");
    const dsw::Cell c = dsw::is_null(volume) ? locate_point(env, point, volume) : env.map.cell(volume.index);
    *nearest = nearest_to_point(env, point, c, radius);
  });
}

dsw_status dsw_environment_find_nearest_to_points(const dsw_environment* environment, const double* points,
                                                  size_t count, size_t stride_bytes, const dsw_volume_id* hints,
                                                  double radius, dsw_nearest* nearest, dsw_volume_id* volumes,
                                                  dsw_location* locations) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray array = dsw::to_finite_points(env.kDimension, points, count, stride_bytes, "points");
    dsw::require_array(nearest, count, "nearest");
    check_radius(radius);
    capi::check_hints(env.map, hints, count, "hints");
    nearest_to_points(env, environment->parallel, count, array, hints, radius, {nearest, volumes, locations});
  });
}

dsw_status dsw_environment_find_nearest_to_segments(const dsw_environment* environment, size_t count,
                                                    const dsw_volume_id* hints, const double* from, const double* to,
                                                    size_t stride_bytes, double radius, dsw_segment_nearest* nearest,
                                                    dsw_volume_id* volumes, dsw_location* locations) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray first = dsw::to_finite_points(env.kDimension, from, count, stride_bytes, "from");
    const dsw::PointArray last = dsw::to_finite_points(env.kDimension, to, count, stride_bytes, "to");
    dsw::require_array(nearest, count, "nearest");
    check_radius(radius);
    capi::check_hints(env.map, hints, count, "hints");
    nearest_to_segments(env, environment->parallel, count, first, last, hints, radius, {nearest, volumes, locations});
  });
}

dsw_status dsw_environment_find_signed_distances(const dsw_environment* environment, const double* points, size_t count,
                                                 size_t stride_bytes, double* distances, dsw_nearest* nearest) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray array = dsw::to_finite_points(env.kDimension, points, count, stride_bytes, "points");
    dsw::require_array(distances, count, "distances");
    signed_distances(env, environment->parallel, count, array, distances, nearest);
  });
}

dsw_status dsw_environment_find_inside(const dsw_environment* environment, const double* points, size_t count,
                                       size_t stride_bytes, const dsw_volume_id* hints, double by, double* inside,
                                       dsw_volume_id* volumes) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray array = dsw::to_finite_points(env.kDimension, points, count, stride_bytes, "points");
    dsw::require_array(inside, count, "inside");
    if (!(by >= 0 && std::isfinite(by))) fail(DSW_STATUS_OUT_OF_RANGE, "by is %g, must be finite and at least 0", by);
    capi::check_hints(env.map, hints, count, "hints");
    find_inside(env, environment->parallel, count, array, hints, by, inside, volumes);
  });
}
