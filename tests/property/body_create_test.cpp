// Creation of bodies and their level: what is refused, with which status, and that nothing is left of it.
#include "body_support.h"

namespace dsw::oracle {
namespace {

constexpr Vec kA = {0.5, 0.5, 0.5}, kB = {0.75, 0.5, 0.5}, kC = {0.5, 0.75, 0.5}, kD = {0.5, 0.5, 0.75},
              kE = {0.25, 0.25, 0.25};

class BodyCreateTest : public BodyTest {
 protected:
  void refuse(dsw_status status, const BodyPlan& plan, dsw_level level = DSW_LEVEL_EDGES_SWEPT,
              const std::vector<dsw_volume_id>& hints = {}) {
    dsw_body_id body = {77, 78};
    EXPECT_EQ(create_body(scene(), plan, level, 0, hints, &body), status) << dsw_last_error_message();
    EXPECT_EQ(std::string(dsw_last_error_message()).rfind("dsw_body_create", 0), 0u) << dsw_last_error_message();
    EXPECT_TRUE(body.index == 77 && body.generation == 78);
    EXPECT_EQ(body_count(), 0u);
  }
  dsw_body_desc segment_desc() {
    static const double positions[6] = {0.5, 0.5, 0.5, 0.75, 0.5, 0.5};
    static const uint32_t edges[2] = {0, 1};
    dsw_body_desc d = defaults(dsw_body_desc_init);
    d.positions = positions;
    d.vertex_count = 2;
    d.edges = edges;
    d.edge_count = 1;
    return d;
  }
  void refuse(dsw_status status, const dsw_body_desc& d) {
    dsw_body_id body = {77, 78};
    EXPECT_EQ(dsw_body_create(scene(), &d, &body), status) << dsw_last_error_message();
    EXPECT_TRUE(body.index == 77 && body.generation == 78);
    EXPECT_EQ(body_count(), 0u);
  }
};

TEST_F(BodyCreateTest, DefaultsAreThoseOfTheHeader) {
  dsw_body_desc d;
  std::memset(&d, 0x55, sizeof d);
  dsw_body_desc_init(&d, sizeof d);
  EXPECT_EQ(d.struct_size, sizeof d);
  EXPECT_EQ(d.flags, 0u);
  EXPECT_EQ(d.level, DSW_LEVEL_EDGES_SWEPT);
  EXPECT_TRUE(d.positions == nullptr && d.hints == nullptr && d.edges == nullptr && d.face_offsets == nullptr);
  EXPECT_EQ(d.vertex_count + d.stride_bytes + d.edge_count + d.face_count, 0u);
  EXPECT_EQ(d.motion_share, 0);
  dsw_move_options o;
  std::memset(&o, 0x55, sizeof o);
  dsw_move_options_init(&o, sizeof o);
  EXPECT_EQ(o.struct_size, sizeof o);
  EXPECT_TRUE(o.vertex_response == DSW_RESPONSE_STOP && o.edge_response == DSW_RESPONSE_STOP);
  EXPECT_EQ(o.search, DSW_SEARCH_EXACT);
  EXPECT_TRUE(o.order == nullptr && o.order_count == 0);
}

TEST_F(BodyCreateTest, ArgumentsThatAreNotThere) {
  dsw_body_desc d = segment_desc();
  dsw_body_id body;
  EXPECT_EQ(dsw_body_create(nullptr, &d, &body), DSW_STATUS_NULL_ARGUMENT);
  EXPECT_EQ(dsw_body_create(scene(), nullptr, &body), DSW_STATUS_NULL_ARGUMENT);
  EXPECT_EQ(dsw_body_create(scene(), &d, nullptr), DSW_STATUS_NULL_ARGUMENT);
  d.positions = nullptr;
  refuse(DSW_STATUS_NULL_ARGUMENT, d);
  d = segment_desc();
  d.edges = nullptr;
  refuse(DSW_STATUS_NULL_ARGUMENT, d);
  d = segment_desc();
  d.face_count = 1;
  refuse(DSW_STATUS_NULL_ARGUMENT, d);
  d = segment_desc();
  d.struct_size = 4;
  refuse(DSW_STATUS_BAD_STRUCT_SIZE, d);
}

TEST_F(BodyCreateTest, ValuesThatThisVersionDoesNotKnow) {
  dsw_body_desc d = segment_desc();
  d.flags = 0x100;
  refuse(DSW_STATUS_UNSUPPORTED, d);
  for (int level : {-1, 0, 5, 99}) {
    d = segment_desc();
    std::memcpy(&d.level, &level, sizeof level);
    if (level == 0) continue;  // whether 0 is the default is left open
    refuse(DSW_STATUS_UNSUPPORTED, d);
  }
  struct Longer {
    dsw_body_desc desc;
    uint64_t more;
  } longer = {segment_desc(), 1};
  longer.desc.struct_size = sizeof longer;
  refuse(DSW_STATUS_UNSUPPORTED, longer.desc);
  longer.more = 0;
  dsw_body_id body;
  EXPECT_EQ(dsw_body_create(scene(), &longer.desc, &body), DSW_STATUS_OK) << dsw_last_error_message();
}

TEST_F(BodyCreateTest, SizesThatContradictEachOther) {
  dsw_body_desc d = segment_desc();
  d.stride_bytes = 16;
  refuse(DSW_STATUS_WRONG_SIZE, d);
  const uint32_t falling[3] = {0, 3, 0}, two[2] = {0, 2}, corners[3] = {0, 1, 2};
  const double positions[9] = {0.5, 0.5, 0.5, 0.75, 0.5, 0.5, 0.5, 0.75, 0.5};
  d = segment_desc();
  d.positions = positions;
  d.vertex_count = 3;
  d.face_corners = corners;
  d.face_offsets = falling;
  d.face_count = 2;
  refuse(DSW_STATUS_WRONG_SIZE, d);
  d.face_offsets = two;
  d.face_count = 1;
  refuse(DSW_STATUS_WRONG_SIZE, d);
}

TEST_F(BodyCreateTest, PlacesThatAreNone) {
  const double odd[] = {NAN, HUGE_VAL, -HUGE_VAL};
  for (double x : odd) refuse(DSW_STATUS_NON_FINITE, segment(kA, {0.5, x, 0.5}));
  refuse(DSW_STATUS_OUTSIDE, segment(kA, {4.5, 0.5, 0.5}));
  refuse(DSW_STATUS_OUTSIDE, segment(kA, {1e300, 0.5, 0.5}));
  refuse(DSW_STATUS_STALE_ID, segment(kA, kB), DSW_LEVEL_EDGES_SWEPT, {{0, 0}, {3, 9}});
  mark_volume(cube(2, 0, 0));
  refuse(DSW_STATUS_IMPASSABLE, segment(kA, {2.5, 0.5, 0.5}));
  EXPECT_NE(std::string(dsw_last_error_message()).find('1'), std::string::npos) << dsw_last_error_message();
}

TEST_F(BodyCreateTest, EdgesAndFacesThatAreNone) {
  refuse(DSW_STATUS_INDEX_OUT_OF_RANGE, {{kA, kB}, {{0, 2}}, {}});
  refuse(DSW_STATUS_INDEX_OUT_OF_RANGE, {{kA, kB, kC}, {}, {{0, 1, 3}}});
  refuse(DSW_STATUS_REPEATED_VERTEX, {{kA, kB}, {{1, 1}}, {}});
  refuse(DSW_STATUS_REPEATED_VERTEX, {{kA, kB, kC}, {}, {{0, 1, 0}}});
  refuse(DSW_STATUS_DUPLICATE_PART, {{kA, kB}, {{0, 1}, {1, 0}}, {}});
  refuse(DSW_STATUS_DUPLICATE_PART, {{kA, kB, kC}, {}, {{0, 1, 2}, {1, 2, 0}}});
  refuse(DSW_STATUS_NOT_ORIENTED, {{kA, kB, kC, kD}, {}, {{0, 1, 2}, {0, 1, 3}}});
}

TEST_F(BodyCreateTest, OnlyManifolds) {
  // Three triangles at one edge; two cones that share their tip.
  refuse(DSW_STATUS_NOT_MANIFOLD, {{kA, kB, kC, kD, kE}, {}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}});
  refuse(DSW_STATUS_NOT_MANIFOLD, {{kA, kB, kC, kD, kE}, {}, {{0, 1, 2}, {0, 3, 4}}});
  BodyPlan two = tetrahedron(kA, 0.25);
  const BodyPlan other = tetrahedron(kA, -0.25);
  two.at.insert(two.at.end(), other.at.begin() + 1, other.at.end());
  for (auto f : other.faces) {
    for (uint32_t& v : f) v = v == 0 ? 0 : v + 3;
    two.faces.push_back(f);
  }
  refuse(DSW_STATUS_NOT_MANIFOLD, two);
  // Edges without faces may meet where they like.
  const BodyState state = read(make({{kA, kB, kC, kD, kE}, {{0, 1}, {0, 2}, {0, 3}, {0, 4}}, {{0, 1, 2}}}));
  EXPECT_EQ(state.edges.size(), 5u);
  EXPECT_EQ(state.faces.size(), 1u);
}

TEST_F(BodyCreateTest, IndicesAreThoseGivenAndEdgesOfFacesFollow) {
  const BodyPlan plan = {{kA, kB, kC, kD}, {{2, 1}}, {{0, 1, 2, 3}}};
  const BodyState state = read(make(plan));
  const BodyState want = state_of(plan);
  ASSERT_EQ(state.edges.size(), 5u);  // the square's four and its diagonal
  for (uint32_t i = 0; i < 5; ++i) EXPECT_TRUE(state.edge_ids[i].index == i && state.edge_ids[i].generation == 1);
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(state.vertices[i].index == i && state.vertices[i].generation == 1);
    EXPECT_TRUE(same(state.volumes[i], cube(0, 0, 0)));
  }
  EXPECT_TRUE((state.edges[0] == std::array<uint32_t, 2>{2, 1}));
  EXPECT_EQ(state.at, want.at);
  EXPECT_EQ(state.faces, want.faces);
}

