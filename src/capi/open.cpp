#include <cmath>

#include "capi/cut_results.h"
#include "capi/recorded.h"
#include "cutting/opening.h"
#include "dartsweep/surgery.h"
#include "scene/edits.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::OpenSettings read_settings(const dsw_open_desc& d) {
  capi::check_flags(d.flags, 0, "desc->flags");
  if (!std::isfinite(d.width)) fail(DSW_STATUS_NON_FINITE, "desc->width is not finite");
  if (!(d.width > 0)) fail(DSW_STATUS_OUT_OF_RANGE, "desc->width is %g, must be above 0", d.width);
  return {d.width, d.region, d.tag};
}

template <int D>
void read_faces(const dsw::Map<D>& map, const dsw_open_desc& d, dsw::Crack<D>& crack) {
  for (size_t i = 0; i < d.face_count; ++i) {
    const dsw::HalfFacet front = capi::to_half_facet(map, d.faces[i].front, {"desc->faces", true}, i);
    crack.add(front, capi::to_half_facet(map, d.faces[i].back, {"desc->faces", true}, i), i);
  }
}

}  // namespace

void dsw_open_desc_init(dsw_open_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_open_desc{}); }

dsw_status dsw_environment_open(dsw_environment* environment, const dsw_open_desc* desc, dsw_open_report* report) {
  return capi::guarded_visit("dsw_environment_open", environment, "environment", [&](auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw_scene* const scene = capi::only_scene(*environment);
    capi::require(desc, "desc");
    const dsw_open_desc d = capi::read_struct(desc, "desc");
    const dsw::OpenSettings settings = read_settings(d);
    capi::require_array(d.faces, d.face_count, "desc->faces");
    capi::Recorded call(scene, capi::row_of<dsw_environment_open>, &d);
    dsw::Crack<D> crack(env, settings.region);
    read_faces(env.map, d, crack);
    crack.part();
    dsw::Opening<D> opening(env, crack, settings);
    std::optional<dsw::Edit<D>> edit;
    opening.prepare(edit);
    const dsw::OpenRecord& record = opening.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, nullptr);
    carry_out_prepared(*edit, capi::engine_of<D>(scene));
    results.give_to(*environment);
    const dsw_open_report done{record.smallest,
                               record.largest,
                               static_cast<uint32_t>(record.vertices.size() / 2),
                               record.shortened,
                               static_cast<uint32_t>(record.faces.size()),
                               record.changed};
    call.done(done, capi::items_of(environment->changes));
    if (report != nullptr) *report = done;
  });
}
