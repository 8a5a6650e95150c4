// What a process has recorded that was killed at any moment, what an earlier version has recorded, and which call is
// told to differ.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <thread>

#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)
#define DSW_TEST_WITH_FORK 1
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "record_support.h"

namespace dsw::oracle {
namespace {

#if defined(DSW_TEST_WITH_FORK)

/// Records changes of a scene into a file for ever.
[[noreturn]] void record_until_killed(const std::string& path, uint64_t seed) {
  RandomEdits<3> edits("prisms", seed);
  dsw_recording_desc desc = defaults(dsw_recording_desc_init);
  desc.path = path.c_str();
  desc.flags = DSW_RECORDING_STATES;
  if (dsw_scene_start_recording(edits.handle(), &desc) != DSW_STATUS_OK) _exit(1);
  for (;;) {
    edits.mark();
    edits.move_all();
  }
}

// Each call's result has the checksum of environment or scene as they were then: what is made again is the same up to
// the last call that the process has finished.
TEST(KilledProcessTest, LeavesARecordingOfAllItHasDone) {
  const std::string path = temporary_path("dartsweep_killed_");
  Rng rng(7);
  size_t finished = 0;
  for (uint64_t seed = 1; seed <= seeds_of(6); ++seed) {
    std::remove(path.c_str());
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) record_until_killed(path, seed);
    // At any moment from the beginning of the recording on, also in a call and in a write.
    std::error_code none;
    for (int i = 0; i < 10000 && std::filesystem::file_size(path, none) + 1 < 20000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(rng.below(30000)));
    kill(child, SIGKILL);
    int state = 0;
    ASSERT_EQ(waitpid(child, &state, 0), child);
    ASSERT_TRUE(WIFSIGNALED(state));
    const std::string recording = read_all(path);
    const ReplayPtr replay = open_replay(recording);
    ASSERT_NE(replay, nullptr);
    EXPECT_EQ(info_of(replay).flags, static_cast<uint32_t>(DSW_RECORDING_STATES));
    dsw_replay_report report = {};
    do {
      ASSERT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
      ASSERT_NE(report.outcome, DSW_REPLAY_DIFFERENT) << report.call << " " << report.function;
      finished += report.outcome == DSW_REPLAY_SAME ? 1 : 0;
    } while (report.outcome == DSW_REPLAY_SAME);
  }
  std::remove(path.c_str());
  EXPECT_GT(finished, 20u);
}

#else

TEST(KilledProcessTest, LeavesARecordingOfAllItHasDone) { GTEST_SKIP() << "no process can be forked here"; }

#endif

TEST(ReplayTest, TheFirstCallThatDiffersIsTold) {
  RandomEdits<3> edits("hex", 3);
  std::string recording;
  ASSERT_EQ(start(edits.handle(), &recording, DSW_RECORDING_STATES), DSW_STATUS_OK);
  for (int i = 0; i < 4; ++i) edits.move_all();
  edits.mark();
  const dsw_body_id gone = {12345, 1};
  EXPECT_EQ(dsw_body_destroy(edits.handle(), gone), DSW_STATUS_STALE_ID);
  ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
  std::vector<std::string> functions;
  {
    const ReplayPtr replay = open_replay(recording);
    dsw_replay_report report = {};
    while (dsw_replay_step(replay.get(), &report) == DSW_STATUS_OK && report.outcome == DSW_REPLAY_SAME) {
      functions.push_back(report.function);
    }
    ASSERT_EQ(report.outcome, DSW_REPLAY_END);
    ASSERT_GT(functions.size(), 3u);
  }
  const uint32_t kinds[] = {DSW_DIFFERS_STATUS, DSW_DIFFERS_RESULTS, DSW_DIFFERS_STATE};
  for (size_t word = 0; word < 3; ++word) {
    const size_t wrong = functions.size() / 2 + word % 2;
    Entries entries(recording);
    entries.result(wrong)[word] ^= 1;
    const std::string altered = entries.sealed();
    const ReplayPtr replay = open_replay(altered);
    dsw_replay_report report = {};
    for (size_t i = 0; i <= wrong; ++i) {
      ASSERT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
      ASSERT_EQ(report.outcome == DSW_REPLAY_DIFFERENT, i == wrong) << i;
    }
    EXPECT_EQ(report.call, wrong);
    EXPECT_EQ(report.function, functions[wrong]);
    EXPECT_EQ(report.differs, kinds[word]);
  }
}

// Recordings of earlier versions, and of this one, stay as they are: tests/record/README.md.
TEST(ReplayTest, WhatEarlierVersionsRecordedIsMadeAgain) {
  size_t files = 0;
  for (const auto& each : std::filesystem::recursive_directory_iterator(DSW_RECORDINGS)) {
    if (each.path().extension() != ".dswrec") continue;
    SCOPED_TRACE(each.path().string());
    const std::string recording = read_all(each.path().string());
    const ReplayPtr replay = open_replay(recording);
    ASSERT_NE(replay, nullptr);
    EXPECT_LE(info_of(replay).version, dsw_version());
    EXPECT_GT(replay_all(replay), 5u);
    EXPECT_EQ(info_of(replay).bytes_left, 0u);
    ++files;
  }
  EXPECT_GE(files, 3u);
}

/// Cubes whose points a host lends with far more room than there is memory for, as it may: it knows how much will be
/// written.
struct Lent {
  EnvironmentPtr environment;
  ScenePtr scene;
  std::vector<double> points;
};

constexpr size_t kHugeRoom = static_cast<size_t>(std::min<uint64_t>(uint64_t{1} << 40, SIZE_MAX / 64));

void deform_in_place(Lent& lent, size_t spare) {
  const double* now = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_environment_get_points(lent.environment.get(), &now, &count), DSW_STATUS_OK);
  std::vector<double> next(now, now + 3 * count);
  next.resize(3 * (count + spare));
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.point_room = kHugeRoom;
  ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(lent.scene.get()), next.data(), count, &options, nullptr),
            DSW_STATUS_OK)
      << dsw_last_error_message();
  lent.points.swap(next);
}

