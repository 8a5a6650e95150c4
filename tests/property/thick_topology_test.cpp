// Random changes of the topology with thick bodies inside: after each, every distance is kept.
#include "random_edits.h"
#include "thick_scene.h"

namespace dsw::oracle {
namespace {

struct TopologyTally {
  uint64_t changes = 0, compared = 0, occupied = 0, thick = 0, refused = 0;
};

/// Whatever bodies there are.
void follow_all(ThickScene& scene) {
  scene.bodies.clear();
  std::vector<dsw_body_id> ids(1000);
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_body_ids(scene.handle(), ids.data(), ids.size(), &count), DSW_STATUS_OK);
  for (size_t i = 0; i < count; ++i) scene.adopt(ids[i]);
}

template <int D>
void keeps_every_distance(const std::string& name, TopologyTally& tally) {
  const auto seeds = static_cast<uint64_t>(std::max(2, effort_of(4)));
  for (uint64_t seed = 1; seed <= seeds && !testing::Test::HasFailure(); ++seed) {
    RandomEdits<D> edits(name, seed, nullptr, seed % 2 == 0 ? DSW_FEATURE_LIVE_CHANGES : 0);
    if (edits.environment() == nullptr) continue;
    ThickScene scene(edits.handle(), false);
    follow_all(scene);
    Rng rng(seed);
    for (size_t i = 0; i < scene.bodies.size(); ++i) {
      const double room = scene.room(i, HUGE_VAL);
      if (!(room > 0) || !std::isfinite(room)) continue;
      const double radius = room * rng.range(0.1, 0.99);
      const dsw_status status = scene.set_radius(i, radius);
      // Distances are certain up to 2^-70 of the size of the parts: of room below that a radius may be refused.
      if (status == DSW_STATUS_OCCUPIED && scene.room(i, HUGE_VAL, 0x1p-69) < radius) {
        ++tally.refused;
        continue;
      }
      EXPECT_EQ(status, DSW_STATUS_OK) << "seed " << seed << ", " << radius << " of " << room << ": "
                                       << dsw_last_error_message();
      ++tally.thick;
    }
    for (int call = 0; call < std::clamp(effort_of(120), 30, 120) && !testing::Test::HasFailure(); ++call) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " call " + std::to_string(call));
      ASSERT_EQ(edits.step(), "");
      tally.occupied += edits.occupants().empty() ? 0u : 1u;
      if (call % 4 == 1) edits.mark();
      if (call % 4 == 3) {
        ASSERT_EQ(edits.move_all(), "");
      }
      follow_all(scene);
      // Cuts can leave an outer boundary that crosses itself by a rounding: then nothing is certain.
      if (dsw_environment_check(edits.environment(), nullptr) != DSW_STATUS_OK) break;
      ++tally.compared;
      scene.read_obstacles();
      EXPECT_EQ(scene.too_near(), "");
    }
    for (const EditTally& each : edits.tallies) tally.changes += each.done;
  }
}

void record(const TopologyTally& tally) {
  const std::pair<const char*, uint64_t> all[] = {{"changes", tally.changes},
                                                  {"compared", tally.compared},
                                                  {"occupied", tally.occupied},
                                                  {"thick", tally.thick},
                                                  {"refused", tally.refused}};
  for (const auto& [name, value] : all) testing::Test::RecordProperty(name, std::to_string(value));
  EXPECT_GT(tally.changes, 5u);
}

class ThickTopologyTest : public SceneTest {};
DSW_FOR_ALL_SCENES(ThickTopologyTest);
TEST_P(ThickTopologyTest, ChangesKeepEveryDistance) {
  TopologyTally tally;
  keeps_every_distance<3>(GetParam(), tally);
  record(tally);
}

class ThickPlaneTopologyTest : public SceneTest {};
DSW_FOR_ALL_PLANE_SCENES(ThickPlaneTopologyTest);
TEST_P(ThickPlaneTopologyTest, ChangesKeepEveryDistance) {
  TopologyTally tally;
  keeps_every_distance<2>(GetParam(), tally);
  record(tally);
}

}  // namespace
}  // namespace dsw::oracle
