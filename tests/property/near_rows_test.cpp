// Near rows against their definition in exact arithmetic: none is missing, none is there that is not near.
#include "near_check.h"
#include "plane_support.h"

namespace dsw::oracle {
namespace {

class NearRowsTest : public SceneTest {};
DSW_FOR_ALL_SCENES(NearRowsTest);

TEST_P(NearRowsTest, AreAllThatAreNear) {
  NearTally tally;
  const bool is_warped = std::string(GetParam()).find("warped") != std::string::npos;
  const auto rounds = static_cast<uint64_t>(effort_of(1));
  // Seeds that found rows with what is hidden, at distances of 0 and 1e-25, and walls of volumes that overlap those of the
  // way: one that comes closer than the obstacle, and one across the way.
  const std::multimap<std::string, uint64_t> found{
      {"tet_slivers", 44}, {"prisms_warped", 50}, {"voronoi_warped", 113}, {"voronoi_warped", 119}};
  std::set<uint64_t> seeds;
  for (auto [at, end] = found.equal_range(GetParam()); at != end; ++at) seeds.insert(at->second);
  for (uint64_t seed = 41; seed < 41 + 2 * rounds; ++seed) seeds.insert(seed);
  for (const uint64_t seed : seeds) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    World& world = *place.world;
    // Volumes overlap only where the outer boundary crosses itself.
    const Place* const overlapping = is_warped && world.outer_boundary_crosses() ? &place : nullptr;
    Rng rng(seed);
    Motions motions(world, rng);
    const Obstacles obstacles(place, rng);
    const NearTruth::Scene scene_truth = near_scene(place, obstacles, overlapping != nullptr);
    const double size = largest(place.mesh.points);
    const NearTruth truth(scene_truth);
    const ScenePtr scene = make_scene(place.get());
    // What brute force costs grows with what there is.
    const int usual = scene_truth.obstacles.size() > 2000 ? 5 : 25,
              most = std::min(usual, std::max(2, effort_of(usual)));
    int made = 0;
    for (int i = 0; i < 400 && made < most; ++i) {
      const BodyPlan plan = any_plan(motions, rng);
      if (!std::all_of(plan.at.begin(), plan.at.end(), finite)) continue;
      const dsw_level level =
          std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}[rng.below(4)];
      dsw_body_id body;
      if (create_body(scene.get(), plan, level, 0, {}, &body) != DSW_STATUS_OK) continue;
      ++made;
      const double limit = world.size * std::pow(10, rng.range(-3, -0.6)), radius = rng.chance(0.5) ? 0 : 0.3 * limit;
      for (int round = 0; round < 3; ++round) {
        BodyState state;
        ASSERT_EQ(read_body(scene.get(), body, state), "");
        SCOPED_TRACE("seed " + std::to_string(seed) + " body " + std::to_string(i) + " round " + std::to_string(round));
        check_rows(rows_with(find_rows(scene.get(), body, limit - radius, radius), {0, 0}), state, truth, limit, level,
                   size, any_pair, tally, overlapping);
        if (HasFailure()) return record(tally);
        std::vector<Vec> targets = state.at;
        for (Vec& t : targets) t = motions.near(t, round == 0 ? 1e-3 : 0.05);
        if (!std::all_of(targets.begin(), targets.end(), finite)) break;
        ASSERT_EQ(dsw_body_move(scene.get(), body, targets[0].data(), targets.size(), sizeof(Vec), nullptr, nullptr),
                  DSW_STATUS_OK);
      }
      dsw_body_destroy(scene.get(), body);
    }
  }
  record(tally);
  EXPECT_GT(tally.rows, static_cast<uint64_t>(effort_of(100)));
}

