#include "dartsweep/record.h"

#include <cerrno>
#include <cstring>

#include "capi/recorded.h"
#include "capi/scene_handle.h"
#include "snapshot/bytes.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr size_t kLeastKept = size_t{1} << 20;

bool write_to_host(void* user, const void* bytes, size_t size) {
  const auto& recording = *static_cast<capi::Recording*>(user);
  return recording.write(recording.user, bytes, size) == 0;
}

int write_to_file(void* user, const void* bytes, size_t size) {
  return std::fwrite(bytes, 1, size, static_cast<std::FILE*>(user)) == size ? 0 : 1;
}

int keep_in_memory(void* user, const void* bytes, size_t size) {
  auto& kept = *static_cast<dsw::Array<uint8_t>*>(user);
  const auto* const from = static_cast<const uint8_t*>(bytes);
  try {
    kept.insert(kept.end(), from, from + size);
    return 0;
  } catch (...) {
    return 1;
  }
}

/** Whether the environment reads points of the host's, and for how many vertices there is room. */
struct Lending {
  uint64_t is_borrowed, room;
};

uint64_t room_of(const dsw_scene& scene) {
  if (scene.watch != nullptr) return scene.watch->room;
  return capi::visit(*scene.environment,
                     [](const auto& env) -> uint64_t { return env.lent == nullptr ? 0 : env.point_room; });
}

template <class Saved>
dsw::Array<uint8_t> saved_block(const Saved& saved) {
  dsw::Array<uint8_t> block(snapshot_bytes(saved), 0, saved.memory);
  save(saved, block.data());
  return block;
}

template <class Saved>
void write_snapshot(const Saved& saved, dsw::EntryKind kind, const Lending* lending, dsw::RecordWriter& writer) {
  const dsw::Array<uint8_t> block = saved_block(saved);
  writer.begin(kind, block.size() + (lending == nullptr ? 0 : sizeof *lending));
  if (lending != nullptr) writer.put(lending, sizeof *lending);
  writer.put(block.data(), block.size());
  writer.end();
}

void write_beginning(const dsw_scene& scene, capi::Recording& recording) {
  const uint32_t maker[2] = {dsw_version(), recording.flags};
  recording.writer.write_header();
  recording.writer.write(dsw::EntryKind::kMaker, maker, sizeof maker);
  capi::visit(scene, [&](const auto& engine) {
    const Lending lending{engine.env.owned_points.empty() ? 1u : 0u, room_of(scene)};
    write_snapshot(engine.env, dsw::EntryKind::kEnvironment, &lending, recording.writer);
    write_snapshot(engine, dsw::EntryKind::kScene, nullptr, recording.writer);
  });
  recording.most_kept = recording.kept.size() + std::max(kLeastKept, 2 * recording.kept.size());
}

}  // namespace

