// All vertices of bodies move at once: what is carried rigidly never stops itself, islands are alone, features that
// stop pass nothing, what is remembered does not matter, and memory that runs out changes nothing.
#include "host_memory.h"
#include "together_support.h"

#include <cmath>

namespace dsw::oracle {
namespace {

constexpr double kPi = 3.14159265358979323846;

BodyPlan coil(double radius, double pitch, double phase, size_t count) {
  BodyPlan plan;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / 16 + phase;
    plan.at.push_back({2 + radius * std::cos(angle), 2 + radius * std::sin(angle), 1.6 + pitch * i / 16});
    if (i != 0) plan.edges.push_back({i - 1, i});
  }
  return plan;
}
/// A strip of triangles that is rolled up.
BodyPlan roll(size_t count) {
  BodyPlan plan;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 0.35 * (i / 2), radius = 0.3 + 0.01 * angle;
    plan.at.push_back({2 + radius * std::cos(angle), 2 + radius * std::sin(angle), 1.7 + (i % 2 == 0 ? 0.0 : 0.3)});
    if (i < 2) continue;
    plan.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i} : std::vector<uint32_t>{i - 1, i - 2, i});
  }
  return plan;
}
/// A rotation by `angle` about an axis through the centre, and a way along.
Vec carried(const Vec& p, const Vec& axis, double angle, const Vec& way) {
  const Vec x = {p[0] - 2, p[1] - 2, p[2] - 2};
  const double c = std::cos(angle), s = std::sin(angle), along = (axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2]);
  const Vec across = {axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
                      axis[0] * x[1] - axis[1] * x[0]};
  Vec to;
  for (size_t k = 0; k < 3; ++k) to[k] = 2 + c * x[k] + s * across[k] + (1 - c) * along * axis[k] + way[k];
  return to;
}
Vec random_axis(Rng& rng) {
  Vec axis;
  double length = 0;
  do {
    for (double& x : axis) x = rng.range(-1, 1);
    length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  } while (length < 0.1 || length > 1);
  for (double& x : axis) x /= length;
  return axis;
}

class TogetherMoreTest : public testing::Test {
 protected:
  void SetUp() override {
    ground_ = make_ground(3, 4, 0, 0, false, rng_);
    ASSERT_NE(ground_.environment, nullptr);
  }
  Walker add(dsw_scene* scene, const BodyPlan& plan, dsw_level level, bool self) {
    Walker walker{};
    walker.level = level;
    walker.self = self;
    EXPECT_EQ(create_body(scene, plan, level, self ? DSW_BODY_SELF_CONTACTS : 0, {}, &walker.id), DSW_STATUS_OK)
        << dsw_last_error_message();
    EXPECT_EQ(read_body(scene, walker.id, walker.state), "");
    walker.end = walker.state.at;
    return walker;
  }

  Rng rng_{3};
  Ground ground_;
};

