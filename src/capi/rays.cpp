#include "dartsweep/rays.h"

#include "capi/body_access.h"
#include "capi/convert.h"
#include "scene/rays.h"

namespace capi = dsw::capi;
using dsw::fail;

dsw_status dsw_scene_cast(dsw_scene* scene, size_t count, const dsw_volume_id* starts, const double* from,
                          const double* to, size_t stride_bytes, const dsw_cast_options* options, dsw_flight* flights,
                          dsw_contact_partner* partners) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw::PointArray first = dsw::to_finite_points(D, from, count, stride_bytes, "from");
    const dsw::PointArray last = dsw::to_finite_points(D, to, count, stride_bytes, "to");
    dsw::require_array(flights, count, "flights");
    dsw::require_array(partners, count, "partners");
    const dsw::SegmentOptions settings = capi::to_options(options, DSW_CAST_OPEN_ENDS);
    capi::check_hints(s.env.map, starts, count, "starts");
    cast_among_bodies(s, count, starts, first, last, settings, flights, partners);
  });
}

dsw_status dsw_scene_find_nearest(dsw_scene* scene, const double* points, size_t count, size_t stride_bytes,
                                  const dsw_volume_id* hints, double radius, dsw_nearest* nearest,
                                  dsw_contact_partner* partners, dsw_volume_id* volumes, dsw_location* locations) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw::PointArray array = dsw::to_finite_points(D, points, count, stride_bytes, "points");
    dsw::require_array(nearest, count, "nearest");
    dsw::require_array(partners, count, "partners");
    if (!(radius >= 0)) fail(DSW_STATUS_OUT_OF_RANGE, "radius is %g, must be at least 0", radius);
    capi::check_hints(s.env.map, hints, count, "hints");
    nearest_among_bodies(s, count, array, hints, radius, {nearest, volumes, locations}, partners);
  });
}
