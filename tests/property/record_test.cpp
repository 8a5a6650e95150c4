// Recordings: every call that changes a scene, made again with the same bits, or damaged.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "record_support.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

class RecordTest : public SceneTest {};
DSW_FOR_ALL_SCENES(RecordTest);
class PlaneRecordTest : public SceneTest {};
DSW_FOR_ALL_PLANE_SCENES(PlaneRecordTest);

template <int D>
void is_made_again(const std::string& scene) {
  size_t calls = 0;
  const auto seeds = static_cast<uint64_t>(std::max(3, effort_of(4)));  // for each kind of features
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const uint32_t features = seed == 2   ? uint32_t{DSW_FEATURE_LIVE_CHANGES}
                              : seed == 3 ? DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_STATISTICS
                                          : 0u;
    RandomEdits<D> edits(scene, seed, nullptr, features);
    if (edits.environment() == nullptr) continue;
    std::string recording, later;
    const auto change = [&](int times) {
      for (int i = 0; i < times; ++i) {
        ASSERT_EQ(edits.step(), "");
        edits.mark();
        if (i % 4 == 3) {
          ASSERT_EQ(edits.move_all(), "");
        }
      }
    };
    ASSERT_EQ(start(edits.handle(), &recording), DSW_STATUS_OK) << dsw_last_error_message();
    change(std::clamp(effort_of(30), 12, 30));
    ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
    const ReplayPtr replay = open_replay(recording);
    calls += replay_all(replay);
    ASSERT_TRUE(saved_both(scene_of(replay)) == edits.saved()) << "scene seed " << seed;
    // Now that the points are the host's.
    ASSERT_EQ(start(edits.handle(), &later), DSW_STATUS_OK);
    change(std::clamp(effort_of(20), 8, 20));
    ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
    const ReplayPtr second = open_replay(later);
    calls += replay_all(second);
    ASSERT_TRUE(saved_both(scene_of(second)) == edits.saved()) << "scene seed " << seed << ", the second time";
  }
  EXPECT_GT(calls, 0u);
}

TEST_P(RecordTest, WhatWasRecordedIsMadeAgainWithTheSameBits) { is_made_again<3>(GetParam()); }
TEST_P(PlaneRecordTest, WhatWasRecordedIsMadeAgainWithTheSameBits) { is_made_again<2>(GetParam()); }

