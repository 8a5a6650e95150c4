// Moves of bodies: what is refused, what each level meets, and what the report says.
#include "body_support.h"

namespace dsw::oracle {
namespace {

constexpr Vec kA = {0.5, 0.5, 0.5}, kB = {0.75, 0.5, 0.5};

class BodyMoveTest : public BodyTest {
 protected:
  BodyAnswer move(dsw_body_id body, const std::vector<Vec>& targets, const dsw_move_options* options = nullptr) {
    BodyAnswer answer;
    EXPECT_EQ(move_body(scene(), body, targets, options, answer), "");
    return answer;
  }
  /// Contacts of the last move included.
  std::string everything(dsw_body_id body) {
    BodyAnswer answer;
    const dsw_body_contact* contacts = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contacts(scene(), body, &contacts, &count), DSW_STATUS_OK);
    answer.contacts.assign(contacts, contacts + count);
    answer.after = read(body);
    return bits_of(answer) + bits_of(answer.after);
  }
  void refuse(dsw_status status, dsw_body_id body, const std::vector<Vec>& targets, size_t count, size_t stride,
              const dsw_move_options* options) {
    const std::string before = everything(body);
    dsw_move_report report, untouched;
    std::memset(&report, 0x55, sizeof report);
    std::memset(&untouched, 0x55, sizeof untouched);
    EXPECT_EQ(dsw_body_move(scene(), body, targets[0].data(), count, stride, options, &report), status)
        << dsw_last_error_message();
    EXPECT_EQ(std::memcmp(&report, &untouched, sizeof report), 0);
    EXPECT_EQ(everything(body), before);
  }
};

TEST_F(BodyMoveTest, ArgumentsThatAreRefusedChangeNothing) {
  const dsw_body_id body = make(segment(kA, kB));
  ASSERT_EQ(move(body, {{0.25, 0.5, 0.5}, {-5, 0.5, 0.5}}).contacts.size(), 1u);
  const std::vector<Vec> back = {kA, kB};
  refuse(DSW_STATUS_WRONG_SIZE, body, back, 1, 0, nullptr);
  refuse(DSW_STATUS_WRONG_SIZE, body, {kA, kB, kA}, 3, 0, nullptr);
  refuse(DSW_STATUS_WRONG_SIZE, body, back, 2, 16, nullptr);
  refuse(DSW_STATUS_NON_FINITE, body, {kA, {0.5, NAN, 0.5}}, 2, 0, nullptr);
  refuse(DSW_STATUS_NON_FINITE, body, {kA, {0.5, HUGE_VAL, 0.5}}, 2, 0, nullptr);
  const auto with = [&](dsw_status status, auto set) {
    dsw_move_options options = defaults(dsw_move_options_init);
    set(options);
    refuse(status, body, back, 2, 0, &options);
  };
  static const uint32_t beyond[] = {0, 2}, twice[] = {1, 1};
  with(DSW_STATUS_OUT_OF_RANGE, [](dsw_move_options& o) { o.order = beyond, o.order_count = 2; });
  with(DSW_STATUS_DUPLICATE_ID, [](dsw_move_options& o) { o.order = twice, o.order_count = 2; });
  with(DSW_STATUS_OUT_OF_RANGE, [](dsw_move_options& o) { o.bisection_depth = 53; });
  with(DSW_STATUS_OUT_OF_RANGE, [](dsw_move_options& o) { o.min_part = 0.6; });
  with(DSW_STATUS_OUT_OF_RANGE, [](dsw_move_options& o) { o.min_part = -0.1; });
  with(DSW_STATUS_UNSUPPORTED, [](dsw_move_options& o) { o.flags = 2; });
  with(DSW_STATUS_UNSUPPORTED, [](dsw_move_options& o) { o.search = static_cast<dsw_search>(4); });
  with(DSW_STATUS_UNSUPPORTED, [](dsw_move_options& o) { o.edge_response = static_cast<dsw_response>(6); });
  with(DSW_STATUS_UNSUPPORTED, [](dsw_move_options& o) { o.vertex_response = DSW_RESPONSE_HYBRID; });
  with(DSW_STATUS_BAD_STRUCT_SIZE, [](dsw_move_options& o) { o.struct_size = 8; });
  EXPECT_EQ(dsw_body_move(scene(), body, nullptr, 2, 0, nullptr, nullptr), DSW_STATUS_NULL_ARGUMENT);
  EXPECT_EQ(dsw_body_move(nullptr, body, back[0].data(), 2, 0, nullptr, nullptr), DSW_STATUS_NULL_ARGUMENT);
}

TEST_F(BodyMoveTest, TargetsOfVerticesThatDoNotMoveAreNotRead) {
  const dsw_body_id body = make({{kA, kB, {0.5, 0.75, 0.5}}, {{0, 1}}, {}});
  dsw_move_options options = defaults(dsw_move_options_init);
  const uint32_t order[] = {1};
  options.order = order;
  options.order_count = 1;
  const Vec nothing = {NAN, NAN, NAN}, to = {0.875, 0.5, 0.5};
  BodyAnswer answer = move(body, {nothing, to, nothing}, &options);
  EXPECT_EQ(answer.after.at[1], to);
  EXPECT_EQ(answer.after.at[0], kA);
  EXPECT_EQ(answer.report.vertices_moved, 1u);
  ASSERT_EQ(dsw_body_remove_vertex(scene(), body, answer.after.vertices[2]), DSW_STATUS_OK);
  answer = move(body, {kA, kB, nothing});
  EXPECT_EQ(answer.report.vertices_moved, 2u);
  const uint32_t gone[] = {2};
  options.order = gone;
  refuse(DSW_STATUS_OUT_OF_RANGE, body, {kA, kB, kA}, 3, 0, &options);
}

TEST_F(BodyMoveTest, EachLevelMeetsWhatItSays) {
  // Across the marked edge at (2, 2), whose ends are far from the plane of the motion; and a marked vertex.
  mark_edge(2, 2, 1);
  const Vec from = {1.5, 1.5, 1.5}, fixed = {2.5, 2.75, 1.5}, to = {2.75, 1.5, 1.5};
  for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    const dsw_body_id body = make(segment(from, fixed), level);
    const BodyAnswer answer = move(body, {to, fixed});
    ASSERT_EQ(answer.contacts.size(), level >= DSW_LEVEL_EDGES_SWEPT ? 1u : 0u) << level;
    EXPECT_EQ(answer.report.vertices_stopped, answer.contacts.size());
    EXPECT_EQ(answer.report.fraction, 1);
    if (answer.contacts.empty()) continue;
    const dsw_body_contact& c = answer.contacts[0];
    EXPECT_EQ(c.contact.kind, DSW_CONTACT_EDGE);
    EXPECT_EQ(c.contact.marked_kind, DSW_CELL_EDGE);
    EXPECT_EQ(c.contact.wall.generation, 0u);
    EXPECT_TRUE(c.vertex.index == 0 && c.edge.generation == 1 && c.face.generation == 0);
    EXPECT_EQ(c.point[0], 2);
    EXPECT_EQ(c.point[1], 2);
    EXPECT_EQ(c.history, DSW_HISTORY_NEW);
  }
}