namespace dsw::capi {

Recording::Recording(const Memory* memory, const dsw_recording_desc& desc)
    : writer({write_to_host, this}), flags(desc.flags), write(desc.write), user(desc.user), kept(memory) {
  if ((flags & DSW_RECORDING_LATEST) != 0) {
    write = keep_in_memory;
    user = &kept;
  }
  if (desc.path == nullptr) return;
  file = std::fopen(desc.path, "w+b");
  if (file == nullptr) {
    fail(DSW_STATUS_WRITE_FAILED, "desc->path, %.200s, cannot be written: %s", desc.path, std::strerror(errno));
  }
  std::setvbuf(file, nullptr, _IONBF, 0);  // what was written is the system's at once
  write = write_to_file;
  user = file;
}

Recording::~Recording() {
  if (file != nullptr) std::fclose(file);
}

void begin_recording(const dsw_scene& scene, const dsw_recording_desc& desc, Owned<Recording>& made) {
  made.make(capi::memory_of(*scene.environment), desc);
  write_beginning(scene, *made.get());
  if (!made.get()->writer.works()) fail(DSW_STATUS_WRITE_FAILED, "the start of the recording was not written");
}

bool end_recording(dsw_scene& scene) noexcept {
  Recording* const recording = std::exchange(scene.recording, nullptr);
  if (recording == nullptr) return true;
  const bool works = recording->writer.works();
  recording->~Recording();
  release_bytes(capi::memory_of(*scene.environment), recording, sizeof *recording, alignof(Recording));
  return works;
}

uint64_t state_of(const dsw_scene& scene, bool with_environment, uint32_t format) {
  return visit(scene, [&](const auto& engine) {
    const uint64_t sum = state_checksum(engine, format);
    if (!with_environment) return sum;
    const Array<uint8_t> whole = saved_block(engine.env);
    return checksum(sum, whole.data(), whole.size());
  });
}

/** Begins a recording in memory anew where it has grown too long, or did not go on for want of memory. */
static void renew_kept(dsw_scene& scene) noexcept {
  Recording& recording = *scene.recording;
  if ((recording.flags & DSW_RECORDING_LATEST) == 0) return;
  if (recording.writer.works() && recording.kept.size() <= recording.most_kept) return;
  dsw_recording_desc desc{};
  desc.flags = recording.flags;
  try {
    Owned<Recording> owner(capi::memory_of(*scene.environment));
    begin_recording(scene, desc, owner);
    recording.kept.swap(owner.get()->kept);
    recording.most_kept = owner.get()->most_kept;
    recording.writer.renew();
  } catch (...) {  // next time
  }
}

void Recorded::write_call(uint64_t number, const void* row, const void* given,
                          void (*put)(const void* row, const void* given, const CallPlace& place,
                                      const WordSink& use)) noexcept {
  const CallPlace place{scene_, nullptr, is_planar(*scene_) ? 2u : 3u};
  size_t size = sizeof number;
  put(row, given, place,
      {&size, [](void* sum, const void*, size_t bytes) { *static_cast<size_t*>(sum) += (bytes + 7) & ~size_t{7}; }});
  renew_kept(*scene_);
  RecordWriter& writer = scene_->recording->writer;
  writer.begin(EntryKind::kCall, size);
  writer.put(&number, sizeof number);
  put(row, given, place,
      {&writer, [](void* to, const void* bytes, size_t count) { static_cast<RecordWriter*>(to)->put(bytes, count); }});
  writer.end();
}

void Recorded::finish(bool failed, uint64_t digest) noexcept {
  dsw_scene& scene = *std::exchange(scene_, nullptr);
  const bool wants_state = scene.recording != nullptr && (scene.recording->flags & DSW_RECORDING_STATES) != 0;
  CallResult now;
  now.made = true;
  now.failed = failed;
  now.digest = digest;
  const auto take_state = [&](CallResult& to, uint32_t format) {
    try {
      to.state = state_of(scene, with_environment_, format);
      to.has_state = true;
    } catch (...) {  // no memory: a call that is recorded without
    }
  };
  if (scene.watch != nullptr) {
    scene.watch->last = now;
    if (!failed && scene.watch->wants_state) take_state(scene.watch->last, scene.watch->state_format);
  }
  if (!failed && wants_state) take_state(now, kSceneFormat);
  if (scene.recording == nullptr) return;
  const uint64_t result[kMostResultWords] = {failed ? 1u : 0u, digest, now.state};
  const size_t size = (wants_state && now.has_state ? kMostResultWords : kResultWords) * sizeof(uint64_t);
  scene.recording->writer.write(EntryKind::kResult, result, size);
}

}  // namespace dsw::capi

dsw_status dsw_scene_start_recording(dsw_scene* scene, const dsw_recording_desc* desc) {
  return capi::guard(__func__, [&] {
    dsw_scene& handle = capi::check_handle(scene);
    const dsw_recording_desc d = capi::read_required(desc, "desc", DSW_RECORDING_STATES | DSW_RECORDING_LATEST);
    const bool is_kept = (d.flags & DSW_RECORDING_LATEST) != 0;
    if ((d.path != nullptr) + (d.write != nullptr) + is_kept > 1) {
      fail(DSW_STATUS_UNSUPPORTED, "only one of desc->path, desc->write and DSW_RECORDING_LATEST can be set");
    }
    if (d.path == nullptr && !is_kept) dsw::require(reinterpret_cast<const void*>(d.write), "desc->write");
    if (handle.recording != nullptr) fail(DSW_STATUS_IN_USE, "the scene is being recorded");
    dsw::Owned<capi::Recording> owner(capi::memory_of(*handle.environment));
    capi::begin_recording(handle, d, owner);
    handle.recording = owner.release();
  });
}

dsw_status dsw_scene_stop_recording(dsw_scene* scene) {
  return capi::guard(__func__, [&] {
    if (!capi::end_recording(capi::check_handle(scene))) {
      fail(DSW_STATUS_WRITE_FAILED, "the recording is incomplete: something was not written");
    }
  });
}
