// Two bodies in easy places: filters, levels, touching, responses, rigid moves, edits, walls, memory, threads.
#include "deform_support.h"
#include "host_memory.h"
#include "pairs_crowd.h"

namespace dsw::oracle {
namespace {

constexpr Vec kLow = {0.5, 1.5, 1.5}, kHigh = {3.5, 1.5, 1.5};

class TwoBodiesTest : public MemoryTest {
 protected:
  void SetUp() override {
    MemoryTest::SetUp();
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_STATISTICS);
  }
  BodyAnswer move(dsw_body_id body, const std::vector<Vec>& targets, const dsw_move_options* options = nullptr) {
    BodyAnswer answer;
    EXPECT_EQ(move_body(scene(), body, targets, options, answer), "");
    return answer;
  }
  dsw_contact_partner partner(dsw_body_id body, size_t i = 0) {
    const dsw_contact_partner* partners = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contact_partners(scene(), body, &partners, &count), DSW_STATUS_OK);
    return i < count ? partners[i] : dsw_contact_partner{};
  }
  dsw_status create(const BodyPlan& plan, dsw_level level = DSW_LEVEL_FACES, uint32_t flags = 0) {
    dsw_body_id body;
    return create_body(scene(), plan, level, flags, {}, &body);
  }
  /// A square of two triangles across the first axis.
  static BodyPlan wall(double x) { return {{{x, 1, 1}, {x, 2, 1}, {x, 2, 2}, {x, 1, 2}}, {}, {{0, 1, 2}, {0, 2, 3}}}; }
  static std::vector<Vec> shifted(const BodyPlan& plan, double x) {
    std::vector<Vec> to = plan.at;
    for (Vec& p : to) p[0] += x;
    return to;
  }
};

TEST_F(TwoBodiesTest, AVertexStopsAtAFaceAndSaysWhose) {
  const dsw_body_id square = make(wall(2), DSW_LEVEL_FACES);
  const dsw_body_id wire = make(segment(kLow, {0.5, 1.5, 1.75}), DSW_LEVEL_EDGES_SWEPT);
  const BodyAnswer answer = move(wire, {{2.5, 1.5, 1.5}, {0.5, 1.5, 1.75}});
  ASSERT_EQ(answer.contacts.size(), 1u);
  const dsw_contact& c = answer.contacts[0];
  EXPECT_EQ(c.kind, DSW_CONTACT_PLANE);
  EXPECT_EQ(c.time, 0.75);
  EXPECT_TRUE(c.normal[0] == -1 && c.normal[1] == 0 && c.normal[2] == 0);
  EXPECT_TRUE(c.point[0] == 2 && c.point[1] == 1.5);
  EXPECT_TRUE(c.cause == DSW_CELL_NONE && c.obstacle.kind == DSW_CELL_NONE && c.wall.generation == 0);
  EXPECT_EQ(c.history, DSW_HISTORY_NEW);
  EXPECT_TRUE(partner(wire).body.index == square.index && partner(wire).face.generation == 1);
  EXPECT_LT(answer.after.at[0][0], 2);
  EXPECT_GT(answer.after.at[0][0], 1.999);
  EXPECT_EQ(move(wire, {{2.5, 1.5, 1.5}, {0.5, 1.5, 1.75}}).contacts[0].history, DSW_HISTORY_LASTING);
  dsw_contact_opinion opinion;
  EXPECT_EQ(dsw_contact_check(place_.get(), &c, &opinion), DSW_STATUS_UNSUPPORTED);
}

TEST_F(TwoBodiesTest, WallsAndBodiesCompeteByTime) {
  for (const bool body_first : {true, false}) {
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS);
    make(wall(body_first ? 1.75 : 2.25), DSW_LEVEL_FACES);
    const dsw_body_id point = make({{kLow}, {}, {}}, DSW_LEVEL_POINTS);
    const dsw_face_id face = face_between(1, 1, 1);
    ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    const BodyAnswer answer = move(point, {kHigh});
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_EQ(answer.contacts[0].point[0], body_first ? 1.75 : 2);
    EXPECT_EQ(partner(point).body.generation, body_first ? 1u : 0u);
    EXPECT_EQ(answer.contacts[0].cause, body_first ? DSW_CELL_NONE : DSW_CELL_FACE);
    ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_PASSABLE), DSW_STATUS_OK);
  }
}

