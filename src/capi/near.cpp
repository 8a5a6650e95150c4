#include "dartsweep/near.h"

#include <cmath>

#include "capi/body_access.h"
#include "scene/untested.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::NearSettings to_settings(const dsw_near_options* options, double own_radius) {
  const dsw_near_options o = capi::read_optional(options, "options", DSW_NEAR_JACOBIAN);
  dsw::NearSettings s;
  s.margin = capi::to_length(o.margin, "options->margin");
  s.radius = capi::to_length(o.radius, "options->radius");
  if (!std::isfinite(s.margin + 2 * (s.radius + own_radius))) {
    fail(DSW_STATUS_OUT_OF_RANGE, "options->margin is %g and options->radius %g, which is too much", o.margin,
         o.radius);
  }
  s.jacobian = (o.flags & DSW_NEAR_JACOBIAN) != 0;
  return s;
}

/** Hands out an array of what is kept of near rows; an empty one if there are none. */
template <class T, class Choose>
dsw_status hand_out_near(const char* function, const dsw_scene* scene, dsw_body_id body, const T** items, size_t* count,
                         const char* name, const Choose& choose) {
  return capi::guarded_body(function, scene, body, [&](const auto& of) {
    if (of.record.near.empty()) {
      capi::hand_out<T>(nullptr, 0, items, count, name);
    } else {
      capi::hand_out(choose(of.record.near[0]), items, count, name);
    }
  });
}

}  // namespace

dsw_status dsw_body_find_near_rows(dsw_scene* scene, dsw_body_id body, const dsw_near_options* options,
                                   size_t* row_count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const dsw::FreeBodies<capi::kDimension<decltype(of)>> free(of.scene);
    find_near_rows(of.scene, of.record, to_settings(options, of.body.radius));
    if (row_count != nullptr) *row_count = of.record.near[0].rows.size();
  });
}

dsw_status dsw_body_get_near_rows(const dsw_scene* scene, dsw_body_id body, const dsw_near_row** rows, size_t* count) {
  return hand_out_near(
      __func__, scene, body, rows, count, "rows", [](const auto& near) -> const auto& { return near.rows; });
}

dsw_status dsw_body_get_near_offsets(const dsw_scene* scene, dsw_body_id body, const uint32_t** offsets,
                                     size_t* count) {
  return hand_out_near(
      __func__, scene, body, offsets, count, "offsets",
      [](const auto& near) -> const auto& { return near.jacobian.offsets; });
}

dsw_status dsw_body_get_near_columns(const dsw_scene* scene, dsw_body_id body, const uint32_t** columns,
                                     size_t* count) {
  return hand_out_near(
      __func__, scene, body, columns, count, "columns",
      [](const auto& near) -> const auto& { return near.jacobian.columns; });
}

dsw_status dsw_body_get_near_values(const dsw_scene* scene, dsw_body_id body, const double** values, size_t* count) {
  return hand_out_near(
      __func__, scene, body, values, count, "values",
      [](const auto& near) -> const auto& { return near.jacobian.values; });
}
