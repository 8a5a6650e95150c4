// What leaves through exits, and when and where, against exact integers; and that exits survive what happens to faces.
#include "support.h"

#include <map>

namespace dsw::oracle {
namespace {

class ExitsTest : public SceneTest {};
DSW_FOR_ALL_SCENES(ExitsTest);

/// Every other face of the outer boundary is an exit of one of three patches.
std::map<int, uint32_t> mark_exits(Place& place, Rng& rng) {
  const World& world = *place.world;
  std::map<int, uint32_t> patches;
  for (size_t f = 0; f < world.faces.size(); ++f) {
    const dsw_face_id id = face_id(world, static_cast<int>(f));
    if (world.faces[f].cell[1] >= 0) {
      EXPECT_EQ(dsw_environment_mark_exits(place.get(), &id, 1, 1), DSW_STATUS_BAD_TOPOLOGY);
      continue;
    }
    if (!rng.chance(0.5)) continue;
    const auto patch = static_cast<uint32_t>(rng.between(1, 3));
    EXPECT_EQ(dsw_environment_mark_exits(place.get(), &id, 1, patch), DSW_STATUS_OK) << dsw_last_error_message();
    patches[static_cast<int>(f)] = patch;
  }
  return patches;
}

void mark_some(Place& place, Rng& rng) {
  World& world = *place.world;
  for (Face& f : world.faces) {
    if (!rng.chance(0.05)) continue;
    f.marked = true;
    const dsw_face_id id = face_id(world, static_cast<int>(&f - world.faces.data()));
    EXPECT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
}

Vec far_from(const Vec& from, Motions& motions, Rng& rng) {
  Vec to = motions.target(from);
  const double by = rng.chance(0.5) ? 3 : 1;
  for (size_t k = 0; k < 3; ++k) to[k] = from[k] + by * (to[k] - from[k]);
  return finite(to) ? to : from;
}

/// A particle, or a body of one vertex, moves at random; which of both must leave is known from exact integers.
class Leavers {
 public:
  Leavers(Place& place, const std::map<int, uint32_t>& patches, Rng& rng)
      : world_(*place.world), patches_(patches), rng_(rng), scene_(make_scene(place.get(), DSW_FEATURE_LIVE_CHANGES)) {}

  int moves = 0, left = 0, stopped = 0, wrong = 0;

  void move(const Vec& from, const Vec& to, const std::string& where) {
    const Walk walk = world_.cast(world_.body(from.data()), world_.body(to.data()));
    ASSERT_NE(walk.outcome, Walk::kBroken) << walk.fault;
    dsw_particle_id particle{};
    const dsw_status made = dsw_particle_create(scene_.get(), from.data(), {}, &particle);
    const bool starts = walk.outcome != Walk::kOutside && walk.outcome != Walk::kImpassable;
    ASSERT_EQ(made == DSW_STATUS_OK, starts) << where;
    if (!starts) return;
    const auto found = walk.outcome == Walk::kContact ? patches_.find(walk.face) : patches_.end();
    patch_ = found == patches_.end() ? 0 : found->second;
    left += patch_ != 0 ? 1 : 0;
    stopped += patch_ == 0 && walk.outcome == Walk::kContact ? 1 : 0;
    moves += 2;
    const int failed = failures();
    move_particle(walk, particle, to, where);
    move_body(walk, from, to, where);
    wrong += failures() != failed ? 1 : 0;
  }

 private:
  static int failures() { return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count(); }

  void is_right(const Walk& walk, const dsw_exit* exits, size_t count, const std::string& where) {
    ASSERT_EQ(count, patch_ != 0 ? 1u : 0u) << where;
    if (count == 0) return;
    EXPECT_EQ(exits[0].patch, patch_) << where;
    EXPECT_EQ(exits[0].time, walk.time) << where;
    EXPECT_TRUE(same(exits[0].face, face_id(world_, walk.face))) << where;
  }

  void move_particle(const Walk& walk, dsw_particle_id particle, const Vec& to, const std::string& where) {
    dsw_cast_options options = defaults(dsw_cast_options_init);
    const bool leaves = rng_.chance(0.5);
    options.flags = leaves ? uint32_t{DSW_CAST_LEAVE} : 0;
    dsw_flight flight;
    ASSERT_EQ(dsw_particle_move(scene_.get(), particle, to.data(), &options, &flight), DSW_STATUS_OK);
    EXPECT_EQ(flight.outcome == DSW_OUTCOME_EXIT, patch_ != 0) << where;
    EXPECT_EQ(flight.outcome == DSW_OUTCOME_REACHED, walk.outcome == Walk::kReached) << where;
    const dsw_exit* exits = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_scene_get_exits(scene_.get(), &exits, &count), DSW_STATUS_OK);
    is_right(walk, exits, count, where);
    const dsw_status there = dsw_particle_get_position(scene_.get(), particle, nullptr, nullptr);
    EXPECT_EQ(there == DSW_STATUS_OK, patch_ == 0 || !leaves) << where;
    if (there == DSW_STATUS_OK) {
      EXPECT_EQ(dsw_particle_destroy(scene_.get(), particle), DSW_STATUS_OK);
    }
  }

  void move_body(const Walk& walk, const Vec& from, const Vec& to, const std::string& where) {
    dsw_body_desc desc = defaults(dsw_body_desc_init);
    desc.positions = from.data();
    desc.vertex_count = 1;
    desc.level = DSW_LEVEL_POINTS;
    dsw_body_id body{};
    ASSERT_EQ(dsw_body_create(scene_.get(), &desc, &body), DSW_STATUS_OK) << dsw_last_error_message();
    dsw_move_options options = defaults(dsw_move_options_init);
    options.flags = DSW_MOVE_LEAVE;
    ASSERT_EQ(dsw_body_move(scene_.get(), body, to.data(), 1, 0, &options, nullptr), DSW_STATUS_OK);
    const dsw_exit* exits = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_get_exits(scene_.get(), body, &exits, &count), DSW_STATUS_OK);
    is_right(walk, exits, count, where);
    dsw_body_counts counts{};
    counts.struct_size = sizeof counts;
    ASSERT_EQ(dsw_body_get_counts(scene_.get(), body, &counts), DSW_STATUS_OK);
    EXPECT_EQ(counts.vertex_count, patch_ != 0 ? 0u : 1u) << where;
    EXPECT_EQ(dsw_body_destroy(scene_.get(), body), DSW_STATUS_OK);
  }