TEST_F(TwoBodiesTest, ABodyThatMeetsItselfTouchesItselfAtNoLevel) {
  BodyPlan cross;
  cross.at = {{1.25, 1.5, 1.5}, {1.75, 1.5, 1.5}, {1.5, 1.25, 1.5}, {1.5, 1.75, 1.5}};
  cross.edges = {{0, 1}, {2, 3}};
  EXPECT_EQ(create(cross, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS), DSW_STATUS_OCCUPIED);
  const dsw_body_id body = make(cross, DSW_LEVEL_POINTS, DSW_BODY_SELF_CONTACTS);
  EXPECT_EQ(dsw_body_set_level(scene(), body, DSW_LEVEL_EDGES), DSW_STATUS_OCCUPIED);
  // The ends of an edge do not meet either, so it can go, or count no more.
  const BodyPlan edge = segment({2.25, 1.5, 1.5}, {2.75, 1.5, 1.5});
  const dsw_body_id wire = make(edge, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS);
  const BodyAnswer answer = move(wire, {{2.75, 1.5, 1.5}, {2.75, 1.5, 1.5}});
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].time, 1);
  EXPECT_EQ(answer.contacts[0].normal[0], -1);
  EXPECT_EQ(partner(wire).vertex.index, 1u);
  EXPECT_LT(answer.after.at[0][0], 2.75);
  EXPECT_EQ(create(segment({3.5, 1.5, 1.5}, {3.5, 1.5, 1.5}), DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS),
            DSW_STATUS_OCCUPIED);
  EXPECT_EQ(dsw_body_set_level(scene(), wire, DSW_LEVEL_POINTS), DSW_STATUS_OK);
  EXPECT_EQ(dsw_body_remove_edge(scene(), wire, {0, 1}), DSW_STATUS_OK);
}

TEST_F(TwoBodiesTest, WallsThatMovePushNoBodyIntoAnother) {
  size_t pushed = 0;
  for (const dsw_deform_method method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    scene_.reset();
    place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)), 0, context_.get());
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING);
    mark_wall(0, 1, 1);
    mark_wall(2, 1, 1);
    std::vector<Meeting> bodies(3);
    const BodyPlan plans[3] = {tetrahedron({1.125, 1.25, 1.25}, 0.5), wall(1.75),
                               segment({2.25, 1.25, 1.25}, {2.5, 1.75, 1.75})};
    for (size_t i = 0; i < 3; ++i) bodies[i].id = make(plans[i], DSW_LEVEL_FACES);
    std::vector<std::vector<double>> arrays;  // all lent
    Rng rng(9);
    for (int step = 0; step < 12; ++step) {
      arrays.push_back(points_of(place_.get()));
      // The walls close in on what is between them.
      for (size_t i = 0; i < arrays.back().size(); i += 3) {
        double& x = arrays.back()[i];
        if (x > 0.5 && x < 3.5) x += (x < 2 ? 1 : -1) * rng.range(0, 0.12);
      }
      dsw_deform_options options;
      dsw_deform_options_init(&options, sizeof options);
      options.method = method;
      options.response = DSW_WALL_PUSH;
      dsw_deform_report report;
      ASSERT_EQ(dsw_scene_deform(scene(), arrays.back().data(), arrays.back().size() / 3, &options, &report),
                DSW_STATUS_OK);
      pushed += report.pushed_count;
      for (Meeting& body : bodies) body.state = read(body.id);
      for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < i; ++j) ASSERT_TRUE(are_apart(bodies[i], bodies[j])) << step << " " << i << " " << j;
      }
    }
    scene_.reset();
    place_.environment.reset();  // before what it reads
  }
  EXPECT_GT(pushed, 5u);
}