TEST_F(TogetherMoreTest, WhatIsCarriedRigidlyNeverStopsItself) {
  struct Case {
    const char* name;
    std::vector<BodyPlan> plans;
    dsw_level level;
  };
  const Case cases[] = {{"tight coil", {coil(0.5, 0.01, 0, 200)}, DSW_LEVEL_EDGES_SWEPT},
                        {"two coils", {coil(0.5, 0.1, 0, 100), coil(0.5, 0.1, kPi, 100)}, DSW_LEVEL_EDGES_SWEPT},
                        {"rolled cloth", {roll(160)}, DSW_LEVEL_FACES}};
  for (const Case& each : cases) {
    size_t moves = 0, stops[2] = {0, 0};
    for (int round = 0; round < effort_of(20); ++round) {
      const Vec axis = random_axis(rng_), way = {rng_.range(-0.5, 0.5), rng_.range(-0.5, 0.5), rng_.range(-0.5, 0.5)};
      const double angle = rng_.range(-2, 2);
      for (int mode = 0; mode < 2; ++mode) {
        ScenePtr scene = make_scene(ground_.environment.get(), DSW_FEATURE_BODY_CONTACTS);
        std::vector<Walker> walkers;
        for (const BodyPlan& plan : each.plans) walkers.push_back(add(scene.get(), plan, each.level, true));
        std::vector<dsw_body_id> ids;
        std::vector<Vec> targets;
        for (Walker& walker : walkers) {
          ids.push_back(walker.id);
          for (Vec& p : walker.end) p = carried(p, axis, angle, way);
          targets.insert(targets.end(), walker.end.begin(), walker.end.end());
        }
        if (mode == 0) {
          std::vector<dsw_move_report> reports(ids.size());
          ASSERT_EQ(dsw_scene_move_bodies(scene.get(), ids.data(), ids.size(), targets[0].data(), targets.size(),
                                          sizeof(Vec), nullptr, reports.data()),
                    DSW_STATUS_OK);
          size_t stopped = 0;
          for (const dsw_move_report& report : reports) stopped += report.vertices_stopped;
          stops[0] += stopped != 0 ? 1 : 0;
        } else {
          const TogetherAnswer answer = move_together(scene.get(), walkers, DSW_TOGETHER_STOP_ALL);
          stops[1] += answer.reports[0].fraction != 1 ? 1 : 0;
        }
      }
      ++moves;
    }
    std::printf("%s: %zu moves; stopped one by one %zu, together %zu\n", each.name, moves, stops[0], stops[1]);
    EXPECT_EQ(stops[1], 0u);
  }
}

TEST_F(TogetherMoreTest, AnIslandThatMeetsNothingArrives) {
  for (const dsw_together_stop stop : {DSW_TOGETHER_STOP_ALL, DSW_TOGETHER_STOP_ISLAND, DSW_TOGETHER_STOP_FEATURE}) {
    ScenePtr scene = make_scene(ground_.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = {
        add(scene.get(), segment({1, 1, 1}, {1, 2, 1}), DSW_LEVEL_EDGES_SWEPT, false),
        add(scene.get(), segment({1.5, 1.5, 0.5}, {1.5, 1.5, 1.5}), DSW_LEVEL_EDGES_SWEPT, false),
        add(scene.get(), segment({3, 3, 3}, {3, 3.5, 3}), DSW_LEVEL_EDGES_SWEPT, false)};
    // The first two meet half-way, where their middles cross.
    for (Vec& p : walkers[0].end) p[0] += 0.5;
    for (Vec& p : walkers[1].end) p[0] -= 0.5;
    for (Vec& p : walkers[2].end) p[0] += 0.25;
    const TogetherAnswer answer = move_together(scene.get(), walkers, stop);
    EXPECT_NEAR(answer.reports[0].fraction, 0.5, 1e-9);
    EXPECT_NEAR(answer.reports[1].fraction, 0.5, 1e-9);
    ASSERT_EQ(answer.contacts[0].size(), 1u);
    ASSERT_EQ(answer.contacts[1].size(), 1u);
    EXPECT_EQ(answer.contacts[0][0].time, 0.5);
    EXPECT_EQ(answer.contacts[0][0].contact.normal[0], -1);
    EXPECT_EQ(answer.contacts[1][0].contact.normal[0], 1);
    EXPECT_EQ(answer.contacts[0][0].point[0], 1.25);
    EXPECT_EQ(answer.contacts[0][0].point[1], 1.5);
    EXPECT_EQ(answer.contacts[0][0].point[2], 1);
    EXPECT_EQ(answer.contacts[0][0].edge_parameter, 0.5);
    const dsw_contact_partner* partners = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_get_contact_partners(scene.get(), walkers[0].id, &partners, &count), DSW_STATUS_OK);
    ASSERT_EQ(count, 1u);
    EXPECT_EQ(partners[0].body.index, walkers[1].id.index);
    if (stop == DSW_TOGETHER_STOP_ALL) {
      EXPECT_NEAR(answer.after[2].at[0][0], 3.125, 1e-9);
    } else {
      EXPECT_EQ(answer.after[2].at[0][0], 3.25);
      EXPECT_EQ(answer.reports[2].fraction, 1);
    }
  }
}