  World& world_;
  const std::map<int, uint32_t>& patches_;
  Rng& rng_;
  ScenePtr scene_;
  uint32_t patch_ = 0;
};

TEST_P(ExitsTest, WhatComesToAnExitLeavesAndNothingElse) {
  int moves = 0, left = 0, stopped = 0, wrong = 0;
  for (uint64_t seed = 1; seed < 1 + seeds_of(3, 1); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    if (place.world->outer_boundary_crosses()) continue;
    Rng rng(seed);
    mark_some(place, rng);
    const std::map<int, uint32_t> patches = mark_exits(place, rng);
    Leavers leavers(place, patches, rng);
    Motions motions(*place.world, rng);
    for (int i = 0; i < at_least(60); ++i) {
      const Vec from = motions.start();
      leavers.move(from, far_from(from, motions, rng),
                   GetParam() + " seed " + std::to_string(seed) + " move " + std::to_string(i));
    }
    moves += leavers.moves;
    wrong += leavers.wrong;
    left += leavers.left;
    stopped += leavers.stopped;
  }
  RecordProperty("exit_moves", moves);
  RecordProperty("exits_wrong", wrong);
  if (moves > 100) {
    EXPECT_GT(left, 0);
    EXPECT_GT(stopped, 0);
  }
}

/// Saved and loaded, and merged into large cells, exits have the same faces, by their vertices.
TEST_P(ExitsTest, SavedAndCoarsenedOnesAreTheSame) {
  const auto by_vertices = [](dsw_environment* environment) {
    std::map<std::vector<uint32_t>, uint32_t> found;
    size_t count = 0;
    dsw_environment_get_exit_faces(environment, nullptr, 0, &count);
    std::vector<dsw_face_id> faces(count);
    EXPECT_EQ(dsw_environment_get_exit_faces(environment, faces.data(), count, &count), DSW_STATUS_OK);
    for (const dsw_face_id face : faces) {
      dsw_vertex_id corners[64];
      size_t corner_count = 0;
      EXPECT_EQ(dsw_environment_copy_vertices(environment, cell_of(face), corners, 64, &corner_count), DSW_STATUS_OK);
      std::vector<uint32_t> key;
      for (size_t i = 0; i < corner_count; ++i) key.push_back(corners[i].index);
      std::sort(key.begin(), key.end());
      EXPECT_EQ(dsw_environment_get_exit(environment, face, &found[key]), DSW_STATUS_OK);
    }
    EXPECT_EQ(found.size(), count);
    return found;
  };
  Place place = make_place(GetParam(), 3);
  ASSERT_PLACE(place);
  Rng rng(3);
  const size_t marked = mark_exits(place, rng).size();
  const auto exits = by_vertices(place.get());
  EXPECT_EQ(exits.size(), marked);
  size_t size = 0;
  dsw_environment_save(place.get(), nullptr, 0, &size);
  std::vector<unsigned char> block(size);
  ASSERT_EQ(dsw_environment_save(place.get(), block.data(), size, &size), DSW_STATUS_OK);
  dsw_environment* loaded = nullptr;
  ASSERT_EQ(dsw_environment_load(nullptr, block.data(), size, &loaded), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(by_vertices(EnvironmentPtr(loaded).get()), exits);
  dsw_environment* coarse = nullptr;
  if (dsw_environment_coarsen(place.get(), nullptr, &coarse, nullptr, 0, nullptr) != DSW_STATUS_OK) return;
  EXPECT_EQ(by_vertices(EnvironmentPtr(coarse).get()), exits);
}

}  // namespace
}  // namespace dsw::oracle
