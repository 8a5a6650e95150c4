// A scene that enables nothing pays for nothing: not in bytes, not in orientation tests, not for what others enable.
#include "host_memory.h"

namespace dsw::oracle {
namespace {

constexpr uint32_t kFeatures[] = {DSW_FEATURE_STATISTICS, DSW_FEATURE_CROSSINGS, DSW_FEATURE_DEFORMING,
                                  DSW_FEATURE_BODY_CONTACTS, DSW_FEATURE_LIVE_CHANGES};

class LeftOutTest : public MemoryTest {
 protected:
  void SetUp() override {
    MemoryTest::SetUp();
    mark_wall(1, 1, 1);
    scene_.reset();
    unused_ = memory_.bytes;
  }

  /// Two bodies at every level press on the wall in a scene of their own. @return the bytes that are held then.
  size_t bytes_of(uint32_t features, dsw_statistics* statistics = nullptr) {
    scene_ = make_scene(place_.get(), features);
    for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
      for (double y : {0.125, 1.125}) {
        const BodyPlan plan = tetrahedron({0.25 * static_cast<int>(level), y, 1.25}, 0.1875);
        const dsw_body_id body = make(plan, level);
        std::vector<Vec> targets = plan.at;
        for (int step = 0; step < 4; ++step) {
          for (Vec& p : targets) p[0] += 0.5;
          EXPECT_EQ(dsw_body_move(scene(), body, targets[0].data(), targets.size(), 0, nullptr, nullptr),
                    DSW_STATUS_OK);
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

}  // namespace
}  // namespace dsw::oracle
