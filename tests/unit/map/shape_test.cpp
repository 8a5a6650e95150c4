// Shapes: the laws of beta1 and beta2 inside of a cell, the cuts of its facets, and what is refused as a shape.

#include "map/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "map/integrity.h"
#include "map/loops.h"

namespace {

using namespace dsw;
using namespace dsw::test;

void expect_laws(const Shape& shape) {
  const uint32_t n = shape.dart_count(), facets = shape.facet_count();
  ASSERT_EQ(shape.vertex_count() + facets, shape.edge_count() + 2) << "Euler";
  ASSERT_EQ(n, 2 * shape.edge_count());
  ASSERT_EQ(shape.facet_first(0), 0u);
  ASSERT_EQ(shape.facet_first(facets), n);
  std::map<uint32_t, int> darts_of_edge;
  uint32_t next_edge = 0;
  for (uint32_t d = 0; d < n; ++d) {
    const uint32_t f = shape.dart_facet(d), opposite = shape.dart_beta2(d);
    ASSERT_TRUE(shape.facet_first(f) <= d && d < shape.facet_first(f + 1));
    ASSERT_LT(shape.dart_vertex(d), shape.vertex_count());
    EXPECT_EQ(shape.dart_facet(shape.beta1(d)), f) << "beta1 stays in its facet";
    EXPECT_EQ(shape.beta0(shape.beta1(d)), d);
    EXPECT_EQ(shape.beta1(shape.beta0(d)), d);
    EXPECT_NE(opposite, d) << "beta2 has no fixed point";
    EXPECT_NE(shape.dart_facet(opposite), f);
    EXPECT_EQ(shape.dart_beta2(opposite), d) << "beta2 is an involution";
    EXPECT_EQ(shape.dart_vertex(opposite), shape.dart_vertex(shape.beta1(d))) << "beta2 turns the edge round";
    EXPECT_EQ(shape.dart_edge(opposite), shape.dart_edge(d));
    ++darts_of_edge[shape.dart_edge(d)];
    if (opposite > d) {
      EXPECT_EQ(shape.dart_edge(d), next_edge++) << "edges are counted when first met";
    }
  }
  ASSERT_EQ(darts_of_edge.size(), shape.edge_count());
  for (const auto& [edge, count] : darts_of_edge) EXPECT_EQ(count, 2) << edge;
  for (uint32_t d = 0; d < n; ++d) {  // beta1 runs through the whole facet, beta1 o beta2 round the whole vertex
    uint32_t e = d, steps = 0;
    do e = shape.beta1(e), ++steps;
    while (e != d);
    EXPECT_EQ(steps, shape.facet_size(shape.dart_facet(d)));
    std::set<uint32_t> round;
    do round.insert(e), e = shape.beta1(shape.dart_beta2(e));
    while (e != d);
    for (uint32_t other = 0; other < n; ++other) {
      EXPECT_EQ(round.count(other) == 1, shape.dart_vertex(other) == shape.dart_vertex(d));
    }
  }
}

/** Triangles of every facet: a fan of its loop, turned like it, each edge of the loop in one triangle. */
void expect_cuts(const Shape& shape) {
  ASSERT_EQ(shape.simplex_count(), shape.dart_count() - 2 * shape.facet_count());
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    std::multiset<std::pair<uint32_t, uint32_t>> open;
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      EXPECT_EQ(shape.simplex_facets(3)[s], f);
      const uint16_t* v = shape.simplices() + 3 * s;
      EXPECT_EQ(v[0], shape.simplices()[3 * shape.simplex_first(f)]) << "a fan";
      for (int k = 0; k < 3; ++k) {
        const auto back = open.find({v[(k + 1) % 3], v[k]});
        if (back != open.end()) {
          open.erase(back);
        } else {
          open.insert({v[k], v[(k + 1) % 3]});
        }
      }
    }
    std::multiset<std::pair<uint32_t, uint32_t>> loop;
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      loop.insert({shape.dart_vertex(d), shape.dart_vertex(shape.beta1(d))});
    }
    EXPECT_EQ(open, loop) << "facet " << f;
  }
}

