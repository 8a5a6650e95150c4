#include <cmath>

#include "scene/surgery.h"

#include "capi/change.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

void check_count(size_t count, size_t least, const char* name) {
  if (count < least) fail(DSW_STATUS_OUT_OF_RANGE, "desc->%s is %zu, must be at least %zu", name, count, least);
  if (count >= dsw::kVertexMask) fail(DSW_STATUS_TOO_LARGE, "desc->%s is %zu, must be below 2^28", name, count);
}

dsw::CutSettings read_settings(const dsw_carve_desc& d, int dimension) {
  dsw::CutSettings settings;
  settings.snap = capi::to_snap(d.snap);
  if (!std::isfinite(d.finest)) fail(DSW_STATUS_NON_FINITE, "desc->finest is not finite");
  if (d.finest < 0) fail(DSW_STATUS_OUT_OF_RANGE, "desc->finest is %g, must not be negative", d.finest);
  if (d.finest > 0 && (d.flags & DSW_CARVE_WHOLE) != 0) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->finest is %g, must be 0 with DSW_CARVE_WHOLE", d.finest);
  }
  if (d.finest > 0 && dimension == 2)
    fail(DSW_STATUS_UNSUPPORTED, "desc->finest is %g, must be 0 in the plane", d.finest);
  settings.finest = d.finest;
  settings.covers = (d.flags & DSW_CARVE_COVER) != 0;
  settings.splits = d.flags != 0 ? dsw::Splits::kNothing : dsw::Splits::kImpassable;
  return settings;
}

/** Reads the shape as a blade of triangles, in the plane of segments. */
template <int D>
dsw::Blade<D> read_shape(const dsw::Memory* memory, const dsw_carve_desc& d) {
  const char* const simplex = D == 3 ? "triangle" : "segment";
  check_count(d.point_count, 1, "point_count");
  check_count(d.triangle_count, 1, "triangle_count");
  dsw::require(d.triangles, "desc->triangles");
  const auto points = dsw::to_finite_points(D, d.points, d.point_count, d.point_stride_bytes, "desc->points");
  for (size_t s = 0; s < d.triangle_count; ++s) {
    const uint32_t* const c = d.triangles + D * s;
    for (size_t k = 0; k < D; ++k) {
      if (c[k] < d.point_count) continue;
      fail(DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->triangles[%zu] is %u; there are %zu points", D * s + k, c[k],
           d.point_count);
    }
    if (c[0] == c[1] || (D == 3 && (c[1] == c[2] || c[2] == c[0]))) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "%s %zu of desc->triangles repeats a point", simplex, s);
    }
  }
  auto shape = dsw::Blade<D>::of_simplices(memory, points, static_cast<uint32_t>(d.point_count), d.triangles,
                                           static_cast<uint32_t>(d.triangle_count));
  const uint32_t rim = shape.find_rim();
  if (rim != dsw::Blade<D>::kNone) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "the surface is not closed: no %s continues it at a side of %s %u", simplex, simplex,
         rim);
  }
  return shape;
}

}  // namespace

dsw_status dsw_environment_carve(dsw_environment* environment, const dsw_carve_desc* desc, dsw_change* out) {
  return capi::guarded_change(__func__, environment, out, [&](auto& change) {
    constexpr int D = capi::kDimension<decltype(change)>;
    const dsw_carve_desc d = capi::read_required(desc, "desc", DSW_CARVE_WHOLE | DSW_CARVE_COVER);
    const dsw::CutSettings settings = read_settings(d, D);
    const auto shape = read_shape<D>(change.memory(), d);
    const dsw::Cell start = capi::to_hint(change.map(), d.start, "desc->start");
    change.record(capi::row_of<dsw_environment_carve>, &d);
    carve_out(change, shape, start, settings);
    change.tell();
  });
}

dsw_status dsw_environment_tie(dsw_environment* environment, const dsw_tie_desc* desc, dsw_change* out) {
  return capi::guarded_change(__func__, environment, out, [&](auto& change) {
    constexpr int D = capi::kDimension<decltype(change)>;
    const dsw_tie_desc d = capi::read_required(desc, "desc", 0);
    const double snap = capi::to_snap(d.snap);
    check_count(d.point_count, D, "point_count");
    const auto points = dsw::to_finite_points(D, d.points, d.point_count, d.point_stride_bytes, "desc->points");
    const dsw::Cell start = capi::to_hint(change.map(), d.start, "desc->start");
    change.record(capi::row_of<dsw_environment_tie>, &d);
    tie_off(change, points, static_cast<uint32_t>(d.point_count), start, snap);
    change.tell();
  });
}
