#include "dartsweep/scene.h"

#include "capi/convert.h"
#include "capi/recorded.h"
#include "capi/scene_handle.h"

namespace capi = dsw::capi;
using dsw::fail;

dsw_status dsw_scene_create(dsw_environment* environment, const dsw_scene_desc* desc, dsw_scene** scene) {
  return capi::guard(__func__, [&] {
    dsw_environment& home = capi::check_handle(environment);
    dsw::require(scene, "scene");
    const dsw_scene_desc d = capi::read_optional(desc, "desc");
    dsw::check_flags(d.features,
                     DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS | DSW_FEATURE_DEFORMING |
                         DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_LIVE_CHANGES,
                     "desc->features");
    const dsw::SceneFeatures features{
        (d.features & DSW_FEATURE_STATISTICS) != 0, (d.features & DSW_FEATURE_CROSSINGS) != 0,
        (d.features & DSW_FEATURE_DEFORMING) != 0, (d.features & DSW_FEATURE_BODY_CONTACTS) != 0,
        (d.features & DSW_FEATURE_LIVE_CHANGES) != 0};
    *scene = enter(capi::make_scene(home, features));
  });
}

dsw_status dsw_scene_destroy(dsw_scene* scene) {
  return capi::guard(__func__, [&] {
    if (scene == nullptr) return;
    if (capi::check_handle(scene).watch != nullptr) fail(DSW_STATUS_IN_USE, "the scene belongs to a replay");
    capi::detach(*scene);
    capi::destroy_scene(scene);
  });
}

dsw_environment* dsw_scene_get_environment(const dsw_scene* scene) {
  dsw_environment* environment = nullptr;
  capi::guard(__func__, [&] {
    if (scene != nullptr) environment = capi::check_handle(scene).environment;
  });
  return environment;
}

dsw_status dsw_scene_get_statistics(const dsw_scene* scene, dsw_statistics* statistics) {
  return capi::guarded_visit(__func__, scene, [&](const auto& engine) {
    capi::check_enabled(engine.features.statistics, "DSW_FEATURE_STATISTICS");
    const dsw::SceneStatistics& from = engine.statistics;
    dsw_statistics s{};
    s.casts = from.cast.casts;
    s.volumes_visited = from.cast.volumes_visited;
    s.orientation_tests = from.cast.orientation_tests;
    s.exact_fallbacks = from.cast.exact_fallbacks;
    s.ties = from.cast.ties;
    s.forecast_hits = from.forecast_hits;
    s.contacts = from.contacts;
    s.candidates = from.candidates;
    s.occupants_tested = from.looked_at;
    capi::give_struct(statistics, "statistics", s);
  });
}

dsw_status dsw_scene_reset_statistics(dsw_scene* scene) {
  return capi::guarded_visit(__func__, scene, [&](auto& engine) {
    capi::check_enabled(engine.features.statistics, "DSW_FEATURE_STATISTICS");
    capi::Recorded call(scene, capi::row_of<dsw_scene_reset_statistics>);
    engine.statistics = dsw::SceneStatistics{};
    call.done();
  });
}

dsw_status dsw_scene_get_memory_bytes(const dsw_scene* scene, uint64_t* bytes) {
  return capi::guarded_visit(__func__, scene, [&](const auto& engine) {
    capi::give<uint64_t>(bytes, "bytes", engine.memory_bytes() + sizeof *scene - sizeof engine);
  });
}