/// Bodies near each other and near themselves, in a box.
TEST(NearBodiesTest, AreAllThatAreNear) {
  NearTally tally;
  uint64_t own = 0;
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(effort_of(120)); ++seed) {
    Place place = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)));
    ASSERT_PLACE(place);
    Rng rng(seed);
    const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_BODY_CONTACTS);
    struct Made {
      dsw_body_id id;
      dsw_level level;
      BodyState state;
      bool self;
    };
    std::vector<Made> bodies;
    for (int i = 0; i < 200 && bodies.size() < 6; ++i) {
      // On a lattice half of the time, for parallels and right angles.
      const bool lattice = rng.chance(0.5);
      const auto any = [&](double low, double high) {
        return lattice ? low + (high - low) * 0.125 * static_cast<double>(rng.below(9)) : rng.range(low, high);
      };
      BodyPlan plan;
      plan.at.push_back({any(1, 2), any(1, 2), any(1, 2)});
      const size_t more = 1 + rng.below(6);
      for (size_t k = 0; k < more; ++k) {
        const Vec& last = plan.at.back();
        plan.at.push_back({last[0] + any(-0.5, 0.5), last[1] + any(-0.5, 0.5), last[2] + any(-0.5, 0.5)});
      }
      const bool surface = more >= 2 && rng.chance(0.4);
      for (uint32_t k = 0; !surface && k < more; ++k) plan.edges.push_back({k, k + 1});
      for (uint32_t k = 0; surface && k + 1 < more; ++k) {
        plan.faces.push_back(k % 2 == 0 ? std::vector<uint32_t>{k, k + 1, k + 2}
                                        : std::vector<uint32_t>{k + 1, k, k + 2});
      }
      const dsw_level level =
          std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}[rng.below(4)];
      Made made{{0, 0}, level, {}, rng.chance(0.6)};
      const uint32_t flags = made.self ? DSW_BODY_SELF_CONTACTS : 0;
      if (create_body(scene.get(), plan, level, flags, {}, &made.id) != DSW_STATUS_OK) continue;
      ASSERT_EQ(read_body(scene.get(), made.id, made.state), "");
      bodies.push_back(made);
    }
    const auto is_joined = [](const std::vector<int>& a, const std::vector<int>& b) {
      return std::any_of(a.begin(), a.end(), [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); });
    };
    for (const Made& body : bodies) {
      const double radius = rng.chance(0.5) ? 0 : 0.05, margin = rng.range(0.02, 0.5);
      const std::vector<dsw_near_row> rows = find_rows(scene.get(), body.id, margin, radius);
      for (const Made& other : bodies) {
        const bool is_own = &other == &body;
        SCOPED_TRACE("seed " + std::to_string(seed) + " bodies " + std::to_string(body.id.index) + " " +
                     std::to_string(other.id.index));
        NearTruth::Scene known;
        known.points = other.state.at;
        known.is_shifted = false;
        if (!is_own || body.self) {
          for_each_part(other.state, other.level,
                        [&](const std::vector<int>& ids, const std::vector<Vec>&) { known.obstacles.push_back(ids); });
        }
        const NearTruth truth(known);
        const double limit = margin + (is_own ? 2 : 1) * radius;
        for (const dsw_near_row& row : rows) {
          if (row.body.generation == other.id.generation && row.body.index == other.id.index) {
            EXPECT_EQ(row.gap, row.distance - (is_own ? 2 : 1) * radius);
          }
        }
        // Two vertices of one body make one row, if one of them sees the other.
        const auto sees = [&](const std::vector<int>& a, const std::vector<int>& b) {
          return truth.rows_of({body.state.at[static_cast<size_t>(a[0])]}, limit + 1).count(b) != 0;
        };
        const auto counts = [&](const std::vector<int>& a, const std::vector<int>& b) {
          if (!is_own) return true;
          if (is_joined(a, b)) return false;
          if (a.size() != b.size()) return a.size() < b.size();
          return a < b || (a.size() == 1 && !sees(b, a));
        };
        const uint64_t before = tally.rows;
        check_rows(rows_with(rows, other.id), body.state, truth, limit, body.level, 4, counts, tally);
        own += is_own ? tally.rows - before : 0;
        if (testing::Test::HasFailure()) return;
      }
    }
  }
  EXPECT_GT(tally.rows, static_cast<uint64_t>(effort_of(1000)));
  EXPECT_GT(own, static_cast<uint64_t>(effort_of(100)));
}

