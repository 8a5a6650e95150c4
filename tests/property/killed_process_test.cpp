// What a process has recorded that was killed at any moment. For systems with fork().
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "record_support.h"

namespace dsw::oracle {
namespace {

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
  const std::string path = ::testing::TempDir() + "dartsweep_killed_" + std::to_string(getpid()) + ".dswrec";
  Rng rng(7);
  size_t finished = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
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

}  // namespace
}  // namespace dsw::oracle
