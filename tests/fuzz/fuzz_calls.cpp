// Any bytes as a program of calls: every function that changes a scene or its environment, with ids that live, are
// stale or were never given out, and numbers of every kind. No answer may be INTERNAL; in the end all must be free, and
// the recording of it, made again, must end with the same bytes.

#include "calls.h"

namespace {

int append(void* user, const void* bytes, size_t size) {
  auto& all = *static_cast<std::vector<uint8_t>*>(user);
  const auto* const from = static_cast<const uint8_t*>(bytes);
  all.insert(all.end(), from, from + size);
  return 0;
}

/** What was saved must load, which proves that all particles and bodies are where they should be. */
void check_saved(const std::vector<uint8_t>& environment, const std::vector<uint8_t>& scene) {
  dsw_environment* copy = nullptr;
  dsw_fuzz::require(dsw_environment_load(nullptr, environment.data(), environment.size(), &copy) == DSW_STATUS_OK,
                    "an environment loads as it was saved");
  dsw_scene* again = nullptr;
  dsw_fuzz::require(dsw_scene_load(copy, scene.data(), scene.size(), &again) == DSW_STATUS_OK,
                    "everything is free and in its volume");
  dsw_scene_destroy(again);
  dsw_environment_destroy(copy);
}

void check_replay(const std::vector<uint8_t>& recording, const std::vector<uint8_t>& environment,
                  const std::vector<uint8_t>& scene) {
  dsw_replay* replay = nullptr;
  dsw_fuzz::require(dsw_replay_create(nullptr, recording.data(), recording.size(), &replay) == DSW_STATUS_OK,
                    "a recording opens");
  dsw_replay_report report;
  do {
    dsw_fuzz::require(dsw_replay_step(replay, &report) == DSW_STATUS_OK, "a call is made again");
    dsw_fuzz::require(report.outcome == DSW_REPLAY_SAME || report.outcome == DSW_REPLAY_END, "and does the same");
  } while (report.outcome == DSW_REPLAY_SAME);
  dsw_scene* again = nullptr;
  dsw_fuzz::require(dsw_replay_get_scene(replay, &again) == DSW_STATUS_OK, "a replay has a scene");
  dsw_fuzz::require(dsw_fuzz::save(dsw_scene_get_environment(again)) == environment && dsw_fuzz::save(again) == scene,
                    "a replay ends with the same bytes");
  dsw_fuzz::require(dsw_replay_destroy(replay) == DSW_STATUS_OK, "a replay goes");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr int kMostCalls = 60;
  // Not always, it takes most of the time; and not always from the beginning: what has been done before is in its
  // snapshots only.
  const int first_recorded = size % 4 == 0 ? static_cast<int>(size / 4 % 8) : kMostCalls;
  dsw_fuzz::Bytes bytes(data, size);
  const dsw_fuzz::World world = dsw_fuzz::world_of(bytes.byte());
  dsw_environment* const home = dsw_fuzz::make_world(world);
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = bytes.byte() & 0x1fu;
  dsw_scene* scene = nullptr;
  dsw_fuzz::require(dsw_scene_create(home, &desc, &scene) == DSW_STATUS_OK, "a scene");
  std::vector<uint8_t> recording;
  {
    dsw_fuzz::Calls calls(scene, world, &bytes);
    for (int i = 0; i < kMostCalls && !bytes.empty(); ++i) {
      if (i == first_recorded) dsw_fuzz::record(scene, append, &recording);
      const dsw_status status = calls.make();
      dsw_fuzz::require(status != DSW_STATUS_INTERNAL, dsw_last_error_message());
      if (status == DSW_STATUS_OK) dsw_fuzz::check_radii(scene);
    }
    dsw_fuzz::require(dsw_scene_stop_recording(scene) == DSW_STATUS_OK, "its end");
    const std::vector<uint8_t> environment_block = dsw_fuzz::save(home), scene_block = dsw_fuzz::save(scene);
    check_saved(environment_block, scene_block);
    if (!recording.empty()) check_replay(recording, environment_block, scene_block);
    dsw_fuzz::require(dsw_scene_destroy(scene) == DSW_STATUS_OK, "the scene goes");
    dsw_fuzz::require(dsw_environment_destroy(home) == DSW_STATUS_OK, "its environment goes");
  }
  return 0;
}
