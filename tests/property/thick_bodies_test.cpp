// Thick bodies in easy places, where it is known what happens; bodies that meet; rigid moves, memory and threads.
#include "pairs_support.h"
#include "thick_checks.h"
#include "two_bodies.h"

namespace dsw::oracle {
namespace {

class ThickBodyTest : public MemoryTest {
 protected:
  void features(uint32_t bits) {
    scene_.reset();
    scene_ = make_scene(place_.get(), bits);
  }
  dsw_body_id make(const BodyPlan& plan, double radius, dsw_level level = DSW_LEVEL_EDGES_SWEPT, uint32_t flags = 0) {
    dsw_body_id body = {0, 0};
    EXPECT_EQ(create_body(scene(), plan, level, flags, {}, &body, radius), DSW_STATUS_OK) << dsw_last_error_message();
    return body;
  }
  BodyAnswer move(dsw_body_id body, const std::vector<Vec>& targets, const dsw_move_options* options = nullptr) {
    BodyAnswer answer;
    EXPECT_EQ(move_body(scene(), body, targets, options, answer), "");
    return answer;
  }
  double gap(dsw_body_id body, double limit) {
    double found = HUGE_VAL;
    EXPECT_EQ(dsw_body_find_least_gap(scene(), body, limit, &found), DSW_STATUS_OK);
    return found;
  }
  static BodyPlan ball(double x, double y, double z) { return {{{x, y, z}}, {}, {}}; }
  static void expect_normal(const dsw_body_contact& c, const Vec& normal) {
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(c.contact.normal[k], normal[k], 1e-9);
  }
};

TEST_F(ThickBodyTest, ABallStopsItsRadiusBeforeAWall) {
  for (const dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    const dsw_body_id body = make(ball(0.5, 1.5, 1.5), 0.25, level);
    const BodyAnswer answer = move(body, {{4.5, 1.5, 1.5}});
    ASSERT_EQ(answer.contacts.size(), 1u);
    const dsw_body_contact& c = answer.contacts[0];
    EXPECT_NEAR(c.time, 3.25 / 4, 1e-9);
    EXPECT_NEAR(c.position[0], 3.75, 1e-9);
    expect_normal(c, {-1, 0, 0});
    EXPECT_EQ(c.contact.obstacle.kind, DSW_CELL_FACE);
    EXPECT_LE(answer.after.at[0][0], 3.75 + 1e-9);
    EXPECT_GE(answer.after.at[0][0], 3.75 - 1e-6);
    EXPECT_NEAR(gap(body, 1), 0, 1e-6);
    ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  }
}

TEST_F(ThickBodyTest, ABallStopsAtEverythingThatIsMarked) {
  // The rim of a wall, a marked edge and a marked vertex, at any level.
  const Vec to = {3.5, 1.5, 1.625};
  for (int kind = 0; kind < 3; ++kind) {
    scene_.reset();
    place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)), 0, context_.get());
    features(0);
    if (kind == 0) mark_wall(1, 2, 1);
    if (kind == 1) mark_edge(2, 2, 1);
    const dsw_vertex_id marked = {point(2, 2, 2), 1};
    if (kind == 2) {
      ASSERT_EQ(dsw_environment_mark_vertices(place_.get(), &marked, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    for (const dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
      const dsw_body_id body = make(ball(0.5, 1.625, 1.625), 0.45, level);
      const BodyAnswer answer = move(body, {{to[0], 1.625, to[2]}});
      const double across = kind == 2 ? std::hypot(0.375, 0.375) : 0.375;
      const size_t expected = across < 0.45 ? 1 : 0;
      ASSERT_EQ(answer.contacts.size(), expected) << "obstacle " << kind << " level " << level;
      if (expected == 0) {
        EXPECT_EQ(answer.after.at[0][0], to[0]);
      } else {
        EXPECT_NEAR(answer.contacts[0].position[0], 2 - std::sqrt(0.45 * 0.45 - across * across), 1e-9);
        EXPECT_EQ(answer.contacts[0].contact.obstacle.kind, kind == 2 ? DSW_CELL_VERTEX : DSW_CELL_EDGE);
      }
      ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
    }
  }
}

TEST_F(ThickBodyTest, ACapsuleAndAPlatePassAMarkedEdgeAtTheirRadius) {
  mark_edge(2, 2, 1);
  // An edge that is moved past the marked one crosswise, above it.
  const dsw_body_id wire = make(segment({0.5, 1, 2.3}, {0.5, 3, 2.3}), 0.2);
  ASSERT_EQ(move(wire, {{3.5, 1, 2.3}, {3.5, 3, 2.3}}).contacts.size(), 0u);
  ASSERT_EQ(dsw_body_destroy(scene(), wire), DSW_STATUS_OK);
  const dsw_body_id low = make(segment({0.5, 1, 1.5}, {0.5, 3, 1.5}), 0.2);
  dsw_move_options options = defaults(dsw_move_options_init);
  const uint32_t order[] = {0};
  options.order = order;
  options.order_count = 1;
  const BodyAnswer answer = move(low, {{3.5, 1, 1.5}, {0.5, 3, 1.5}}, &options);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].edge.generation, 1u);
  EXPECT_EQ(answer.contacts[0].contact.obstacle.kind, DSW_CELL_EDGE);
  // The wire turns round its fixed end, and stops where it is 0.2 from the marked edge.
  const Vec p = answer.after.at[0], q = {0.5, 3, 1.5};
  const double away =
      std::fabs((p[0] - q[0]) * (2 - q[1]) - (p[1] - q[1]) * (2 - q[0])) / std::hypot(p[0] - q[0], p[1] - q[1]);
  EXPECT_NEAR(away, 0.2, 1e-6);
  const dsw_body_id plate =
      make({{{1.2, 1.2, 2.3}, {2.9, 1.2, 2.3}, {2, 2.9, 2.3}}, {}, {{0, 1, 2}}}, 0.2, DSW_LEVEL_FACES);
  EXPECT_NEAR(gap(plate, 1), 0.1, 1e-9);
  const BodyAnswer sunk = move(plate, {{1.2, 1.2, 1.9}, {2.9, 1.2, 1.9}, {2, 2.9, 1.9}});
  EXPECT_GT(sunk.contacts.size(), 0u);
  EXPECT_NEAR(gap(plate, 1), 0, 1e-6);
}