TEST_F(TogetherMoreTest, APartnerThatHardlyMovesSendsNothingBack) {
  for (const dsw_together_stop stop : {DSW_TOGETHER_STOP_ALL, DSW_TOGETHER_STOP_ISLAND, DSW_TOGETHER_STOP_FEATURE}) {
    for (const double way : {0.0, 1.2e-15}) {
      ScenePtr scene = make_scene(ground_.environment.get(), DSW_FEATURE_BODY_CONTACTS);
      std::vector<Walker> walkers = {
          add(scene.get(), segment({1, 1, 1}, {1, 2, 1}), DSW_LEVEL_EDGES_SWEPT, false),
          add(scene.get(), segment({1.5, 1.5, 0.5}, {1.5, 1.5, 1.5}), DSW_LEVEL_EDGES_SWEPT, false)};
      for (Vec& p : walkers[0].end) p[0] += 1;
      for (Vec& p : walkers[1].end) p[0] += way;
      const TogetherAnswer answer = move_together(scene.get(), walkers, stop);
      ASSERT_EQ(answer.contacts[0].size(), 1u);
      for (const Vec& p : answer.after[0].at) {
        EXPECT_GT(p[0], 1.5 - 1e-14) << "stop " << stop << ", way " << way;
        EXPECT_LT(p[0], 1.5 + way);
      }
    }
  }
}

