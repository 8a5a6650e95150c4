// What integrity asks beyond the counts: linked facets are cut alike, and no vertex hides a second disc.

#include <gtest/gtest.h>

#include "map/integrity.h"
#include "small_meshes.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;

/** The first link that leads somewhere, seen from the cell with the lower index. */
HalfFacet inner_facet(const Map<3>& map) {
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    for (uint32_t f = 0; f < map.facets_of(map.cell(i)); ++f) {
      const HalfFacet h = map.half_facet(map.cell(i), f);
      if (map.opposite(h).valid()) return h;
    }
  }
  return {};
}

/** Local vertices of a facet's loop, in the numbering of its cell, so that position k is `vertex_order[k]`. */
std::vector<uint16_t> loop_like(const Map<3>& map, HalfFacet h, const std::vector<uint32_t>& vertex_order) {
  const Cell c = map.cell_of(h);
  std::vector<uint16_t> loop;
  for (const uint32_t v : vertex_order) {
    for (uint32_t k = 0; k < map.vertices_of(c); ++k) {
      if (map.vertex(c, k) == v) loop.push_back(static_cast<uint16_t>(k));
    }
  }
  return loop;
}

std::vector<uint32_t> vertices_of(const Map<3>& map, HalfFacet h) {
  const Cell c = map.cell_of(h);
  const Shape shape = map.shape(c);
  const uint32_t f = map.local_of(h, c);
  std::vector<uint32_t> vertices;
  for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d)
    vertices.push_back(map.vertex(c, shape.dart_vertex(d)));
  return vertices;
}

/** Cuts one side of a polyhedron's facet; triangles by positions in the loop of `like`, turned round if `turned`. */
void cut(Map<3>& map, HalfFacet h, const std::vector<uint32_t>& like, const std::vector<size_t>& triangles,
         bool turned) {
  const std::vector<uint16_t> loop = loop_like(map, h, like);
  std::vector<uint16_t> local;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    for (const size_t k : {t, turned ? t + 2 : t + 1, turned ? t + 1 : t + 2}) local.push_back(loop[triangles[k]]);
  }
  const Cell c = map.cell_of(h);
  ASSERT_EQ(map.form(c), Form::kGeneral);
  set_triangles(map.shape_tables.data() + map.shape_offsets[map.record(c)[0] & kShapeMask], map.local_of(h, c),
                local.data());
}

constexpr const char* kUnlike = "two linked facets do not have the same vertices in opposite order, cut alike";

TEST(LinkedCuts, TheSameTrianglesInAnyOrderOnBothSides) {
  const std::vector<size_t> fan = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5}, zigzag = {0, 1, 5, 1, 2, 5, 5, 2, 4, 2, 3, 4};
  const std::vector<size_t> zigzag_again = {2, 4, 5, 3, 4, 2, 5, 0, 1, 5, 1, 2},
                            ears = {0, 1, 2, 2, 3, 4, 4, 5, 0, 0, 2, 4};
  const std::vector<std::vector<size_t>> all = {fan, zigzag, zigzag_again, ears};
  for (size_t near = 0; near < all.size(); ++near) {
    for (size_t far = 0; far < all.size(); ++far) {
      Environment<3> env(nullptr);
      build_mesh(env, two_polygon_prisms(6));
      const HalfFacet h = inner_facet(env.map);
      const std::vector<uint32_t> loop = vertices_of(env.map, h);
      ASSERT_EQ(loop.size(), 6u);
      cut(env.map, h, loop, all[near], false);
      cut(env.map, env.map.opposite(h), loop, all[far], true);
      const bool alike = near == far || (near + far == 3 && near * far == 2);
      EXPECT_STREQ(check_integrity(env.map), alike ? nullptr : kUnlike) << near << " " << far;
    }
  }
}

TEST(LinkedCuts, AQuadHasTwoDiagonalsWhereverItsTrianglesBegin) {
  const std::vector<size_t> from_0 = {0, 1, 2, 0, 2, 3}, from_2 = {2, 0, 1, 3, 0, 2}, from_1 = {1, 2, 3, 1, 3, 0};
  for (const uint8_t left : {kHexahedron, kPyramid, kPolyhedron}) {
    int alike = 0;
    const char* of_0 = nullptr;
    for (const std::vector<size_t>& triangles : {from_0, from_2, from_1}) {
      Environment<3> env(nullptr);
      build_mesh(env, pair_of(left, kPolyhedron));
      Map<3>& map = env.map;
      HalfFacet side = {};  // of the polyhedron against what is left of it
      for (uint32_t i = 0; i < map.cell_count && !side.valid(); ++i) {
        for (uint32_t f = 0; f < map.facets_of(map.cell(i)); ++f) {
          const HalfFacet g = map.half_facet(map.cell(i), f);
          if (i + 1 == map.cell_count && map.opposite(g).valid()) side = g;
        }
      }
      ASSERT_TRUE(side.valid());
      cut(map, side, vertices_of(map, side), triangles, false);
      const char* const found = check_integrity(map);
      if (found == nullptr) ++alike;
      if (found != nullptr) {
        EXPECT_STREQ(found, kUnlike);
      }
      if (triangles == from_0) of_0 = found;
      if (triangles == from_2) {
        EXPECT_STREQ(found, of_0) << "both ends of one diagonal";
      }
    }
    EXPECT_TRUE(alike == 1 || alike == 2) << "one diagonal of the two";
  }
}

TEST(LinkedCuts, LinkedToAFacetWithOtherVertices) {
  Environment<3> env(nullptr);
  build_mesh(env, pair_of(kHexahedron, kHexahedron));
  Map<3>& map = env.map;
  const HalfFacet h = inner_facet(map), o = map.opposite(h);
  const HalfFacet other{o.word % kUnitWords<3> == 7 ? o.word - 1 : o.word + 1};
  ASSERT_FALSE(map.opposite(other).valid());
  map.words[o.word] = kNoFacet;
  map.words[h.word] = other.word;
  map.words[other.word] = h.word;
  EXPECT_STREQ(check_integrity(map), kUnlike);
}

/** A cube whose opposite corners 0 and 6 are one vertex has two discs there. One vertex more, and Euler's sum fits. */
TEST(LinkedCuts, AVertexInTwoDiscsIsSeenThoughTheNumbersFit) {
  const uint16_t loops[] = {0, 4, 6, 3, 1, 2, 0, 5, 0, 1, 5, 4, 3, 6, 0, 2, 0, 3, 2, 1, 4, 5, 0, 6};
  const uint16_t first[] = {0, 4, 8, 12, 16, 20, 24};
  Array<uint16_t> table;
  EXPECT_EQ(append_polyhedron({loops, first, 6, 7}, nullptr, table), ShapeDefect::kNotSphere);
  EXPECT_EQ(append_polyhedron({loops, first, 6, 8}, nullptr, table), ShapeDefect::kNotSphere);
}

}  // namespace