TEST_F(ThickBodyTest, ASlitLetsPassWhatIsThinEnough) {
  // Between two marked edges that are 1 apart.
  mark_edge(2, 1, 1);
  mark_edge(2, 2, 1);
  for (const double radius : {0.25, 0.49999999, 0.5, 0.50000001}) {
    const dsw_body_id body = make(ball(0.875, 1.5, 1.5), radius);
    const BodyAnswer answer = move(body, {{3.125, 1.5, 1.5}});
    EXPECT_EQ(answer.contacts.size(), radius > 0.5 ? 1u : 0u) << radius;
    ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  }
}

TEST_F(ThickBodyTest, ABallSlidesAlongAWallIntoACorner) {
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = DSW_RESPONSE_SLIDE;
  options.flags = DSW_MOVE_KEEP_WALLS;
  const dsw_body_id body = make(ball(0.5, 1.5, 1.5), 0.25);
  const Vec end = move(body, {{4.5, 5.5, 1.5}}, &options).after.at[0];
  EXPECT_NEAR(end[0], 3.75, 1e-5);
  EXPECT_NEAR(end[1], 3.75, 1e-5);
  EXPECT_NEAR(end[2], 1.5, 1e-5);
  EXPECT_GE(gap(body, 1), -0x1p-30 * 0.25);
  // Round an edge that sticks out.
  mark_edge(2, 2, 1);
  const dsw_body_id other = make(ball(1.5, 1.9, 1.5), 0.25);
  const Vec past = move(other, {{2.5, 1.9, 1.5}}, &options).after.at[0];
  EXPECT_GE(std::hypot(past[0] - 2, past[1] - 2), 0.25 * (1 - 0x1p-30));
}