/// What random changes do not call, on a grid of cubes. The points that are lent must outlive it.
void call_the_others(dsw_scene* scene, std::vector<double>& lent, std::vector<double>& lent_next) {
  dsw_environment* const environment = dsw_scene_get_environment(scene);
  const auto ok = [](dsw_status status) { EXPECT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message(); };
  const dsw_volume_id null_volume = {0, 0};
  dsw_volume_id first;
  ok(dsw_environment_get_volume_id(environment, 0, &first));
  double centre[3];
  ok(dsw_environment_get_centre(environment, first, centre));
  const auto point = [&](double x, double y, double z) { return Vec{centre[0] + x, centre[1] + y, centre[2] + z}; };
  constexpr double kNear = 1e-3;
  ok(dsw_environment_set_tag(environment, first, 7));
  ok(dsw_environment_mark_region(environment, 12345, DSW_MARK_IMPASSABLE, 0, nullptr, nullptr));
  ok(dsw_environment_mark_between(environment, 12345, 54321, DSW_MARK_IMPASSABLE, nullptr));
  dsw_vertex_id vertex;
  ok(dsw_environment_get_vertex_id(environment, 0, &vertex));
  ok(dsw_environment_mark_vertices(environment, &vertex, 1, DSW_MARK_IMPASSABLE));
  dsw_face_id face;
  ok(dsw_environment_get_face_id(environment, first, 0, &face));
  const double load = 0;
  ok(dsw_environment_tear_faces(environment, &face, &load, 1, 1, nullptr));
  dsw_status marked = DSW_STATUS_BAD_TOPOLOGY;  // until a face is on the outer boundary
  for (uint32_t i = 0; marked == DSW_STATUS_BAD_TOPOLOGY; ++i) {
    const dsw_face_id one = {i / 6, 1, i % 6};
    marked = dsw_environment_mark_exits(environment, &one, 1, 4);
  }
  ok(marked);

  // Diagonals of bottom and top, and the volume along both.
  dsw_vertex_id corner_ids[8];
  size_t corner_count = 0;
  ok(dsw_environment_copy_vertices(environment, {DSW_CELL_VOLUME, first.index, first.generation, 0}, corner_ids, 8,
                                   &corner_count));
  for (const uint32_t ring : {0u, 4u}) {
    const size_t ends[] = {0, 4};
    dsw_face_id quad;
    uint32_t indices[4];
    for (uint32_t k = 0; k < 4; ++k) indices[k] = corner_ids[ring + k].index;
    ok(dsw_environment_find_faces(environment, 1, ends, indices, &quad, nullptr));
    ok(dsw_environment_split_face(environment, quad, corner_ids[ring], corner_ids[ring + 2], nullptr, nullptr));
  }
  ok(dsw_environment_get_volume_id(environment, first.index, &first));
  const dsw_vertex_id loop[] = {corner_ids[0], corner_ids[2], corner_ids[6], corner_ids[4]};
  ok(dsw_environment_split_volume(environment, first, loop, 4, nullptr, nullptr));
  ok(dsw_environment_get_volume_id(environment, first.index, &first));
  ok(dsw_environment_get_centre(environment, first, centre));

  const std::vector<Vec> places = {point(0, 0, 0), point(kNear, 0, 0), point(0, kNear, 0)};
  std::vector<dsw_particle_id> particles(places.size());
  ok(dsw_scene_create_particles(scene, places[0].data(), places.size(), 0, nullptr, particles.data(), nullptr));
  ok(dsw_particle_create(scene, places[0].data(), first, &particles[0]));
  ok(dsw_particle_move(scene, particles[0], places[1].data(), nullptr, nullptr));
  ok(dsw_scene_move_particles(scene, particles.data(), particles.size(), places[0].data(), 0, nullptr, nullptr));
  std::vector<dsw_flight> flights(particles.size());
  ok(dsw_scene_cast_from_particles(scene, particles.data(), particles.size(), places[0].data(), 0, nullptr,
                                   flights.data()));
  ok(dsw_particle_destroy(scene, particles[0]));
  ok(dsw_scene_reset_statistics(scene));

  std::vector<Vec> corners = {point(0, 0, kNear), point(kNear, 0, kNear), point(0, kNear, kNear)};
  const uint32_t offsets[] = {0, 3}, triangle[] = {0, 1, 2};
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  desc.positions = corners[0].data();
  desc.vertex_count = corners.size();
  desc.face_offsets = offsets;
  desc.face_corners = triangle;
  desc.face_count = 1;
  desc.face_corner_count = 3;
  desc.flags = DSW_BODY_SELF_CONTACTS;
  desc.radius = kNear / 256;
  dsw_body_id body;
  ok(dsw_body_create(scene, &desc, &body));
  ok(dsw_body_set_level(scene, body, DSW_LEVEL_FACES));
  ok(dsw_body_set_filter(scene, body, 2, 4));
  ok(dsw_body_set_radius(scene, body, kNear / 128));
  const dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, kNear}};
  ok(dsw_body_move_rigid(scene, body, &motion, nullptr, nullptr));
  ok(dsw_body_move(scene, body, corners[0].data(), corners.size(), 0, nullptr, nullptr));
  dsw_move_options options = defaults(dsw_move_options_init);
  const uint32_t order[] = {2, 0};
  options.order = order;
  options.order_count = 2;
  ok(dsw_body_move(scene, body, corners[0].data(), corners.size(), 0, &options, nullptr));
  ok(dsw_scene_move_bodies(scene, &body, 1, corners[0].data(), corners.size(), 0, nullptr, nullptr));
  ok(dsw_body_set_radius(scene, body, 0));  // those below move thin bodies alone
  for (Vec& corner : corners) corner[0] += kNear / 8;
  dsw_together_options together = defaults(dsw_together_options_init);
  together.stop = DSW_TOGETHER_STOP_FEATURE;
  ok(dsw_scene_move_together(scene, &body, 1, corners[0].data(), corners.size(), 0, &together, nullptr));
  const dsw_rigid_motion back = {{0, 0, 0, 1}, {0, 0, 0}, {-kNear / 16, 0, 0}};
  ok(dsw_scene_move_rigid(scene, &body, 1, &back, nullptr, nullptr));
  const std::vector<Vec> beside = {point(9, 0, 0), point(9, 1, 0), point(9, 0, 1), point(9, 1, 1)};
  dsw_cut_desc blade = defaults(dsw_cut_desc_init);
  blade.points = beside[0].data();
  blade.rows = blade.columns = 2;
  ok(dsw_scene_cut_bodies(scene, &blade, &body, 1, nullptr));
  const double* now = nullptr;
  size_t point_count = 0;
  ok(dsw_environment_get_points(environment, &now, &point_count));
  lent.assign(now, now + 3 * point_count);
  lent[3 * size_t{corner_ids[0].index}] += kNear;
  lent.resize(2 * lent.size());
  dsw_scene_deform_options lending = defaults(dsw_scene_deform_options_init);
  lending.point_room = 2 * point_count;
  for (Vec& corner : corners) corner[1] += kNear / 8;
  dsw_deform_report bent = {};
  ok(dsw_scene_deform(scene, lent.data(), point_count, &body, 1, corners[0].data(), corners.size(), 0, &lending, &bent,
                      nullptr));
  EXPECT_EQ(bent.outcome, DSW_DEFORM_DONE);
  lent_next.assign(lent.begin(), lent.end());
  ok(dsw_scene_deform_rigid(scene, lent_next.data(), point_count, &body, 1, &back, &lending, &bent, nullptr));
  EXPECT_EQ(bent.outcome, DSW_DEFORM_DONE);
  dsw_body_edge_id edges[3];
  size_t count = 0;
  ok(dsw_body_get_edge_ids(scene, body, edges, 3, &count));
  dsw_body_edit edit;
  ok(dsw_body_split_edge(scene, body, edges[0], 0.5, &edit));
  ok(dsw_body_collapse_edge(scene, body, edit.rest, edit.vertex, nullptr));
  dsw_body_vertex_id added, corner;
  dsw_body_edge_id edge;
  dsw_body_face_id made;
  const Vec fourth = point(kNear, kNear, kNear);
  ok(dsw_body_get_vertex_id(scene, body, 1, &corner));
  ok(dsw_body_add_vertex(scene, body, fourth.data(), null_volume, &added));
  ok(dsw_body_add_edge(scene, body, corner, added, &edge));
  dsw_body_vertex_id third;
  ok(dsw_body_get_vertex_id(scene, body, 2, &third));
  ok(dsw_body_add_face(scene, body, corner, added, third, &made));
  ok(dsw_body_remove_face(scene, body, made));
  ok(dsw_body_remove_edge(scene, body, edge));
  ok(dsw_body_get_edge_ids(scene, body, nullptr, 0, &count) == DSW_STATUS_BUFFER_TOO_SMALL ? DSW_STATUS_OK
                                                                                           : DSW_STATUS_INTERNAL);
  std::vector<dsw_body_edge_id> rest(count);
  ok(dsw_body_get_edge_ids(scene, body, rest.data(), rest.size(), &count));
  for (const dsw_body_edge_id& each : rest) {
    dsw_body_vertex_id ends[2];
    ok(dsw_body_get_edge_ends(scene, body, each, ends));
    if (ends[0].index == added.index || ends[1].index == added.index) ok(dsw_body_remove_edge(scene, body, each));
  }
  ok(dsw_body_remove_vertex(scene, body, added));
  uint32_t freed = 0;
  ok(dsw_body_depenetrate(scene, body, null_volume, 0, &freed, nullptr));
  ok(dsw_body_destroy(scene, body));
}

