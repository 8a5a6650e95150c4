#include "dartsweep/scene.h"

#include "capi/convert.h"
#include "capi/recorded.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

template <int D>
void require_statistics(const dsw::Scene<D>& scene) {
  if (!scene.features.statistics) fail(DSW_STATUS_NOT_ENABLED, "the scene does not enable DSW_FEATURE_STATISTICS");
}

}  // namespace

void dsw_scene_desc_init(dsw_scene_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_scene_desc{}); }

dsw_status dsw_scene_create(dsw_environment* environment, const dsw_scene_desc* desc, dsw_scene** scene) {
  return capi::guard(__func__, [&] {
    dsw_environment& home = capi::check_handle(environment);
    capi::require(scene, "scene");
    const dsw_scene_desc d = capi::read_optional(desc, "desc");
    capi::check_flags(d.features,
                      DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS | DSW_FEATURE_DEFORMING |
                          DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_LIVE_CHANGES,
                      "desc->features");
    const dsw::SceneFeatures features{
        (d.features & DSW_FEATURE_STATISTICS) != 0, (d.features & DSW_FEATURE_CROSSINGS) != 0,
        (d.features & DSW_FEATURE_DEFORMING) != 0, (d.features & DSW_FEATURE_BODY_CONTACTS) != 0,
        (d.features & DSW_FEATURE_LIVE_CHANGES) != 0};
    capi::SceneOwner owner(home, features);
    *scene = owner.enter();
  });
}

dsw_status dsw_scene_destroy(dsw_scene* scene) {
  return capi::guard(__func__, [&] {
    if (scene == nullptr) return;
    const dsw::Memory* const memory = capi::memory_of(*capi::check_handle(scene).environment);
    if (scene->watch != nullptr) fail(DSW_STATUS_IN_USE, "the scene belongs to a replay");
    capi::detach(*scene);
    capi::destroy_object(memory, scene);
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
    require_statistics(engine);
    const dsw::SceneStatistics& from = engine.statistics;
    capi::require(statistics, "statistics");
    capi::check_size(statistics, "statistics");
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
    capi::write_struct(statistics, s);
  });
}

dsw_status dsw_scene_reset_statistics(dsw_scene* scene) {
  return capi::guarded_visit(__func__, scene, [&](auto& engine) {
    require_statistics(engine);
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
