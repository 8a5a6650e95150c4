// Bug reports in one call: what is in them, and whether the validation sees what is wrong.
#include <cstdio>
#include <cstring>

#include "record_support.h"

namespace dsw::oracle {
namespace {

dsw_status write_bug_report(dsw_scene* scene, std::string* report, dsw_validation* validation,
                            const char* note = nullptr) {
  dsw_bug_report_desc desc = defaults(dsw_bug_report_desc_init);
  desc.write = append_bytes;
  desc.user = report;
  desc.note = note;
  *validation = {};
  validation->struct_size = sizeof *validation;
  return dsw_scene_write_bug_report(scene, &desc, validation);
}

/// Opens a report; it must hold `calls` calls and come to the same validation.
void check_report(const std::string& report, size_t calls, const dsw_validation& said, const char* note) {
  const ReplayPtr replay = open_replay(report);
  ASSERT_NE(replay, nullptr);
  EXPECT_EQ(info_of(replay).flags, uint32_t{DSW_RECORDING_STATES} | DSW_RECORDING_BUG_REPORT);
  dsw_validation validation = {};
  validation.struct_size = sizeof validation;
  dsw_replay_report step = {};
  ASSERT_EQ(dsw_replay_step_validated(replay.get(), &step, &validation), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(std::memcmp(&validation, &said, sizeof validation), 0) << validation.text;
  EXPECT_EQ(step.outcome, calls == 0 ? DSW_REPLAY_END : DSW_REPLAY_SAME);
  ASSERT_EQ(dsw_replay_step(replay.get(), &step), DSW_STATUS_OK);
  EXPECT_EQ(step.outcome, DSW_REPLAY_END);
  EXPECT_EQ(step.call, calls);
  EXPECT_STREQ(info_of(replay).note, note);
  ASSERT_NE(info_of(replay).validation, nullptr);
  EXPECT_EQ(std::memcmp(info_of(replay).validation, &said, sizeof said), 0);
}

class ReportTest : public SceneTest {};
DSW_FOR_ALL_SCENES(ReportTest);

TEST_P(ReportTest, TheLastCallIsValidated) {
  const std::string path = temporary_path("dartsweep_report_");
  for (uint64_t seed = 1; seed <= seeds_of(2); ++seed) {
    RandomEdits<3> edits(GetParam(), seed);
    if (edits.environment() == nullptr) continue;
    dsw_recording_desc desc = defaults(dsw_recording_desc_init);
    if (seed == 1) desc.path = path.c_str();
    if (seed == 2) desc.flags = DSW_RECORDING_LATEST;
    ASSERT_EQ(dsw_scene_start_recording(edits.handle(), &desc), DSW_STATUS_OK);
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(edits.step(), "");
      ASSERT_EQ(edits.move_all(), "");
      const std::string before = edits.saved();
      std::string report;
      dsw_validation validation;
      ASSERT_EQ(write_bug_report(edits.handle(), &report, &validation, "look"), DSW_STATUS_OK)
          << dsw_last_error_message();
      EXPECT_EQ(validation.is_right, 1u) << validation.text;
      EXPECT_EQ(edits.saved(), before);
      check_report(report, 1, validation, "look");
    }
    ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
  }
  std::remove(path.c_str());
}

TEST(BugReportTest, OfASceneThatIsNotRecordedIsWhatIsThere) {
  RandomEdits<3> edits("hex", 1);
  std::string report;
  dsw_validation validation;
  ASSERT_EQ(write_bug_report(edits.handle(), &report, &validation), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_GT(validation.places, 0u);
  check_report(report, 0, validation, "");
}

// A recording in memory begins anew before it gets long.
TEST(BugReportTest, OnlyTheLatestCallsAreKept) {
  RandomEdits<3> edits("hex", 4);
  ASSERT_EQ(edits.step(), "");
  dsw_recording_desc desc = defaults(dsw_recording_desc_init);
  desc.flags = DSW_RECORDING_LATEST;
  ASSERT_EQ(dsw_scene_start_recording(edits.handle(), &desc), DSW_STATUS_OK);
  const capi::Recording& recording = *edits.handle()->recording;
  const size_t most = recording.most_kept;
  size_t longest = 0;
  bool began_anew = false;
  for (int i = 0; i < 4000 && !began_anew; ++i) {
    const size_t before = recording.kept.size();
    ASSERT_EQ(edits.move_all(), "");
    began_anew = recording.kept.size() < before;
    longest = std::max(longest, recording.kept.size());
  }
  EXPECT_TRUE(began_anew);
  EXPECT_LT(longest, most + 100000);
  std::string report;
  dsw_validation validation;
  ASSERT_EQ(write_bug_report(edits.handle(), &report, &validation), DSW_STATUS_OK) << dsw_last_error_message();
  check_report(report, 1, validation, "");
}

// A vertex that something has put behind a wall: the scene is not what its calls have made; the validation names that.
TEST(BugReportTest, WhatIsWrongIsNamed) {
  for (uint64_t seed = 1; seed <= seeds_of(20); ++seed) {
    RandomEdits<3> edits("hex", seed);
    dsw_scene& scene = *edits.handle();
    std::string report;
    ASSERT_EQ(start(&scene, &report), DSW_STATUS_OK);
    ASSERT_EQ(dsw_scene_stop_recording(&scene), DSW_STATUS_OK);
    const ReplayPtr replay = open_replay(report);
    uint32_t v = 0;
    BodyVertex<3>* vertex = nullptr;
    for (BodyRecord<3>& each : dsw::capi::space(*scene_of(replay)).bodies) {
      // At POINTS no edge is looked at.
      if (vertex != nullptr || !covers_edges(each.body.level)) continue;
      const size_t count = each.body.vertices.size();
      for (v = 0; v < count && !(each.body.has_vertex(v) && each.body.vertices[v].first_edge != kNone);) ++v;
      if (v < count) vertex = &each.body.vertices[v];
    }
    if (vertex == nullptr) continue;
    const BodyVertex<3> kept = *vertex;
    vertex->position[0] += 1e6;
    dsw_validation validation = {};
    validation.struct_size = sizeof validation;
    dsw_replay_report step = {};
    ASSERT_EQ(dsw_replay_step_validated(replay.get(), &step, &validation), DSW_STATUS_OK);
    EXPECT_EQ(validation.is_right, 0u);
    EXPECT_EQ(validation.lost, 1u);
    EXPECT_GT(validation.crossing, 0u);
    EXPECT_NE(std::string(validation.text).find("vertex " + std::to_string(v)), std::string::npos) << validation.text;
    *vertex = kept;
    return;
  }
  FAIL() << "no scene has a body with edges";
}

}  // namespace
}  // namespace dsw::oracle
