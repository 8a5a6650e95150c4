// Recordings: every call that changes a scene, made again with the same bits; also what a process left that was killed.
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

#include "random_edits.h"

namespace dsw::oracle {
namespace {

int append(void* user, const void* bytes, size_t size) {
  static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
  return 0;
}

dsw_status start(dsw_scene* scene, std::string* recording) {
  dsw_recording_desc desc;
  dsw_recording_desc_init(&desc, sizeof desc);
  desc.write = append;
  desc.user = recording;
  return dsw_scene_start_recording(scene, &desc);
}

struct DestroyReplay {
  void operator()(dsw_replay* replay) const { dsw_replay_destroy(replay); }
};
using ReplayPtr = std::unique_ptr<dsw_replay, DestroyReplay>;

ReplayPtr open_replay(const std::string& recording) {
  dsw_replay* replay = nullptr;
  EXPECT_EQ(dsw_replay_create(nullptr, recording.data(), recording.size(), &replay), DSW_STATUS_OK)
      << dsw_last_error_message();
  return ReplayPtr(replay);
}

dsw_scene* scene_of(const ReplayPtr& replay) {
  dsw_scene* scene = nullptr;
  EXPECT_EQ(dsw_replay_get_scene(replay.get(), &scene), DSW_STATUS_OK);
  return scene;
}

/// Environment and scene as their snapshots.
std::string saved(const dsw_scene* scene) {
  const dsw_environment* const environment = dsw_scene_get_environment(scene);
  size_t sizes[2] = {};
  dsw_environment_save(environment, nullptr, 0, &sizes[0]);
  dsw_scene_save(scene, nullptr, 0, &sizes[1]);
  std::string blocks(sizes[0] + sizes[1], '\0');
  EXPECT_EQ(dsw_environment_save(environment, &blocks[0], sizes[0], &sizes[0]), DSW_STATUS_OK);
  EXPECT_EQ(dsw_scene_save(scene, &blocks[sizes[0]], sizes[1], &sizes[1]), DSW_STATUS_OK);
  return blocks;
}

/// Makes all calls again; how many there were.
size_t replay_all(const ReplayPtr& replay, dsw_replay_outcome last = DSW_REPLAY_SAME) {
  for (size_t calls = 0;; ++calls) {
    dsw_replay_report report = {};
    EXPECT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
    EXPECT_EQ(report.call, calls);
    if (report.outcome == last && last != DSW_REPLAY_SAME) return calls;
    if (report.outcome != DSW_REPLAY_SAME) {
      EXPECT_EQ(report.outcome, DSW_REPLAY_END) << report.function << ": " << dsw_last_error_message();
      return calls;
    }
  }
}

class RecordTest : public SceneTest {};
DSW_FOR_ALL_SCENES(RecordTest);

TEST_P(RecordTest, WhatWasRecordedIsMadeAgainWithTheSameBits) {
  size_t calls = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const uint32_t features = seed == 2   ? uint32_t{DSW_FEATURE_LIVE_CHANGES}
                              : seed == 3 ? DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_STATISTICS
                                          : 0u;
    RandomEdits edits(GetParam(), seed, nullptr, features);
    if (edits.environment() == nullptr) continue;
    std::string recording, later;
    const auto change = [&](int times) {
      for (int i = 0; i < times; ++i) {
        ASSERT_EQ(edits.step(), "");
        edits.mark();
        if (i % 4 == 3) {
          ASSERT_EQ(edits.move_all(), "");
        }
      }
    };
    ASSERT_EQ(start(edits.handle(), &recording), DSW_STATUS_OK) << dsw_last_error_message();
    change(30);
    ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
    const ReplayPtr replay = open_replay(recording);
    calls += replay_all(replay);
    ASSERT_TRUE(saved(scene_of(replay)) == edits.saved()) << "scene seed " << seed;
    // Now that the points are the host's.
    ASSERT_EQ(start(edits.handle(), &later), DSW_STATUS_OK);
    change(20);
    ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
    const ReplayPtr second = open_replay(later);
    calls += replay_all(second);
    ASSERT_TRUE(saved(scene_of(second)) == edits.saved()) << "scene seed " << seed << ", the second time";
  }
  EXPECT_GT(calls, 0u);
}

// A wrong byte anywhere is found, and a recording that ends anywhere is replayed up to there.
TEST(DamagedRecordingTest, IsFoundOrReplayedUpToWhereItEnds) {
  RandomEdits edits("tet_kuhn", 5);
  ASSERT_NE(edits.environment(), nullptr);
  std::string recording;
  ASSERT_EQ(start(edits.handle(), &recording), DSW_STATUS_OK);
  const size_t beginning = recording.size();
  for (int i = 0; i < 8; ++i) ASSERT_EQ(edits.step(), "");
  ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
  const size_t all = replay_all(open_replay(recording));
  ASSERT_GT(all, 2u);
  size_t unfinished = 0, ended = 0;
  for (size_t size = beginning; size <= recording.size(); size += 8) {
    const ReplayPtr replay = open_replay(recording.substr(0, size));
    dsw_replay_report report = {};
    do {
      ASSERT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
      ASSERT_NE(report.outcome, DSW_REPLAY_DIFFERENT);
    } while (report.outcome == DSW_REPLAY_SAME);
    ++(report.outcome == DSW_REPLAY_END ? ended : unfinished);
  }
  EXPECT_GT(unfinished, 0u);
  EXPECT_GT(ended, 0u);
  for (size_t at = 0; at < recording.size(); at += at < beginning ? 97 : 1) {
    std::string damaged = recording;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    dsw_replay* made = nullptr;
    dsw_status status = dsw_replay_create(nullptr, damaged.data(), damaged.size(), &made);
    const ReplayPtr replay(made);
    size_t same = 0;
    for (dsw_replay_report report = {}; status == DSW_STATUS_OK;) {
      status = dsw_replay_step(replay.get(), &report);
      if (status == DSW_STATUS_OK) {
        ASSERT_EQ(report.outcome, DSW_REPLAY_SAME) << "byte " << at;
        ++same;
      }
    }
    EXPECT_TRUE(status == DSW_STATUS_CORRUPT || (at < 16 && status == DSW_STATUS_BAD_VERSION)) << "byte " << at;
    ASSERT_LT(same, all) << "byte " << at;
  }
}

TEST(KilledProcessTest, LeavesARecordingOfAllItHasDone) {
  const std::string path = ::testing::TempDir() + "dartsweep_killed_" + std::to_string(getpid()) + ".rec";
  constexpr int kCalls = 12;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    RandomEdits edits("prisms", 2);
    dsw_recording_desc desc;
    dsw_recording_desc_init(&desc, sizeof desc);
    desc.path = path.c_str();
    if (dsw_scene_start_recording(edits.handle(), &desc) != DSW_STATUS_OK) _exit(1);
    for (int i = 0; i < kCalls; ++i) edits.mark();
    kill(getpid(), SIGKILL);
  }
  int state = 0;
  ASSERT_EQ(waitpid(child, &state, 0), child);
  ASSERT_TRUE(WIFSIGNALED(state));
  std::ifstream file(path, std::ios::binary);
  const std::string recording((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::remove(path.c_str());
  RandomEdits edits("prisms", 2);
  for (int i = 0; i < kCalls; ++i) edits.mark();
  const ReplayPtr replay = open_replay(recording);
  EXPECT_GT(replay_all(replay), 0u);
  EXPECT_TRUE(saved(scene_of(replay)) == edits.saved());
}

}  // namespace
}  // namespace dsw::oracle