TEST_F(TwoBodiesTest, LevelsSayWhatMeets) {
  // Through the inside of the square: its edges alone are not there.
  for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    const dsw_body_id square = make(wall(2), level);
    const dsw_body_id point = make({{{0.5, 1.25, 1.5}}, {}, {}}, DSW_LEVEL_POINTS);
    EXPECT_EQ(move(point, {{2.5, 1.25, 1.5}}).contacts.size(), level == DSW_LEVEL_FACES ? 1u : 0u) << level;
    ASSERT_EQ(dsw_body_destroy(scene(), square), DSW_STATUS_OK);
    ASSERT_EQ(dsw_body_destroy(scene(), point), DSW_STATUS_OK);
  }
}

TEST_F(TwoBodiesTest, TouchingIsRefusedWhereABodyIsMade) {
  make(wall(2), DSW_LEVEL_FACES);
  EXPECT_EQ(create({{{2, 1.5, 1.25}}, {}, {}}), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(segment({1, 2, 2}, {3, 2, 2})), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(create(segment({1, 2, 2.5}, {3, 2, 2.5})), DSW_STATUS_OK);
  const uint32_t* pairs = nullptr;
  size_t count = 0;
  ASSERT_EQ(create(segment({1, 1.5, 1.25}, {3, 1.5, 1.25})), DSW_STATUS_OCCUPIED);
  ASSERT_EQ(dsw_scene_get_offending_edges(scene(), &pairs, &count), DSW_STATUS_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(body_count(), 2u);
  // A level that does not cover what touches.
  EXPECT_EQ(create(segment({1, 1.5, 1.25}, {3, 1.5, 1.25}), DSW_LEVEL_POINTS), DSW_STATUS_OK);
}

TEST_F(TwoBodiesTest, RaisingALevelAndJoiningLookAtOthers) {
  make(wall(2), DSW_LEVEL_FACES);
  const dsw_body_id wire = make(segment({1, 1.5, 1.25}, {3, 1.5, 1.25}), DSW_LEVEL_POINTS);
  EXPECT_EQ(dsw_body_set_level(scene(), wire, DSW_LEVEL_EDGES), DSW_STATUS_OCCUPIED);
  const dsw_body_id two = make({{{1, 1.75, 1.25}, {3, 1.75, 1.25}}, {}, {}}, DSW_LEVEL_EDGES);
  const std::string before = bits_of(read(two));
  dsw_body_edge_id edge;
  EXPECT_EQ(dsw_body_add_edge(scene(), two, read(two).vertices[0], read(two).vertices[1], &edge), DSW_STATUS_OCCUPIED);
  dsw_body_vertex_id vertex;
  const double on[3] = {2, 1.75, 1.5};
  EXPECT_EQ(dsw_body_add_vertex(scene(), two, on, {0, 0}, &vertex), DSW_STATUS_OCCUPIED);
  EXPECT_EQ(bits_of(read(two)), before);
}

TEST_F(TwoBodiesTest, FiltersKeepBodiesApart) {
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  const BodyPlan plan = wall(2);
  const dsw_body_id square = make(plan, DSW_LEVEL_FACES);
  const double at[6] = {1, 1.5, 1.25, 3, 1.5, 1.25};
  const uint32_t ends[2] = {0, 1};
  desc.positions = at;
  desc.vertex_count = 2;
  desc.edges = ends;
  desc.edge_count = 1;
  desc.mask = 0x2;  // the square is in 0x1
  dsw_body_id wire;
  ASSERT_EQ(dsw_body_create(scene(), &desc, &wire), DSW_STATUS_OK);
  EXPECT_EQ(move(wire, {{3, 1.5, 1.25}, {1, 1.5, 1.75}}).contacts.size(), 0u);
  EXPECT_EQ(dsw_body_set_filter(scene(), square, 0x2, 0), DSW_STATUS_OCCUPIED);
  uint32_t category = 0, mask = 0;
  ASSERT_EQ(dsw_body_get_filter(scene(), square, &category, &mask), DSW_STATUS_OK);
  EXPECT_TRUE(category == 1 && mask == 0xffffffffu);
  EXPECT_EQ(move(wire, {{3, 1.5, 1.25}, {2.5, 1.5, 1.75}}).contacts.size(), 0u);
  EXPECT_EQ(dsw_body_set_filter(scene(), square, 0x2, 0), DSW_STATUS_OK);
  EXPECT_EQ(move(wire, {{1, 1.5, 1.25}, {2.5, 1.5, 1.75}}).contacts.size(), 1u);
}

TEST_F(TwoBodiesTest, WhatIsNotNamedIsRefused) {
  scene_ = make_scene(place_.get());
  const dsw_body_id body = make(wall(2), DSW_LEVEL_FACES);
  const dsw_contact_partner* partners = nullptr;
  size_t count = 0;
  uint32_t bits = 0;
  EXPECT_EQ(dsw_body_get_contact_partners(scene(), body, &partners, &count), DSW_STATUS_NOT_NAMED);
  EXPECT_EQ(dsw_body_get_filter(scene(), body, &bits, &bits), DSW_STATUS_NOT_NAMED);
  EXPECT_EQ(dsw_body_set_filter(scene(), body, 1, 1), DSW_STATUS_NOT_NAMED);
  EXPECT_EQ(create(wall(2), DSW_LEVEL_FACES, DSW_BODY_SELF_CONTACTS), DSW_STATUS_NOT_NAMED);
  EXPECT_EQ(create(wall(2)), DSW_STATUS_OK);  // one in the other
}

TEST_F(TwoBodiesTest, ARigidMoveStopsBeforeTheOther) {
  make(wall(2), DSW_LEVEL_FACES);
  const dsw_body_id body = make(tetrahedron({0.5, 1.25, 1.25}, 0.5), DSW_LEVEL_FACES);
  dsw_rigid_motion motion;
  std::memset(&motion, 0, sizeof motion);
  motion.rotation[3] = 1;
  motion.translation[0] = 2;
  dsw_move_report report;
  const std::string before = bits_of(read(body));
  until_it_succeeds([&] { return dsw_body_move_rigid(scene(), body, &motion, nullptr, &report); },
                    [&] { return bits_of(read(body)) == before; });
  EXPECT_EQ(report.fraction, 0.25);
  EXPECT_EQ(report.contact_count, 1u);
  EXPECT_NE(partner(body).body.generation, 0u);
}

TEST_F(TwoBodiesTest, ResponsesWorkOnBodies) {
  make(wall(2), DSW_LEVEL_FACES);
  const dsw_body_id wire = make(segment({0.5, 1.25, 1.25}, {0.5, 1.25, 0.5}));
  dsw_move_options options = default_options();
  options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
  BodyAnswer answer = move(wire, {{2.5, 1.75, 1.25}, {0.5, 1.25, 0.5}}, &options);
  ASSERT_GE(answer.contacts.size(), 1u);
  EXPECT_LT(answer.after.at[0][0], 2);
  EXPECT_GT(answer.after.at[0][0], 1.99);
  EXPECT_GT(answer.after.at[0][1], 1.74);
  // An edge that gets a vertex where another one is in its way.
  make(segment({2.5, 2.5, 0.5}, {2.5, 2.5, 2.5}));
  const Vec from = {2, 2.25, 1.5}, fixed = {3, 3, 1.5}, to = {3, 2.25, 1.5};
  const dsw_body_id edge = make(segment(from, fixed));
  options.edge_response = DSW_RESPONSE_ADAPTIVE_ONE;
  answer = move(edge, {to, fixed}, &options);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].kind, DSW_CONTACT_EDGE);
  EXPECT_EQ(answer.report.edit_count, 1u);
  EXPECT_EQ(answer.after.at[0], to);
}