TEST(Shape, StandardFormsWithEveryCut) {
  const std::pair<Form, uint32_t> forms[] = {
      {Form::kSimplex, 4}, {Form::kPyramid, 5}, {Form::kPrism, 6}, {Form::kBox, 8}};
  for (const auto& [form, vertices] : forms) {
    std::set<std::vector<uint16_t>> all_cuts;
    for (uint32_t cuts = 0; cuts < 1u << quad_count(form); ++cuts) {
      const Shape shape = standard_shape(form, cuts);
      EXPECT_EQ(shape.vertex_count(), vertices);
      expect_laws(shape);
      expect_cuts(shape);
      all_cuts.insert({shape.simplices(), shape.simplices() + 3 * shape.simplex_count()});
      uint32_t quad = 0;
      for (uint32_t f = 0; f < shape.facet_count(); ++f) {
        if (shape.facet_size(f) != 4) continue;
        const uint32_t base = shape.dart_vertex(shape.facet_first(f) + (cuts >> quad++ & 1u));
        EXPECT_EQ(shape.simplices()[3 * shape.simplex_first(f)], base);
      }
    }
    EXPECT_EQ(all_cuts.size(), 1u << quad_count(form));
  }
}

TEST(Shape, PolyhedraCutFromEveryBase) {
  for (const auto& loops : {tetrahedron(), box(), prism_over(3), prism_over(5), prism_over(12), cut_corner()}) {
    for (uint32_t base = 0; base < 12; ++base) {
      std::vector<uint16_t> bases;
      for (const auto& loop : loops) bases.push_back(static_cast<uint16_t>(base % loop.size()));
      Array<uint16_t> table(3, 77);  // tables follow each other
      ASSERT_EQ(append(loops, table, bases.data()), ShapeDefect::kNone);
      const Shape shape(table.data() + 3);
      expect_laws(shape);
      expect_cuts(shape);
      for (uint32_t f = 0; f < shape.facet_count(); ++f) {
        EXPECT_EQ(shape.simplices()[3 * shape.simplex_first(f)], loops[f][bases[f]]);
      }
      EXPECT_TRUE(std::all_of(table.begin(), table.begin() + 3, [](uint16_t w) { return w == 77; }));
    }
  }
}

TEST(Shape, FewVerticesAndManyAreLinkedAlike) {
  for (int n = 3; n <= 40; ++n) {  // a table of ways up to 32 vertices, sorted edges beyond
    const Loops prism = prism_over(n);
    Array<uint16_t> table;
    ASSERT_EQ(append(prism, table), ShapeDefect::kNone) << n;
    expect_laws(Shape(table.data()));
    const auto expect_open = [&](const Loops& loops) {
      Array<uint16_t> none;
      EXPECT_EQ(append(loops, none), ShapeDefect::kOpen) << n;
      EXPECT_TRUE(none.empty());
    };
    Loops turned = prism, missing = prism, twice = prism;
    std::reverse(turned[2].begin(), turned[2].end());  // two darts take one way
    missing.pop_back();                                // a dart without an opposite
    twice.push_back(prism[0]);
    expect_open(turned);
    expect_open(missing);
    expect_open(twice);
  }
}

TEST(Shape, TrianglesAreTakenAsTheyAreGiven) {
  const Loops loops = prism_over(6);
  Array<uint16_t> given, set;
  ASSERT_EQ(append(loops, set), ShapeDefect::kNone);
  const uint16_t three_ears[] = {6, 7, 8, 8, 9, 10, 10, 11, 6, 6, 8, 10};
  set_triangles(set.data(), 1, three_ears);
  const Shape shape(set.data());
  const std::vector<uint16_t> triangles(shape.simplices(), shape.simplices() + 3 * shape.simplex_count());
  std::vector<uint16_t> vertices, first{0};
  for (const auto& loop : loops) {
    vertices.insert(vertices.end(), loop.begin(), loop.end());
    first.push_back(static_cast<uint16_t>(vertices.size()));
  }
  ASSERT_EQ(append_polyhedron({vertices.data(), first.data(), 8, 12}, nullptr, given, triangles.data()),
            ShapeDefect::kNone);
  EXPECT_EQ(given, set);
}

TEST(Shape, AFacetIsCutAnewAloneAndSoundnessFollows) {
  Array<uint16_t> table, scratch;
  ASSERT_EQ(append(prism_over(6), table), ShapeDefect::kNone);
  const Array<uint16_t> before = table;
  const uint16_t three_ears[] = {6, 7, 8, 8, 9, 10, 10, 11, 6, 6, 8, 10};  // no fan
  set_triangles(table.data(), 1, three_ears);
  EXPECT_EQ(sound_table_length<3>(table.data(), table.size(), scratch), table.size());
  size_t changed = 0;
  for (size_t i = 0; i < table.size(); ++i) changed += table[i] != before[i] ? 1u : 0u;
  EXPECT_LE(changed, 12u);
  EXPECT_TRUE(std::equal(three_ears, three_ears + 12,
                         Shape(table.data()).simplices() + 3 * Shape(table.data()).simplex_first(1)));
  const uint16_t bad[][12] = {
      {6, 7, 8, 8, 9, 10, 10, 11, 6, 6, 10, 8},  // the middle turned
      {6, 7, 8, 8, 9, 10, 10, 11, 6, 6, 7, 8},   // one twice, the middle missing
      {6, 7, 8, 6, 8, 9, 6, 9, 10, 6, 10, 10},   // one without area
      {6, 7, 8, 6, 8, 9, 6, 9, 10, 6, 10, 5},    // a vertex of another facet
      {6, 7, 8, 6, 8, 9, 6, 9, 10, 6, 10, 0xffff},
  };
  for (const auto& triangles : bad) {
    set_triangles(table.data(), 1, triangles);
    EXPECT_EQ(sound_table_length<3>(table.data(), table.size(), scratch), 0u);
  }
  EXPECT_EQ(sound_table_length<3>(before.data(), before.size() - 1, scratch), 0u) << "cut off";
}

