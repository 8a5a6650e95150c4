// A scene that enables nothing pays for nothing: not in bytes, not in orientation tests, not for what others enable.
#include "host_memory.h"

namespace dsw::oracle {
namespace {

constexpr uint32_t kFeatures[] = {DSW_FEATURE_STATISTICS, DSW_FEATURE_CROSSINGS, DSW_FEATURE_DEFORMING,
                                  DSW_FEATURE_BODY_CONTACTS, DSW_FEATURE_LIVE_CHANGES};

/// What a host can ask for beside the features of a scene.
struct Asked {
  const char* name;
  uint32_t features, flags, move_flags, passes;
  double radius;
  bool rows, at_once, records;
};

constexpr Asked kNothingAsked = {"nothing", 0, 0, 0, 0, 0, false, false, false};
constexpr Asked kAllAsked[] = {
    {"back edges", 0, DSW_BODY_SKIP_BACK_EDGES, 0, 0, 0, false, false, false},
    {"hybrid", 0, DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BACK_EDGES, 0, 0, 0, false, false, false},
    {"left back edges", 0, DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES, 0, 0, 0, false, false, false},
    {"self contacts", DSW_FEATURE_BODY_CONTACTS, DSW_BODY_SELF_CONTACTS, 0, 0, 0, false, false, false},
    {"RIGID", 0, DSW_BODY_RIGID, 0, 0, 0, false, false, false},
    {"NO_SEQUENCES", 0, DSW_BODY_NO_SEQUENCES, 0, 0, 0, false, false, false},
    {"radius", 0, 0, 0, 0, 0.015625, false, false, false},
    {"KEEP_WALLS", 0, 0, DSW_MOVE_KEEP_WALLS, 0, 0, false, false, false},
    {"passes", 0, 0, 0, 4, 0, false, false, false},
    {"near rows", 0, 0, 0, 0, 0, true, false, false},
    {"together", 0, 0, 0, 0, 0, false, true, false},
    {"recording", 0, 0, 0, 0, 0, false, false, true}};

class LeftOutTest : public MemoryTest {
 protected:
  void SetUp() override {
    MemoryTest::SetUp();
    mark_wall(1, 1, 1);
    scene_.reset();
    unused_ = memory_.bytes;
  }

  /// Two bodies at every level press on the wall in a scene of their own. @return the bytes that are held then.
  size_t bytes_of(uint32_t features, dsw_statistics* statistics = nullptr, const Asked& asked = kNothingAsked) {
    scene_ = make_scene(place_.get(), features | asked.features);
    if (asked.records) record();
    for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
      for (double y : {0.125, 1.125}) {
        const BodyPlan plan = tetrahedron({0.25 * static_cast<int>(level), y, 1.25}, 0.1875);
        const dsw_body_id body = make(plan, level, level == DSW_LEVEL_EDGES ? asked.flags : 0);
        if (asked.radius > 0) {
          EXPECT_EQ(dsw_body_set_radius(scene(), body, asked.radius), DSW_STATUS_OK);
        }
        std::vector<Vec> targets = plan.at;
        for (int step = 0; step < 4; ++step) {
          for (Vec& p : targets) p[0] += 0.5;
          move(body, targets, asked);
        }
      }
    }
    if (statistics != nullptr) {
      statistics->struct_size = sizeof *statistics;
      EXPECT_EQ(dsw_scene_get_statistics(scene(), statistics), DSW_STATUS_OK);
    }
    const size_t bytes = memory_.bytes;
    scene_.reset();
    return bytes;
  }

  void record() {
    dsw_recording_desc desc;
    dsw_recording_desc_init(&desc, sizeof desc);
    desc.write = [](void*, const void*, size_t) { return 0; };
    EXPECT_EQ(dsw_scene_start_recording(scene(), &desc), DSW_STATUS_OK);
  }

