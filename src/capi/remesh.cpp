#include "dartsweep/remesh.h"

#include "capi/convert.h"
#include "capi/recorded.h"
#include "capi/remesh.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace dsw::capi {

MendSettings to_mend_settings(uint32_t radius, uint32_t max_faces) {
  MendSettings s;
  if (radius > 8) fail(DSW_STATUS_OUT_OF_RANGE, "the radius is %u, must be 1 to 8, or 0", radius);
  if (max_faces != 0 && (max_faces < 4 || max_faces > kMostRim)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "max_faces is %u, must be 4 to %u, or 0", max_faces, kMostRim);
  }
  if (radius != 0) s.radius = radius;
  if (max_faces != 0) s.most_faces = max_faces;
  return s;
}

MendResults::MendResults(const Environment<3>& env, const MendRecord& record, const Edit<3>* edit)
    : changes_(Allocator<dsw_volume_change>(env.memory)), unmended_(Allocator<dsw_volume_id>(env.memory)) {
  if (edit != nullptr) changes_.reserve(edit->most_changes());
  for (const Cell c : record.left) unmended_.push_back(volume_id(env.map, c));
}

void MendResults::move_to(dsw_environment& handle, Edit<3>* edit) noexcept {
  handle.unmended_volumes.swap(unmended_);
  if (edit != nullptr) append_changes(*edit, changes_);
  handle.changes.swap(changes_);
}

}  // namespace dsw::capi

void dsw_remesh_desc_init(dsw_remesh_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_remesh_desc{}); }

dsw_status dsw_environment_remesh(dsw_environment* environment, const dsw_remesh_desc* desc,
                                  dsw_remesh_report* report) {
  return capi::guard("dsw_environment_remesh", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    const dsw_remesh_desc d = capi::read_optional(desc, "desc");
    capi::check_flags(d.flags, 0, "desc->flags");
    dsw::Environment<3>& env = capi::space(handle);
    const size_t points = d.next == nullptr ? 0 : env.map.vertex_count;
    if (d.point_count != points) {
      fail(DSW_STATUS_WRONG_SIZE, "desc->point_count is %zu, must be %zu", d.point_count, points);
    }
    capi::require_array(d.volumes, d.volume_count, "desc->volumes");
    const dsw::MendSettings settings = capi::to_mend_settings(d.radius, d.max_faces);
    capi::Recorded call(scene, capi::row_of<dsw_environment_remesh>, &d);
    dsw::Mending mending(env, d.next, settings);
    for (size_t i = 0; i < d.volume_count; ++i) {
      mending.want(capi::to_cell(env.map, d.volumes[i], {"desc->volumes", true}, i));
    }
    if (d.volumes == nullptr) mending.want_all();
    std::optional<dsw::Edit<3>> edit;
    mending.prepare(edit);
    const dsw::MendRecord& record = mending.record();
    dsw::Edit<3>* const change = edit ? &*edit : nullptr;
    capi::MendResults results(env, record, change);
    if (change != nullptr) carry_out_prepared(*change, capi::engine_of<3>(scene));
    results.move_to(handle, change);
    const auto left = static_cast<uint32_t>(record.left.size());
    const dsw_remesh_report done{record.wanted, record.wanted - left, left, record.patches, record.gone,
                                 record.made,   record.most_faces,    0};
    call.done(done, capi::items_of(handle.changes));
    if (report != nullptr) *report = done;
  });
}

dsw_status dsw_environment_get_unmended_volumes(const dsw_environment* environment, const dsw_volume_id** volumes,
                                                size_t* count) {
  return capi::guard("dsw_environment_get_unmended_volumes", [&] {
    capi::hand_out(capi::check_handle(environment, "environment").unmended_volumes, volumes, count, "volumes");
  });
}
