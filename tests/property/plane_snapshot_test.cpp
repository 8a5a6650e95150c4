// Snapshots of the plane, also those of version 1.0.0, whose records were wider.
#include "plane_support.h"
#include "record_support.h"
#include "snapshot/bytes.h"
#include "snapshot_support.h"
#include "wheel.h"

namespace dsw::oracle {
namespace {

/// With a volume, vertices and sides of the hub that are impassable.
EnvironmentPtr make_marked_wheel() {
  const Wheel wheel;
  EnvironmentPtr environment = create_from(wheel.describe());
  dsw_volume_id hub, volume;
  EXPECT_EQ(dsw_environment_get_volume_id(environment.get(), 0, &hub), DSW_STATUS_OK);
  EXPECT_EQ(dsw_environment_get_volume_id(environment.get(), 3, &volume), DSW_STATUS_OK);
  EXPECT_EQ(dsw_environment_mark_volumes(environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
            DSW_STATUS_OK);
  for (const uint32_t i : {0u, 7u}) {
    dsw_vertex_id vertex;
    EXPECT_EQ(dsw_environment_get_vertex_id(environment.get(), i, &vertex), DSW_STATUS_OK);
    EXPECT_EQ(dsw_environment_mark_vertices(environment.get(), &vertex, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  for (const uint32_t i : {2u, 11u, 19u}) {
    dsw_face_id face;
    EXPECT_EQ(dsw_environment_get_face_id(environment.get(), hub, i, &face), DSW_STATUS_OK);
    EXPECT_EQ(dsw_environment_mark_faces(environment.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  return environment;
}

Bytes kept(const char* name) {
  const std::string block = read_all(std::string(DSW_RECORDINGS "/1.0.0/plane/") + name);
  EXPECT_FALSE(block.empty()) << name;
  return {block.begin(), block.end()};
}

TEST(PlaneSnapshotTest, WhatVersion1HasSavedComesBack) {
  const EnvironmentPtr environment = load_environment(kept("environment.snapshot")), made = make_marked_wheel();
  EXPECT_EQ(saved(environment.get()), saved(made.get())) << "saved anew it is what is saved today";
  EXPECT_EQ(saved(load_environment(saved(made.get())).get()), saved(made.get()));
  // Particles go on in either.
  const Bytes block = kept("scene.snapshot");
  std::vector<dsw_flight> flights[2];
  for (const dsw_environment* each : {environment.get(), made.get()}) {
    const ScenePtr owner = load_scene(const_cast<dsw_environment*>(each), block);
    dsw_scene* const scene = owner.get();
    // Saved anew it has today's version, and comes back to the bit.
    const Bytes again = saved(owner.get());
    const ScenePtr copy = load_scene(const_cast<dsw_environment*>(each), again);
    EXPECT_EQ(saved(copy.get()), again);
    std::vector<dsw_particle_id> particles(3);
    size_t count = 0;
    ASSERT_EQ(dsw_scene_get_particle_ids(scene, particles.data(), 3, &count), DSW_STATUS_OK);
    ASSERT_EQ(count, 3u);
    const double targets[6] = {-2, 0.25, -2.5, -0.5, 0.125, -3};
    std::vector<dsw_flight>& out = flights[each == made.get()];
    out.resize(3);
    ASSERT_EQ(dsw_scene_move_particles(scene, particles.data(), 3, targets, 0, nullptr, out.data()), DSW_STATUS_OK);
  }
  EXPECT_EQ(std::memcmp(flights[0].data(), flights[1].data(), 3 * sizeof(dsw_flight)), 0);
  // Cells of one kind need no tables of records.
  for (const char* name : {"triangles.snapshot", "quad.snapshot"}) {
    const EnvironmentPtr uniform = load_environment(kept(name));
    EXPECT_EQ(saved(load_environment(saved(uniform.get())).get()), saved(uniform.get()));
    EXPECT_EQ(dsw_environment_check(uniform.get(), nullptr), DSW_STATUS_OK);
  }
}

/// With its checksum right.
Bytes sealed(Bytes block) {
  constexpr size_t kAt = 24;
  auto* const bytes = reinterpret_cast<uint8_t*>(&block[0]);
  const uint64_t sum = checksum(checksum(0, bytes, kAt), bytes + kAt + 8, block.size() - kAt - 8);
  std::memcpy(bytes + kAt, &sum, sizeof sum);
  return block;
}

TEST(PlaneSnapshotTest, DamagedRecordsOfVersion1AreRefusedOrSound) {
  const Bytes block = kept("environment.snapshot");
  Rng rng(3);
  size_t refused = 0, accepted = 0;
  for (int i = 0; i < at_least(4000); ++i) {
    Bytes damaged = block;
    const size_t at = 32 + 4 * rng.below((block.size() - 32) / 4);
    uint32_t word = 0;
    std::memcpy(&word, &block[at], 4);
    const uint32_t values[] = {word ^ (1u << rng.below(32)), static_cast<uint32_t>(rng.below(64)), word + 8,
                               0xffffffffu};
    std::memcpy(&damaged[at], &values[rng.below(4)], 4);
    damaged = sealed(damaged);
    dsw_environment* environment = nullptr;
    const dsw_status status = dsw_environment_load(nullptr, damaged.data(), damaged.size(), &environment);
    if (status != DSW_STATUS_OK) {
      EXPECT_TRUE(status == DSW_STATUS_CORRUPT || status == DSW_STATUS_TRUNCATED) << dsw_last_error_message();
      ++refused;
      continue;
    }
    const EnvironmentPtr owner(environment);
    EXPECT_EQ(saved(load_environment(saved(owner.get())).get()), saved(owner.get()));
    ++accepted;
  }
  RecordProperty("refused", std::to_string(refused));
  RecordProperty("accepted", std::to_string(accepted));
  EXPECT_GT(refused, 1000u);
}

/// Quadrilaterals are no longer known to be convex once points have moved.
TEST(PlaneSnapshotTest, EdgesAmongPolygonsThatHaveMoved) {
  std::vector<double> next;  // lent
  const EnvironmentPtr environment = make_squares(8, false);
  ScenePtr scene = make_scene(environment.get());
  const double points[4] = {1.5, 1.4, 6.5, 6.3}, targets[4] = {1.55, 1.42, 6.45, 6.2};
  const uint32_t edge[2] = {0, 1};
  dsw_body_desc d = defaults(dsw_body_desc_init);
  d.positions = points;
  d.vertex_count = 2;
  d.edges = edge;
  d.edge_count = 1;
  dsw_body_id body;
  ASSERT_EQ(dsw_body_create(scene.get(), &d, &body), DSW_STATUS_OK) << dsw_last_error_message();
  ASSERT_EQ(dsw_body_move(scene.get(), body, targets, 2, 0, nullptr, nullptr), DSW_STATUS_OK);
  const Bytes block = saved(scene.get());
  scene.reset();
  scene = make_scene(environment.get(), DSW_FEATURE_DEFORMING);
  const double* at_first = nullptr;
  size_t point_count = 0;
  ASSERT_EQ(dsw_environment_get_points(environment.get(), &at_first, &point_count), DSW_STATUS_OK);
  next.assign(at_first, at_first + 2 * point_count);
  ASSERT_EQ(dsw_environment_deform(environment.get(), next.data(), next.size() / 2, nullptr, nullptr), DSW_STATUS_OK);
  scene.reset();
  scene = load_scene(environment.get(), block);
  dsw_scene* const loaded = scene.get();
  ASSERT_EQ(dsw_body_move(loaded, body, points, 2, 0, nullptr, nullptr), DSW_STATUS_OK);
  double at[4];
  size_t count = 0;
  ASSERT_EQ(dsw_body_get_positions(loaded, body, at, 2, 0, nullptr, &count), DSW_STATUS_OK);
  EXPECT_TRUE(std::equal(at, at + 4, points));
}

/// Section `number` of a block begins here.
size_t section_at(const Bytes& block, uint32_t number) {
  uint32_t count = 0;
  std::memcpy(&count, &block[44], sizeof count);
  size_t at = 48 + size_t{count} * 8;
  for (uint32_t i = 0; i < number; ++i) {
    uint64_t bytes = 0;
    std::memcpy(&bytes, &block[48 + size_t{i} * 8], sizeof bytes);
    at += (bytes + 7) / 8 * 8;
  }
  return at;
}

TEST(PlaneSnapshotTest, NoBodyIsAtTheLevelOfFaces) {
  constexpr uint32_t kBodies = 7;  // their numbers begin with the level
  const EnvironmentPtr environment = make_squares(2, false);
  const ScenePtr scene = make_scene(environment.get());
  const double point[2] = {0.5, 0.5};
  dsw_body_desc d = defaults(dsw_body_desc_init);
  d.positions = point;
  d.vertex_count = 1;
  d.level = DSW_LEVEL_EDGES;
  dsw_body_id body;
  ASSERT_EQ(dsw_body_create(scene.get(), &d, &body), DSW_STATUS_OK) << dsw_last_error_message();
  const Bytes block = saved(scene.get());
  const size_t at = section_at(block, kBodies);
  ASSERT_EQ(block[at], 1);
  for (const auto& [level, status] : {std::pair(0, DSW_STATUS_OK), std::pair(3, DSW_STATUS_CORRUPT)}) {
    Bytes changed = block;
    changed[at] = static_cast<unsigned char>(level);
    changed = sealed(changed);
    dsw_scene* loaded = nullptr;
    EXPECT_EQ(dsw_scene_load(environment.get(), changed.data(), changed.size(), &loaded), status) << level;
    const ScenePtr owner(loaded);
  }
}

}  // namespace
}  // namespace dsw::oracle