/// A square around y = `far`, below and above, and an upright edge, which has points 4 and 9.
std::vector<double> around_an_edge(double far, double x, double y) {
  std::vector<double> points;
  for (const double z : {-8.0, 8.0})
    points.insert(points.end(), {-8, far - 8, z, 8, far - 8, z, 8, far + 8, z, -8, far + 8, z, x, y, z});
  return points;
}
/// The four wedges at that edge.
EnvironmentPtr four_wedges(const std::vector<double>& points, bool is_marked) {
  EnvironmentPtr room = create_from(uniform_desc(
      3, DSW_CELL_TYPE_WEDGE, 6, points, {5, 6, 9, 0, 1, 4, 6, 7, 9, 1, 2, 4, 7, 8, 9, 2, 3, 4, 8, 5, 9, 3, 0, 4}));
  const uint32_t ends[2] = {4, 9};
  dsw_edge_id edge;
  EXPECT_EQ(dsw_environment_find_edges(room.get(), 1, ends, &edge, nullptr), DSW_STATUS_OK);
  EXPECT_EQ(dsw_environment_mark_edges(room.get(), &edge, is_marked ? 1 : 0, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  return room;
}

/// An edge slides along itself until another vertex of its body touches the outer boundary. The place where the edge
/// stops is rounded, so it is beside the line of the edge. A marked edge stands between this line and this place.
TEST_F(TogetherMoreTest, WhatSlidesFarFromTheOriginPassesNothing) {
  constexpr double kFar = 0x3p20;  // neighbouring doubles are 2^-31 apart here
  size_t moves = 0, in_the_way = 0, passed = 0;
  for (; moves < static_cast<size_t>(effort_of(40)); ++moves) {
    const double x = (32 + rng_.below(64u)) / 64.0, y = (32 + rng_.below(64u)) / 64.0;
    const std::vector<Vec> from = {{-1 - 3 * x, kFar - 3 * y, 0.25}, {-1, kFar, 0.25}, {7, kFar + 5, 1}};
    const std::vector<Vec> to = {
        {-1 - x, kFar - y, 0.25}, {-1 + 2 * x, kFar + 2 * y, 0.25}, {rng_.range(8.8, 9.2), kFar + 5, 1}};
    const auto move = [&](double at_x, double at_y, bool is_marked) {
      std::vector<double> points = around_an_edge(kFar, at_x, at_y);
      const EnvironmentPtr room = four_wedges(points, is_marked);
      ScenePtr scene = make_scene(room.get(), DSW_FEATURE_DEFORMING);
      Walker walker = add(scene.get(), {from, {{0, 1}}, {}}, DSW_LEVEL_EDGES_SWEPT, false);
      walker.end = to;
      if (moves % 2 == 0) return move_together(scene.get(), {walker}, DSW_TOGETHER_STOP_ALL).after[0].at;
      const dsw_status status = dsw_scene_deform(scene.get(), points.data(), 10, &walker.id, 1, to[0].data(), 3,
                                                 sizeof(Vec), nullptr, nullptr, nullptr);
      EXPECT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message();
      EXPECT_EQ(read_body(scene.get(), walker.id, walker.state), "");
      return walker.state.at;
    };
    const std::vector<Vec> unhindered = move(0, kFar, false);
    const Vec& front = unhindered[1];
    // The marked edge is half-way between the stopped edge and the path of its front end.
    const double at_y = front[1] - 0x1p-31 * rng_.between(1 << 24, 1 << 28), back = front[1] - at_y;
    const double at_x = front[0] - back * (x / y + (front[0] + 1) / (front[1] - kFar)) / 2;
    const double low[3] = {at_x, at_y, -8}, high[3] = {at_x, at_y, 8};
    const auto touches = [&](const std::vector<Vec>& end) {
      const MovingPair<3> pair = {
          PairKind::kEdgeEdge, {&from[0][0], &from[1][0], low, high}, {&end[0][0], &end[1][0], low, high}};
      return first_touch(pair).touches;
    };
    in_the_way += touches(unhindered) ? 1 : 0;
    passed += touches(move(at_x, at_y, true)) ? 1 : 0;
  }
  std::printf("%zu moves, %zu with an edge in the way; passed %zu\n", moves, in_the_way, passed);
  EXPECT_EQ(passed, 0u);
  EXPECT_GT(2 * in_the_way, moves);
}

TEST_F(TogetherMoreTest, AnEdgeThatStandsAloneKeepsItsEndsApart) {
  ScenePtr scene = make_scene(ground_.environment.get(), DSW_FEATURE_BODY_CONTACTS);
  std::vector<Walker> walkers = {add(scene.get(), segment({1, 1, 1}, {2, 1, 1}), DSW_LEVEL_EDGES_SWEPT, true)};
  walkers[0].end = {{1.5, 1, 1}, {1.5, 1, 1}};
  const TogetherAnswer answer = move_together(scene.get(), walkers, DSW_TOGETHER_STOP_ALL);
  ASSERT_EQ(answer.contacts[0].size(), 2u);
  EXPECT_EQ(answer.contacts[0][0].time, 1);
  EXPECT_LT(answer.after[0].at[0][0], answer.after[0].at[1][0]);
  EXPECT_NEAR(answer.after[0].at[0][0], 1.5, 1e-12);
}

TEST_F(TogetherMoreTest, TheNormalOfAWallLooksOutOfIt) {
  ScenePtr scene = make_scene(ground_.environment.get());
  std::vector<Walker> walkers = {add(scene.get(), segment({1, 1.25, 1}, {3, 1.5, 1.5}), DSW_LEVEL_EDGES_SWEPT, false)};
  for (Vec& p : walkers[0].end) p[2] -= 2;
  const TogetherAnswer answer = move_together(scene.get(), walkers, DSW_TOGETHER_STOP_FEATURE);
  ASSERT_EQ(answer.contacts[0].size(), 2u);
  EXPECT_EQ(answer.contacts[0][0].contact.normal[2], 1);
  EXPECT_EQ(answer.contacts[0][0].contact.kind, DSW_CONTACT_PLANE);
  EXPECT_EQ(answer.contacts[0][0].time, 0.5);
  EXPECT_EQ(answer.contacts[0][0].point[2], 0);
  EXPECT_EQ(answer.contacts[0][1].contact.normal[2], 1);
  EXPECT_EQ(answer.reports[0].vertices_stopped, 2u);
  EXPECT_GT(answer.after[0].at[0][2], 0);
  EXPECT_LT(answer.after[0].at[0][2], 1e-12);
  EXPECT_LT(answer.after[0].at[1][2], 1e-12);
}

/// A tree or a walk of edges, or a strip.
BodyPlan tangle(Rng& rng, bool surface) {
  BodyPlan plan;
  plan.at.push_back({rng.range(1, 3), rng.range(1, 3), rng.range(1, 3)});
  plan.at[0] = sheared(plan.at[0], 3);
  for (uint32_t i = 1; i < 12; ++i) {
    Vec p = plan.at.back();
    for (double& x : p) x += rng.range(-0.4, 0.4);
    plan.at.push_back(p);
    if (!surface) plan.edges.push_back({i - 1, i});
    if (!surface || i < 2) continue;
    plan.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i} : std::vector<uint32_t>{i - 1, i - 2, i});
  }
  return plan;
}