TEST_F(BodyMoveTest, EdgesThatMoveAlikeAndLessThanTheirLengthAreSweptOnce) {
  const auto skipped = [&](const Vec& to_a, const Vec& to_b) {
    const dsw_body_id body = make(segment(kA, kB), DSW_LEVEL_EDGES, DSW_BODY_SKIP_SIMILAR_MOTION);
    const BodyAnswer answer = move(body, {to_a, to_b});
    EXPECT_EQ(answer.report.vertices_stopped, 0u);
    return answer.report.edges_skipped;
  };
  EXPECT_EQ(skipped({0.5, 0.7, 0.5}, {0.75, 0.7, 0.5}), 2u);
  EXPECT_EQ(skipped({0.5, 0.7, 0.5}, {0.75, 0.71, 0.5}), 2u);
  EXPECT_EQ(skipped({0.5, 0.7, 0.5}, {0.75, 0.74, 0.5}), 0u);
  EXPECT_EQ(skipped({0.5, 0.8, 0.5}, {0.75, 0.8, 0.5}), 0u);
}

TEST_F(BodyMoveTest, SkippedEdgesKeepTheirSequences) {
  std::vector<BodyAnswer> answers[2];
  for (int i = 0; i < 2; ++i) {
    BodyPlan plan;
    for (uint32_t v = 0; v < 6; ++v) {
      plan.at.push_back({0.3 + 0.5 * v, 0.5, 0.5});
      if (v > 0) plan.edges.push_back({v - 1, v});
    }
    const uint32_t keeps = i == 0 ? 0 : DSW_BODY_SEQUENCES;
    const dsw_body_id body = make(plan, DSW_LEVEL_EDGES, DSW_BODY_SKIP_SIMILAR_MOTION | keeps);
    Rng rng(3);
    for (int step = 0; step < at_least(50); ++step) {
      std::vector<Vec> targets = read(body).at;
      // The first ones move alike, the others do not.
      const double y = rng.range(-0.2, 0.2);
      for (size_t v = 0; v < targets.size(); ++v) targets[v][1] += v < 3 ? y : rng.range(-0.3, 0.3);
      answers[i].push_back(move(body, targets));
    }
  }
  size_t skipped = 0;
  for (size_t step = 0; step < answers[0].size(); ++step) {
    ASSERT_EQ(answers[0][step].after.at, answers[1][step].after.at) << step;
    skipped += answers[0][step].report.edges_skipped;
  }
  EXPECT_GT(skipped, 50u);
}

