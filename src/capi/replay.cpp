#include "capi/replay.h"

#include "dartsweep/record.h"
#include "environment/moving.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::Entry next_entry(dsw_replay& replay, dsw::EntryKind kind, const char* what) {
  dsw::Entry entry;
  if (!replay.reader.next(&entry)) fail(DSW_STATUS_TRUNCATED, "the recording ends before %s", what);
  if (entry.kind != kind) fail(DSW_STATUS_CORRUPT, "the recording is damaged: no %s where it should be", what);
  return entry;
}

/** As when the host had lent its points: with the same room, since changes depend on it. */
void lend_points(dsw_replay& replay, uint64_t room) {
  dsw::Environment<3>& env = replay.environment->engine;
  const size_t count = env.map.vertex_count;
  if (room > dsw::kVertexMask || (room != 0 && room < count))
    fail(DSW_STATUS_CORRUPT, "the recording is damaged: points");
  dsw::Array<double>& points = replay.points[0];
  points.resize(3 * std::max(count, static_cast<size_t>(room)));
  std::copy_n(env.points, 3 * count, points.data());
  env.points = points.data();
  env.lent = room == 0 ? nullptr : points.data();
  env.point_room = static_cast<size_t>(room);
  release_owned_points(env);
}

void load_beginning(dsw_replay& replay) {
  const dsw::Entry first = next_entry(replay, dsw::EntryKind::kEnvironment, "its environment");
  uint64_t lending[2];
  if (first.size < sizeof lending) fail(DSW_STATUS_CORRUPT, "the recording is damaged: its environment");
  std::memcpy(lending, first.bytes, sizeof lending);
  capi::EnvironmentOwner environment(replay.context);
  load(environment->engine, first.bytes + sizeof lending, first.size - sizeof lending);
  replay.environment = environment.take();
  const dsw::Entry second = next_entry(replay, dsw::EntryKind::kScene, "its scene");
  capi::SceneOwner scene(*replay.environment, dsw::saved_features(second.bytes, second.size));
  load(scene->engine, second.bytes, second.size);
  replay.scene = scene.enter();
  replay.scene->watch = &replay.watch;
  if (lending[0] != 0) lend_points(replay, lending[1]);
}

}  // namespace

dsw_replay::dsw_replay(dsw_context* owner, const uint8_t* bytes, size_t size)
    : context(owner),
      reader(bytes, size),
      words(dsw::Allocator<uint64_t>(capi::memory_of(owner))),
      points{dsw::Array<double>(dsw::Allocator<double>(capi::memory_of(owner))),
             dsw::Array<double>(dsw::Allocator<double>(capi::memory_of(owner)))} {
  capi::retain(owner);
}

dsw_replay::~dsw_replay() {
  if (scene != nullptr) {
    const dsw::Memory* const memory = environment->engine.memory;
    capi::detach(*scene);
    capi::destroy_object(memory, scene);
  }
  if (environment != nullptr) capi::destroy_environment(environment);
  capi::release(context);
}

dsw_status dsw_replay_create(dsw_context* context, const void* recording, size_t size_bytes, dsw_replay** replay) {
  return capi::guard("dsw_replay_create", [&] {
    capi::check_context(context);
    capi::require(recording, "recording");
    capi::require(replay, "replay");
    const dsw::Memory* const memory = capi::memory_of(context);
    dsw_replay* const made =
        capi::create_object<dsw_replay>(memory, context, static_cast<const uint8_t*>(recording), size_bytes);
    try {
      load_beginning(*made);
    } catch (...) {
      capi::destroy_object(memory, made);
      throw;
    }
    *replay = made;
  });
}

dsw_status dsw_replay_destroy(dsw_replay* replay) {
  return capi::guard("dsw_replay_destroy", [&] {
    if (replay == nullptr) return;
    dsw_replay& handle = capi::check_handle(replay, "replay");
    const uint32_t scenes = capi::scene_count(*handle.environment);
    if (scenes != 1) fail(DSW_STATUS_IN_USE, "%u scenes use the environment of the replay", scenes);
    capi::destroy_object(capi::memory_of(handle.context), replay);
  });
}

dsw_status dsw_replay_get_scene(const dsw_replay* replay, dsw_scene** scene) {
  return capi::guard("dsw_replay_get_scene", [&] {
    const dsw_replay& handle = capi::check_handle(replay, "replay");
    capi::require(scene, "scene");
    *scene = handle.scene;
  });
}

dsw_status dsw_replay_step(dsw_replay* replay, dsw_replay_report* report) {
  return capi::guard("dsw_replay_step", [&] {
    dsw_replay& handle = capi::check_handle(replay, "replay");
    capi::require(report, "report");
    dsw_replay_report step{};
    step.call = handle.calls;
    step.outcome = DSW_REPLAY_END;
    dsw::RecordReader reader = handle.reader;
    dsw::Entry entry;
    if (!reader.next(&entry)) {
      *report = step;
      return;
    }
    if (entry.kind != dsw::EntryKind::kCall)
      fail(DSW_STATUS_CORRUPT, "the recording is damaged: no call where it should be");
    handle.words.resize(entry.size / sizeof(uint64_t));
    std::memcpy(handle.words.data(), entry.bytes, entry.size);
    capi::Arguments arguments(handle.words);
    const auto number = arguments.get<uint64_t>();
    const capi::Call call =
        number < static_cast<uint64_t>(capi::Call::kCount) ? static_cast<capi::Call>(number) : capi::Call::kCount;
    capi::ReplayRow row = capi::environment_row(call);
    if (row.function == nullptr) row = capi::body_row(call);
    if (row.function == nullptr)
      fail(DSW_STATUS_CORRUPT, "the recording has call number %llu, which this version does not know",
           static_cast<unsigned long long>(number));
    step.function = row.function;
    uint64_t result[2] = {};
    const bool is_finished = reader.next(&entry);
    if (is_finished) {
      if (entry.kind != dsw::EntryKind::kResult || entry.size != sizeof result) {
        fail(DSW_STATUS_CORRUPT, "the recording is damaged: no result where it should be");
      }
      std::memcpy(result, entry.bytes, sizeof result);
    }
    handle.watch = capi::CallWatch{};
    step.status = row.make(handle, arguments);
    const capi::CallWatch& now = handle.watch;
    const bool failed = !now.made || now.failed;
    step.has_failed = result[0] != 0 ? 1u : 0u;
    const bool is_same = failed == (result[0] != 0) && (failed || now.digest == result[1]);
    step.outcome = !is_finished ? DSW_REPLAY_UNFINISHED : is_same ? DSW_REPLAY_SAME : DSW_REPLAY_DIFFERENT;
    handle.reader = reader;
    ++handle.calls;
    *report = step;
  });
}