// The first of each kind is kept in the folder DSW_KEEP_RECORDINGS, if there is one: so are those of tests/record made.
void keep_recording(const std::string& kind, const std::string& recording) {
  const char* const folder = std::getenv("DSW_KEEP_RECORDINGS");
  if (folder != nullptr) std::ofstream(std::string(folder) + "/" + kind + ".dswrec", std::ios::binary) << recording;
}

TEST(RecordedCallsTest, EveryCallIsMadeAgain) {
  if (seed_of(0) != 0) GTEST_SKIP() << "its calls fit what DSW_SEED=0 draws";
  std::set<std::string> functions;
  for (const char* kind : {"hex", "tet_kuhn", "polyhedra"}) {
    for (uint64_t seed = 1; seed <= std::min(seeds_of(64, 4), uint64_t{8}); ++seed) {
      std::vector<double> lent, lent_next;
      RandomEdits<3> edits(kind, seed, nullptr, DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_STATISTICS);
      if (edits.environment() == nullptr) continue;
      std::string recording;
      ASSERT_EQ(start(edits.handle(), &recording), DSW_STATUS_OK);
      const bool by_hand = std::string(kind) == "hex" && seed == 1;
      if (by_hand) call_the_others(edits.handle(), lent, lent_next);
      for (int i = 0; i < 40 && !by_hand; ++i) {
        ASSERT_EQ(edits.step(), "");
        edits.mark();
        if (i % 8 == 7) {
          ASSERT_EQ(edits.move_all(), "");
        }
      }
      ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
      if (seed == 1) keep_recording(kind, recording);
      const ReplayPtr replay = open_replay(recording);
      replay_all(replay, &functions);
      ASSERT_TRUE(saved_both(scene_of(replay)) == edits.saved()) << kind << " " << seed;
    }
  }
  std::string names;
  for (const std::string& name : functions) names += name + "\n";
  EXPECT_EQ(functions.size(), capi::kCallCount) << names;
}