TEST_F(BodyMoveTest, ALoneMarkedVertexIsMetByFacesOnly) {
  const dsw_vertex_id marked = {point(2, 2, 1), 1};
  ASSERT_EQ(dsw_environment_mark_vertices(place_.get(), &marked, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  const Vec p = {2, 1.5, 0.5}, q = {1.25, 2.75, 1}, r = {2.75, 2.75, 1}, to = {2, 1.5, 1.75};
  for (dsw_level level : {DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    const dsw_body_id body = make({{p, q, r}, {}, {{0, 1, 2}}}, level);
    const BodyAnswer answer = move(body, {to, q, r});
    ASSERT_EQ(answer.contacts.size(), level == DSW_LEVEL_FACES ? 1u : 0u);
    if (answer.contacts.empty()) continue;
    const dsw_body_contact& c = answer.contacts[0];
    EXPECT_EQ(c.contact.kind, DSW_CONTACT_VERTEX);
    EXPECT_EQ(c.contact.marked_kind, DSW_CELL_VERTEX);
    EXPECT_TRUE(c.contact.obstacle.kind == DSW_CELL_VERTEX && c.contact.obstacle.index == marked.index);
    EXPECT_TRUE(c.face.generation == 1 && c.edge.generation == 0 && c.contact.wall.generation == 0);
    EXPECT_TRUE(c.point[0] == 2 && c.point[1] == 2 && c.point[2] == 1);
    EXPECT_EQ(c.time, std::nextafter(0.4, 0));  // 2/5, rounded down
    EXPECT_LT(c.contact.normal[2], 0);
  }
}

TEST_F(BodyMoveTest, APushThatLastsSaysSo) {
  mark_wall(0, 0, 0);
  const dsw_body_id body = make(segment(kA, kB));
  const std::vector<Vec> to = {kA, {1.5, 0.5, 0.5}};
  BodyAnswer answer = move(body, to);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].history, DSW_HISTORY_NEW);
  answer = move(body, to);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].history, DSW_HISTORY_LASTING);
  EXPECT_EQ(move(body, {kA, kB}).contacts.size(), 0u);
  answer = move(body, to);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].history, DSW_HISTORY_NEW);
}

TEST_F(BodyMoveTest, AStopLastsWhicheverObstaclesWereListedBesideIt) {
  mark_edge(2, 2, 1);
  mark_edge(3, 2, 1);
  const Vec from = {1.5, 1.5, 1.5}, fixed = {2.5, 2.75, 1.5}, to = {3.75, 1.5, 1.5};
  const dsw_body_id body = make(segment(from, fixed));
  dsw_move_options options = defaults(dsw_move_options_init);
  options.search = DSW_SEARCH_EXHAUSTIVE;
  ASSERT_EQ(move(body, {to, fixed}, &options).contacts.size(), 2u);
  const BodyAnswer again = move(body, {to, fixed});
  ASSERT_EQ(again.contacts.size(), 1u);
  EXPECT_EQ(again.contacts[0].history, DSW_HISTORY_LASTING);
}

