// Two bodies in easy places: filters, levels, touching, responses, rigid moves, edits, walls, memory, threads.
#include "two_bodies.h"
#include "deform_support.h"

namespace dsw::oracle {
namespace {

constexpr Vec kLow = {0.5, 1.5, 1.5}, kHigh = {3.5, 1.5, 1.5};

class TwoBodiesTest : public TwoBodies {
 protected:
  TwoBodiesTest() : TwoBodies(DSW_LEVEL_FACES) {}
  void SetUp() override {
    MemoryTest::SetUp();
    scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_STATISTICS);
  }
  /// A square of two triangles across the first axis.
  static BodyPlan wall(double x) { return {{{x, 1, 1}, {x, 2, 1}, {x, 2, 2}, {x, 1, 2}}, {}, {{0, 1, 2}, {0, 2, 3}}}; }
};

TEST_F(TwoBodiesTest, AVertexStopsAtAFaceAndSaysWhose) {
  const dsw_body_id square = make(wall(2), DSW_LEVEL_FACES);
  const dsw_body_id polyline = make(segment(kLow, {0.5, 1.5, 1.75}), DSW_LEVEL_EDGES_SWEPT);
  const BodyAnswer answer = move(polyline, {{2.5, 1.5, 1.5}, {0.5, 1.5, 1.75}});
  ASSERT_EQ(answer.contacts.size(), 1u);
  const dsw_body_contact& c = answer.contacts[0];
  EXPECT_EQ(c.contact.kind, DSW_CONTACT_PLANE);
  EXPECT_EQ(c.time, 0.75);
  EXPECT_TRUE(c.contact.normal[0] == -1 && c.contact.normal[1] == 0 && c.contact.normal[2] == 0);
  EXPECT_TRUE(c.point[0] == 2 && c.point[1] == 1.5);
  EXPECT_TRUE(c.contact.marked_kind == DSW_CELL_NONE && c.contact.obstacle.kind == DSW_CELL_NONE &&
              c.contact.wall.generation == 0);
  EXPECT_EQ(c.history, DSW_HISTORY_NEW);
  EXPECT_TRUE(partner(polyline).body.index == square.index && partner(polyline).face.generation == 1);
  EXPECT_LT(answer.after.at[0][0], 2);
  EXPECT_GT(answer.after.at[0][0], 1.999);
  EXPECT_EQ(move(polyline, {{2.5, 1.5, 1.5}, {0.5, 1.5, 1.75}}).contacts[0].history, DSW_HISTORY_LASTING);
  dsw_cross_check check;
  EXPECT_EQ(dsw_environment_cross_check(place_.get(), &c, &check), DSW_STATUS_UNSUPPORTED);
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
    EXPECT_EQ(answer.contacts[0].contact.marked_kind, body_first ? DSW_CELL_NONE : DSW_CELL_FACE);
    ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_PASSABLE), DSW_STATUS_OK);
  }
}

