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

void read_faces(const dsw::Map<3>& map, const dsw_open_desc& d, dsw::Crack& crack) {
  for (size_t i = 0; i < d.face_count; ++i) {
    const dsw::HalfFacet front = capi::to_half_facet(map, d.faces[i].front, {"desc->faces", true}, i);
    crack.add(front, capi::to_half_facet(map, d.faces[i].back, {"desc->faces", true}, i), i);
  }
}

}  // namespace

void dsw_open_desc_init(dsw_open_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_open_desc{}); }

dsw_status dsw_environment_open(dsw_environment* environment, const dsw_open_desc* desc, dsw_open_report* report) {
  return capi::guard("dsw_environment_open", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    capi::require(desc, "desc");
    const dsw_open_desc d = capi::read_struct(desc, "desc");
    const dsw::OpenSettings settings = read_settings(d);
    dsw::Environment<3>& env = capi::space(handle);
    capi::require_array(d.faces, d.face_count, "desc->faces");
    capi::Recorded call(scene, capi::Call::kOpen, capi::without(d, &dsw_open_desc::faces),
                        capi::Items<dsw_cut_face>{d.faces, d.face_count});
    dsw::Crack crack(env, settings.region);
    read_faces(env.map, d, crack);
    crack.part();
    dsw::Opening opening(env, crack, settings);
    std::optional<dsw::Edit<3>> edit;
    opening.prepare(edit);
    const dsw::OpenRecord& record = opening.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, nullptr);
    carry_out_prepared(*edit, capi::engine_of(scene));
    results.give_to(handle);
    const dsw_open_report done{record.smallest,
                               record.largest,
                               static_cast<uint32_t>(record.vertices.size() / 2),
                               record.shortened,
                               static_cast<uint32_t>(record.faces.size()),
                               record.changed};
    call.done(done, capi::items_of(handle.changes));
    if (report != nullptr) *report = done;
  });
}