TEST_F(BodyMoveTest, AllObstaclesUnderTheEdgeComeInTheirOrder) {
  mark_edge(2, 2, 1);
  mark_edge(3, 2, 1);
  const Vec from = {1.5, 1.5, 1.5}, fixed = {2.5, 2.75, 1.5}, to = {3.75, 1.5, 1.5};
  const dsw_body_id body = make(segment(from, fixed)), twin = make(segment(from, fixed));
  dsw_move_options options = defaults(dsw_move_options_init);
  options.search = DSW_SEARCH_EXHAUSTIVE;
  const BodyAnswer all = move(body, {to, fixed}, &options), exact = move(twin, {to, fixed});
  ASSERT_EQ(all.contacts.size(), 2u);
  ASSERT_EQ(exact.contacts.size(), 1u);
  EXPECT_LT(all.contacts[0].time, all.contacts[1].time);
  EXPECT_EQ(all.contacts[0].time, exact.contacts[0].time);
  EXPECT_EQ(all.contacts[0].point[0], 2);
  EXPECT_EQ(all.contacts[1].point[0], 3);
  EXPECT_EQ(all.after.at, exact.after.at);
}

TEST_F(BodyMoveTest, HalvingEndsBetweenAFreePlaceAndOneThatIsNot) {
  constexpr double kStep = 0x1p-12;
  mark_wall(2, 1, 1);
  mark_wall(1, 2, 2);
  mark_edge(3, 3, 1);
  Rng rng(17);
  dsw_move_options options = defaults(dsw_move_options_init), exact = options;
  options.search = DSW_SEARCH_BISECTION;
  options.bisection_depth = 12;
  options.stand_off = exact.stand_off = -1;
  int of_paths = 0, of_edges = 0, of_faces = 0, far = 0;
  for (int i = 0; i < at_least(600); ++i) {
    const dsw_level level = static_cast<dsw_level>(1 + i % 4);
    const auto inside = [&] { return Vec{rng.range(0.1, 3.9), rng.range(0.1, 3.9), rng.range(0.1, 3.9)}; };
    const BodyPlan plan = {{inside(), inside(), inside()}, {}, {{0, 1, 2}}};
    std::vector<Vec> targets = plan.at;
    targets[0] = inside();
    dsw_body_id bodies[3];
    if (create_body(scene(), plan, level, 0, {}, &bodies[0]) != DSW_STATUS_OK) continue;
    const BodyAnswer halved = move(bodies[0], targets, &options);
    ASSERT_EQ(dsw_body_destroy(scene(), bodies[0]), DSW_STATUS_OK);
    if (halved.contacts.empty()) {
      EXPECT_EQ(halved.after.at[0], targets[0]);
      continue;
    }
    ASSERT_EQ(halved.contacts.size(), 1u);
    const dsw_body_contact& c = halved.contacts[0];
    EXPECT_EQ(std::floor(c.time / kStep), c.time / kStep);
    // It stands where it is seen free, and the place behind is not free; nor is the target.
    const Vec to = targets[0];
    const auto place = [&](double t) {
      Vec at = plan.at[0];
      for (size_t k = 0; k < 3; ++k) at[k] += t * (to[k] - at[k]);
      return at;
    };
    for (int k = 1; k < 3; ++k) bodies[k] = make(plan, level);
    targets[0] = place(c.time);
    EXPECT_EQ(halved.after.at[0], targets[0]);
    EXPECT_TRUE(move(bodies[1], targets, &exact).contacts.empty()) << i;
    targets[0] = place(c.time + kStep);
    const BodyAnswer behind = move(bodies[2], targets, &exact);
    EXPECT_EQ(behind.contacts.size(), 1u) << i;
    for (int k = 1; k < 3; ++k) ASSERT_EQ(dsw_body_destroy(scene(), bodies[k]), DSW_STATUS_OK);
    // What runs into a face does so on that face.
    of_faces += c.face.generation != 0 ? 1 : 0;
    if (c.contact.kind != DSW_CONTACT_PLANE) continue;
    ++(c.edge.generation != 0 ? of_edges : of_paths);
    double largest = 0;
    for (const double x : c.contact.normal) largest = std::max(largest, std::fabs(x));
    EXPECT_EQ(largest, 1) << i;  // all faces here look along an axis
    for (size_t k = 0; k < 3; ++k)
      far += c.contact.normal[k] != 0 && std::fabs(c.point[k] - std::round(c.point[k])) > 1e-12 ? 1 : 0;
  }
  EXPECT_GT(of_paths, 20);
  EXPECT_GT(of_edges, 20);
  EXPECT_GT(of_faces, 0);
  EXPECT_EQ(far, 0);
}

