// A coarsened environment is the same space in fewer cells: valid, exactly as large, and whatever flies, is swept or
// moves meets the same faces at the same times.
#include "body_support.h"

#include "../gmp_numbers.h"

#include <algorithm>

namespace dsw::oracle {
namespace {

struct Coarse {
  EnvironmentPtr environment;
  std::vector<uint32_t> map;
  dsw_coarsen_report report{};
};

Coarse coarsened(const Place& place, uint32_t max_faces) {
  Coarse coarse;
  dsw_coarsen_options options = defaults(dsw_coarsen_options_init);
  options.max_faces = max_faces;
  coarse.report.struct_size = sizeof coarse.report;
  coarse.map.resize(place.world->ids.size());
  dsw_environment* made = nullptr;
  EXPECT_EQ(dsw_environment_coarsen(place.get(), &options, &made, coarse.map.data(), coarse.map.size(), &coarse.report),
            DSW_STATUS_OK)
      << dsw_last_error_message();
  coarse.environment.reset(made);
  return coarse;
}

/// Six times the volume inside of the triangles that a volume's tetrahedra are made of, exactly. Volumes of triangles
/// only.
mpq_class volume_of(const dsw_environment* environment, uint32_t index) {
  mpq_class sum = 0;
  uint32_t faces = 0;
  EXPECT_EQ(dsw_environment_get_volume_counts(environment, {index, 1}, nullptr, nullptr, nullptr, &faces),
            DSW_STATUS_OK);
  for (uint32_t f = 0; f < faces; ++f) {
    mpq_class p[3][3];
    const auto vertices = vertices_of(environment, cell_of(dsw_face_id{index, 1, f}));
    EXPECT_EQ(vertices.size(), 3u);
    for (size_t k = 0; k < 3; ++k) {
      double xyz[3];
      EXPECT_EQ(dsw_environment_get_vertex_position(environment, vertices[k], xyz), DSW_STATUS_OK);
      for (size_t i = 0; i < 3; ++i) p[k][i] = xyz[i];
    }
    sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return sum;
}

/// The vertices of a face, whatever its name is; empty for the null id.
std::vector<uint32_t> corners(const dsw_environment* environment, dsw_face_id face) {
  std::vector<uint32_t> indices;
  if (face.generation == 0) return indices;
  for (const dsw_vertex_id v : vertices_of(environment, cell_of(face))) indices.push_back(v.index);
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// Marks some of everything.
void mark_some(const Place& place, Rng& rng) {
  for (int n = 0; n < 4; ++n) {
    const size_t f = rng.below(place.world->faces.size());
    const dsw_face_id face = face_id(*place.world, static_cast<int>(f));
    ASSERT_EQ(dsw_environment_mark_faces(place.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  const dsw_volume_id volume = place.world->ids[rng.below(place.world->ids.size())];
  ASSERT_EQ(dsw_environment_mark_volumes(place.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr), DSW_STATUS_OK);
  const dsw_edge_id edge = {volume.index, volume.generation, 0};
  ASSERT_EQ(dsw_environment_mark_edges(place.get(), &edge, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
}

class CoarsenTest : public SceneTest {
 protected:
  void SetUp() override {
    place_ = make_place(GetParam(), 71);
    ASSERT_PLACE(place_);
  }
  uint32_t mapped(const Coarse& coarse, dsw_volume_id v) const { return v.generation == 0 ? 0 : coarse.map[v.index]; }

  Place place_;
};
DSW_FOR_ALL_SCENES(CoarsenTest);

TEST_P(CoarsenTest, CellsAreValidAndAsLargeAsWhatTheyWere) {
  for (const uint32_t max_faces : {8u, 16u, 28u}) {
    const Coarse coarse = coarsened(place_, max_faces);
    ASSERT_NE(coarse.environment, nullptr);
    EXPECT_EQ(dsw_environment_check(coarse.environment.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    std::map<uint32_t, std::vector<uint32_t>> parts;
    for (uint32_t i = 0; i < coarse.map.size(); ++i) parts[coarse.map[i]].push_back(i);
    EXPECT_EQ(parts.size(), coarse.report.volume_count[1]);
    for (const auto& [whole, cells] : parts) {
      if (cells.size() == 1) continue;
      mpq_class sum = 0;
      for (const uint32_t cell : cells) sum += volume_of(place_.get(), cell);
      EXPECT_EQ(sum, volume_of(coarse.environment.get(), whole));
    }
  }
}

TEST_P(CoarsenTest, CastsMeetTheSameFacesAtTheSameTimes) {
  for (const bool marked : {false, true}) {
    Rng rng(72);
    if (marked) mark_some(place_, rng);
    for (const uint32_t max_faces : {10u, 16u, 28u}) {
      const Coarse coarse = coarsened(place_, max_faces);
      ASSERT_NE(coarse.environment, nullptr);
      Motions motions(*place_.world, rng);
      for (int i = 0; i < at_least(400); ++i) {
        const Vec p = motions.start(), q = motions.target(p);
        dsw_flight fine, other;
        ASSERT_EQ(dsw_environment_cast(place_.get(), {0, 0}, p.data(), q.data(), nullptr, &fine), DSW_STATUS_OK);
        ASSERT_EQ(dsw_environment_cast(coarse.environment.get(), {0, 0}, p.data(), q.data(), nullptr, &other),
                  DSW_STATUS_OK);
        ASSERT_EQ(fine.outcome, other.outcome) << hex(p) << hex(q);
        EXPECT_EQ(fine.time, other.time);
        EXPECT_EQ(hex(fine.position), hex(other.position));
        EXPECT_EQ(corners(place_.get(), fine.contact.wall), corners(coarse.environment.get(), other.contact.wall));
        EXPECT_EQ(mapped(coarse, fine.volume), other.volume.index);
        EXPECT_LE(other.volumes_visited, fine.volumes_visited);
      }
    }
  }
}

TEST_P(CoarsenTest, SweptEdgesMeetTheSameAtTheSameTimes) {
  Rng rng(73);
  mark_some(place_, rng);
  const Coarse coarse = coarsened(place_, 16);
  ASSERT_NE(coarse.environment, nullptr);
  Motions motions(*place_.world, rng);
  std::vector<double> from, to, fixed;
  constexpr size_t kCount = 400;
  for (size_t i = 0; i < kCount; ++i) {
    const Vec p = motions.start(), q = motions.target(p), r = motions.target(p);
    from.insert(from.end(), p.begin(), p.end());
    to.insert(to.end(), q.begin(), q.end());
    fixed.insert(fixed.end(), r.begin(), r.end());
  }
  std::vector<dsw_sweep> fine(kCount), other(kCount);
  dsw_sweep_options options = defaults(dsw_sweep_options_init);
  options.level = DSW_LEVEL_EDGES_SWEPT;
  ASSERT_EQ(dsw_environment_sweep_edges(place_.get(), kCount, nullptr, from.data(), to.data(), fixed.data(), 0,
                                        &options, fine.data()),
            DSW_STATUS_OK);
  ASSERT_EQ(dsw_environment_sweep_edges(coarse.environment.get(), kCount, nullptr, from.data(), to.data(), fixed.data(),
                                        0, &options, other.data()),
            DSW_STATUS_OK);
  for (size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(fine[i].outcome, other[i].outcome) << i;
    EXPECT_EQ(fine[i].time, other[i].time) << i;
  }
}

TEST_P(CoarsenTest, BodiesMoveAsFarAndStayFree) {
  Rng rng(74);
  mark_some(place_, rng);
  const Coarse coarse = coarsened(place_, 16);
  ASSERT_NE(coarse.environment, nullptr);
  dsw_move_options options = defaults(dsw_move_options_init);
  options.stand_off = -1;  // by default a share of the cell's size
  Motions motions(*place_.world, rng);
  dsw_environment* const both[2] = {place_.get(), coarse.environment.get()};
  ScenePtr scenes[2] = {make_scene(both[0]), make_scene(both[1])};
  int moved = 0;
  for (int i = 0; i < at_least(60); ++i) {
    const Vec p = motions.start(), q = motions.target(p);
    BodyState states[2];
    dsw_status made[2];
    std::vector<double> targets;
    for (int k = 0; k < 2; ++k) {
      const Vec at = motions.target(p);
      targets.insert(targets.end(), at.begin(), at.end());
    }
    for (int k = 0; k < 2; ++k) {
      dsw_body_id body;
      made[k] = create_body(scenes[k].get(), segment(p, q), DSW_LEVEL_EDGES_SWEPT, 0, {}, &body);
      if (made[k] != DSW_STATUS_OK) continue;
      ASSERT_EQ(dsw_body_move(scenes[k].get(), body, targets.data(), 2, 0, &options, nullptr), DSW_STATUS_OK);
      EXPECT_EQ(read_body(scenes[k].get(), body, states[k]), "");
      ASSERT_EQ(dsw_body_destroy(scenes[k].get(), body), DSW_STATUS_OK);
    }
    ASSERT_EQ(made[0], made[1]);
    if (made[0] != DSW_STATUS_OK) continue;
    ++moved;
    for (size_t v = 0; v < 2; ++v) EXPECT_EQ(hex(states[0].at[v]), hex(states[1].at[v])) << i;
  }
  EXPECT_GT(moved, 0);
}

TEST(Coarsen, TetrahedraBecomeFewCells) {
  for (const char* const name : {"tet_kuhn", "tet_random"}) {
    const Place place = make_place(name, 75);
    ASSERT_PLACE(place);
    const Coarse coarse = coarsened(place, 16);
    ASSERT_NE(coarse.environment, nullptr);
    EXPECT_LT(coarse.report.volume_count[1] * 3, coarse.report.volume_count[0]) << name;
    EXPECT_LT(coarse.report.passable_area[1], 0.7 * coarse.report.passable_area[0]) << name;
  }
}

}  // namespace
}  // namespace dsw::oracle