/// Chains of the plane among impassable triangles, sides and marked vertices.
TEST(NearPlaneTest, AreAllThatAreNear) {
  constexpr uint32_t kSquares = 9;
  const EnvironmentPtr environment = make_squares(kSquares, true);
  Rng rng(5);
  const double* points = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_environment_get_points(environment.get(), &points, &count), DSW_STATUS_OK);
  NearTruth::Scene known;
  known.dimension = 2;
  for (size_t v = 0; v < count; ++v) known.points.push_back({points[2 * v], points[2 * v + 1], 0});
  known.wall_points = known.points;
  std::vector<dsw_face_id> sides;
  for (uint32_t i = 0; i < 2 * kSquares * kSquares; ++i) {
    dsw_volume_id volume;
    ASSERT_EQ(dsw_environment_get_volume_id(environment.get(), i, &volume), DSW_STATUS_OK);
    for (uint32_t local = 0; local < 3; ++local) sides.push_back({volume.index, volume.generation, local});
    if (rng.chance(0.1)) {
      ASSERT_EQ(dsw_environment_mark_volumes(environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
                DSW_STATUS_OK);
    }
    if (rng.chance(0.1)) {
      ASSERT_EQ(dsw_environment_mark_faces(environment.get(), &sides.back(), 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
  }
  std::set<std::vector<int>> walls;
  for (const dsw_face_id& side : sides) {
    int impassable = 0;
    ASSERT_EQ(dsw_environment_is_impassable(environment.get(), cell_of(side), &impassable), DSW_STATUS_OK);
    std::vector<int> ids;
    for (const dsw_vertex_id& v : vertices_of(environment.get(), cell_of(side)))
      ids.push_back(static_cast<int>(v.index));
    std::sort(ids.begin(), ids.end());
    if (impassable != 0) walls.insert(ids);
  }
  known.walls.assign(walls.begin(), walls.end());
  known.obstacles = known.walls;
  for (uint32_t v = 0; v < count; ++v) {
    dsw_vertex_id id;
    ASSERT_EQ(dsw_environment_get_vertex_id(environment.get(), v, &id), DSW_STATUS_OK);
    if (!rng.chance(0.1)) continue;
    ASSERT_EQ(dsw_environment_mark_vertices(environment.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    known.obstacles.push_back({static_cast<int>(v)});
  }
  const NearTruth truth(known);
  const ScenePtr scene = make_scene(environment.get());
  NearTally tally;
  for (int i = 0; i < effort_of(2000); ++i) {
    std::vector<double> at;
    const size_t vertices = 1 + rng.below(4);
    for (size_t k = 0; k < 2 * vertices; ++k) {
      at.push_back(k < 2 ? rng.range(0, kSquares) : at[k - 2] + rng.range(-0.4, 0.4));
    }
    std::vector<uint32_t> edges;
    for (uint32_t k = 0; k + 1 < vertices; ++k) edges.insert(edges.end(), {k, k + 1});
    dsw_body_desc desc = defaults(dsw_body_desc_init);
    desc.positions = at.data();
    desc.vertex_count = vertices;
    desc.edges = edges.data();
    desc.edge_count = edges.size() / 2;
    dsw_body_id body;
    if (dsw_body_create(scene.get(), &desc, &body) != DSW_STATUS_OK) continue;
    const double limit = rng.range(0.05, 0.6);
    BodyState state;
    for (size_t k = 0; k < vertices; ++k) state.at.push_back({at[2 * k], at[2 * k + 1], 0});
    for (uint32_t k = 0; k + 1 < vertices; ++k) state.edges.push_back({k, k + 1});
    SCOPED_TRACE("chain " + std::to_string(i));
    check_rows(rows_with(find_rows(scene.get(), body, limit, 0), {0, 0}), state, truth, limit, DSW_LEVEL_EDGES,
               kSquares, any_pair, tally);
    if (testing::Test::HasFailure()) return;
    ASSERT_EQ(dsw_body_destroy(scene.get(), body), DSW_STATUS_OK);
  }
  EXPECT_GT(tally.rows, static_cast<uint64_t>(effort_of(300)));
}

/// A plate in the middle of a box, which leaves a gap at x > 2.
class NearPlateTest : public testing::Test {
 protected:
  void SetUp() override {
    place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(2, 1)));
    ASSERT_PLACE(place_);
    for (const Face& f : place_.world->faces) {
      if (f.cell[1] < 0) continue;
      const auto z = [&](int v) { return place_.mesh.points[static_cast<size_t>(v)][2]; };
      const auto x = [&](int v) { return place_.mesh.points[static_cast<size_t>(v)][0]; };
      const bool in_plate = std::all_of(f.loop.begin(), f.loop.end(), [&](int v) { return z(v) == 1 && x(v) <= 2; });
      const dsw_face_id id = face_id(*place_.world, static_cast<int>(&f - place_.world->faces.data()));
      if (!in_plate) continue;
      ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    scene_ = make_scene(place_.get());
  }
  dsw_body_id make(const BodyPlan& plan) {
    dsw_body_id body{0, 0};
    EXPECT_EQ(create_body(scene_.get(), plan, DSW_LEVEL_EDGES_SWEPT, 0, {}, &body), DSW_STATUS_OK);
    return body;
  }
  void move(dsw_body_id body, const std::vector<Vec>& to) {
    ASSERT_EQ(dsw_body_move(scene_.get(), body, to[0].data(), to.size(), sizeof(Vec), nullptr, nullptr), DSW_STATUS_OK);
  }

  Place place_;
  ScenePtr scene_;
};

TEST_F(NearPlateTest, WhatWasSeenFromOneSideIsNotUsedOnTheOther) {
  const dsw_body_id body = make({{{1.5, 1.5, 1.005}}, {}, {}});
  const auto normal_of = [&] {
    const std::vector<dsw_near_row> rows = find_rows(scene_.get(), body, 0.1, 0);
    EXPECT_EQ(rows.size(), 1u);
    return rows.empty() ? 0 : rows[0].normal[2];
  };
  EXPECT_EQ(normal_of(), 1);
  for (const dsw_near_row& row : find_rows(scene_.get(), body, 1.2, 0)) {
    EXPECT_GE(row.obstacle_point[2], 1) << "the plate hides the floor";
  }
  for (const Vec& to : {Vec{2.5, 1.5, 1.005}, Vec{2.5, 1.5, 0.995}, Vec{1.5, 1.5, 0.995}}) move(body, {to});
  EXPECT_EQ(normal_of(), -1);
}

TEST_F(NearPlateTest, AWireAlongAFlatWallHasRowsAtItsEnds) {
  const dsw_body_id body = make({{{0.3, 0.4, 1.1}, {1.9, 3.7, 1.1}}, {{0, 1}}, {}});
  const std::vector<dsw_near_row> rows = find_rows(scene_.get(), body, 0.2, 0);
  ASSERT_EQ(rows.size(), 2u);
  for (const dsw_near_row& row : rows) EXPECT_EQ(row.vertices[1], UINT32_MAX);
}

TEST_F(NearPlateTest, AVertexOnTheFloorSeesTheWallBesideIt) {
  const dsw_body_id body = make({{{0.05, 1.5, 0.5}}, {}, {}});
  move(body, {{0.05, 1.5, 0}});
  BodyState state;
  ASSERT_EQ(read_body(scene_.get(), body, state), "");
  std::set<double> across;
  for (const dsw_near_row& row : find_rows(scene_.get(), body, 0.1, 0)) across.insert(row.normal[0]);
  EXPECT_EQ(across, (std::set<double>{0, 1}));
}

/// Edges that are nearly parallel: their distance is that of exact arithmetic, and no row is missing.
TEST(NearlyParallelTest, EdgesHaveTheirRows) {
  Place place = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)));
  ASSERT_PLACE(place);
  Rng rng(3);
  int asked = 0;
  for (int i = 0; i < effort_of(2000); ++i) {
    const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_BODY_CONTACTS);
    const double tilt = std::ldexp(rng.range(0.5, 1), -static_cast<int>(rng.between(2, 50)));
    const double apart = std::ldexp(rng.range(0.5, 1), -static_cast<int>(rng.between(1, 20)));
    const Vec way = {rng.range(0.5, 1), rng.range(-1, 1), rng.range(-0.3, 0.3)}, at = {2, 2, 1.5};
    const auto end = [&](double t, double side, double up) {
      return Vec{at[0] + t * way[0] - side * way[1], at[1] + t * way[1] + side * way[0], at[2] + t * way[2] + up};
    };
    const std::vector<Vec> a = {end(-0.8, -tilt, 0), end(0.7, tilt, 0)}, b = {end(-0.6, 0, apart), end(0.9, 0, apart)};
    dsw_body_id first, second;
    if (create_body(scene.get(), {a, {{0, 1}}, {}}, DSW_LEVEL_EDGES, 0, {}, &first) != DSW_STATUS_OK) continue;
    if (create_body(scene.get(), {b, {{0, 1}}, {}}, DSW_LEVEL_EDGES, 0, {}, &second) != DSW_STATUS_OK) continue;
    NearTruth::Scene known;
    known.points = b;
    known.obstacles = {{0, 1}};
    const NearTruth::Rows truth = NearTruth(known).rows_of(a, 1);
    const auto expected = truth.find({0, 1});
    if (expected == truth.end()) continue;
    ++asked;
    SCOPED_TRACE(i);
    const std::vector<dsw_near_row> all = find_rows(scene.get(), first, expected->second.distance * 1.01 + 1e-12, 0);
    const RowsByIds rows = rows_with(all, second);
    const auto row = rows.find({{0, 1}, {0, 1}});
    ASSERT_NE(row, rows.end());
    check_numbers(*row->second, expected->second, 4);
    EXPECT_NEAR(row->second->weights[1], expected->second.weights[1], 1e-11);
  }
  EXPECT_GT(asked, effort_of(1000));
}

}  // namespace
}  // namespace dsw::oracle