TEST_F(BodyMoveTest, AllObstaclesAtEdgesAreThoseOfTheEdgesThatWereHit) {
  // The edge to vertex 1 passes a marked edge and ends free, so EDGES ignores it. The edge to vertex 2 ends in a wall.
  mark_edge(1, 1, 1);
  mark_wall(2, 1, 1);
  const BodyPlan plan = {{{0.5, 0.5, 1.5}, {1.25, 2.25, 1.5}, {2.75, 2.5, 1.5}}, {{0, 1}, {0, 2}}, {}};
  const std::vector<Vec> to = {{3.5, 0.5, 1.5}, plan.at[1], plan.at[2]};
  const dsw_body_id body = make(plan, DSW_LEVEL_EDGES), twin = make(plan, DSW_LEVEL_EDGES);
  dsw_move_options options = defaults(dsw_move_options_init);
  options.search = DSW_SEARCH_EXHAUSTIVE;
  const BodyAnswer exact = move(twin, to), all = move(body, to, &options);
  ASSERT_EQ(exact.contacts.size(), 1u);
  EXPECT_TRUE(exact.contacts[0].point[0] == 3 && exact.contacts[0].point[1] == 1);
  ASSERT_GE(all.contacts.size(), 1u);
  EXPECT_EQ(all.contacts.size(), 1u);
  EXPECT_EQ(all.contacts[0].time, exact.contacts[0].time);
}

TEST_F(BodyMoveTest, AnInsertedVertexIsReportedAndSplitsItsEdge) {
  mark_edge(2, 2, 1);
  const Vec from = {1.5, 1.5, 1.5}, fixed = {2.5, 2.75, 1.5}, to = {2.75, 1.5, 1.5};
  for (dsw_response response :
       {DSW_RESPONSE_ADAPTIVE_ONE, DSW_RESPONSE_ADAPTIVE_MANY, DSW_RESPONSE_HYBRID, DSW_RESPONSE_ADAPTIVE_SLIDE}) {
    const dsw_body_id body = make(segment(from, fixed));
    dsw_move_options options = defaults(dsw_move_options_init);
    options.edge_response = response;
    const BodyAnswer answer = move(body, {to, fixed}, &options);
    EXPECT_GE(answer.contacts.size(), 1u);
    ASSERT_GE(answer.report.edit_count, 1u);
    const dsw_body_edit* edits = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_get_edits(scene(), body, &edits, &count), DSW_STATUS_OK);
    ASSERT_EQ(count, answer.report.edit_count);
    EXPECT_TRUE(edits[0].inserted == 1 && edits[0].vertex.index == 2 && edits[0].reserved == 0);
    EXPECT_EQ(answer.after.edges.size(), 1 + count);
    EXPECT_EQ(answer.after.at[0], to);
    EXPECT_EQ(answer.report.vertices_stopped, 0u);
  }
}