TEST_F(TwoBodiesTest, ABodyThatMeetsItselfKeepsItsVertices) {
  const dsw_body_id square = make(wall(2), DSW_LEVEL_FACES, DSW_BODY_SELF_CONTACTS);
  const BodyState state = read(square);
  EXPECT_EQ(dsw_body_split_edge(scene(), square, state.edge_ids[0], 0.5, nullptr), DSW_STATUS_UNSUPPORTED);
  EXPECT_EQ(dsw_body_collapse_edge(scene(), square, state.edge_ids[0], state.vertices[state.edges[0][0]], nullptr),
            DSW_STATUS_UNSUPPORTED);
  // One corner goes over an edge that it is no end of.
  EXPECT_EQ(move(square, {{2, 2.25, 1.5}, state.at[1], state.at[2], state.at[3]}).contacts.size(), 1u);
  EXPECT_EQ(create({{{2.5, 1, 1}, {3.5, 2, 1}, {3.5, 1, 1}, {2.5, 2, 1}}, {{0, 1}, {1, 2}, {2, 3}}, {}},
                   DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS),
            DSW_STATUS_OCCUPIED);
}

TEST_F(TwoBodiesTest, MemoryThatRunsOutLeavesAllAsItWas) {
  const BodyPlan left = wall(1), right = wall(3), middle = tetrahedron({1.75, 1.25, 1.25}, 0.5);
  dsw_body_id bodies[3] = {};
  const BodyPlan* const plans[3] = {&left, &right, &middle};
  for (int i = 0; i < 3; ++i) {
    until_it_succeeds(
        [&] {
          return create_body(scene(), *plans[i], DSW_LEVEL_FACES, i == 2 ? DSW_BODY_SELF_CONTACTS : 0, {}, &bodies[i]);
        },
        [&] { return body_count() == static_cast<size_t>(i); });
  }
  const auto state = [&] {
    std::string text;
    for (dsw_body_id b : bodies) text += bits_of(read(b));
    return text;
  };
  std::string before = state();
  dsw_move_options options = default_options();
  options.edge_response = DSW_RESPONSE_HYBRID;
  options.vertex_response = DSW_RESPONSE_SLIDE;
  std::vector<double> targets;
  for (int i = 0; i < 3; ++i) {
    for (const Vec& p : shifted(*plans[i], i == 0 ? 2 : i == 1 ? -2 : 0.125))
      targets.insert(targets.end(), p.begin(), p.end());
  }
  until_it_succeeds(
      [&] {
        return dsw_scene_move_bodies(scene(), bodies, 3, targets.data(), targets.size() / 3, 0, &options, nullptr);
      },
      [&] { return state() == before; });
  EXPECT_NE(state(), before);
  before = state();
  until_it_succeeds([&] { return dsw_body_set_filter(scene(), bodies[0], 2, 2); }, [&] { return state() == before; });
  until_it_succeeds([&] { return dsw_body_set_filter(scene(), bodies[0], 1, 0); }, [&] { return state() == before; });
}

/// Many bodies in space, see Crowd.
std::string space_answers(dsw_context* context, bool together) {
  const Place place = place_of(hex_grid(axis(8, 1), axis(8, 1), axis(8, 1)), 0, context);
  Crowd crowd(place.get(), 3, DSW_LEVEL_FACES);
  return crowd.answers(60, 6, together, [](Rng& rng, size_t i) {
    const Vec at = {rng.range(0.1, 7), rng.range(0.1, 7), rng.range(0.1, 7)};
    return i % 3 == 0 ? segment(at, {at[0] + 0.7, at[1] + 0.3, at[2] + 0.5}) : tetrahedron(at, 0.6);
  });
}

TEST(PairsThreadsTest, TheSameBitsForAnyNumberOfThreads) { check_threads(space_answers); }

}  // namespace
}  // namespace dsw::oracle