TEST_F(ThickBodyTest, TwoBallsStopAtTheSumOfTheirRadii) {
  features(DSW_FEATURE_BODY_CONTACTS);
  const dsw_body_id still = make(ball(3, 1.5, 1.5), 0.25);
  for (const double radius : {0.125, 0.0}) {
    const dsw_body_id body = make(ball(1, 1.5, 1.5), radius);
    EXPECT_NEAR(gap(body, 3), std::min(1 - radius, 1.75 - radius), 1e-9);
    const BodyAnswer answer = move(body, {{3.5, 1.5, 1.5}});
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_NEAR(answer.contacts[0].position[0], 2.75 - radius, 1e-9);
    expect_normal(answer.contacts[0], {-1, 0, 0});
    const dsw_contact_partner* partners = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_get_contact_partners(scene(), body, &partners, &count), DSW_STATUS_OK);
    ASSERT_EQ(count, 1u);
    EXPECT_TRUE(same_id(partners[0].body, still) && partners[0].vertex.generation == 1);
    EXPECT_NEAR(gap(body, 3), 0, 1e-6);
    ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  }
  dsw_body_id refused;
  EXPECT_EQ(create_body(scene(), ball(2.7, 1.5, 1.5), DSW_LEVEL_POINTS, 0, {}, &refused, 0.0625), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create_body(scene(), ball(2.8, 1.5, 1.5), DSW_LEVEL_POINTS, 0, {}, &refused, 0), DSW_STATUS_OCCUPIED);
  // Bodies that cannot meet do not keep apart.
  ASSERT_EQ(dsw_body_set_filter(scene(), still, 2, 2), DSW_STATUS_OK);
  const dsw_body_id other = make(ball(2.9, 1.5, 1.5), 0.25);
  EXPECT_NEAR(gap(other, 3), 0.85, 1e-9);
  EXPECT_EQ(dsw_body_set_filter(scene(), still, 1, 1), DSW_STATUS_OCCUPIED);
  ASSERT_EQ(dsw_body_set_radius(scene(), other, 0.01), DSW_STATUS_OK);
  ASSERT_EQ(dsw_body_set_radius(scene(), still, 0.08), DSW_STATUS_OK);
  EXPECT_EQ(dsw_body_set_filter(scene(), still, 1, 1), DSW_STATUS_OK);
  EXPECT_NEAR(gap(other, 3), 0.01, 1e-9);
  EXPECT_EQ(dsw_body_set_radius(scene(), other, 0.03), DSW_STATUS_OCCUPIED);
}

TEST_F(ThickBodyTest, AThinBodyMeetsTheWallInFrontOfAThickBody) {
  features(DSW_FEATURE_BODY_CONTACTS);
  mark_wall(1, 1, 1);  // at x = 2
  make(ball(3, 1.5, 1.5), 0.25);
  const dsw_body_id body = make(ball(0.5, 1.5, 1.5), 0);
  for (const dsw_search search : {DSW_SEARCH_EXACT, DSW_SEARCH_BISECTION}) {
    dsw_move_options options = defaults(dsw_move_options_init);
    options.search = search;
    const BodyAnswer answer = move(body, {{3.5, 1.5, 1.5}}, &options);
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_NEAR(answer.contacts[0].position[0], 2, 1e-6);
    EXPECT_EQ(answer.contacts[0].contact.obstacle.kind, DSW_CELL_FACE);
  }
}

TEST_F(ThickBodyTest, OwnPartsKeepApartUnlessAShortWayJoinsThem) {
  features(DSW_FEATURE_BODY_CONTACTS);
  // A hairpin: two strands that are joined at one end by an edge.
  const auto hairpin = [](double apart, double link) {
    return BodyPlan{{{0.5, 1, 1.5},
                     {1.5, 1, 1.5},
                     {2.5, 1, 1.5},
                     {2.5 + link, 1 + apart / 2, 1.5},
                     {2.5, 1 + apart, 1.5},
                     {1.5, 1 + apart, 1.5},
                     {0.5, 1 + apart, 1.5}},
                    {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}},
                    {}};
  };
  dsw_body_id body;
  // The strands are 0.4 apart, their far ends 2.4 along the edges.
  ASSERT_EQ(create_body(scene(), hairpin(0.4, 0.1), DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SELF_CONTACTS, {}, &body, 0.15),
            DSW_STATUS_OK);
  EXPECT_EQ(dsw_body_set_radius(scene(), body, 0.25), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(dsw_body_set_radius(scene(), body, 0.199), DSW_STATUS_OK);
  // A far end goes to the other strand.
  std::vector<Vec> targets = hairpin(0.4, 0.1).at;
  targets[6][1] = 1.05;
  const BodyAnswer answer = move(body, targets);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_GE(answer.after.at[6][1], 1.398 - 1e-9);
  ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  // Short edges alone are joined, however thick.
  const BodyPlan bow = {
      {{1, 1, 1}, {1.1, 1, 1}, {1.2, 1, 1}, {1.2, 1.1, 1}, {1.1, 1.1, 1}}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}, {}};
  EXPECT_EQ(create_body(scene(), bow, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SELF_CONTACTS, {}, &body, 0.2), DSW_STATUS_OK);
}

TEST_F(ThickBodyTest, ARadiusIsCheckedAsAnArgument) {
  const dsw_body_id body = make(ball(1.5, 1.5, 1.5), 0);
  for (const double wrong : {-1.0, -0x1p-1074, HUGE_VAL, double{NAN}}) {
    EXPECT_NE(dsw_body_set_radius(scene(), body, wrong), DSW_STATUS_OK) << wrong;
    dsw_body_id none;
    EXPECT_NE(create_body(scene(), ball(1.5, 1.5, 1.5), DSW_LEVEL_EDGES, 0, {}, &none, wrong), DSW_STATUS_OK);
    double found = 7;
    EXPECT_NE(dsw_body_find_least_gap(scene(), body, wrong, &found), DSW_STATUS_OK);
    EXPECT_EQ(found, 7);
  }
  EXPECT_EQ(gap(body, 0.25), 0.25);
  EXPECT_NEAR(gap(body, 4), 1.5, 1e-9);
}

