// The radius of bodies in snapshots and recordings, and those of before format 5, which have none.
#include <cmath>
#include <limits>

#include "body_support.h"
#include "record_support.h"
#include "scene/scene.h"
#include "snapshot/record.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

constexpr double kRadius = 0.0625;

std::string saved_in(dsw_scene* scene, uint32_t format) {
  return capi::visit(*scene, [&](const auto& engine) {
    std::string block(snapshot_bytes(engine, format), 0);
    save(engine, reinterpret_cast<uint8_t*>(&block[0]), format);
    return block;
  });
}

class SavedRadiusTest : public BodyTest {
 protected:
  void SetUp() override {
    BodyTest::SetUp();
    scene_.reset();
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
    const std::vector<Vec> at = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {1.5, 1.25, 0.5}};
    body_ = make({at, {{0, 1}, {1, 2}}, {}}, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SELF_CONTACTS);
    ASSERT_EQ(dsw_body_set_radius(scene(), body_, kRadius), DSW_STATUS_OK);
    in(scene()).lengths.assign({1.0, 0.75});
  }
  /// The body inside.
  Body<3>& in(dsw_scene* scene) const { return capi::space(*scene).bodies[body_.index].body; }
  dsw_status load_status(const std::string& block) const {
    dsw_scene* loaded = nullptr;
    const dsw_status status = dsw_scene_load(place_.get(), block.data(), block.size(), &loaded);
    ScenePtr owner(loaded);
    return status;
  }

  dsw_body_id body_ = {0, 0};
};

TEST_F(SavedRadiusTest, ComesBackWithTheLengthsOfEdges) {
  const Bytes block = saved(scene());
  const ScenePtr loaded = load_scene(place_.get(), block);
  ASSERT_NE(loaded, nullptr);
  EXPECT_EQ(in(loaded.get()).radius, kRadius);
  ASSERT_EQ(in(loaded.get()).lengths.size(), 2u);
  EXPECT_EQ(in(loaded.get()).lengths[1], 0.75);
  EXPECT_TRUE(saved(loaded.get()) == block);
}

TEST_F(SavedRadiusTest, IsPartOfTheState) {
  const uint64_t before = capi::state_of(*scene(), false);
  in(scene()).radius = kRadius / 2;
  EXPECT_NE(capi::state_of(*scene(), false), before);
  in(scene()).radius = kRadius;
  EXPECT_EQ(capi::state_of(*scene(), false), before);
  in(scene()).lengths[0] = 1.5;
  EXPECT_NE(capi::state_of(*scene(), false), before);
}

TEST_F(SavedRadiusTest, IsRefusedWhereItIsNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, kInfinity, std::nan("")}) {
    in(scene()).radius = bad;
    EXPECT_EQ(load_status(saved_in(scene(), kSceneFormat)), DSW_STATUS_CORRUPT) << bad;
    in(scene()).radius = kRadius;
    in(scene()).lengths[1] = bad;
    EXPECT_EQ(load_status(saved_in(scene(), kSceneFormat)), DSW_STATUS_CORRUPT) << bad;
    in(scene()).lengths[1] = 0.75;
  }
  EXPECT_EQ(load_status(saved_in(scene(), kSceneFormat)), DSW_STATUS_OK) << dsw_last_error_message();
  in(scene()).radius = 0;
  EXPECT_EQ(load_status(saved_in(scene(), kSceneFormat)), DSW_STATUS_CORRUPT) << "a thin body has no lengths";
  in(scene()).radius = kRadius;
  in(scene()).lengths.resize(1);
  EXPECT_EQ(load_status(saved_in(scene(), kSceneFormat)), DSW_STATUS_CORRUPT) << "one is missing";
}

TEST_F(SavedRadiusTest, IsZeroInEarlierFormats) {
  for (uint32_t format = kOldestSceneFormat; format < kSceneFormat; ++format) {
    const std::string block = saved_in(scene(), format);
    const ScenePtr loaded = load_scene(place_.get(), block);
    ASSERT_NE(loaded, nullptr) << format;
    EXPECT_EQ(in(loaded.get()).radius, 0) << format;
    EXPECT_TRUE(in(loaded.get()).lengths.empty()) << format;
    EXPECT_TRUE(saved_in(loaded.get(), format) == block) << format;
  }
}

