// Bug reports: recordings of one call, made of a scene's recording.

#include <algorithm>
#include <cstring>
#include <memory>

#include "capi/replay.h"
#include "capi/scene_handle.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

using Bytes = dsw::Array<uint8_t>;

void read_file(std::FILE* file, Bytes& bytes) {
  const bool opened = std::fseek(file, 0, SEEK_END) == 0;
  const long size = opened ? std::ftell(file) : -1;
  if (size <= 0) fail(DSW_STATUS_NOT_FOUND, "the scene's recording cannot be read again");
  bytes.resize(static_cast<size_t>(size));
  const bool is_read =
      std::fseek(file, 0, SEEK_SET) == 0 && std::fread(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (std::fseek(file, 0, SEEK_END) != 0 || !is_read) {
    fail(DSW_STATUS_NOT_FOUND, "the scene's recording cannot be read again");
  }
}

/** A recording that ends with the scene as it is. */
void get_recording(dsw_scene& scene, Bytes& bytes) {
  capi::Recording* const own = scene.recording;
  if (own != nullptr && own->writer.works() && own->file != nullptr) return read_file(own->file, bytes);
  if (own != nullptr && own->writer.works() && (own->flags & DSW_RECORDING_LATEST) != 0) {
    bytes.assign(own->kept.begin(), own->kept.end());
    return;
  }
  dsw_recording_desc desc{};
  desc.flags = DSW_RECORDING_LATEST;
  dsw::Owned<capi::Recording> now(capi::memory_of(*scene.environment));
  capi::begin_recording(scene, desc, now);
  bytes.swap(now.get()->kept);
}

size_t count_calls(const Bytes& recording) {
  dsw::RecordReader reader(recording.data(), recording.size());
  size_t calls = 0;
  for (dsw::Entry entry; reader.next(&entry);) {
    if (entry.kind == dsw::EntryKind::kCall) ++calls;
    if (entry.kind == dsw::EntryKind::kRepeated) --calls;
  }
  return calls;
}

void write_note(dsw::RecordWriter& writer, const char* note) {
  constexpr size_t kMostText = size_t{1} << 16;
  const size_t length = std::min(std::strlen(note), kMostText - 1);
  char rest[8] = {};
  const size_t whole = length & ~size_t{7};
  std::memcpy(rest, note + whole, length - whole);
  writer.begin(dsw::EntryKind::kNote, whole + sizeof rest);
  writer.put(note, whole);
  writer.put(rest, sizeof rest);
  writer.end();
}

void check_done(dsw_status status) {
  if (status == DSW_STATUS_OK) return;
  const bool is_cut_off = status == DSW_STATUS_TRUNCATED;  // by somebody else: it was written whole
  fail(is_cut_off ? DSW_STATUS_CORRUPT : status, "making the recording again: %.300s", dsw_last_error_message());
}

/** Makes the calls before the last one again; false if one did something else. */
bool make_others(dsw_replay* replay, size_t count) {
  dsw_replay_report report;
  for (size_t i = 0; i + 1 < count; ++i) {
    check_done(dsw_replay_step(replay, &report));
    if (report.outcome != DSW_REPLAY_SAME) return false;
  }
  return true;
}

}  // namespace

dsw_status dsw_scene_write_bug_report(dsw_scene* scene, const dsw_bug_report_desc* desc, dsw_validation* validation) {
  return capi::guard(__func__, [&] {
    dsw_scene& handle = capi::check_handle(scene);
    const dsw_bug_report_desc d = capi::read_required(desc, "desc", 0);
    if (d.path != nullptr && d.write != nullptr) {
      fail(DSW_STATUS_UNSUPPORTED, "desc->path and desc->write are both set, one of them must be null");
    }
    if (d.path == nullptr) dsw::require(reinterpret_cast<const void*>(d.write), "desc->write");
    if (validation != nullptr) capi::check_size(validation, "validation");

    Bytes recording(capi::memory_of(*handle.environment));
    get_recording(handle, recording);
    dsw_replay* made = nullptr;
    check_done(dsw_replay_create(handle.environment->context, recording.data(), recording.size(), &made));
    const capi::ReplayOwner replay(made);
    bool is_same = make_others(made, count_calls(recording));

    dsw_recording_desc to{};
    to.struct_size = sizeof to;
    to.flags = DSW_RECORDING_STATES | DSW_RECORDING_BUG_REPORT;
    to.path = d.path;
    to.write = d.write;
    to.user = d.user;
    dsw::Owned<capi::Recording> owner(capi::memory_of(*handle.environment));
    capi::begin_recording(*made->scene, to, owner);
    made->scene->recording = owner.release();
    dsw_replay_report report;
    dsw_validation answer{};
    answer.struct_size = sizeof answer;
    check_done(dsw_replay_step_validated(made, &report, &answer));
    is_same = is_same && report.outcome != DSW_REPLAY_DIFFERENT;
    dsw::RecordWriter& writer = made->scene->recording->writer;
    write_note(writer, d.note == nullptr ? "" : d.note);
    answer.struct_size = sizeof answer;
    capi::use_recorded(answer,
                       [&](const void* bytes, size_t size) { writer.write(dsw::EntryKind::kValidation, bytes, size); });
    if (!capi::end_recording(*made->scene)) fail(DSW_STATUS_WRITE_FAILED, "the bug report was not written");
    if (validation != nullptr) capi::write_struct(validation, answer);
    if (!is_same || capi::state_of(handle, true) != capi::state_of(*made->scene, true)) {
      fail(DSW_STATUS_CORRUPT,
           "the replay ends in another state than that of the scene; the bug report has the state of the replay");
    }
  });
}