TEST_F(ThickBodyTest, RigidMovesKeepEveryDistance) {
  mark_wall(1, 1, 1);
  mark_edge(3, 3, 1);
  features(DSW_FEATURE_BODY_CONTACTS);
  ThickScene scene(scene_.get(), true);
  Rng rng(5);
  for (int i = 0; i < 100 && scene.bodies.size() < 8; ++i) {
    const Vec at = {rng.range(0.3, 3.5), rng.range(0.3, 3.5), rng.range(0.3, 2.5)};
    scene.create(i % 2 == 0 ? tetrahedron(at, 0.4) : segment(at, {at[0] + 0.3, at[1] + 0.3, at[2]}),
                 i % 2 == 0 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT, 0.02 * (1 + i % 4),
                 i % 3 == 0 ? DSW_BODY_RIGID : 0);
  }
  ASSERT_GE(scene.bodies.size(), 6u);
  int stopped = 0;
  for (int round = 0; round < effort_of(400) && !HasFailure(); ++round) {
    const size_t i = rng.below(scene.bodies.size());
    dsw_rigid_motion motion{};
    for (double& x : motion.rotation) x = rng.range(-0.2, 0.2);
    motion.rotation[3] = 1;
    for (size_t k = 0; k < 3; ++k) {
      motion.centre[k] = scene.bodies[i].state.at[0][k];
      motion.translation[k] = rng.range(-0.5, 0.5);
    }
    dsw_move_report report;
    ASSERT_EQ(dsw_body_move_rigid(scene.handle(), scene.bodies[i].id, &motion, nullptr, &report), DSW_STATUS_OK);
    stopped += report.fraction < 1 ? 1 : 0;
    scene.read(i);
    EXPECT_EQ(scene.too_near(i), "");
  }
  EXPECT_GT(stopped, effort_of(50));
}

/// A wire that meets itself, pulled about in a narrow box.
TEST_F(ThickBodyTest, AKnotKeepsItsRadius) {
  features(DSW_FEATURE_BODY_CONTACTS);
  ThickScene scene(scene_.get(), true);
  BodyPlan plan;
  for (uint32_t v = 0; v < 16; ++v) {
    plan.at.push_back({0.5 + 0.19 * v, 1.5 + 0.3 * (v % 2), 1.5});
    if (v > 0) plan.edges.push_back({v - 1, v});
  }
  ASSERT_EQ(scene.create(plan, DSW_LEVEL_EDGES_SWEPT, 0.06, DSW_BODY_SELF_CONTACTS), DSW_STATUS_OK);
  Meeting self{scene.bodies[0].id, DSW_LEVEL_EDGES_SWEPT, true, 3, {}};
  Rng rng(11);
  size_t contacts = 0;
  for (int round = 0; round < effort_of(400) && !HasFailure(); ++round) {
    dsw_move_options options = defaults(dsw_move_options_init);
    if (round % 2 == 1) options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
    std::vector<Vec> targets = scene.bodies[0].state.at;
    const Vec to = {rng.range(1.2, 2.8), rng.range(1.2, 2.8), rng.range(0.8, 2.2)};
    for (Vec& p : targets) p = between(p, to, rng.range(-0.1, 0.3));
    contacts += move(scene.bodies[0].id, targets, &options).contacts.size();
    scene.read(0);
    EXPECT_EQ(scene.too_near(0), "") << round;
    self.state = scene.bodies[0].state;
    EXPECT_TRUE(are_apart(self, self)) << round;
  }
  EXPECT_GT(contacts, static_cast<size_t>(effort_of(200)));
}