TEST(BodySlideTest, TargetsAtTheEndOfTheDoublesLeaveNumbers) {
  // Oblique walls: a projection of such a move may overflow.
  Rng rng(5);
  const Mesh mesh = delaunay(rng, 14, 64);
  const EnvironmentPtr environment = create_environment(mesh);
  const ScenePtr scene = make_scene(environment.get());
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.edge_response = DSW_RESPONSE_SLIDE;
  for (int i = 0; i < at_least(200); ++i) {
    BodyPlan plan;
    for (int v = 0; v < 2; ++v) plan.at.push_back({rng.range(16, 48), rng.range(16, 48), rng.range(16, 48)});
    plan.edges = {{0, 1}};
    dsw_body_id body;
    if (create_body(scene.get(), plan, DSW_LEVEL_EDGES_SWEPT, 0, {}, &body) != DSW_STATUS_OK) continue;
    std::vector<Vec> targets = plan.at;
    for (Vec& t : targets) {
      for (double& x : t) x = rng.chance(0.7) ? (rng.chance(0.5) ? 1.7e308 : -1.7e308) : x;
    }
    BodyAnswer answer;
    ASSERT_EQ(move_body(scene.get(), body, targets, &options, answer), "");
    for (const Vec& p : answer.after.at) {
      for (double x : p) ASSERT_TRUE(std::isfinite(x)) << i << ": " << hex(p);
    }
    for (const dsw_body_contact& c : answer.contacts) {
      for (size_t k = 0; k < 3; ++k) {
        ASSERT_TRUE(std::isfinite(c.from[k]) && std::isfinite(c.to[k])) << i << ": " << hex(c.from) << hex(c.to);
        ASSERT_TRUE(std::isfinite(c.position[k])) << i << ": " << hex(c.position);
        ASSERT_TRUE(std::isfinite(c.point[k]) && std::isfinite(c.contact.normal[k])) << i << ": " << hex(c.point);
      }
      ASSERT_TRUE(c.time >= 0 && c.time <= 1) << i;
    }
    dsw_body_destroy(scene.get(), body);
  }
}

class BodyRigidTest : public BodyMoveTest {
 protected:
  dsw_rigid_motion shift(const Vec& by) const {
    dsw_rigid_motion m;
    std::memset(&m, 0, sizeof m);
    m.rotation[3] = 1;
    for (size_t k = 0; k < 3; ++k) m.translation[k] = by[k];
    return m;
  }
};

TEST_F(BodyRigidTest, AFreeMotionIsMadeWhole) {
  const dsw_body_id body = make(tetrahedron(kA, 0.25));
  const BodyState before = read(body);
  dsw_move_report report;
  const dsw_rigid_motion m = shift({2, 1, 0.5});
  ASSERT_EQ(dsw_body_move_rigid(scene(), body, &m, nullptr, &report), DSW_STATUS_OK);
  EXPECT_EQ(report.fraction, 1);
  EXPECT_EQ(report.contact_count, 0u);
  const BodyState after = read(body);
  for (size_t v = 0; v < 4; ++v) {
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(after.at[v][k], before.at[v][k] + m.translation[k]);
  }
}

TEST_F(BodyRigidTest, AWallLeavesAFractionThatIsFree) {
  mark_wall(1, 0, 0);
  const dsw_body_id body = make(tetrahedron(kA, 0.25), DSW_LEVEL_FACES);
  dsw_move_report report;
  const dsw_rigid_motion m = shift({3, 0, 0});
  ASSERT_EQ(dsw_body_move_rigid(scene(), body, &m, nullptr, &report), DSW_STATUS_OK);
  const BodyState after = read(body);
  double furthest = 0;
  for (size_t v = 0; v < 4; ++v) furthest = std::max(furthest, after.at[v][0]);
  EXPECT_LE(furthest, 2);
  EXPECT_GT(furthest, 2 - 16 * 0x1p-53);
  EXPECT_GE(report.contact_count, 1u);
}

// An edge keeps what it has touched. That says nothing once the wall is gone.
TEST_F(BodyRigidTest, WhatIsNoLongerThereStopsNothing) {
  mark_wall(0, 1, 0);
  const dsw_body_id body = make(segment({0.5, 1.5, 1.375}, {1.5, 1.5, 1.375}));
  BodyState state = read(body);
  for (Vec& at : state.at) at[2] -= 0.5;
  const BodyAnswer touched = move(body, state.at);
  ASSERT_GE(touched.contacts.size(), 1u);
  EXPECT_EQ(touched.contacts[0].contact.kind, DSW_CONTACT_EDGE);
  const dsw_face_id wall = face_between(0, 1, 0);
  ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &wall, 1, DSW_MARK_PASSABLE), DSW_STATUS_OK);
  dsw_move_report report;
  const dsw_rigid_motion m = shift({0, 0, -0.5});
  ASSERT_EQ(dsw_body_move_rigid(scene(), body, &m, nullptr, &report), DSW_STATUS_OK);
  EXPECT_EQ(report.fraction, 1);
  EXPECT_EQ(report.contact_count, 0u);
}