TEST_F(BodyCreateTest, WhatIsNotFreeIsNamed) {
  mark_wall(0, 0, 0);
  const BodyPlan plan = {{kA, {1.5, 0.5, 0.5}, {1.5, 0.75, 0.5}, kC}, {{2, 1}, {3, 0}, {0, 1}}, {}};
  refuse(DSW_STATUS_OCCUPIED, plan);
  refuse(DSW_STATUS_OCCUPIED, plan, DSW_LEVEL_EDGES);
  const uint32_t* pairs = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_offending_edges(scene(), &pairs, &count), DSW_STATUS_OK);
  ASSERT_EQ(count, 1u);
  EXPECT_TRUE(pairs[0] + pairs[1] == 1u);
  make(plan, DSW_LEVEL_POINTS);
}

TEST_F(BodyCreateTest, AMarkedEdgeThroughAFaceIsSeenAtFacesOnly) {
  mark_edge(1, 1, 1);
  const BodyPlan plan = {{{0.5, 0.5, 1.5}, {2, 0.5, 1.5}, {0.5, 2, 1.5}}, {}, {{0, 1, 2}}};
  dsw_body_id body = make(plan);
  BodyState before = read(body);
  EXPECT_EQ(dsw_body_set_level(scene(), body, DSW_LEVEL_FACES), DSW_STATUS_OCCUPIED);
  const uint32_t* pairs = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_offending_edges(scene(), &pairs, &count), DSW_STATUS_OK);
  EXPECT_GE(count, 1u);
  dsw_level level = DSW_LEVEL_POINTS;
  ASSERT_EQ(dsw_body_get_level(scene(), body, &level), DSW_STATUS_OK);
  EXPECT_EQ(level, DSW_LEVEL_EDGES_SWEPT);
  EXPECT_EQ(bits_of(read(body)), bits_of(before));
  ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  refuse(DSW_STATUS_OCCUPIED, plan, DSW_LEVEL_FACES);
}

