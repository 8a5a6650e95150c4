#include "dartsweep/detach.h"

#include "capi/body_access.h"
#include "capi/recorded.h"
#include "scene/detachment.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr uint32_t kMostHalvings = 40;

}  // namespace

dsw_status dsw_environment_detach(dsw_environment* environment, const dsw_detach_desc* desc, dsw_body_id* body,
                                  dsw_change* change) {
  return capi::guard(__func__, [&] {
    dsw_environment& home = capi::check_handle(environment);
    dsw_scene* const scene = capi::only_scene(home);
    if (scene == nullptr) fail(DSW_STATUS_NOT_FOUND, "the environment has no scene for the body");
    dsw::require(body, "body");
    if (change != nullptr) capi::check_size(change, "change");
    const dsw_detach_desc d = capi::read_required(desc, "desc");
    const double gap = capi::to_quarter(d.gap, 0.01, "desc->gap");
    if (d.halvings > kMostHalvings) {
      fail(DSW_STATUS_OUT_OF_RANGE, "desc->halvings is %u, must be at most %u", d.halvings, kMostHalvings);
    }
    const dsw::SweepLevel level = capi::to_level(d.level, DSW_LEVEL_FACES, "desc->level");
    dsw::Scene<3>& engine = capi::space(*scene);
    const dsw::BodyDescription like =
        capi::to_description(engine, {level, d.flags, d.motion_share, d.category, d.mask});
    if (like.may_penetrate) fail(DSW_STATUS_UNSUPPORTED, "desc->flags has DSW_BODY_START_PENETRATING: a piece is free");
    dsw::Environment<3>& env = capi::space(home);
    const dsw::Cell start = capi::to_engine(env.map, d.volume, "desc->volume");
    capi::Recorded call(scene, capi::row_of<dsw_environment_detach>, &d);
    dsw::Detachment detachment(env, engine, start, d.max_volumes == 0 ? SIZE_MAX : d.max_volumes);
    const uint32_t halvings = d.halvings == 0 ? 32 : d.halvings;
    *body = detachment.carry_out(like, gap, 2 * (2 * halvings + 1), home.results);
    call.done(*body, home.results);
    if (change != nullptr) capi::write_struct(change, home.results.change());
  });
}
