// Any bytes as a program of calls, as in fuzz_calls, whose recording is then damaged in the arguments of its calls,
// with all checksums right again. A recording is not trusted: each call is made, refused or CORRUPT, and in the end all
// must load as it was saved, and be free.

#include <cstring>

#include "calls.h"

namespace {

// These numbers are those of src/snapshot/README.md and capi/words.h. The host is taken to be little endian, as all are
// that fuzz.
constexpr uint32_t kCall = 3;  // a kind of entry
constexpr size_t kHeaderWords = 2, kHeadWords = 2;

using Words = std::vector<uint64_t>;

uint64_t sum_of(const uint64_t* words, size_t count) {
  uint64_t sum = 0;
  for (size_t i = 0; i < count; ++i) {
    sum = (sum ^ words[i]) * 0x9e3779b97f4a7c15u;
    sum ^= sum >> 32;
  }
  return sum;
}

void append_entry(uint32_t kind, const Words& content, Words* recording) {
  const size_t at = recording->size();
  const uint64_t head[] = {kind, 8 * content.size()};
  recording->push_back(kind | sum_of(head, 2) << 32);
  recording->push_back(head[1]);
  recording->insert(recording->end(), content.begin(), content.end());
  recording->push_back(sum_of(recording->data() + at, recording->size() - at));
}

int append_to(void* user, const void* bytes, size_t size) {
  auto& all = *static_cast<Words*>(user);
  dsw_fuzz::require(size % 8 == 0, "recordings are written in words");
  all.resize(all.size() + size / 8);
  std::memcpy(all.data() + all.size() - size / 8, bytes, size);
  return 0;
}

Words record(dsw_fuzz::Bytes* bytes) {
  constexpr int kMostCalls = 12;
  Words recording;
  const dsw_fuzz::World world = dsw_fuzz::world_of(bytes->byte());
  dsw_environment* const home = dsw_fuzz::make_world(world);
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = bytes->byte() & 0x1fu;
  dsw_scene* scene = nullptr;
  dsw_fuzz::require(dsw_scene_create(home, &desc, &scene) == DSW_STATUS_OK, "a scene");
  dsw_fuzz::record(scene, append_to, &recording);
  {
    dsw_fuzz::Calls calls(scene, world, bytes);
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

Words damaged(const Words& recording, dsw_fuzz::Bytes* bytes) {
  Words made(recording.begin(), recording.begin() + kHeaderWords);
  for (size_t at = kHeaderWords; at < recording.size();) {
    const auto kind = static_cast<uint32_t>(recording[at]);
    const auto first = recording.begin() + static_cast<std::ptrdiff_t>(at + kHeadWords);
    Words words(first, first + static_cast<std::ptrdiff_t>(recording[at + 1] / 8));
    at += kHeadWords + words.size() + 1;
    if (kind == kCall) {
      for (uint32_t i = bytes->below(4); i != 0; --i) {
        uint64_t& word = words[bytes->byte() % words.size()];
        const uint32_t which = bytes->below(8);
        word = odd_word(word, which, bytes->byte());
      }
      if (bytes->below(8) == 7) words.resize(1 + bytes->byte() % (2 * words.size()));
    }
    append_entry(kind, words, &made);
  }
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  dsw_fuzz::Bytes none(nullptr, 0), damage(data, size / 3), program(data + size / 3, size - size / 3);
  const Words recorded = record(&program);
  dsw_fuzz::require(damaged(recorded, &none) == recorded, "append_entry() still knows the format");
  const Words recording = damaged(recorded, &damage);
  dsw_replay* replay = nullptr;
  dsw_fuzz::require(dsw_replay_create(nullptr, recording.data(), 8 * recording.size(), &replay) == DSW_STATUS_OK,
                    "a recording opens");
  dsw_replay_report report;
  dsw_status status;
  dsw_validation validation;
  validation.struct_size = sizeof validation;
  do {
    char text[64];
    size_t text_size = 0;
    status = dsw_replay_describe_next(replay, text, sizeof text, &text_size);
    dsw_fuzz::require(status == DSW_STATUS_OK || status == DSW_STATUS_CORRUPT, dsw_last_error_message());
    status = dsw_replay_step_validated(replay, &report, &validation);
    dsw_fuzz::require(status == DSW_STATUS_OK || status == DSW_STATUS_CORRUPT || status == DSW_STATUS_UNSUPPORTED ||
                          status == DSW_STATUS_BAD_STRUCT_SIZE,
                      dsw_last_error_message());
    dsw_fuzz::require(status != DSW_STATUS_OK || report.status != DSW_STATUS_INTERNAL, dsw_last_error_message());
    dsw_fuzz::require(status != DSW_STATUS_OK || validation.is_right == 1, validation.text);
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
