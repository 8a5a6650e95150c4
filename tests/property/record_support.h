// Recordings in memory, and what makes them again.
#pragma once

#include <cstring>
#include <fstream>
#include <random>
#include <set>

#include "capi/recorded.h"
#include "random_edits.h"
#include "snapshot/bytes.h"

namespace dsw::oracle {

inline int append_bytes(void* user, const void* bytes, size_t size) {
  static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
  return 0;
}

inline dsw_status start(dsw_scene* scene, std::string* recording, uint32_t flags = 0) {
  dsw_recording_desc desc = defaults(dsw_recording_desc_init);
  desc.write = append_bytes;
  desc.user = recording;
  desc.flags = flags;
  return dsw_scene_start_recording(scene, &desc);
}

/// A name for a recording that no other process has.
inline std::string temporary_path(const std::string& stem) {
  return ::testing::TempDir() + stem + std::to_string(std::random_device()()) + ".dswrec";
}

inline std::string read_all(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct DestroyReplay {
  void operator()(dsw_replay* replay) const { dsw_replay_destroy(replay); }
};
using ReplayPtr = std::unique_ptr<dsw_replay, DestroyReplay>;

inline ReplayPtr open_replay(const std::string& recording) {
  dsw_replay* replay = nullptr;
  EXPECT_EQ(dsw_replay_create(nullptr, recording.data(), recording.size(), &replay), DSW_STATUS_OK)
      << dsw_last_error_message();
  return ReplayPtr(replay);
}

inline dsw_scene* scene_of(const ReplayPtr& replay) {
  dsw_scene* scene = nullptr;
  EXPECT_EQ(dsw_replay_get_scene(replay.get(), &scene), DSW_STATUS_OK);
  return scene;
}

inline dsw_replay_info info_of(const ReplayPtr& replay) {
  dsw_replay_info info;
  info.struct_size = sizeof info;
  EXPECT_EQ(dsw_replay_get_info(replay.get(), &info), DSW_STATUS_OK);
  return info;
}

/// Makes all calls again; how many there were. Adds names of functions that did what they should.
inline size_t replay_all(const ReplayPtr& replay, std::set<std::string>* functions = nullptr) {
  for (size_t calls = 0;; ++calls) {
    dsw_replay_report report = {};
    EXPECT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.call, calls);
    if (report.outcome != DSW_REPLAY_SAME) {
      EXPECT_EQ(report.outcome, DSW_REPLAY_END) << report.function << ": " << dsw_last_error_message();
      return calls;
    }
    if (functions != nullptr && report.status == DSW_STATUS_OK) functions->insert(report.function);
  }
}

/// The words of a recording, entry by entry.
class Entries {
 public:
  explicit Entries(const std::string& recording) : words_(recording.size() / 8) {
    std::memcpy(words_.data(), recording.data(), 8 * words_.size());
    for (size_t at = 2; at < words_.size(); at += words_[at + 1] / 8 + 3) entries_.push_back(at);
  }
  /// Gives the words of the result of the call with a number.
  uint64_t* result(size_t call) {
    for (const size_t at : entries_) {
      if (static_cast<uint32_t>(words_[at]) == 4 && call-- == 0) return &words_[at + 2];
    }
    return nullptr;
  }
  /// With its checksums right.
  std::string sealed() {
    for (const size_t at : entries_) {
      const size_t size = words_[at + 1] / 8 + 2;
      words_[at + size] = checksum(0, reinterpret_cast<const uint8_t*>(&words_[at]), 8 * size);
    }
    return {reinterpret_cast<const char*>(words_.data()), 8 * words_.size()};
  }

 private:
  std::vector<uint64_t> words_;
  std::vector<size_t> entries_;
};

}  // namespace dsw::oracle