TEST_F(BodyRigidTest, MotionsThatAreNone) {
  const dsw_body_id body = make(segment(kA, kB));
  const std::string before = everything(body);
  dsw_rigid_motion m = shift({0, 0, 0});
  m.rotation[3] = 0;
  EXPECT_EQ(dsw_body_move_rigid(scene(), body, &m, nullptr, nullptr), DSW_STATUS_OUT_OF_RANGE);
  m = shift({NAN, 0, 0});
  EXPECT_EQ(dsw_body_move_rigid(scene(), body, &m, nullptr, nullptr), DSW_STATUS_NON_FINITE);
  m = shift({0, 0, 0});
  m.rotation[0] = HUGE_VAL;
  EXPECT_EQ(dsw_body_move_rigid(scene(), body, &m, nullptr, nullptr), DSW_STATUS_NON_FINITE);
  EXPECT_EQ(dsw_body_move_rigid(scene(), body, nullptr, nullptr, nullptr), DSW_STATUS_NULL_ARGUMENT);
  EXPECT_EQ(everything(body), before);
}

// Vertex 0 is stopped halfway by the edge to vertex 1, so that the volumes noted for the edge to vertex 2 are not those
// that it crosses. Then its path enters one more volume, and between that and what was noted stands an obstacle.
TEST_F(BodyMoveTest, ASequenceThatTheEdgeDoesNotCrossAnyMoreIsNotContinued) {
  mark_volume(cube(1, 1, 1));
  const Vec u = {0.5, 1.5, 1.5}, q = {3.1, 1.55, 1.5};
  for (dsw_level level : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
    std::string answers[2];
    for (uint32_t flags : {0u, static_cast<uint32_t>(DSW_BODY_SEQUENCES)}) {
      const dsw_body_id body = make({{{1.1, 0.2, 1.5}, u, q}, {{0, 2}, {0, 1}}, {}}, level, flags);
      EXPECT_EQ(move(body, {{2.5, 1.1, 1.5}, u, q}).contacts.size(), 1u);
      const BodyAnswer answer = move(body, {{0.9, 0.55, 1.5}, u, q});
      EXPECT_EQ(answer.contacts.size(), 1u) << "level " << level << ", flags " << flags;
      answers[flags == 0 ? 0 : 1] = bits_of(answer.after);
      // Raising the level casts every edge.
      EXPECT_EQ(dsw_body_set_level(scene(), body, DSW_LEVEL_FACES), DSW_STATUS_OK) << dsw_last_error_message();
    }
    EXPECT_EQ(answers[0], answers[1]);
  }
}

