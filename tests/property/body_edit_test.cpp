// Edits of bodies: ids and generations, manifolds, splits and collapses, and what is refused.
#include "body_support.h"

namespace dsw::oracle {
namespace {

constexpr Vec kA = {0.5, 0.5, 0.5}, kB = {0.75, 0.5, 0.5}, kC = {0.5, 0.75, 0.5}, kD = {0.5, 0.5, 0.75};

class BodyEditTest : public BodyTest {
 protected:
  /// Expects that a call fails and that the body has the same bits after it.
  template <class Call>
  void refuse(dsw_status status, dsw_body_id body, Call call) {
    const std::string before = bits_of(read(body));
    EXPECT_EQ(call(), status) << dsw_last_error_message();
    EXPECT_EQ(bits_of(read(body)), before);
  }
  static size_t edge_between(const BodyState& s, uint32_t a, uint32_t b) {
    for (size_t e = 0; e < s.edges.size(); ++e) {
      if ((s.edges[e][0] == a && s.edges[e][1] == b) || (s.edges[e][0] == b && s.edges[e][1] == a)) return e;
    }
    ADD_FAILURE() << "no edge " << a << "-" << b;
    return 0;
  }
};

TEST_F(BodyEditTest, RemovedPartsAreStaleAndTheirIndicesComeBackWithAHigherGeneration) {
  const dsw_body_id body = make(tetrahedron(kA, 0.25));
  const BodyState before = read(body);
  ASSERT_EQ(dsw_body_remove_face(scene(), body, before.face_ids[3]), DSW_STATUS_OK);
  refuse(DSW_STATUS_STALE_ID, body, [&] { return dsw_body_remove_face(scene(), body, before.face_ids[3]); });
  EXPECT_EQ(read(body).edges.size(), 6u);
  dsw_body_face_id face = {0, 0};
  ASSERT_EQ(dsw_body_add_face(scene(), body, before.vertices[1], before.vertices[2], before.vertices[3], &face),
            DSW_STATUS_OK);
  EXPECT_EQ(face.index, before.face_ids[3].index);
  EXPECT_GT(face.generation, before.face_ids[3].generation);

  const size_t e = edge_between(before, 0, 1);
  ASSERT_EQ(dsw_body_remove_edge(scene(), body, before.edge_ids[e]), DSW_STATUS_OK);
  EXPECT_EQ(read(body).edges.size(), 5u);
  EXPECT_EQ(read(body).faces.size(), 2u);
  dsw_body_vertex_id ends[2];
  refuse(DSW_STATUS_STALE_ID, body, [&] { return dsw_body_get_edge_ends(scene(), body, before.edge_ids[e], ends); });

  ASSERT_EQ(dsw_body_remove_vertex(scene(), body, before.vertices[3]), DSW_STATUS_OK);
  const BodyState rest = read(body);
  EXPECT_EQ(rest.vertices[3].generation, 0u);
  EXPECT_TRUE(rest.at[3] == (Vec{0, 0, 0}));
  EXPECT_EQ(rest.edges.size(), 2u);
  EXPECT_EQ(rest.faces.size(), 0u);
  refuse(DSW_STATUS_STALE_ID, body, [&] { return dsw_body_remove_vertex(scene(), body, before.vertices[3]); });
  dsw_body_vertex_id vertex = {0, 0};
  ASSERT_EQ(dsw_body_add_vertex(scene(), body, kD.data(), {0, 0}, &vertex), DSW_STATUS_OK);
  EXPECT_EQ(vertex.index, 3u);
  EXPECT_GT(vertex.generation, before.vertices[3].generation);
}

TEST_F(BodyEditTest, AFaceTakesItsMissingEdgesAlong) {
  const dsw_body_id body = make({{kA, kB, kC}, {{0, 1}}, {}});
  const BodyState before = read(body);
  dsw_body_face_id face;
  ASSERT_EQ(dsw_body_add_face(scene(), body, before.vertices[0], before.vertices[1], before.vertices[2], &face),
            DSW_STATUS_OK);
  EXPECT_EQ(read(body).edges.size(), 3u);
  ASSERT_EQ(dsw_body_remove_face(scene(), body, face), DSW_STATUS_OK);
  EXPECT_EQ(read(body).edges.size(), 3u);
}

TEST_F(BodyEditTest, WhatCannotBeAdded) {
  mark_volume(cube(3, 3, 2));
  mark_wall(0, 0, 0);
  const dsw_body_id body = make({{kA, kB, kC, kD, {1.5, 0.5, 0.5}}, {{3, 0}}, {{0, 1, 2}}});
  const BodyState s = read(body);
  const auto& v = s.vertices;
  const dsw_body_vertex_id stale = {1, 9};
  const auto add_vertex = [&](const Vec& at, dsw_volume_id hint) {
    dsw_body_vertex_id id;
    return dsw_body_add_vertex(scene(), body, at.data(), hint, &id);
  };
  const auto add_edge = [&](dsw_body_vertex_id a, dsw_body_vertex_id b) {
    dsw_body_edge_id id;
    return dsw_body_add_edge(scene(), body, a, b, &id);
  };
  const auto add_face = [&](dsw_body_vertex_id a, dsw_body_vertex_id b, dsw_body_vertex_id c) {
    dsw_body_face_id id;
    return dsw_body_add_face(scene(), body, a, b, c, &id);
  };
  refuse(DSW_STATUS_NON_FINITE, body, [&] { return add_vertex({NAN, 0, 0}, {0, 0}); });
  refuse(DSW_STATUS_OUTSIDE, body, [&] { return add_vertex({-1, 0, 0}, {0, 0}); });
  refuse(DSW_STATUS_IMPASSABLE, body, [&] { return add_vertex({3.5, 3.5, 2.5}, {0, 0}); });
  refuse(DSW_STATUS_STALE_ID, body, [&] { return add_vertex(kB, {1, 7}); });
  refuse(DSW_STATUS_STALE_ID, body, [&] { return add_edge(v[0], stale); });
  refuse(DSW_STATUS_REPEATED_VERTEX, body, [&] { return add_edge(v[3], v[3]); });
  refuse(DSW_STATUS_DUPLICATE_PART, body, [&] { return add_edge(v[0], v[3]); });
  refuse(DSW_STATUS_OCCUPIED, body, [&] { return add_edge(v[0], v[4]); });
  refuse(DSW_STATUS_STALE_ID, body, [&] { return add_face(v[0], v[1], stale); });
  refuse(DSW_STATUS_REPEATED_VERTEX, body, [&] { return add_face(v[0], v[1], v[1]); });
  refuse(DSW_STATUS_DUPLICATE_PART, body, [&] { return add_face(v[1], v[2], v[0]); });
  refuse(DSW_STATUS_NOT_ORIENTED, body, [&] { return add_face(v[0], v[1], v[3]); });
  refuse(DSW_STATUS_OCCUPIED, body, [&] { return add_face(v[1], v[0], v[4]); });
  dsw_body_face_id face;
  ASSERT_EQ(dsw_body_add_face(scene(), body, v[1], v[0], v[3], &face), DSW_STATUS_OK);
  dsw_body_vertex_id more;
  ASSERT_EQ(dsw_body_add_vertex(scene(), body, Vec{0.25, 0.25, 0.25}.data(), {0, 0}, &more), DSW_STATUS_OK);
  refuse(DSW_STATUS_NOT_MANIFOLD, body, [&] { return add_face(v[0], v[1], more); });
}

TEST_F(BodyEditTest, AFaceThatWouldMakeASecondFanIsRefused) {
  const dsw_body_id body = make({{kA, kB, kC, kD, {0.25, 0.25, 0.25}}, {}, {{0, 1, 2}}});
  const BodyState s = read(body);
  refuse(DSW_STATUS_NOT_MANIFOLD, body, [&] {
    dsw_body_face_id face;
    return dsw_body_add_face(scene(), body, s.vertices[0], s.vertices[3], s.vertices[4], &face);
  });
}

TEST_F(BodyEditTest, SplitAndCollapseAreARoundTrip) {
  for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
    const dsw_body_id body = make(tetrahedron(kA, 0.25), level);
    const BodyState before = read(body);
    const size_t e = edge_between(before, 1, 2);
    dsw_body_edit split;
    std::memset(&split, 0x55, sizeof split);
    ASSERT_EQ(dsw_body_split_edge(scene(), body, before.edge_ids[e], 0.25, &split), DSW_STATUS_OK);
    const BodyState middle = read(body);
    EXPECT_EQ(middle.edges.size(), 9u);
    EXPECT_EQ(middle.faces.size(), 6u);
    EXPECT_TRUE(split.inserted == 1 && split.reserved == 0 && split.edge_parameter == 0.25);
    EXPECT_EQ(split.edge.index, before.edge_ids[e].index);
    EXPECT_EQ(split.edge.generation, before.edge_ids[e].generation);
    const Vec& a = before.at[split.ends[0].index];
    const Vec& b = before.at[split.ends[1].index];
    const Vec& m = middle.at[split.vertex.index];
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(m[k], a[k] + 0.25 * (b[k] - a[k]), 1e-15);
    const auto joins = [&](dsw_body_edge_id id, dsw_body_vertex_id x, dsw_body_vertex_id y) {
      dsw_body_vertex_id ends[2];
      EXPECT_EQ(dsw_body_get_edge_ends(scene(), body, id, ends), DSW_STATUS_OK);
      return (ends[0].index == x.index && ends[1].index == y.index) ||
             (ends[0].index == y.index && ends[1].index == x.index);
    };
    EXPECT_TRUE(joins(split.edge, split.ends[0], split.vertex));
    EXPECT_TRUE(joins(split.rest, split.vertex, split.ends[1]));

    dsw_body_edit merge;
    std::memset(&merge, 0x55, sizeof merge);
    ASSERT_EQ(dsw_body_collapse_edge(scene(), body, split.rest, split.vertex, &merge), DSW_STATUS_OK)
        << dsw_last_error_message();
    EXPECT_TRUE(merge.inserted == 0 && merge.vertex.index == split.vertex.index &&
                merge.ends[0].index == split.ends[1].index && merge.edge.index == split.rest.index);
    const BodyState after = read(body);
    EXPECT_EQ(after.faces.size(), 4u);
    EXPECT_EQ(after.edges.size(), 6u);
    for (size_t v = 0; v < 4; ++v) EXPECT_EQ(after.at[v], before.at[v]);
    // Turned as before: the same cyclic triples.
    const auto turned = [](const BodyState& s) {
      auto faces = s.faces;
      for (auto& f : faces) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
      std::sort(faces.begin(), faces.end());
      return faces;
    };
    EXPECT_EQ(turned(after), turned(before));
    ASSERT_EQ(dsw_body_destroy(scene(), body), DSW_STATUS_OK);
  }
}

TEST_F(BodyEditTest, SplitsThatAreRefused) {
  const dsw_body_id body = make(segment(kA, kB));
  const BodyState s = read(body);
  for (double share : {0.0, 1.0, -0.5, 1.5}) {
    refuse(DSW_STATUS_OUT_OF_RANGE, body,
           [&] { return dsw_body_split_edge(scene(), body, s.edge_ids[0], share, nullptr); });
  }
  for (double share : {static_cast<double>(NAN), HUGE_VAL}) {
    const std::string before = bits_of(read(body));
    EXPECT_NE(dsw_body_split_edge(scene(), body, s.edge_ids[0], share, nullptr), DSW_STATUS_OK);
    EXPECT_EQ(bits_of(read(body)), before);
  }
  refuse(DSW_STATUS_STALE_ID, body, [&] { return dsw_body_split_edge(scene(), body, {0, 9}, 0.5, nullptr); });
}

TEST_F(BodyEditTest, CollapsesThatAreRefused) {
  const dsw_body_id surface = make(tetrahedron(kA, 0.25));
  BodyState s = read(surface);
  const size_t e = edge_between(s, 0, 1);
  // Two triangles on the same three vertices would be left.
  refuse(DSW_STATUS_NOT_MANIFOLD, surface,
         [&] { return dsw_body_collapse_edge(scene(), surface, s.edge_ids[e], s.vertices[0], nullptr); });
  refuse(DSW_STATUS_NOT_FOUND, surface,
         [&] { return dsw_body_collapse_edge(scene(), surface, s.edge_ids[e], s.vertices[2], nullptr); });
  refuse(DSW_STATUS_STALE_ID, surface, [&] {
    return dsw_body_collapse_edge(scene(), surface, {0, 9}, s.vertices[0], nullptr);
  });
  refuse(DSW_STATUS_STALE_ID, surface, [&] {
    return dsw_body_collapse_edge(scene(), surface, s.edge_ids[e], {0, 9}, nullptr);
  });

  // A polyline round a marked edge: its middle vertex cannot go to an end.
  mark_edge(2, 2, 1);
  const dsw_body_id line = make({{{1.5, 1.5, 1.5}, {2.5, 1.5, 1.5}, {2.5, 2.75, 1.5}}, {{0, 1}, {1, 2}}, {}});
  s = read(line);
  refuse(DSW_STATUS_OCCUPIED, line,
         [&] { return dsw_body_collapse_edge(scene(), line, s.edge_ids[0], s.vertices[1], nullptr); });
  // At EDGES a marked edge is no obstacle.
  ASSERT_EQ(dsw_body_set_level(scene(), line, DSW_LEVEL_EDGES), DSW_STATUS_OK);
  EXPECT_EQ(dsw_body_collapse_edge(scene(), line, s.edge_ids[0], s.vertices[1], nullptr), DSW_STATUS_OK)
      << dsw_last_error_message();
  EXPECT_EQ(read(line).edges.size(), 1u);
}

TEST_F(BodyEditTest, ATriangleMayBecomeAnEdge) {
  const dsw_body_id body = make({{kA, kB, kC}, {}, {{0, 1, 2}}});
  const BodyState s = read(body);
  ASSERT_EQ(dsw_body_collapse_edge(scene(), body, s.edge_ids[edge_between(s, 0, 1)], s.vertices[0], nullptr),
            DSW_STATUS_OK)
      << dsw_last_error_message();
  const BodyState after = read(body);
  EXPECT_EQ(after.faces.size(), 0u);
  EXPECT_EQ(after.edges.size(), 1u);
}

TEST_F(BodyEditTest, AnEdgeBetweenTwoSurfacesDoesNotCollapseToAVertexOfTwoFans) {
  const dsw_body_id body = make({{kA, kB, kC, {1.5, 1.5, 0.5}, {1.75, 1.5, 0.5}, {1.5, 1.75, 0.5}, {1.25, 1.5, 0.75}},
                                 {{0, 3}, {3, 6}},
                                 {{0, 1, 2}, {3, 4, 5}}});
  const BodyState s = read(body);
  for (uint32_t v : {0u, 3u}) {
    refuse(DSW_STATUS_NOT_MANIFOLD, body, [&] {
      return dsw_body_collapse_edge(scene(), body, s.edge_ids[edge_between(s, 0, 3)], s.vertices[v], nullptr);
    });
  }
  // Where only one of them is a surface there is one fan.
  EXPECT_EQ(dsw_body_collapse_edge(scene(), body, s.edge_ids[edge_between(s, 3, 6)], s.vertices[3], nullptr),
            DSW_STATUS_OK)
      << dsw_last_error_message();
}

}  // namespace
}  // namespace dsw::oracle