// Both ends move alike, so the edge is left out. With one end gone ahead it meets a wall before that end meets the body.
TEST_F(TwoBodiesTest, AWallComesFirstWhereItsEdgeWasLeftOut) {
  const dsw_face_id face = face_between(1, 1, 1);
  ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  make({{{2.6, 1.935, 1.2}, {3.3, 1.935, 1.2}, {2.95, 1.935, 1.9}}, {}, {{0, 1, 2}}}, DSW_LEVEL_FACES);
  for (const uint32_t flags : {0u, static_cast<uint32_t>(DSW_BODY_SKIP_SIMILAR_MOTION)}) {
    const dsw_body_id body = make(segment({2.95, 0.9, 1.5}, {1.05, 0.9, 1.5}), DSW_LEVEL_EDGES, flags);
    const BodyAnswer answer = move(body, {{2.95, 2.05, 1.5}, {1.05, 2.05, 1.5}});
    ASSERT_GE(answer.contacts.size(), 1u);
    EXPECT_EQ(answer.contacts[0].contact.marked_kind, DSW_CELL_FACE) << flags;
    EXPECT_EQ(partner(body).body.generation, 0u) << flags;
    EXPECT_NEAR(answer.contacts[0].time, 0.1 / 0.575, 1e-12);
    ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
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
  const dsw_body_id polyline = make(edge, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS);
  const BodyAnswer answer = move(polyline, {{2.75, 1.5, 1.5}, {2.75, 1.5, 1.5}});
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].time, 1);
  EXPECT_EQ(answer.contacts[0].contact.normal[0], -1);
  EXPECT_EQ(partner(polyline).vertex.index, 1u);
  EXPECT_LT(answer.after.at[0][0], 2.75);
  EXPECT_EQ(create(segment({3.5, 1.5, 1.5}, {3.5, 1.5, 1.5}), DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS),
            DSW_STATUS_OCCUPIED);
  EXPECT_EQ(dsw_body_set_level(scene(), polyline, DSW_LEVEL_POINTS), DSW_STATUS_OK);
  EXPECT_EQ(dsw_body_remove_edge(scene(), polyline, {0, 1}), DSW_STATUS_OK);
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
    for (int step = 0; step < at_least(12); ++step) {
      arrays.push_back(points_of(place_.get()));
      // The walls close in on what is between them.
      for (size_t i = 0; i < arrays.back().size(); i += 3) {
        double& x = arrays.back()[i];
        if (x > 0.5 && x < 3.5) x += (x < 2 ? 1 : -1) * rng.range(0, 0.12);
      }
      dsw_deform_options options = defaults(dsw_deform_options_init);
      options.method = method;
      options.response = DSW_WALL_PUSH;
      dsw_deform_report report;
      ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene()), arrays.back().data(),
                                       arrays.back().size() / 3, &options, &report),
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
  const dsw_body_id polyline = make(segment({1, 1.5, 1.25}, {3, 1.5, 1.25}), DSW_LEVEL_POINTS);
  EXPECT_EQ(dsw_body_set_level(scene(), polyline, DSW_LEVEL_EDGES), DSW_STATUS_OCCUPIED);
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
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  const BodyPlan plan = wall(2);
  const dsw_body_id square = make(plan, DSW_LEVEL_FACES);
  const double at[6] = {1, 1.5, 1.25, 3, 1.5, 1.25};
  const uint32_t ends[2] = {0, 1};
  desc.positions = at;
  desc.vertex_count = 2;
  desc.edges = ends;
  desc.edge_count = 1;
  desc.mask = 0x2;  // the square is in 0x1
  dsw_body_id polyline;
  ASSERT_EQ(dsw_body_create(scene(), &desc, &polyline), DSW_STATUS_OK);
  EXPECT_EQ(move(polyline, {{3, 1.5, 1.25}, {1, 1.5, 1.75}}).contacts.size(), 0u);
  EXPECT_EQ(dsw_body_set_filter(scene(), square, 0x2, 0), DSW_STATUS_OCCUPIED);
  uint32_t category = 0, mask = 0;
  ASSERT_EQ(dsw_body_get_filter(scene(), square, &category, &mask), DSW_STATUS_OK);
  EXPECT_TRUE(category == 1 && mask == 0xffffffffu);
  EXPECT_EQ(move(polyline, {{3, 1.5, 1.25}, {2.5, 1.5, 1.75}}).contacts.size(), 0u);
  EXPECT_EQ(dsw_body_set_filter(scene(), square, 0x2, 0), DSW_STATUS_OK);
  EXPECT_EQ(move(polyline, {{1, 1.5, 1.25}, {2.5, 1.5, 1.75}}).contacts.size(), 1u);
}

TEST_F(TwoBodiesTest, WhatIsNotEnabledIsRefused) {
  scene_ = make_scene(place_.get());
  const dsw_body_id body = make(wall(2), DSW_LEVEL_FACES);
  const dsw_contact_partner* partners = nullptr;
  size_t count = 0;
  uint32_t bits = 0;
  EXPECT_EQ(dsw_body_get_contact_partners(scene(), body, &partners, &count), DSW_STATUS_NOT_ENABLED);
  EXPECT_EQ(dsw_body_get_filter(scene(), body, &bits, &bits), DSW_STATUS_NOT_ENABLED);
  EXPECT_EQ(dsw_body_set_filter(scene(), body, 1, 1), DSW_STATUS_NOT_ENABLED);
  EXPECT_EQ(create(wall(2), DSW_LEVEL_FACES, DSW_BODY_SELF_CONTACTS), DSW_STATUS_NOT_ENABLED);
  EXPECT_EQ(create(wall(2)), DSW_STATUS_OK);  // one in the other
}

TEST_F(TwoBodiesTest, ARigidMoveStopsBeforeTheOther) {
  EXPECT_EQ(stop_rigidly(wall(2), tetrahedron({0.5, 1.25, 1.25}, 0.5)).contact_count, 1u);
}