TEST_F(TogetherMoreTest, FeaturesThatStopPassNothing) {
  size_t moves = 0, passed = 0, wrong = 0, reached = 0, stopped = 0;
  for (int round = 0; round < effort_of(40); ++round) {
    const Ground ground = make_ground(3, 4, 0.15, 0.05, false, rng_);
    const bool surface = round % 2 == 0;
    const dsw_level level = surface ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT;
    std::vector<BodyPlan> plans;
    std::vector<std::vector<Vec>> ends;
    ScenePtr trial = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    for (int tries = 0; tries < 60 && plans.size() < 2; ++tries) {
      const BodyPlan plan = tangle(rng_, surface);
      dsw_body_id id;
      if (create_body(trial.get(), plan, level, DSW_BODY_SELF_CONTACTS, {}, &id) != DSW_STATUS_OK) continue;
      plans.push_back(plan);
      ends.push_back(plan.at);
      const Vec way = {rng_.range(-0.4, 0.4), rng_.range(-0.4, 0.4), rng_.range(-0.4, 0.4)};
      for (Vec& p : ends.back()) {
        for (size_t k = 0; k < 3; ++k) p[k] += way[k] + rng_.range(-0.1, 0.1);
      }
    }
    if (plans.empty()) continue;
    ++moves;
    // Whatever the limit, they end where one steady motion leads.
    for (const uint32_t limit : {1u, 2u, 3u, 64u}) {
      ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
      std::vector<Walker> walkers;
      for (size_t i = 0; i < plans.size(); ++i) {
        walkers.push_back(add(scene.get(), plans[i], level, true));
        walkers[i].end = ends[i];
      }
      const double truth = first_time<3>(ground, walkers, false);
      const TogetherAnswer answer =
          move_together(scene.get(), walkers, DSW_TOGETHER_STOP_FEATURE, limit, rng_.below(3u));
      for (size_t i = 0; i < plans.size(); ++i) {
        stopped += answer.reports[i].vertices_stopped;
        reached += answer.reports[i].vertices_moved - answer.reports[i].vertices_stopped;
        walkers[i].end = answer.after[i].at;
      }
      double fraction = 1;
      for (const dsw_move_report& report : answer.reports) fraction = std::min(fraction, report.fraction);
      wrong += truth <= 1 ? fraction > truth : fraction != 1;
      passed += first_time<3>(ground, walkers, round % 8 == 0) <= 1 ? 1 : 0;
    }
  }
  std::printf("%zu moves; %zu vertices arrived, %zu stopped; passed %zu, wrong fraction %zu\n", moves, reached, stopped,
              passed, wrong);
  record_moves(moves, passed, 0, 0);
  EXPECT_EQ(passed + wrong, 0u);
  EXPECT_GT(reached, 0u);
  EXPECT_GT(stopped, 0u);
}