// A thick body stops before a thin one would: the exact times are those of thin ones.
TEST_F(SavedRadiusTest, ContactsOfThickBodiesAreNotValidated) {
  std::string recording;
  ASSERT_EQ(start(scene(), &recording), DSW_STATUS_OK);
  for (const double radius : {kRadius, 0.0}) {
    ASSERT_EQ(dsw_body_set_radius(scene(), body_, radius), DSW_STATUS_OK);
    const std::vector<Vec> down = {{0.5, 0.5, -1}, {1.5, 0.5, -1}, {1.5, 1.25, -1}};
    dsw_move_report report;
    ASSERT_EQ(dsw_body_move(scene(), body_, down[0].data(), down.size(), 0, nullptr, &report), DSW_STATUS_OK);
    EXPECT_NE(report.contact_count, 0u);
  }
  ASSERT_EQ(dsw_scene_stop_recording(scene()), DSW_STATUS_OK);
  const ReplayPtr replay = open_replay(recording);
  for (int i = 0; i < 4; ++i) {
    dsw_replay_report report = {};
    dsw_validation validation;
    validation.struct_size = sizeof validation;
    ASSERT_EQ(dsw_replay_step_validated(replay.get(), &report, &validation), DSW_STATUS_OK);
    EXPECT_EQ(validation.is_right, 1u) << validation.text;
    if (i % 2 == 0) continue;  // the radius
    EXPECT_STREQ(report.function, "dsw_body_move");
    EXPECT_EQ(validation.contacts == 0, i == 1) << i;
    EXPECT_EQ(validation.not_validated != 0, i == 1) << i;
  }
}

/// Whether a recorded call leaves a state that is also of the environment.
bool has_environment(const Entry& call) {
  uint64_t number = 0;
  std::memcpy(&number, call.bytes, sizeof number);
  bool changes = false;
  capi::visit_row(number, [&](const auto& row) { changes = capi::changes_environment(row); });
  return changes;
}

/// A recording as a library would have written it whose scenes have another format.
std::string recorded_in(const std::string& recording, uint32_t format) {
  const ReplayPtr replay = open_replay(recording);
  std::string out;
  RecordWriter writer(
      {[](void* user, const void* bytes, size_t size) { return append_bytes(user, bytes, size) == 0; }, &out});
  writer.write_header();
  RecordReader reader(reinterpret_cast<const uint8_t*>(recording.data()), recording.size());
  bool with_environment = false;
  for (Entry entry; reader.next(&entry);) {
    std::string bytes(reinterpret_cast<const char*>(entry.bytes), entry.size);
    if (entry.kind == EntryKind::kScene) bytes = saved_in(scene_of(replay), format);
    if (entry.kind == EntryKind::kCall) with_environment = has_environment(entry);
    if (entry.kind == EntryKind::kResult) {
      dsw_replay_report report = {};
      EXPECT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
      EXPECT_EQ(report.outcome, DSW_REPLAY_SAME);
      const uint64_t state = capi::state_of(*scene_of(replay), with_environment, format);
      if (bytes.size() == capi::kMostResultWords * sizeof state) std::memcpy(&bytes[2 * sizeof state], &state, 8);
    }
    writer.write(entry.kind, bytes.data(), bytes.size());
  }
  return out;
}

TEST(RecordedStatesTest, AreComparedInTheirFormat) {
  RandomEdits<3> edits("hex", 3);
  std::string recording;
  ASSERT_EQ(start(edits.handle(), &recording, DSW_RECORDING_STATES), DSW_STATUS_OK);
  for (int i = 0; i < 4; ++i) edits.move_all();
  edits.mark();
  ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
  for (uint32_t format = kOldestSceneFormat; format <= kSceneFormat; ++format) {
    const std::string earlier = recorded_in(recording, format);
    EXPECT_EQ(earlier == recording, format == kSceneFormat);
    const size_t calls = replay_all(open_replay(earlier));
    ASSERT_GT(calls, 3u);
    Entries entries(earlier);
    entries.result(0)[2] ^= 1;
    const std::string altered = entries.sealed();
    dsw_replay_report report = {};
    ASSERT_EQ(dsw_replay_step(open_replay(altered).get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
    // Earlier ones have forecasts in their states.
    EXPECT_EQ(report.differs, format < kOldestStateFormat ? 0u : uint32_t{DSW_DIFFERS_STATE}) << format;
  }
}

}  // namespace
}  // namespace dsw::oracle