  void move(dsw_body_id body, const std::vector<Vec>& targets, const Asked& asked) {
    if (asked.at_once) {
      EXPECT_EQ(dsw_scene_move_together(scene(), &body, 1, targets[0].data(), targets.size(), 0, nullptr, nullptr),
                DSW_STATUS_OK);
    } else {
      dsw_move_options options;
      dsw_move_options_init(&options, sizeof options);
      options.vertex_response = asked.move_flags != 0 ? DSW_RESPONSE_SLIDE : DSW_RESPONSE_STOP;
      options.flags = asked.move_flags;
      options.passes = asked.passes;
      EXPECT_EQ(dsw_body_move(scene(), body, targets[0].data(), targets.size(), 0, &options, nullptr), DSW_STATUS_OK);
    }
    if (asked.rows) {
      dsw_near_options options;
      dsw_near_options_init(&options, sizeof options);
      options.margin = 0.25;
      size_t count = 0;
      EXPECT_EQ(dsw_body_find_near_rows(scene(), body, &options, &count), DSW_STATUS_OK);
    }
  }

  size_t unused_ = 0;  // bytes of the environment without a scene
};

TEST_F(LeftOutTest, ASceneThatNamesNothingIsOneBlock) {
  const size_t calls = memory_.calls;
  scene_ = make_scene(place_.get());
  EXPECT_EQ(memory_.calls, calls + 1);
  uint64_t own = 0;
  EXPECT_EQ(dsw_scene_get_memory_bytes(scene(), &own), DSW_STATUS_OK);
  EXPECT_EQ(memory_.bytes - unused_, own);
}

TEST_F(LeftOutTest, WhatAFeatureKeepsIsHeldOnlyWhereItIsEnabled) {
  const size_t nothing = bytes_of(0);
  EXPECT_EQ(memory_.bytes, unused_);
  // Statistics are counters in the scene itself, crossings those of particles. Deforming goes last: it leaves walks for
  // warped volumes.
  for (uint32_t feature : {DSW_FEATURE_BODY_CONTACTS, DSW_FEATURE_LIVE_CHANGES, DSW_FEATURE_DEFORMING}) {
    EXPECT_GT(bytes_of(feature), nothing) << feature;
  }
}

TEST_F(LeftOutTest, NothingIsPaidForWhatAnotherSceneHasEnabled) {
  dsw_statistics before = {}, after = {};
  const size_t nothing = bytes_of(0);
  bytes_of(DSW_FEATURE_STATISTICS, &before);
  EXPECT_GT(before.contacts, 0u);
  EXPECT_GT(before.orientation_tests, 0u);
  for (uint32_t feature : kFeatures) {
    if (feature == DSW_FEATURE_DEFORMING) continue;  // says that walks stay those for warped volumes
    bytes_of(feature);
    EXPECT_EQ(memory_.bytes, unused_) << feature;
    EXPECT_EQ(bytes_of(0), nothing) << feature;
    bytes_of(DSW_FEATURE_STATISTICS, &after);
    EXPECT_EQ(after.orientation_tests, before.orientation_tests) << feature;
    EXPECT_EQ(after.volumes_visited, before.volumes_visited) << feature;
  }
}

/// Flags, radii, options, rows, recordings and moves at once: a scene that does not ask for them pays nothing, whatever others did.
TEST_F(LeftOutTest, NothingIsPaidForWhatIsNotAskedFor) {
  dsw_statistics before = {}, after = {};
  const size_t nothing = bytes_of(0);
  bytes_of(DSW_FEATURE_STATISTICS, &before);
  for (const Asked& asked : kAllAsked) {
    bytes_of(0, nullptr, asked);
    EXPECT_EQ(memory_.bytes, unused_) << asked.name;
    EXPECT_EQ(bytes_of(0), nothing) << asked.name;
    bytes_of(DSW_FEATURE_STATISTICS, &after);
    EXPECT_EQ(after.orientation_tests, before.orientation_tests) << asked.name;
    EXPECT_EQ(after.volumes_visited, before.volumes_visited) << asked.name;
  }
}

}  // namespace
}  // namespace dsw::oracle