TEST_F(TwoBodiesTest, ResponsesWorkOnBodies) {
  make(wall(2), DSW_LEVEL_FACES);
  const dsw_body_id polyline = make(segment({0.5, 1.25, 1.25}, {0.5, 1.25, 0.5}));
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = options.edge_response = DSW_RESPONSE_SLIDE;
  BodyAnswer answer = move(polyline, {{2.5, 1.75, 1.25}, {0.5, 1.25, 0.5}}, &options);
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
  EXPECT_EQ(answer.contacts[0].contact.kind, DSW_CONTACT_EDGE);
  EXPECT_EQ(answer.report.edit_count, 1u);
  EXPECT_EQ(answer.after.at[0], to);
}

TEST_F(TwoBodiesTest, HalvingStopsBeforeAnotherBody) {
  const dsw_body_id square = make(wall(2), DSW_LEVEL_FACES);
  const BodyPlan plan = segment({0.5, 1.25, 1.25}, {0.5, 1.25, 0.5});
  const std::vector<Vec> to = {{2.5, 1.75, 1.25}, {0.5, 1.25, 0.5}};
  dsw_move_options options = defaults(dsw_move_options_init);
  options.stand_off = -1;
  const dsw_body_id twin = make(plan);
  const BodyAnswer exact = move(twin, to, &options);
  ASSERT_EQ(dsw_body_destroy(scene(), twin), DSW_STATUS_OK);
  options.search = DSW_SEARCH_BISECTION;
  options.bisection_depth = 20;
  const dsw_body_id polyline = make(plan);
  const BodyAnswer halved = move(polyline, to, &options);
  ASSERT_EQ(exact.contacts.size(), 1u);
  ASSERT_EQ(halved.contacts.size(), 1u);
  const double late = exact.contacts[0].time - halved.contacts[0].time;
  EXPECT_TRUE(late >= 0 && late <= 0x1p-20) << late;
  EXPECT_EQ(partner(polyline).body.index, square.index);
  EXPECT_EQ(halved.contacts[0].contact.obstacle.kind, DSW_CELL_NONE);
  EXPECT_EQ(halved.after.at[0][0], halved.contacts[0].position[0]);
  EXPECT_EQ(halved.contacts[0].to[0], 2.5);
}

TEST_F(TwoBodiesTest, ABodyThatMeetsItselfIsSplitAndMerged) {
  const dsw_body_id square = make(wall(2), DSW_LEVEL_FACES, DSW_BODY_SELF_CONTACTS);
  const BodyState state = read(square);
  for (size_t e = 0; e < state.edges.size(); ++e) {
    dsw_body_edit edit;
    ASSERT_EQ(dsw_body_split_edge(scene(), square, state.edge_ids[e], 0.5, &edit), DSW_STATUS_OK);
    const size_t faces = read(square).faces.size();
    EXPECT_EQ(faces, state.edges[e][0] + state.edges[e][1] == 2 ? 4u : 3u) << "the diagonal has two faces";
    ASSERT_EQ(dsw_body_collapse_edge(scene(), square, edit.rest, edit.vertex, nullptr), DSW_STATUS_OK);
    EXPECT_EQ(read(square).faces.size(), state.faces.size());
  }
  // One corner goes over an edge that it is no end of.
  std::vector<Vec> targets = read(square).at;
  targets[0] = {2, 2.25, 1.5};
  EXPECT_EQ(move(square, targets).contacts.size(), 1u);
  EXPECT_EQ(create({{{2.5, 1, 1}, {3.5, 2, 1}, {3.5, 1, 1}, {2.5, 2, 1}}, {{0, 1}, {1, 2}, {2, 3}}, {}},
                   DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS),
            DSW_STATUS_OCCUPIED);
}

TEST_F(TwoBodiesTest, AVertexIsNotMergedAcrossItsOwnBody) {
  // The middle vertex of a hook goes to the first one; the last one stays, and what lies between is in the way.
  const std::vector<Vec> hook = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.5, 1.5, 0.5}};
  const std::vector<std::vector<Vec>> more = {{}, {{0.75, 0.75, 0.5}}, {{0.75, 0.75, 0.25}, {0.75, 0.75, 0.75}}};
  for (const std::vector<Vec>& each : more) {
    BodyPlan plan{hook, {{0, 1}, {1, 2}}, {}};
    plan.at.insert(plan.at.end(), each.begin(), each.end());
    if (each.size() == 2) plan.edges.push_back({3, 4});
    const dsw_body_id body = make(plan, DSW_LEVEL_EDGES, DSW_BODY_SELF_CONTACTS);
    const BodyState state = read(body);
    EXPECT_EQ(dsw_body_collapse_edge(scene(), body, state.edge_ids[0], state.vertices[1], nullptr),
              each.empty() ? DSW_STATUS_OK : DSW_STATUS_OCCUPIED);
    ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  }
}