/// Cubes, some of which are marked. Their walls are cut into triangles; in flat walls it does not matter how.
Ground cubes(int n, double marked, Rng& rng) {
  Ground ground;
  ground.dimension = 3;
  const auto index = [&](int x, int y, int z) { return static_cast<uint32_t>(x + (n + 1) * (y + (n + 1) * z)); };
  std::vector<double> flat;
  for (int z = 0; z <= n; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) {
        ground.points.push_back({0.013 + 0.97 * x, 0.021 + 1.03 * y, 0.007 + 0.99 * z});
        flat.insert(flat.end(), ground.points.back().begin(), ground.points.back().end());
      }
    }
  }
  std::vector<int32_t> corners;
  std::map<std::vector<uint32_t>, std::vector<uint32_t>> quads;  // by sorted corners: the cells
  std::map<std::vector<uint32_t>, std::vector<uint32_t>> loops;
  uint32_t cell = 0;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x, ++cell) {
        const uint32_t v[8] = {
            index(x, y, z),     index(x + 1, y, z),     index(x + 1, y + 1, z),     index(x, y + 1, z),
            index(x, y, z + 1), index(x + 1, y, z + 1), index(x + 1, y + 1, z + 1), index(x, y + 1, z + 1)};
        corners.insert(corners.end(), v, v + 8);
        constexpr int kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
        for (const auto& face : kFaces) {
          const std::vector<uint32_t> loop = {v[face[0]], v[face[1]], v[face[2]], v[face[3]]};
          std::vector<uint32_t> name = loop;
          std::sort(name.begin(), name.end());
          quads[name].push_back(cell);
          loops[name] = loop;
        }
      }
    }
  }
  ground.environment = create_from(uniform_desc(3, DSW_CELL_TYPE_HEXAHEDRON, 8, flat, corners));
  std::vector<bool> is_marked(cell);
  for (uint32_t c = 0; c < cell; ++c) {
    is_marked[c] = rng.chance(marked);
    const dsw_volume_id volume = {c, 1};
    if (!is_marked[c]) continue;
    EXPECT_EQ(dsw_environment_mark_volumes(ground.environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr),
              DSW_STATUS_OK);
  }
  for (const auto& [name, of] : quads) {
    if (of.size() == 2 && !is_marked[of[0]] && !is_marked[of[1]]) continue;
    const std::vector<uint32_t>& loop = loops[name];
    ground.walls.push_back({loop[0], loop[1], loop[2]});
    ground.walls.push_back({loop[0], loop[2], loop[3]});
  }
  return ground;
}

TEST_F(TogetherMoreTest, HexahedraToo) {
  size_t moves = 0, touches = 0, missed = 0, made_up = 0, wrong = 0, passed = 0;
  for (int round = 0; round < effort_of(200); ++round) {
    const Ground ground = cubes(4, 0.1, rng_);
    const bool surface = round % 2 == 0;
    const dsw_level level = surface ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT;
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 60 && walkers.size() < 2; ++tries) {
      Walker walker{};
      walker.level = level;
      walker.self = true;
      BodyPlan plan = tangle(rng_, surface);
      for (Vec& p : plan.at) {
        for (double& x : p) x *= 0.8;
      }
      if (create_body(scene.get(), plan, level, DSW_BODY_SELF_CONTACTS, {}, &walker.id) != DSW_STATUS_OK) continue;
      EXPECT_EQ(read_body(scene.get(), walker.id, walker.state), "");
      walker.end = walker.state.at;
      const Vec way = {rng_.range(-0.4, 0.4), rng_.range(-0.4, 0.4), rng_.range(-0.4, 0.4)};
      for (Vec& p : walker.end) {
        for (size_t k = 0; k < 3; ++k) p[k] += way[k] + rng_.range(-0.1, 0.1);
      }
      walkers.push_back(walker);
    }
    if (walkers.empty()) continue;
    const double truth = first_time<3>(ground, walkers, round % 8 == 0);
    const auto stop = round % 4 < 2 ? DSW_TOGETHER_STOP_ALL : DSW_TOGETHER_STOP_FEATURE;
    const TogetherAnswer answer = move_together(scene.get(), walkers, stop);
    ++moves;
    double told = 2;
    for (const auto& each : answer.contacts) {
      for (const dsw_body_contact& contact : each) told = std::min(told, contact.time);
    }
    touches += truth <= 1 ? 1 : 0;
    missed += truth <= 1 && told > 1 ? 1 : 0;
    made_up += truth > 1 && told <= 1 ? 1 : 0;
    wrong += stop == DSW_TOGETHER_STOP_ALL && truth <= 1 && told != truth ? 1 : 0;
    // A wall is normal to an axis, so a rounded end may lie exactly on it.
    for (size_t i = 0; i < walkers.size(); ++i) walkers[i].end = answer.after[i].at;
    passed += first_time<3>(ground, walkers, round % 8 == 0) < 1 ? 1 : 0;
  }
  std::printf("%zu moves, %zu with a touch; missed %zu, made up %zu, wrong time %zu, passed %zu\n", moves, touches,
              missed, made_up, wrong, passed);
  record_moves(moves, missed + passed, 0, 0);
  EXPECT_EQ(missed + made_up + wrong + passed, 0u);
}