// A wrong byte anywhere is found, and a recording that ends anywhere is replayed up to there.
TEST(DamagedRecordingTest, IsFoundOrReplayedUpToWhereItEnds) {
  RandomEdits<3> edits("tet_kuhn", 5);
  ASSERT_NE(edits.environment(), nullptr);
  std::string recording;
  ASSERT_EQ(start(edits.handle(), &recording), DSW_STATUS_OK);
  const size_t beginning = recording.size();
  for (int i = 0; i < 8; ++i) ASSERT_EQ(edits.step(), "");
  ASSERT_EQ(dsw_scene_stop_recording(edits.handle()), DSW_STATUS_OK);
  const size_t all = replay_all(open_replay(recording));
  ASSERT_GT(all, 2u);
  size_t unfinished = 0, ended = 0;
  for (size_t size = beginning; size <= recording.size(); size += 8) {
    const std::string part = recording.substr(0, size);  // the replay reads it as long as it lives
    const ReplayPtr replay = open_replay(part);
    dsw_replay_report report = {};
    do {
      ASSERT_EQ(dsw_replay_step(replay.get(), &report), DSW_STATUS_OK) << dsw_last_error_message();
      ASSERT_NE(report.outcome, DSW_REPLAY_DIFFERENT);
    } while (report.outcome == DSW_REPLAY_SAME);
    ++(report.outcome == DSW_REPLAY_END ? ended : unfinished);
  }
  EXPECT_GT(unfinished, 0u);
  EXPECT_GT(ended, 0u);
  for (size_t at = 0; at < recording.size(); at += at < beginning ? 97 : 1) {
    std::string damaged = recording;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    dsw_replay* made = nullptr;
    dsw_status status = dsw_replay_create(nullptr, damaged.data(), damaged.size(), &made);
    const ReplayPtr replay(made);
    size_t same = 0;
    for (dsw_replay_report report = {}; status == DSW_STATUS_OK;) {
      status = dsw_replay_step(replay.get(), &report);
      if (status == DSW_STATUS_OK) {
        ASSERT_EQ(report.outcome, DSW_REPLAY_SAME) << "byte " << at;
        ++same;
      }
    }
    EXPECT_TRUE(status == DSW_STATUS_CORRUPT || (at < 16 && status == DSW_STATUS_BAD_VERSION)) << "byte " << at;
    ASSERT_LT(same, all) << "byte " << at;
  }
}

}  // namespace
}  // namespace dsw::oracle