/// Every allocation is refused once; nothing has changed then.
TEST_F(ThickBodyTest, RunningOutOfMemoryChangesNothing) {
  mark_wall(1, 1, 1);
  mark_edge(2, 2, 1);
  features(DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING);
  dsw_body_id bodies[3];
  const BodyPlan plans[3] = {tetrahedron({0.4, 1.4, 1.4}, 0.4),
                             segment({1.5, 2.5, 1.2}, {1.5, 3.4, 1.8}),
                             {{{3.2, 0.5, 0.5}, {3.2, 1, 0.5}, {3.2, 1.5, 0.5}, {3.5, 1.5, 0.5}, {3.5, 0.7, 0.5}},
                              {{0, 1}, {1, 2}, {2, 3}, {3, 4}},
                              {}}};
  const auto state = [&](size_t count) {
    std::string text;
    for (size_t i = 0; i < count; ++i) {
      double radius = 0;
      EXPECT_EQ(dsw_body_get_radius(scene(), bodies[i], &radius), DSW_STATUS_OK);
      text += bits_of(read(bodies[i])) + number(radius);
    }
    return text;
  };
  for (size_t i = 0; i < 3; ++i) {
    const std::string before = state(i);
    until_it_succeeds(
        [&] {
          return create_body(scene(), plans[i], i == 0 ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT,
                             i == 2 ? DSW_BODY_SELF_CONTACTS : 0, {}, &bodies[i], 0.05);
        },
        [&] { return body_count() == i && state(i) == before; });
  }
  std::string before = state(3);
  for (const dsw_body_id body : bodies) {
    until_it_succeeds([&] { return dsw_body_set_radius(scene(), body, 0.0625); }, [&] { return state(3) == before; });
    before = state(3);
    double found = 5;
    until_it_succeeds([&] { return dsw_body_find_least_gap(scene(), body, 1, &found); },
                      [&] { return found == 5 && state(3) == before; });
    EXPECT_NE(found, 5);
  }
  for (int response = 0; response < 6; ++response) {
    dsw_move_options options = defaults(dsw_move_options_init);
    options.edge_response = static_cast<dsw_response>(response);
    options.vertex_response = response % 2 == 0 ? DSW_RESPONSE_SLIDE : DSW_RESPONSE_STOP;
    std::vector<Vec> targets;
    for (const dsw_body_id body : bodies) {
      for (Vec p : read(body).at) targets.push_back({p[0] + (response % 2 == 0 ? 1.5 : -1.5), p[1] + 0.4, p[2] + 0.1});
    }
    before = state(3);
    until_it_succeeds(
        [&] {
          return dsw_scene_move_bodies(scene(), bodies, 3, targets[0].data(), targets.size(), sizeof(Vec), &options,
                                       nullptr);
        },
        [&] { return state(3) == before; });
  }
  dsw_rigid_motion motion{};
  motion.rotation[3] = 1;
  motion.translation[0] = 3;
  before = state(3);
  until_it_succeeds([&] { return dsw_body_move_rigid(scene(), bodies[0], &motion, nullptr, nullptr); },
                    [&] { return state(3) == before; });
  const dsw_face_id face = face_between(2, 2, 2);
  before = state(3);
  dsw_status marked = DSW_STATUS_OUT_OF_MEMORY;
  for (size_t refusal = 1; marked == DSW_STATUS_OUT_OF_MEMORY && refusal < 200; ++refusal) {
    memory_.refuse = memory_.calls + refusal;
    marked = dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE);
    memory_.refuse = 0;
    EXPECT_EQ(state(3), before);
  }
  EXPECT_EQ(marked, DSW_STATUS_OK);
  std::vector<std::vector<double>> lent;
  for (const int method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.method = static_cast<dsw_deform_method>(method);
    const double* points = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_environment_get_points(place_.get(), &points, &count), DSW_STATUS_OK);
    lent.emplace_back(points, points + 3 * count);
    for (size_t i = 0; i < count; ++i) lent.back()[3 * i] += 0.1 * std::sin(2 * lent.back()[3 * i + 1]);
    before = state(3);
    until_it_succeeds(
        [&] { return dsw_environment_deform(place_.get(), lent.back().data(), count, &options, nullptr); },
        [&] { return state(3) == before; });
  }
  scene_.reset();
  place_.environment.reset();  // before the points that it reads
}

/// Many thick bodies in space, see Crowd.
std::string thick_answers(dsw_context* context, bool together) {
  const Place place = place_of(hex_grid(axis(8, 1), axis(8, 1), axis(8, 1)), 0, context);
  Crowd crowd(place.get(), 3, DSW_LEVEL_FACES, 0.0625);
  return crowd.answers(60, 6, together, [](Rng& rng, size_t i) {
    const Vec at = {rng.range(0.1, 7), rng.range(0.1, 7), rng.range(0.1, 7)};
    return i % 3 == 0 ? segment(at, {at[0] + 0.7, at[1] + 0.3, at[2] + 0.5}) : tetrahedron(at, 0.6);
  });
}

TEST(ThickThreadsTest, TheSameBitsForAnyNumberOfThreads) { check_threads(thick_answers); }

}  // namespace
}  // namespace dsw::oracle