TEST_F(TogetherMoreTest, WhatIsRememberedDoesNotMatter) {
  size_t moves = 0, different = 0, contacts = 0;
  for (int round = 0; round < std::max(effort_of(20), 4); ++round) {
    const Ground ground = make_ground(3, 4, 0.15, 0.05, round % 2 == 0, rng_);
    const bool surface = round % 4 < 2;
    const dsw_level level = surface ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT;
    ScenePtr old = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 60 && walkers.size() < 2; ++tries) {
      const BodyPlan plan = tangle(rng_, surface);
      Walker walker{};
      if (create_body(old.get(), plan, level, DSW_BODY_SELF_CONTACTS, {}, &walker.id) != DSW_STATUS_OK) continue;
      EXPECT_EQ(read_body(old.get(), walker.id, walker.state), "");
      walkers.push_back(walker);
    }
    if (walkers.empty()) continue;
    for (int step = 0; step < 30; ++step) {
      ScenePtr fresh = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
      std::vector<Walker> copies;
      for (Walker& walker : walkers) {
        BodyPlan plan;
        plan.at = walker.state.at;
        for (const auto& f : walker.state.faces) plan.faces.push_back({f[0], f[1], f[2]});
        if (!surface) plan.edges = walker.state.edges;
        walker.end = walker.state.at;
        const Vec way = {rng_.range(-0.05, 0.05), rng_.range(-0.05, 0.05), rng_.range(-0.05, 0.05)};
        for (Vec& p : walker.end) {
          for (size_t k = 0; k < 3; ++k) p[k] += way[k] + rng_.range(-0.01, 0.01);
        }
        copies.push_back(add(fresh.get(), plan, level, true));
        copies.back().end = walker.end;
      }
      const auto stop = static_cast<dsw_together_stop>(step % 3);
      const uint32_t response = rng_.below(3u);
      const TogetherAnswer answers[2] = {move_together(old.get(), walkers, stop, 0, response),
                                         move_together(fresh.get(), copies, stop, 0, response)};
      ++moves;
      for (size_t i = 0; i < walkers.size(); ++i) {
        bool same = answers[0].contacts[i].size() == answers[1].contacts[i].size();
        contacts += answers[0].contacts[i].size();
        for (size_t v = 0; v < walkers[i].state.at.size(); ++v) {
          same = same && hex(answers[0].after[i].at[v]) == hex(answers[1].after[i].at[v]) &&
                 answers[0].after[i].volumes[v].index == answers[1].after[i].volumes[v].index;
        }
        different += same ? 0 : 1;
        walkers[i].state = answers[0].after[i];
      }
    }
  }
  std::printf("%zu moves, %zu contacts; different %zu\n", moves, contacts, different);
  EXPECT_EQ(different, 0u);
}

}  // namespace
}  // namespace dsw::oracle
