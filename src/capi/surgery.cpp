#include "scene/surgery.h"

#include <cmath>

#include "capi/change.h"
#include "capi/read_blade.h"

namespace capi = dsw::capi;
using dsw::fail;

dsw_status dsw_environment_cut(dsw_environment* environment, const dsw_cut_desc* desc, dsw_change* out) {
  return capi::guarded_change(__func__, environment, out, [&](auto& change) {
    constexpr int D = capi::kDimension<decltype(change)>;
    const dsw_cut_desc d = capi::read_required(desc, "desc", DSW_CUT_UNSEW);
    dsw::CutSettings settings;
    settings.unsew = (d.flags & DSW_CUT_UNSEW) != 0;
    settings.snap = capi::to_snap(d.snap);
    const auto blade = dsw::Blade<D>::of_grid(change.memory(), capi::read_blade<D>(d), d.rows, d.columns);
    const dsw::Cell start = capi::to_hint(change.map(), d.start, "desc->start");
    change.record(capi::row_of<dsw_environment_cut>, &d);
    cut_along(change, blade, start, settings);
    change.tell();
  });
}

dsw_status dsw_environment_tear_faces(dsw_environment* environment, const dsw_face_id* faces, const double* loads,
                                      size_t count, double threshold, dsw_change* out) {
  return capi::guarded_change(__func__, environment, out, [&](auto& change) {
    dsw::require_array(faces, count, "faces");
    dsw::require_array(loads, count, "loads");
    if (std::isnan(threshold)) fail(DSW_STATUS_NON_FINITE, "threshold is not a number");
    change.record(capi::row_of<dsw_environment_tear_faces>, faces, loads, count, threshold);
    auto facets = change.template array<dsw::HalfFacet>(0);
    for (size_t i = 0; i < count; ++i) {
      const dsw::HalfFacet h = capi::to_engine(change.map(), faces[i], {"faces", true}, i);
      if (std::isnan(loads[i])) fail(DSW_STATUS_NON_FINITE, "loads[%zu] is not a number", i);
      if (loads[i] > threshold) facets.push_back(h);
    }
    tear_facets(change, facets);
    change.tell();
  });
}

dsw_status dsw_environment_open_crack(dsw_environment* environment, const dsw_open_crack_desc* desc, dsw_change* out) {
  return capi::guarded_change(__func__, environment, out, [&](auto& change) {
    const dsw_open_crack_desc d = capi::read_required(desc, "desc", 0);
    if (!std::isfinite(d.width)) fail(DSW_STATUS_NON_FINITE, "desc->width is not finite");
    if (!(d.width > 0)) fail(DSW_STATUS_OUT_OF_RANGE, "desc->width is %g, must be above 0", d.width);
    dsw::require_array(d.faces, d.face_count, "desc->faces");
    change.record(capi::row_of<dsw_environment_open_crack>, &d);
    dsw::Crack<capi::kDimension<decltype(change)>> crack(change.env, d.region);
    for (size_t i = 0; i < d.face_count; ++i) {
      const dsw::HalfFacet front = capi::to_engine(change.map(), d.faces[i].front, {"desc->faces", true}, i);
      crack.add(front, capi::to_engine(change.map(), d.faces[i].back, {"desc->faces", true}, i), i);
    }
    open_crack(change, crack, {d.width, d.region, d.tag});
    change.tell();
  });
}
