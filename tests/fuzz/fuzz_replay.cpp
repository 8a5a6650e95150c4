// Any bytes as a program of calls, as in fuzz_calls, whose recording is then damaged in the arguments of its calls, with all checksums right
// again. A recording is not trusted: each call is made, refused or CORRUPT, and in the end all must load as it was saved, and be free.

#include <cstring>

#include "calls.h"
#include "capi/recorded.h"

namespace {

constexpr auto kDeform = static_cast<uint64_t>(dsw::capi::Call::kDeform);
constexpr size_t kPointRoom = 1 + offsetof(dsw_deform_options, point_room) / 8;  // its word: so much is allocated

bool append(void* user, const void* bytes, size_t size) {
  auto& all = *static_cast<std::vector<uint8_t>*>(user);
  const auto* const from = static_cast<const uint8_t*>(bytes);
  all.insert(all.end(), from, from + size);
  return true;
}
int append_to(void* user, const void* bytes, size_t size) { return append(user, bytes, size) ? 0 : 1; }

std::vector<uint8_t> record(dsw_fuzz::Bytes* bytes) {
  constexpr int kMostCalls = 12;
  std::vector<uint8_t> recording;
  dsw_environment* const home = dsw_fuzz::make_home();
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = bytes->byte() & 0x1fu;
  dsw_scene* scene = nullptr;
  dsw_fuzz::require(dsw_scene_create(home, &desc, &scene) == DSW_STATUS_OK, "a scene");
  dsw_recording_desc to;
  dsw_recording_desc_init(&to, sizeof to);
  to.write = append_to;
  to.user = &recording;
  dsw_fuzz::require(dsw_scene_start_recording(scene, &to) == DSW_STATUS_OK, "a recording");
  {
    dsw_fuzz::Calls calls(scene, bytes);
    for (int i = 0; i < kMostCalls && !bytes->empty(); ++i) calls.make();
    dsw_scene_destroy(scene);
    dsw_environment_destroy(home);
  }
  return recording;
}

/** Words that are at the ends of something, and others. */
uint64_t odd_word(uint64_t was, uint32_t which, uint32_t more) {
  const uint64_t one = 1;
  switch (which) {
    case 0:
      return more;
    case 1:
      return was + more;
    case 2:
      return ~uint64_t{more};
    case 3:
      return was ^ one << more % 64;
    case 4:
      return one << more % 64;
    case 5:
      return UINT64_MAX / (more + 1) + 1;
    case 6:
      return was ^ uint64_t { more } << 8 * (more % 8);
    default:
      return uint64_t{0x7ff8} << 48;  // not a number
  }
}

std::vector<uint8_t> damaged(const std::vector<uint8_t>& recording, dsw_fuzz::Bytes* bytes) {
  std::vector<uint8_t> made;
  dsw::RecordReader reader(recording.data(), recording.size());
  dsw::RecordWriter writer({append, &made});
  writer.write_header();
  dsw::Entry entry;
  while (reader.next(&entry)) {
    std::vector<uint64_t> words(entry.size / 8);
    std::memcpy(words.data(), entry.bytes, entry.size);
    if (entry.kind == dsw::EntryKind::kCall) {
      for (uint32_t i = bytes->below(4); i != 0; --i) {
        uint64_t& word = words[bytes->byte() % words.size()];
        const uint32_t which = bytes->below(8);
        word = odd_word(word, which, bytes->byte());
      }
      if (bytes->below(8) == 7) words.resize(1 + bytes->byte() % (2 * words.size()));
      if (words[0] == kDeform && words.size() > kPointRoom) words[kPointRoom] %= 1024;
    }
    writer.begin(entry.kind, 8 * words.size());
    writer.put(words.data(), 8 * words.size());
    writer.end();
  }
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  dsw_fuzz::Bytes damage(data, size / 3), program(data + size / 3, size - size / 3);
  const std::vector<uint8_t> recording = damaged(record(&program), &damage);
  dsw_replay* replay = nullptr;
  dsw_fuzz::require(dsw_replay_create(nullptr, recording.data(), recording.size(), &replay) == DSW_STATUS_OK,
                    "a recording opens");
  dsw_replay_report report;
  dsw_status status;
  do {
    status = dsw_replay_step(replay, &report);
    dsw_fuzz::require(status == DSW_STATUS_OK || status == DSW_STATUS_CORRUPT || status == DSW_STATUS_UNSUPPORTED ||
                          status == DSW_STATUS_BAD_STRUCT_SIZE,
                      dsw_last_error_message());
    dsw_fuzz::require(status != DSW_STATUS_OK || report.status != DSW_STATUS_INTERNAL, dsw_last_error_message());
  } while (status == DSW_STATUS_OK && report.outcome != DSW_REPLAY_END);
  dsw_scene* scene = nullptr;
  dsw_fuzz::require(dsw_replay_get_scene(replay, &scene) == DSW_STATUS_OK, "a replay has a scene");
  const std::vector<uint8_t> environment_block = dsw_fuzz::save(dsw_scene_get_environment(scene)),
                             scene_block = dsw_fuzz::save(scene);
  dsw_environment* environment = nullptr;
  dsw_fuzz::require(
      dsw_environment_load(nullptr, environment_block.data(), environment_block.size(), &environment) == DSW_STATUS_OK,
      "an environment loads as it was saved");
  dsw_scene* again = nullptr;
  dsw_fuzz::require(dsw_scene_load(environment, scene_block.data(), scene_block.size(), &again) == DSW_STATUS_OK,
                    "everything is free and in its volume");
  dsw_scene_destroy(again);
  dsw_environment_destroy(environment);
  dsw_fuzz::require(dsw_replay_destroy(replay) == DSW_STATUS_OK, "a replay goes");
  return 0;
}