TEST(Shape, PolyhedronOfAStandardFormHasItsTable) {
  Array<uint16_t> table;
  ASSERT_EQ(append(box(), table), ShapeDefect::kNone);
  EXPECT_TRUE(std::equal(table.begin(), table.end(), standard_shape(Form::kBox, 0).table()));
}

TEST(Shape, DefectsAreNamedAndLeaveTheTablesAlone) {
  const auto reject = [](const Loops& loops, ShapeDefect wanted) {
    Array<uint16_t> table(5, 9);
    EXPECT_EQ(append(loops, table), wanted);
    EXPECT_EQ(table, Array<uint16_t>(5, 9));
  };
  Loops loops = box();
  loops.pop_back();
  reject(loops, ShapeDefect::kOpen);
  loops = box();
  std::reverse(loops[2].begin(), loops[2].end());
  reject(loops, ShapeDefect::kOpen);
  loops = box();
  loops.push_back(loops.back());
  reject(loops, ShapeDefect::kOpen);
  loops = tetrahedron();
  loops[1] = {1, 2};
  reject(loops, ShapeDefect::kShortFacet);
  loops = box();
  loops[0].push_back(loops[0][1]);
  reject(loops, ShapeDefect::kRepeatedVertex);
  reject({{0, 1, 2}, {0, 2, 1}}, ShapeDefect::kOpen);  // flat: too few facets
  reject(torus(), ShapeDefect::kNotSphere);
  reject(two_spheres(), ShapeDefect::kNotSphere);
  loops = torus();  // with a sphere beside it the numbers fit
  uint32_t unused = 0;
  for (const auto& loop : loops) unused = std::max<uint32_t>(unused, 1u + *std::max_element(loop.begin(), loop.end()));
  for (auto loop : tetrahedron()) {
    for (auto& vertex : loop) vertex = static_cast<uint16_t>(vertex + unused);
    loops.push_back(loop);
  }
  reject(loops, ShapeDefect::kNotSphere);
  reject(pinched(), ShapeDefect::kNotSphere);
}

TEST(Shape, SizesBeyondSixteenBitsAreRefused) {
  Array<uint16_t> table;
  Loops loops = prism_over(10922);  // 65532 darts
  loops.push_back({0, 1, 2});
  EXPECT_EQ(append(loops, table), ShapeDefect::kTooLarge);
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(append_polygon(0xffff, table), ShapeDefect::kTooLarge);
  EXPECT_EQ(append_polygon(2, table), ShapeDefect::kShortFacet);
  EXPECT_TRUE(table.empty());
}

TEST(Shape, Polygons) {
  for (const uint32_t n : {3u, 4u, 5u, 100u}) {
    Array<uint16_t> table;
    ASSERT_EQ(append_polygon(n, table), ShapeDefect::kNone);
    const Shape shape(table.data());
    for (const uint32_t count :
         {shape.vertex_count(), shape.facet_count(), shape.edge_count(), shape.dart_count(), shape.simplex_count()}) {
      EXPECT_EQ(count, n);
    }
    for (uint32_t i = 0; i < n; ++i) {
      EXPECT_EQ(shape.facet_first(i), i);
      EXPECT_EQ(shape.simplex_first(i), i);
      EXPECT_EQ(shape.dart_vertex(i), i);
      EXPECT_EQ(shape.simplices()[2 * i], i);
      EXPECT_EQ(shape.simplices()[2 * i + 1], (i + 1) % n);
      EXPECT_EQ(shape.simplex_facets(2)[i], i);
    }
  }
  EXPECT_EQ(planar_shape(3).vertex_count(), 3u);
  EXPECT_EQ(planar_shape(4).vertex_count(), 4u);
}

}  // namespace
