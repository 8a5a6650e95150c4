// What released versions have left behind, space and plane: recordings with states, snapshots and bug reports.
// tests/record/README.md says how these files were made.
#include <filesystem>

#include "capi/replay.h"
#include "record_support.h"
#include "snapshot/block.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

struct Release {
  const char* name;
  uint32_t version;
  size_t in_space, in_plane;  // how many functions it could record there
};
void PrintTo(const Release& release, std::ostream* out) { *out << release.name; }
constexpr Release kReleases[] = {{"1.0.0", 1000000, 48, 0}, {"1.1.0", 1001000, 48, 41}};

std::vector<std::string> kept_files(const std::string& folder, const char* extension) {
  std::vector<std::string> paths;
  for (const auto& each : std::filesystem::directory_iterator(DSW_RECORDINGS "/" + folder)) {
    if (each.path().extension() == extension) paths.push_back(each.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// A scene and its environment in the formats of two blocks.
std::array<std::string, 2> saved_as(dsw_scene* scene, const std::array<std::string, 2>& blocks) {
  std::array<std::string, 2> out;
  capi::visit(*scene, [&](const auto& engine) {
    const uint32_t format = saved_version(reinterpret_cast<const uint8_t*>(blocks[1].data()));
    out[0].resize(snapshot_bytes(engine.env));
    save(engine.env, reinterpret_cast<uint8_t*>(&out[0][0]));
    out[1].resize(snapshot_bytes(engine, format));
    save(engine, reinterpret_cast<uint8_t*>(&out[1][0]), format);
  });
  return out;
}

std::vector<double> places_of(dsw_scene* scene, dsw_body_id body, size_t dimension) {
  size_t count = 0;
  dsw_body_get_positions(scene, body, nullptr, 0, 0, nullptr, &count);
  std::vector<double> places(dimension * count);
  EXPECT_EQ(dsw_body_get_positions(scene, body, places.data(), count, 0, nullptr, &count), DSW_STATUS_OK);
  return places;
}

/// Lifts all bodies and particles and lowers them farther than they were; where they are after each move.
std::vector<double> move_on(dsw_scene* scene, size_t dimension) {
  std::vector<double> all;
  size_t count = 0;
  EXPECT_EQ(dsw_scene_get_body_count(scene, &count), DSW_STATUS_OK);
  std::vector<dsw_body_id> bodies(count);
  EXPECT_EQ(dsw_scene_get_body_ids(scene, bodies.data(), count, &count), DSW_STATUS_OK);
  EXPECT_EQ(dsw_scene_get_particle_count(scene, &count), DSW_STATUS_OK);
  std::vector<dsw_particle_id> particles(count);
  EXPECT_EQ(dsw_scene_get_particle_ids(scene, particles.data(), count, &count), DSW_STATUS_OK);
  for (const double by : {0.125, -0.5}) {
    for (const dsw_body_id body : bodies) {
      std::vector<double> places = places_of(scene, body, dimension), targets = places;
      for (size_t i = dimension - 1; i < targets.size(); i += dimension) targets[i] += by;
      EXPECT_EQ(dsw_body_move(scene, body, targets.data(), targets.size() / dimension, 0, nullptr, nullptr),
                DSW_STATUS_OK)
          << dsw_last_error_message();
      EXPECT_TRUE(by < 0 || places_of(scene, body, dimension) != places) << "nothing is in its way";
      places = places_of(scene, body, dimension);
      all.insert(all.end(), places.begin(), places.end());
    }
    for (const dsw_particle_id particle : particles) {
      double at[3] = {};
      EXPECT_EQ(dsw_particle_get_position(scene, particle, at, nullptr), DSW_STATUS_OK);
      at[dimension - 1] += by;
      EXPECT_EQ(dsw_particle_move(scene, particle, at, nullptr, nullptr), DSW_STATUS_OK);
      EXPECT_EQ(dsw_particle_get_position(scene, particle, at, nullptr), DSW_STATUS_OK);
      all.insert(all.end(), at, at + dimension);
    }
  }
  return all;
}

class KeptTest : public ::testing::TestWithParam<Release> {
 protected:
  std::string folder(const char* place) const { return std::string(GetParam().name) + "/" + place; }
  std::string kept(const std::string& name) const {
    const std::string bytes = read_all(DSW_RECORDINGS "/" + std::string(GetParam().name) + "/" + name);
    EXPECT_FALSE(bytes.empty()) << name;
    return bytes;
  }
  std::array<std::string, 2> kept_blocks(const std::string& name) const {
    return {kept(name + ".environment"), kept(name + ".scene")};
  }
};
INSTANTIATE_TEST_SUITE_P(Releases, KeptTest, ::testing::ValuesIn(kReleases), [](const auto& each) {
  std::string name = each.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

// Functions may have other names by now, and their numbers stay: as many names as numbers, each with a success.
TEST_P(KeptTest, EveryFunctionIsCalledAgainAndLeavesTheSameState) {
  for (const char* const place : {"space", "plane"}) {
    std::set<std::string> functions;
    size_t failed = 0;
    for (const std::string& path : kept_files(folder(place), ".dswrec")) {
      SCOPED_TRACE(path);
      const std::string recording = read_all(path);
      const ReplayPtr replay = open_replay(recording);
      ASSERT_NE(replay, nullptr);
      EXPECT_EQ(info_of(replay).version, GetParam().version);
      EXPECT_EQ(info_of(replay).flags, uint32_t{DSW_RECORDING_STATES});
      dsw_replay_report report = {};
      for (;;) {
        ASSERT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
        if (report.outcome == DSW_REPLAY_END) break;
        EXPECT_EQ(report.outcome, DSW_REPLAY_SAME)
            << "call " << report.call << ", " << report.function << ": " << report.differs;
        // A body that is elsewhere can have other vertices.
        EXPECT_TRUE(replay->goes_otherwise || (report.status == DSW_STATUS_OK) == (report.has_failed == 0));
        failed += report.has_failed;
        if (report.has_failed == 0) functions.insert(report.function);
      }
      EXPECT_EQ(info_of(replay).bytes_left, 0u);
    }
    const bool is_space = std::string(place) == "space";
    EXPECT_EQ(functions.size(), is_space ? GetParam().in_space : GetParam().in_plane) << place;
    EXPECT_TRUE(functions.empty() || failed > 10);
  }
}

/// A recording made again, as it is recorded today.
std::string recorded_again(const std::string& recording, size_t* calls) {
  const ReplayPtr replay = open_replay(recording);
  std::string taken;
  EXPECT_EQ(start(scene_of(replay), &taken, DSW_RECORDING_STATES), DSW_STATUS_OK);
  *calls = replay_all(replay);
  EXPECT_EQ(dsw_scene_stop_recording(scene_of(replay)), DSW_STATUS_OK);
  return taken;
}

// A recording that has no state, or whose states are not looked at, would be the same whatever is done. States of
// earlier formats are not looked at: they have forecasts in them.
TEST_P(KeptTest, AnotherStateIsNoticed) {
  size_t calls = 0;
  const std::string recording = recorded_again(kept("space/bodies.dswrec"), &calls);
  for (const size_t call : {0u, 12u, 50u}) {
    Entries entries(recording);
    entries.result(call)[2] ^= 1;
    const std::string altered = entries.sealed();
    const ReplayPtr replay = open_replay(altered);
    dsw_replay_report report = {};
    for (size_t i = 0; i <= call; ++i) {
      ASSERT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
      EXPECT_EQ(report.outcome, i == call ? DSW_REPLAY_DIFFERENT : DSW_REPLAY_SAME) << i;
    }
    EXPECT_EQ(report.differs, uint32_t{DSW_DIFFERS_STATE});
  }
}

// What is recorded while an old recording is made again is a recording of today.
TEST_P(KeptTest, AReplayIsRecordedInTheFormatOfToday) {
  size_t calls = 0;
  const std::string taken = recorded_again(kept("space/bodies.dswrec"), &calls);
  const ReplayPtr again = open_replay(taken);
  EXPECT_EQ(info_of(again).version, dsw_version());
  EXPECT_EQ(replay_all(again), calls);
}

struct Content {
  const char* name;
  uint32_t volumes, vertices;
  size_t particles, bodies;
  dsw_status check;  // of the environment
};
constexpr Content kInSpace[] = {{"bodies", 32, 75, 1, 8, DSW_STATUS_OK},
                                {"deform", 23, 87, 4, 2, DSW_STATUS_OK},
                                {"folded", 32, 75, 4, 2, DSW_STATUS_INVALID_CELL},
                                {"particles", 32, 75, 3, 0, DSW_STATUS_OK},
                                {"surgery", 59, 124, 1, 1, DSW_STATUS_OK}};
constexpr Content kInPlane[] = {{"bodies", 16, 25, 1, 7, DSW_STATUS_OK},
                                {"deform", 20, 30, 4, 1, DSW_STATUS_OK},
                                {"folded", 16, 25, 4, 1, DSW_STATUS_INVALID_CELL},
                                {"particles", 16, 25, 3, 0, DSW_STATUS_OK},
                                {"surgery", 29, 42, 1, 1, DSW_STATUS_OK}};

TEST_P(KeptTest, SnapshotsAreLoadedAndGoOn) {
  size_t files = 0;
  for (const char* const place : {"space", "plane"}) {
    const bool is_space = std::string(place) == "space";
    for (const std::string& path : kept_files(folder(place), ".scene")) {
      SCOPED_TRACE(path);
      ++files;
      const std::string name = std::filesystem::path(path).stem().string();
      const auto blocks = kept_blocks(std::string(place) + "/" + name);
      const Loaded loaded = load_both(blocks[0], blocks[1]);
      ASSERT_NE(loaded.scene, nullptr);
      const auto* content = std::find_if(is_space ? std::begin(kInSpace) : std::begin(kInPlane),
                                         is_space ? std::end(kInSpace) : std::end(kInPlane),
                                         [&](const Content& each) { return name == each.name; });
      ASSERT_NE(content, is_space ? std::end(kInSpace) : std::end(kInPlane));
      dsw_environment_info info;
      info.struct_size = sizeof info;
      ASSERT_EQ(dsw_environment_get_info(loaded.environment.get(), &info), DSW_STATUS_OK);
      EXPECT_EQ(info.dimension, is_space ? 3u : 2u);
      EXPECT_EQ(info.volume_count, content->volumes);
      EXPECT_EQ(info.vertex_count, content->vertices);
      EXPECT_EQ(dsw_environment_check(loaded.environment.get(), nullptr), content->check);
      size_t count = 99;
      EXPECT_EQ(dsw_scene_get_particle_count(loaded.scene.get(), &count), DSW_STATUS_OK);
      EXPECT_EQ(count, content->particles);
      EXPECT_EQ(dsw_scene_get_body_count(loaded.scene.get(), &count), DSW_STATUS_OK);
      EXPECT_EQ(count, content->bodies);
      const auto again = saved_as(loaded.scene.get(), blocks);
      if (saved_version(reinterpret_cast<const uint8_t*>(blocks[0].data())) ==
          saved_version(reinterpret_cast<const uint8_t*>(again[0].data()))) {
        EXPECT_TRUE(again[0] == blocks[0]) << "the environment";
      }
      EXPECT_TRUE(again[1] == blocks[1]) << "the scene";
      EXPECT_FALSE(move_on(loaded.scene.get(), info.dimension).empty());
    }
  }
  EXPECT_GE(files, 6u);
}

uint64_t state_of(dsw_scene* scene, const std::string& block) {
  const uint32_t format = saved_version(reinterpret_cast<const uint8_t*>(block.data()));
  return capi::visit(*scene, [&](const auto& engine) { return state_checksum(engine, format); });
}

// These were saved right after the last recorded call: two ways to the same state, and on from there.
TEST_P(KeptTest, ASnapshotIsWhereTheRecordingEnds) {
  size_t pairs = 0;
  for (const char* const place : {"space", "plane"}) {
    for (const std::string& path : kept_files(folder(place), ".dswrec")) {
      std::filesystem::path beside = path;
      if (!std::filesystem::exists(beside.replace_extension(".scene"))) continue;
      SCOPED_TRACE(path);
      const std::string recording = read_all(path);
      const ReplayPtr replay = open_replay(recording);
      replay_all(replay);
      const auto blocks = kept_blocks(std::string(place) + "/" + beside.stem().string());
      EXPECT_TRUE(saved_as(scene_of(replay), blocks)[0] == blocks[0]);
      const Loaded loaded = load_both(blocks[0], blocks[1]);
      ++pairs;
      // Walls pushed farther before 2.1.0, and rigid bodies went along chords: what they moved is elsewhere now.
      EXPECT_EQ(replay->goes_otherwise, beside.stem() == "deform" || beside.stem() == "bodies");
      if (replay->goes_otherwise) continue;
      EXPECT_EQ(state_of(scene_of(replay), blocks[1]), state_of(loaded.scene.get(), blocks[1]));
      const size_t dimension = std::string(place) == "space" ? 3 : 2;
      EXPECT_EQ(move_on(scene_of(replay), dimension), move_on(loaded.scene.get(), dimension));
    }
  }
  EXPECT_GE(pairs, 4u);
}

TEST_P(KeptTest, ABugReportHasItsValidationAndComesToItAgain) {
  size_t files = 0;
  for (const char* const place : {"space", "plane"}) {
    for (const std::string& path : kept_files(folder(place), ".bug_report")) {
      SCOPED_TRACE(path);
      ++files;
      const std::string report = read_all(path);
      const ReplayPtr replay = open_replay(report);
      ASSERT_NE(replay, nullptr);
      EXPECT_EQ(info_of(replay).version, GetParam().version);
      EXPECT_EQ(info_of(replay).flags, uint32_t{DSW_RECORDING_STATES} | DSW_RECORDING_BUG_REPORT);
      dsw_validation now = {};
      now.struct_size = sizeof now;
      dsw_replay_report step = {};
      ASSERT_EQ(dsw_replay_step_validated(replay.get(), &step, &now), DSW_STATUS_OK) << dsw_last_error_message();
      EXPECT_EQ(step.outcome, DSW_REPLAY_SAME);
      ASSERT_EQ(dsw_replay_step(replay.get(), &step), DSW_STATUS_OK);
      EXPECT_EQ(step.outcome, DSW_REPLAY_END);
      EXPECT_STREQ(info_of(replay).note, "the thread rests on the floor");
      const dsw_validation* const then = info_of(replay).validation;
      ASSERT_NE(then, nullptr);
      for (const dsw_validation* const each : {then, static_cast<const dsw_validation*>(&now)}) {
        EXPECT_EQ(each->is_right, 1u) << each->text;
        EXPECT_EQ(each->places, 3u);
        EXPECT_EQ(each->edges, 2u);
        EXPECT_GE(each->contacts, 2u);
        EXPECT_STREQ(each->text, "");
      }
      EXPECT_EQ(now.contacts, then->contacts);
      EXPECT_EQ(now.not_validated, then->not_validated);
    }
  }
  EXPECT_EQ(files, GetParam().in_plane == 0 ? 1u : 2u);
}

}  // namespace
}  // namespace dsw::oracle