// Two thousand vertices more than there were: more than a replay makes memory for at once. The step itself recorded has
// one call.
TEST(ReplayTest, RoomOfTheHostsIsMadeAsItIsNeeded) {
  Rng rng(1);
  Lent lent;
  lent.environment = create_environment(kind_named("hex").make(rng), {}, 0, nullptr);
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* scene = nullptr;
  ASSERT_EQ(dsw_scene_create(lent.environment.get(), &desc, &scene), DSW_STATUS_OK);
  lent.scene.reset(scene);
  size_t count = 0;
  const double* now = nullptr;
  ASSERT_EQ(dsw_environment_get_points(lent.environment.get(), &now, &count), DSW_STATUS_OK);
  const size_t more = 2 * count + 3000;
  deform_in_place(lent, more + 8);
  std::string recording, taken;
  ASSERT_EQ(start(scene, &recording, DSW_RECORDING_STATES), DSW_STATUS_OK);
  // Tetrahedra far away, without a vertex in common.
  std::vector<double> points;
  std::vector<int64_t> corners;
  for (size_t i = 0; i < more / 4; ++i) {
    const double x = 1e3 + 4.0 * static_cast<double>(i);
    const double tetrahedron[] = {x, 0, 0, x + 1, 0, 0, x, 1, 0, x, 0, 1};
    points.insert(points.end(), tetrahedron, tetrahedron + 12);
    for (int k = 0; k < 4; ++k) corners.push_back(static_cast<int64_t>(corners.size()));
  }
  dsw_volumes_desc volumes = defaults(dsw_volumes_desc_init);
  volumes.points = points.data();
  volumes.point_count = points.size() / 3;
  volumes.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  volumes.volume_count = corners.size() / 4;
  volumes.connectivity = corners.data();
  volumes.connectivity_count = corners.size();
  ASSERT_EQ(dsw_environment_add_volumes(lent.environment.get(), &volumes, nullptr, nullptr), DSW_STATUS_OK)
      << dsw_last_error_message();
  deform_in_place(lent, 8);
  ASSERT_EQ(dsw_scene_stop_recording(scene), DSW_STATUS_OK);
  const ReplayPtr replay = open_replay(recording);
  ASSERT_EQ(start(scene_of(replay), &taken, DSW_RECORDING_STATES), DSW_STATUS_OK);
  EXPECT_EQ(replay_all(replay), 2u);
  ASSERT_EQ(dsw_scene_stop_recording(scene_of(replay)), DSW_STATUS_OK);
  EXPECT_EQ(replay_all(open_replay(taken)), 2u);
}

// A parallel-for of the host's and any number of threads: the same bits.
TEST(ReplayTest, ThreadsDoNotMatter) {
  RandomEdits<3> edits("tet_kuhn", 2);
  std::string recording;
  ASSERT_EQ(start(edits.handle(), &recording, DSW_RECORDING_STATES), DSW_STATUS_OK);
  for (int i = 0; i < 6; ++i) {
    ASSERT_EQ(edits.step(), "");
    ASSERT_EQ(edits.move_all(), "");
  }
  ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
  for (const uint32_t threads : {1u, 3u}) {
    dsw_context_desc desc = defaults(dsw_context_desc_init);
    desc.thread_count = threads;
    if (threads == 3) {
      desc.parallel_for = [](void*, dsw_task_fn task, void* data, size_t count) {
        while (count-- != 0) task(data, count);
      };
    }
    dsw_context* context = nullptr;
    ASSERT_EQ(dsw_context_create(&desc, &context), DSW_STATUS_OK);
    dsw_replay* made = nullptr;
    ASSERT_EQ(dsw_replay_create(context, recording.data(), recording.size(), &made), DSW_STATUS_OK);
    {
      const ReplayPtr replay(made);
      EXPECT_GT(replay_all(replay), 6u);
    }
    EXPECT_EQ(dsw_context_destroy(context), DSW_STATUS_OK);
  }
}

}  // namespace
}  // namespace dsw::oracle
