// Two bodies in easy places of the plane: what touches what, normals, levels, responses, rigid moves, memory, threads.
#include "plane_support.h"
#include "two_bodies.h"

namespace dsw::oracle {
namespace {

constexpr double kHalf = 0.70710678118654752;

class PlanePairsTest : public TwoBodies {
 protected:
  PlanePairsTest() : TwoBodies(DSW_LEVEL_EDGES) {}
  void SetUp() override {
    MemoryTest::SetUp();
    scene_.reset();
    place_.environment = make_squares(4, true, context_.get());
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
  }
  static BodyPlan point(double x, double y) { return {{{x, y, 0}}, {}, {}}; }
  static BodyPlan line(double x, double y, double to_x, double to_y) { return segment({x, y, 0}, {to_x, to_y, 0}); }
  static BodyPlan closed(const std::vector<Vec>& at) {
    BodyPlan plan{at, {}, {}};
    for (uint32_t i = 0; i < at.size(); ++i) plan.edges.push_back({i, (i + 1) % static_cast<uint32_t>(at.size())});
    return plan;
  }
  static BodyPlan square(double x, double y, double size) {
    return closed({{x, y, 0}, {x + size, y, 0}, {x + size, y + size, 0}, {x, y + size, 0}});
  }
};

bool points_at(const dsw_body_contact& c, double x, double y) {
  return std::fabs(c.contact.normal[0] - x) < 1e-15 && std::fabs(c.contact.normal[1] - y) < 1e-15 &&
         c.contact.normal[2] == 0;
}

TEST_F(PlanePairsTest, AVertexStopsAtAnEdgeAndSaysWhose) {
  const dsw_body_id wall = make(line(2, 1, 2, 2), DSW_LEVEL_EDGES);
  const dsw_body_id polyline = make(line(0.5, 1.5, 0.5, 1.75));
  const BodyAnswer answer = move(polyline, {{2.5, 1.5, 0}, {0.5, 1.75, 0}});
  ASSERT_EQ(answer.contacts.size(), 1u);
  const dsw_body_contact& c = answer.contacts[0];
  EXPECT_EQ(c.contact.kind, DSW_CONTACT_EDGE);
  EXPECT_EQ(c.time, 0.75);
  EXPECT_TRUE(points_at(c, -1, 0));
  EXPECT_TRUE(c.point[0] == 2 && c.point[1] == 1.5 && c.point[2] == 0);
  EXPECT_TRUE(c.vertex.index == 0 && c.edge.generation == 0 && c.face.generation == 0);
  EXPECT_TRUE(c.contact.marked_kind == DSW_CELL_NONE && c.contact.obstacle.kind == DSW_CELL_NONE &&
              c.contact.wall.generation == 0);
  EXPECT_TRUE(partner(polyline).body.index == wall.index && partner(polyline).edge.generation == 1);
  EXPECT_EQ(c.history, DSW_HISTORY_NEW);
  EXPECT_LT(answer.after.at[0][0], 2);
  EXPECT_GT(answer.after.at[0][0], 1.999);
  EXPECT_EQ(move(polyline, {{2.5, 1.5, 0}, {0.5, 1.75, 0}}).contacts[0].history, DSW_HISTORY_LASTING);
}

TEST_F(PlanePairsTest, AnEdgeStopsAtAVertexInsideOfWhatItSweeps) {
  for (const dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES_SWEPT}) {
    const dsw_body_id obstacle = make(point(1, 1.5), level);
    const dsw_body_id polyline = make(line(0.5, 1, 0.5, 2), DSW_LEVEL_EDGES);
    const BodyAnswer answer = move(polyline, {{3.5, 1, 0}, {0.5, 2, 0}});
    ASSERT_EQ(answer.contacts.size(), 1u);
    const dsw_body_contact& c = answer.contacts[0];
    EXPECT_EQ(c.contact.kind, DSW_CONTACT_VERTEX);
    EXPECT_EQ(c.time, 1.0 / 3);
    EXPECT_TRUE(points_at(c, -kHalf, -kHalf));
    EXPECT_TRUE(c.point[0] == 1 && c.point[1] == 1.5 && c.edge_parameter == 0.5);
    EXPECT_TRUE(c.fixed[0][0] == 0.5 && c.fixed[0][1] == 2 && c.edge.generation == 1);
    EXPECT_TRUE(partner(polyline).body.index == obstacle.index && partner(polyline).vertex.generation == 1);
    ASSERT_EQ(dsw_body_destroy(scene(), obstacle), DSW_STATUS_OK);
    ASSERT_EQ(dsw_body_destroy(scene(), polyline), DSW_STATUS_OK);
  }
}

TEST_F(PlanePairsTest, AlongItsAxisAnEdgeMeetsAVertexWithItsEnd) {
  make(point(2.25, 1.5), DSW_LEVEL_POINTS);
  dsw_body_id polyline = make(line(1, 1.5, 0.5, 1.5), DSW_LEVEL_EDGES);
  dsw_body_contact c = move(polyline, {{3.5, 1.5, 0}, {0.5, 1.5, 0}}).contacts.at(0);
  EXPECT_TRUE(c.contact.kind == DSW_CONTACT_VERTEX && c.edge.generation == 0 && c.time == 0.5);
  EXPECT_TRUE(points_at(c, -1, 0));
  // The end of an edge in the same line is part of that edge.
  const dsw_body_id other = make(line(2.75, 2.5, 2.25, 2.5), DSW_LEVEL_EDGES);
  polyline = make(line(1, 2.5, 0.5, 2.5), DSW_LEVEL_EDGES);
  c = move(polyline, {{3.5, 2.5, 0}, {0.5, 2.5, 0}}).contacts.at(0);
  EXPECT_TRUE(c.contact.kind == DSW_CONTACT_EDGE && c.edge.generation == 0 && c.time == 0.5);
  EXPECT_TRUE(points_at(c, -1, 0) && partner(polyline).body.index == other.index);
}

TEST_F(PlanePairsTest, ANormalIsExactWhereTheMotionGrazes) {
  // The way leaves the line of the edge by the smallest step there is.
  const double up = std::nextafter(1.5, 2);
  make(line(2, 1.5, 3, 1.5), DSW_LEVEL_EDGES);
  const dsw_body_id polyline = make(point(0.5, up), DSW_LEVEL_POINTS);
  EXPECT_TRUE(points_at(move(polyline, {{3.5, std::nextafter(1.5, 1), 0}}).contacts.at(0), 0, 1));
  const dsw_body_id edge = make(line(1, 0.5, 0.5, 0.5), DSW_LEVEL_EDGES);
  make(point(2, 0.5), DSW_LEVEL_POINTS);
  EXPECT_EQ(move(edge, {{3.5, std::nextafter(0.5, 0), 0}, {0.5, 0.5, 0}}).contacts.size(), 0u);
  EXPECT_TRUE(points_at(move(edge, {{3.5, 0.75, 0}, {0.5, 0.5, 0}}).contacts.at(0), 0, -1));
}

TEST_F(PlanePairsTest, LevelsSayWhatMeets) {
  for (const dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
    const size_t meets = level == DSW_LEVEL_POINTS ? 0 : 1;
    const dsw_body_id other = make(line(2, 1, 2, 2), level), vertex = make(point(0.5, 1.5), DSW_LEVEL_POINTS);
    EXPECT_EQ(move(vertex, {{2.5, 1.5, 0}}).contacts.size(), meets) << level;
    const dsw_body_id polyline = make(line(1, 0.5, 1, 3), level);
    // Its edge passes a vertex of the other one.
    EXPECT_EQ(move(polyline, {{3, 0.5, 0}, {1, 3, 0}}).contacts.size(), meets) << level;
    for (dsw_body_id each : {other, vertex, polyline}) ASSERT_EQ(dsw_body_destroy(scene(), each), DSW_STATUS_OK);
  }
  make(point(2, 1), DSW_LEVEL_POINTS);
  const dsw_body_id vertex = make(point(1, 1), DSW_LEVEL_POINTS);
  EXPECT_EQ(move(vertex, {{3, 1, 0}}).contacts.size(), 1u);
}

TEST_F(PlanePairsTest, TouchingIsRefused) {
  make(square(1, 1, 1), DSW_LEVEL_EDGES);
  EXPECT_EQ(create(point(2, 1.5)), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(line(2, 2, 3, 3)), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(line(1.5, 2, 3, 2)), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(line(0.5, 1.5, 2.5, 1.5)), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(line(0.5, 1.5, 2.5, 1.5), DSW_LEVEL_POINTS), DSW_STATUS_OK);
  EXPECT_EQ(create(square(1.25, 1.125, 0.25)), DSW_STATUS_OK);  // inside
  EXPECT_EQ(create(square(1.125, 1.25, 0.25)), DSW_STATUS_OCCUPIED);
  const dsw_body_id two = make({{{0.5, 1.75, 0}, {2.5, 1.75, 0}}, {}, {}}, DSW_LEVEL_EDGES);
  dsw_body_edge_id edge;
  EXPECT_EQ(dsw_body_add_edge(scene(), two, read(two).vertices[0], read(two).vertices[1], &edge), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(body_count(), 4u);
}

TEST_F(PlanePairsTest, NothingLeavesAClosedCurve) {
  const dsw_body_id ring = make(square(1, 1, 2), DSW_LEVEL_EDGES);
  Meeting inner, outer;
  inner.id = make(square(1.5, 1.5, 0.5), DSW_LEVEL_EDGES);
  outer.id = ring;
  Rng rng(3);
  size_t contacts = 0;
  for (int i = 0; i < at_least(200); ++i) {
    dsw_move_options options = defaults(dsw_move_options_init);
    if (i % 2 == 0) options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
    std::vector<Vec> targets = read(inner.id).at;
    const Vec way = {rng.range(-1, 1), rng.range(-1, 1), 0};
    for (Vec& p : targets) p = {p[0] + way[0], p[1] + way[1], 0};
    contacts += move(inner.id, targets, &options).contacts.size();
    inner.state = read(inner.id);
    outer.state = read(outer.id);
    ASSERT_TRUE(are_apart(inner, outer)) << i;
    for (const Vec& p : inner.state.at) ASSERT_TRUE(p[0] > 1 && p[0] < 3 && p[1] > 1 && p[1] < 3) << i;
  }
  EXPECT_GT(contacts, 100u);
}

TEST_F(PlanePairsTest, WallsAndBodiesCompeteByTime) {
  const dsw_body_id vertex = make(point(3.5, 1.5), DSW_LEVEL_POINTS);
  EXPECT_EQ(move(vertex, {{4.5, 1.5, 0}}).contacts.at(0).point[0], 4);
  EXPECT_EQ(partner(vertex).body.generation, 0u);
  make(line(0.5, 1, 0.5, 2), DSW_LEVEL_EDGES);
  EXPECT_NEAR(move(vertex, {{-0.5, 1.5, 0}}).contacts.at(0).point[0], 0.5, 1e-15);
  EXPECT_EQ(partner(vertex).body.generation, 1u);
}

TEST_F(PlanePairsTest, ARigidMoveStopsBeforeTheOther) { stop_rigidly(line(2, 0.5, 2, 3.5), square(0.5, 1.25, 0.5)); }

TEST_F(PlanePairsTest, ResponsesWorkOnBodies) {
  make(line(2, 0.5, 2, 2), DSW_LEVEL_EDGES);
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
  const dsw_body_id vertex = make(point(1, 1), DSW_LEVEL_POINTS);
  BodyAnswer answer = move(vertex, {{2.5, 1.75, 0}}, &options);
  EXPECT_GE(answer.contacts.size(), 1u);
  EXPECT_TRUE(answer.after.at[0][0] < 2 && answer.after.at[0][0] > 1.99 && answer.after.at[0][1] > 1.74);
}

TEST_F(PlanePairsTest, AnEdgeGetsAVertexWhereACornerIsInItsWay) {
  make(line(1.625, 2.5, 2.5, 2.5), DSW_LEVEL_EDGES);
  dsw_move_options options = defaults(dsw_move_options_init);
  options.edge_response = DSW_RESPONSE_ADAPTIVE_ONE;
  const Vec fixed = {1, 3.5, 0}, to = {3, 1, 0};
  const dsw_body_id edge = make(segment({1.5, 0.5, 0}, fixed));
  BodyAnswer answer = move(edge, {to, fixed}, &options);
  ASSERT_GE(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].contact.kind, DSW_CONTACT_VERTEX);
  EXPECT_EQ(answer.report.edit_count, 1u);
  EXPECT_EQ(answer.after.at[0], to);
}

TEST_F(PlanePairsTest, AnEdgeIsBentOverNothing) {
  // A new vertex is rounded, and what is nearer to the origin less so: it may lie between the edge and where it would
  // be bent to.
  Rng rng(11);
  int bent = 0, refused = 0;
  for (int i = 0; i < at_least(300); ++i) {
    const Vec low = {rng.range(0.01, 0.1), rng.range(0.01, 0.1), 0}, high = {rng.range(3, 3.9), rng.range(3, 3.9), 0};
    const dsw_body_id edge = make(segment(low, high));
    std::vector<Vec> beside;
    std::vector<dsw_body_id> bodies;
    for (int k = 0; k < 3; ++k) {
      const double share = rng.range(0.02, 0.5);
      const BodyPlan plan = point(low[0] + share * (high[0] - low[0]), low[1] + share * (high[1] - low[1]));
      dsw_body_id body;
      if (create_body(scene(), plan, DSW_LEVEL_POINTS, 0, {}, &body) != DSW_STATUS_OK) continue;
      beside.push_back(plan.at[0]);
      bodies.push_back(body);
    }
    dsw_body_edit edit;
    const dsw_status status = dsw_body_split_edge(scene(), edge, read(edge).edge_ids[0], rng.range(0.6, 0.9), &edit);
    ASSERT_TRUE(status == DSW_STATUS_OK || status == DSW_STATUS_OCCUPIED) << dsw_last_error_message();
    ++(status == DSW_STATUS_OK ? bent : refused);
    for (const Vec& x : beside) {
      if (status != DSW_STATUS_OK) break;
      const Vec middle = read(edge).at[2];
      const TouchTruth truth = touch_truth<2>(low.data(), middle.data(), {high.data()}, {x.data()});
      ASSERT_FALSE(truth.touches || truth.at_start) << i;
    }
    bodies.push_back(edge);
    for (dsw_body_id each : bodies) ASSERT_EQ(dsw_body_destroy(scene(), each), DSW_STATUS_OK);
  }
  EXPECT_GT(bent, 30);
  EXPECT_GT(refused, 30);
}

TEST_F(PlanePairsTest, AChainMeetsItself) {
  // The last link folds back on the first one.
  const BodyPlan chain{{{1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {3, 2, 0}, {2, 2, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}, {}};
  const dsw_body_id body = make(chain, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS);
  std::vector<Vec> targets = chain.at;
  targets[4] = {1.5, 0.5, 0};
  BodyAnswer answer = move(body, targets);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].time, 2.0 / 3);
  EXPECT_TRUE(points_at(answer.contacts[0], 0, 1));
  EXPECT_TRUE(partner(body).body.index == body.index && partner(body).edge.index == 0);
  // Over its own neighbour.
  targets = answer.after.at;
  targets[0] = {2.5, 1, 0};
  answer = move(body, targets);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_TRUE(answer.contacts[0].time == 2.0 / 3 && partner(body).vertex.index == 1);
  dsw_body_edit edit;
  ASSERT_EQ(dsw_body_split_edge(scene(), body, read(body).edge_ids[0], 0.5, &edit), DSW_STATUS_OK);
  ASSERT_EQ(dsw_body_collapse_edge(scene(), body, edit.rest, edit.vertex, nullptr), DSW_STATUS_OK);
  BodyPlan crossing = closed({{1, 3, 0}, {2, 3.5, 0}, {2, 3, 0}, {1, 3.5, 0}});
  EXPECT_EQ(create(crossing, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(crossing, DSW_LEVEL_EDGES), DSW_STATUS_OK);
}

TEST_F(PlanePairsTest, MemoryThatRunsOutLeavesAllAsItWas) {
  const Vec left = {-1, 0.125, 0};
  run_out_of_memory({square(0.5, 1, 1), square(2.5, 1, 1), line(2, 0.5, 2, 3.5)}, 1, {{{1.5, 0.125, 0}, left, left}});
}

/// Rings and lines, see Crowd.
std::string plane_answers(dsw_context* context, bool together) {
  const EnvironmentPtr environment = make_squares(8, true, context);
  Crowd crowd(environment.get(), 2, DSW_LEVEL_EDGES_SWEPT);
  return crowd.answers(40, 8, together, [](Rng& rng, size_t i) {
    const Vec at = {rng.range(0.1, 7), rng.range(0.1, 7), 0};
    BodyPlan plan = segment(at, {at[0] + 0.6, at[1] + 0.3, 0});
    if (i % 3 == 0) return plan;
    plan.at.push_back({at[0] + 0.2, at[1] + 0.5, 0});
    plan.edges.push_back({1, 2});
    plan.edges.push_back({2, 0});
    return plan;
  });
}

TEST(PlanePairsThreadsTest, TheSameBitsForAnyNumberOfThreads) { check_threads(plane_answers); }

}  // namespace
}  // namespace dsw::oracle