TEST_F(BodyCreateTest, RaisingTheLevelIsRefusedWhereTheBodyIsNotFree) {
  mark_wall(0, 0, 0);
  const dsw_body_id body = make(segment(kA, {1.5, 0.5, 0.5}), DSW_LEVEL_POINTS);
  for (dsw_level wanted : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    EXPECT_EQ(dsw_body_set_level(scene(), body, wanted), DSW_STATUS_OCCUPIED);
    dsw_level level = DSW_LEVEL_FACES;
    ASSERT_EQ(dsw_body_get_level(scene(), body, &level), DSW_STATUS_OK);
    EXPECT_EQ(level, DSW_LEVEL_POINTS);
  }
  EXPECT_EQ(dsw_body_set_level(scene(), body, static_cast<dsw_level>(9)), DSW_STATUS_UNSUPPORTED);
  const dsw_body_id clear = make(segment(kA, kB), DSW_LEVEL_POINTS);
  for (dsw_level wanted : {DSW_LEVEL_FACES, DSW_LEVEL_POINTS, DSW_LEVEL_EDGES}) {
    EXPECT_EQ(dsw_body_set_level(scene(), clear, wanted), DSW_STATUS_OK);
    dsw_level level = DSW_LEVEL_EDGES_SWEPT;
    ASSERT_EQ(dsw_body_get_level(scene(), clear, &level), DSW_STATUS_OK);
    EXPECT_EQ(level, wanted);
  }
}