// A thin wedge whose edge runs through the origin, in volumes so large that distances to it are rounded by more than
// its distance from the body: what is measured must not pass for clear.
TEST(BodyClearanceTest, DistancesInHugeVolumesAreNotTrusted) {
  const double size = 1e13, far = 1e-3, turn = std::acos(-1.0) / 180;
  Rng rng(5);
  int met = 0;
  for (int tries = 0; tries < 100; ++tries) {
    // An orthogonal frame: the wedge's edge along x, its inside along -z.
    const auto random = [&] { return rng.range(-1, 1); };
    const auto cross = [](const Vec& a, const Vec& b) {
      return Vec{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto unit = [](const Vec& a) {
      const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
      return Vec{a[0] / length, a[1] / length, a[2] / length};
    };
    const Vec x = unit({random(), random(), random()}), y = unit(cross(x, {random(), random(), random()}));
    const Vec z = cross(x, y);
    const auto at = [&](double a, double b, double c) {
      Vec p;
      for (size_t k = 0; k < 3; ++k) p[k] = a * x[k] + b * y[k] + c * z[k];
      return p;
    };
    Mesh mesh;
    mesh.points = {at(-size, 0, 0), at(size, 0, 0)};
    const int ring[] = {-20, 20, 90, 180, 270};  // degrees from -z
    for (int angle : ring) mesh.points.push_back(at(0, size * std::sin(angle * turn), -size * std::cos(angle * turn)));
    for (int i = 0; i < 5; ++i) mesh.add_standard(DSW_CELL_TYPE_TETRA, {0, 1, 2 + i, 2 + (i + 1) % 5});
    const Place place = place_of(std::move(mesh));
    ASSERT_NE(place.environment, nullptr) << dsw_last_error_message();
    const dsw_volume_id wedge = place.world->ids[0];
    ASSERT_EQ(dsw_environment_mark_volumes(place.get(), &wedge, 1, DSW_MARK_IMPASSABLE, 0, nullptr), DSW_STATUS_OK);
    const ScenePtr scene = make_scene(place.get());
    const Vec p = at(0, 0, far), to = at(0, -0.3 * far, -0.11 * far), q = at(0, 0.3 * far, -0.11 * far);
    std::string answers[2];
    for (uint32_t flags : {0u, static_cast<uint32_t>(DSW_BODY_SKIP_BY_CLEARANCE)}) {
      dsw_body_id body;
      ASSERT_EQ(create_body(scene.get(), segment(p, q), DSW_LEVEL_EDGES_SWEPT, flags, {}, &body), DSW_STATUS_OK)
          << dsw_last_error_message();
      BodyAnswer answer;
      ASSERT_EQ(move_body(scene.get(), body, {to, q}, nullptr, answer), "");
      answers[flags == 0 ? 0 : 1] = bits_of(answer.after);
      met += answer.contacts.empty() ? 0 : 1;
    }
    EXPECT_EQ(answers[0], answers[1]) << "try " << tries;
  }
  EXPECT_EQ(met, 200);
}

TEST_F(BodyMoveTest, TheWorkLimitStopsTheSameMovesWithAndWithoutWhatIsLossless) {
  const std::vector<Vec> at = {{0.5, 0.5, 0.5}, {3.5, 0.5, 0.5}};
  const std::vector<Vec> to = {{0.5, 0.5, 0.5}, {3.5, 0.625, 0.5}}, further = {to[0], {3.5, 0.75, 0.5}};
  for (dsw_level level : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    std::string answers[8];
    for (uint32_t flags = 0; flags < 8; ++flags) {
      const dsw_body_id body = make({at, {{0, 1}}, {}}, level, flags);
      EXPECT_EQ(move(body, to).report.vertices_stopped, 0u);
      dsw_move_options options = defaults(dsw_move_options_init);
      options.max_volumes = 2;
      const BodyAnswer answer = move(body, further, &options);
      EXPECT_EQ(answer.report.vertices_stopped, 1u) << "level " << level << ", flags " << flags;
      answers[flags] = bits_of(answer.after);
    }
  }
}

TEST_F(BodyMoveTest, AStandOffBeyondAllDoublesInsertsNoVertexThere) {
  mark_edge(2, 2, 1);
  dsw_move_options options = defaults(dsw_move_options_init);
  for (double stand_off : {1e300, 1e307, 1.7e308}) {
    for (int i = 0; i < 64; ++i) {
      const double d = 0.37 * i / 64;
      const dsw_body_id body = make({{{1.1 + d, 1.5, 1.4}, {1.3, 2.6 + d, 1.61}}, {{0, 1}}, {}});
      const std::vector<Vec> to = {{2.7, 1.2 + d, 1.45}, {1.3, 2.6 + d, 1.61}};
      // Up to the marked edge, so near that a point on the edge may round to its other side.
      options.stand_off = -1;
      options.edge_response = DSW_RESPONSE_STOP;
      move(body, to, &options);
      options.stand_off = stand_off;
      options.edge_response = DSW_RESPONSE_ADAPTIVE_MANY;
      const BodyAnswer answer = move(body, to, &options);
      for (const Vec& p : answer.after.at) {
        for (double x : p) EXPECT_TRUE(x >= 0 && x <= 4);
      }
      EXPECT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
    }
  }
}

}  // namespace
}  // namespace dsw::oracle