TEST_F(TwoBodiesTest, AWallBendsABodyThatMeetsItselfUpToItself) {
  scene_.reset();
  place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)), 0, context_.get());
  scene_ = make_scene(place_.get(), DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING);
  for (const uint32_t z : {0u, 1u}) {
    for (const uint32_t y : {1u, 2u}) mark_wall(1, y, z);
  }
  // A hairpin: its second leg crosses behind the first one, which a corner of the wall comes up to.
  Meeting polyline;
  polyline.level = DSW_LEVEL_EDGES_SWEPT;
  polyline.id = make({{{2.1, 1.2, 1.2}, {2.1, 2.8, 0.8}, {2.6, 3.2, 1}, {2.3, 2.8, 1.2}, {2.3, 1.2, 0.8}},
                      {{0, 1}, {1, 2}, {2, 3}, {3, 4}},
                      {}},
                     polyline.level, DSW_BODY_SELF_CONTACTS);
  std::vector<std::vector<double>> arrays;  // all lent
  size_t held = 0, inserted = 0;
  for (int step = 0; step < at_least(12); ++step) {
    arrays.push_back(points_of(place_.get()));
    arrays.back()[3 * point(2, 2, 1)] = 2 + 0.04 * (step + 1);
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.response = DSW_WALL_INSERT;
    dsw_deform_report report;
    ASSERT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene()), arrays.back().data(), arrays.back().size() / 3,
                                     &options, &report),
              DSW_STATUS_OK);
    held += report.outcome == DSW_DEFORM_HELD ? 1 : 0;
    polyline.state = read(polyline.id);
    ASSERT_TRUE(are_apart(polyline, polyline)) << step;
    inserted = polyline.state.at.size() - 5;
  }
  EXPECT_GE(inserted, 1u);
  EXPECT_GT(polyline.state.at[5][0], 2.2) << "pushed";
  EXPECT_GT(held, 0u);
  scene_.reset();
  place_.environment.reset();  // before what it reads
}

TEST_F(TwoBodiesTest, ABodyThatMeetsItselfBendsAndIsStraightAgain) {
  // One leg goes over the post that the other end of the body is, and back.
  Meeting polyline;
  polyline.level = DSW_LEVEL_EDGES_SWEPT;
  polyline.id = make({{{0.5, 0.5, 1.4}, {2.5, 0.5, 1.4}, {3.5, 0.7, 1.5}, {1.5, 2, 1.9}, {1.5, 2, 1.1}},
                      {{0, 1}, {1, 2}, {2, 3}, {3, 4}},
                      {}},
                     polyline.level, DSW_BODY_SELF_CONTACTS);
  dsw_move_options options = defaults(dsw_move_options_init);
  options.edge_response = DSW_RESPONSE_ADAPTIVE_ONE;
  options.noise_share = 1e-3;
  options.min_part = 0.1;
  size_t inserted = 0, removed = 0;
  for (int step = 0; step < 3; ++step) {
    const double y = step == 0 ? 3.5 : 0.5;
    std::vector<Vec> targets = read(polyline.id).at;
    targets[0][1] = y;
    if (step == 2) targets[5] = {1.5, 0.5, 1.4};  // the new vertex, back in line
    const std::string before = bits_of(read(polyline.id));
    until_it_succeeds(
        [&] {
          return dsw_body_move(scene(), polyline.id, targets[0].data(), targets.size(), sizeof(Vec), &options, nullptr);
        },
        [&] { return bits_of(read(polyline.id)) == before; });
    const dsw_body_edit* edits = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_get_edits(scene(), polyline.id, &edits, &count), DSW_STATUS_OK);
    for (size_t i = 0; i < count; ++i) ++(edits[i].inserted != 0 ? inserted : removed);
    polyline.state = read(polyline.id);
    ASSERT_TRUE(are_apart(polyline, polyline)) << y;
    EXPECT_EQ(polyline.state.at[0][1], y);
    EXPECT_EQ(removed, step == 2 ? 1u : 0u);
  }
  EXPECT_EQ(inserted, 1u);
}

TEST_F(TwoBodiesTest, MemoryThatRunsOutLeavesAllAsItWas) {
  run_out_of_memory({wall(1), wall(3), tetrahedron({1.75, 1.25, 1.25}, 0.5)}, 2,
                    {{{2, 0, 0}, {-2, 0, 0}, {0.125, 0, 0}}});
  const std::string before = state();
  until_it_succeeds([&] { return dsw_body_set_filter(scene(), bodies_[0], 2, 2); }, [&] { return state() == before; });
  until_it_succeeds([&] { return dsw_body_set_filter(scene(), bodies_[0], 1, 0); }, [&] { return state() == before; });
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