TEST_F(BodyCreateTest, IdsOfGoneBodiesAreStale) {
  const dsw_body_id first = make(segment(kA, kB));
  ASSERT_EQ(dsw_body_destroy(scene(), first), DSW_STATUS_OK);
  const dsw_body_id second = make(segment(kA, kC));
  EXPECT_EQ(second.index, first.index);
  EXPECT_GT(second.generation, first.generation);
  EXPECT_EQ(body_count(), 1u);
  const dsw_body_id bad[] = {first, {0, 0}, {5, 1}};
  for (dsw_body_id id : bad) {
    dsw_body_counts counts = {};
    counts.struct_size = sizeof counts;
    dsw_level level;
    double xyz[6];
    size_t count = 55;
    const double targets[6] = {0};
    dsw_body_vertex_id vertex;
    const dsw_body_contact* contacts = nullptr;
    EXPECT_EQ(dsw_body_destroy(scene(), id), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_get_counts(scene(), id, &counts), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_get_level(scene(), id, &level), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_set_level(scene(), id, DSW_LEVEL_POINTS), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_get_positions(scene(), id, xyz, 2, 0, nullptr, &count), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_get_vertex_ids(scene(), id, &vertex, 1, &count), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_add_vertex(scene(), id, kA.data(), {0, 0}, &vertex), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_move(scene(), id, targets, 2, 0, nullptr, nullptr), DSW_STATUS_STALE_ID);
    EXPECT_EQ(dsw_body_get_contacts(scene(), id, &contacts, &count), DSW_STATUS_STALE_ID);
    EXPECT_EQ(count, 55u);
  }
}

TEST_F(BodyCreateTest, BuffersThatAreTooSmallLearnTheSize) {
  const dsw_body_id body = make(tetrahedron(kA, 0.25));
  size_t count = 0;
  double xyz[12] = {7};
  EXPECT_EQ(dsw_body_get_positions(scene(), body, xyz, 3, 0, nullptr, &count), DSW_STATUS_BUFFER_TOO_SMALL);
  EXPECT_EQ(count, 4u);
  EXPECT_EQ(xyz[0], 7);
  dsw_body_edge_id edges[6] = {{9, 9}};
  EXPECT_EQ(dsw_body_get_edge_ids(scene(), body, edges, 5, &count), DSW_STATUS_BUFFER_TOO_SMALL);
  EXPECT_EQ(count, 6u);
  EXPECT_EQ(edges[0].index, 9u);
  dsw_body_face_id faces[4];
  EXPECT_EQ(dsw_body_get_face_ids(scene(), body, faces, 3, &count), DSW_STATUS_BUFFER_TOO_SMALL);
  EXPECT_EQ(count, 4u);
}

}  // namespace
}  // namespace dsw::oracle
