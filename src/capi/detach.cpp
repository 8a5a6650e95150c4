#include "dartsweep/detach.h"

#include "capi/body_access.h"
#include "capi/recorded.h"
#include "scene/detachment.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr uint32_t kMostHalvings = 40;

dsw_detach_desc default_detachment() noexcept {
  dsw_detach_desc d{};
  d.level = DSW_LEVEL_EDGES_SWEPT;
  return d;
}

void check_numbers(const dsw_detach_desc& d) {
  if (!(d.gap >= 0 && d.gap <= 0.25)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->gap is %g, must be above 0 and at most 0.25, or 0", d.gap);
  }
  if (d.halvings > kMostHalvings) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->halvings is %u, must be %u at most", d.halvings, kMostHalvings);
  }
}

}  // namespace

void dsw_detach_desc_init(dsw_detach_desc* desc, size_t size) { capi::init_struct(desc, size, default_detachment()); }

dsw_status dsw_scene_detach(dsw_scene* scene, const dsw_detach_desc* desc, dsw_body_id* body,
                            dsw_detach_report* report) {
  return capi::guard(__func__, [&] {
    dsw_scene& handle = capi::check_handle(scene);
    dsw_environment& home = *handle.environment;
    capi::only_scene(home);
    capi::require(body, "body");
    const dsw_detach_desc d = capi::read_required(desc, "desc");
    check_numbers(d);
    const dsw::SweepLevel level = capi::to_level(d.level, DSW_LEVEL_FACES, "desc->level");
    const dsw::BodyDescription like =
        capi::to_description(capi::space(handle), {level, d.flags, d.motion_share, d.category, d.mask});
    dsw::Environment<3>& env = capi::space(home);
    const dsw::Cell start = capi::to_cell(env.map, d.volume, {"desc->volume", false});
    capi::Recorded call(scene, capi::row_of<dsw_scene_detach>, &d);
    dsw::Detachment detachment(env, capi::space(handle), start, d.max_volumes == 0 ? SIZE_MAX : d.max_volumes);
    const double gap = d.gap == 0 ? 0.01 : d.gap;
    const uint32_t halvings = d.halvings == 0 ? 32 : d.halvings;
    const dsw_detach_report done = detachment.carry_out(like, gap, 2 * (2 * halvings + 1), body, handle.detached);
    home.results.volumes.clear();
    call.done(*body, done);
    if (report != nullptr) *report = done;
  });
}

dsw_status dsw_scene_get_detached_volumes(const dsw_scene* scene, const dsw_volume_id** volumes, size_t* count) {
  return capi::lend(__func__, scene, &dsw::DetachResults::volumes, volumes, count, "volumes");
}

dsw_status dsw_scene_get_detached_vertices(const dsw_scene* scene, const dsw_detached_vertex** vertices,
                                           size_t* count) {
  return capi::lend(__func__, scene, &dsw::DetachResults::vertices, vertices, count, "vertices");
}

dsw_status dsw_scene_get_detached_faces(const dsw_scene* scene, const dsw_detached_face** faces, size_t* count) {
  return capi::lend(__func__, scene, &dsw::DetachResults::faces, faces, count, "faces");
}
