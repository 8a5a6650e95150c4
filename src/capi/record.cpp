#include "dartsweep/record.h"

#include <cerrno>
#include <cstring>

#include "capi/recorded.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

bool write_to_host(void* user, const void* bytes, size_t size) {
  const auto& recording = *static_cast<capi::Recording*>(user);
  return recording.write(recording.user, bytes, size) == 0;
}

int write_to_file(void* user, const void* bytes, size_t size) {
  return std::fwrite(bytes, 1, size, static_cast<std::FILE*>(user)) == size ? 0 : 1;
}

/** A file without a buffer, so that what was written is the system's at once. */
void open_file(capi::Recording& recording, const char* path) {
  recording.file = std::fopen(path, "wb");
  if (recording.file == nullptr) {
    fail(DSW_STATUS_WRITE_FAILED, "desc->path, %.200s, can't be written: %s", path, std::strerror(errno));
  }
  std::setvbuf(recording.file, nullptr, _IONBF, 0);
  recording.write = write_to_file;
  recording.user = recording.file;
}

/** Whether the environment reads points of the host's, and for how many vertices there is room. */
struct Lending {
  uint64_t is_borrowed, room;
};

template <class Saved>
void write_snapshot(const Saved& saved, dsw::EntryKind kind, const Lending* lending, dsw::RecordWriter& writer) {
  dsw::Array<uint8_t> block{dsw::Allocator<uint8_t>(saved.memory)};
  block.resize(snapshot_bytes(saved));
  save(saved, block.data());
  writer.begin(kind, block.size() + (lending == nullptr ? 0 : sizeof *lending));
  if (lending != nullptr) writer.put(lending, sizeof *lending);
  writer.put(block.data(), block.size());
  writer.end();
}

}  // namespace

namespace dsw::capi {

Recording::Recording(dsw_write_fn function, void* argument) noexcept
    : writer({write_to_host, this}), write(function), user(argument) {}

Recording::~Recording() {
  if (file != nullptr) std::fclose(file);
}

bool end_recording(dsw_scene& scene) noexcept {
  Recording* const recording = std::exchange(scene.recording, nullptr);
  if (recording == nullptr) return true;
  const bool works = recording->writer.works();
  recording->~Recording();
  release_bytes(scene.environment->engine.memory, recording, sizeof *recording, alignof(Recording));
  return works;
}

void Recorded::finish(bool failed, uint64_t digest) noexcept {
  dsw_scene& scene = *std::exchange(scene_, nullptr);
  if (scene.watch != nullptr) *scene.watch = {digest, true, failed};
  if (scene.recording == nullptr) return;
  RecordWriter& writer = scene.recording->writer;
  const uint64_t result[2] = {failed ? 1u : 0u, digest};
  writer.begin(EntryKind::kResult, sizeof result);
  writer.put(result, sizeof result);
  writer.end();
}

}  // namespace dsw::capi

void dsw_recording_desc_init(dsw_recording_desc* desc, size_t size) {
  capi::init_struct(desc, size, dsw_recording_desc{});
}

dsw_status dsw_scene_start_recording(dsw_scene* scene, const dsw_recording_desc* desc) {
  return capi::guard("dsw_scene_start_recording", [&] {
    dsw_scene& handle = capi::check_handle(scene, "scene");
    capi::require(desc, "desc");
    const dsw_recording_desc d = capi::read_struct(desc, "desc");
    if (d.flags != 0) fail(DSW_STATUS_UNSUPPORTED, "desc->flags is %u, must be 0", d.flags);
    if (d.path != nullptr && d.write != nullptr) {
      fail(DSW_STATUS_UNSUPPORTED, "desc->path and desc->write are both set, one of them must be null");
    }
    if (d.path == nullptr) capi::require(reinterpret_cast<const void*>(d.write), "desc->write");
    if (handle.recording != nullptr) fail(DSW_STATUS_IN_USE, "the scene is being recorded");
    const dsw::Environment<3>& env = handle.environment->engine;
    dsw::Owned<capi::Recording> owner(env.memory);
    owner.make(d.write, d.user);
    capi::Recording& recording = *owner.get();
    if (d.path != nullptr) open_file(recording, d.path);
    const Lending lending{env.owned_points.empty() ? 1u : 0u, env.lent == nullptr ? 0 : env.point_room};
    recording.writer.write_header();
    write_snapshot(env, dsw::EntryKind::kEnvironment, &lending, recording.writer);
    write_snapshot(handle.engine, dsw::EntryKind::kScene, nullptr, recording.writer);
    if (!recording.writer.works()) fail(DSW_STATUS_WRITE_FAILED, "the beginning could not be written");
    handle.recording = owner.release();
  });
}

dsw_status dsw_scene_stop_recording(dsw_scene* scene) {
  return capi::guard("dsw_scene_stop_recording", [&] {
    if (!capi::end_recording(capi::check_handle(scene, "scene"))) {
      fail(DSW_STATUS_WRITE_FAILED, "the recording ends early: something could not be written");
    }
  });
}
