// The laws of the map on tiny meshes: single cells of every form and cut, glued pairs, rings round an edge, mixed cells.

#include "map/map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "environment/test_mesh.h"
#include "map/dart.h"
#include "map/integrity.h"

namespace {

using namespace dsw;
using namespace dsw::test;

void expect_records(const Map<3>& map) {
  EXPECT_EQ(check_integrity(map), nullptr);
  std::set<uint32_t> words;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    EXPECT_EQ(map.index(c), i);
    EXPECT_EQ(map.facets_of(c), map.shape(c).facet_count());
    EXPECT_EQ(map.vertices_of(c), map.shape(c).vertex_count());
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      EXPECT_TRUE(words.insert(h.word).second) << "a word of its own";
      EXPECT_EQ(map.cell_of(h), c);
      EXPECT_EQ(map.local_of(h, c), f);
    }
  }
}

void expect_laws(const Map<3>& map) {
  uint32_t darts = 0, facets = 0, boundary = 0;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    for (uint32_t local = 0; local < map.shape(c).dart_count(); ++local, ++darts) {
      const Dart d{c, local};
      EXPECT_EQ(beta2(map, beta2(map, d)), d);
      EXPECT_EQ(dart_vertex(map, beta2(map, d)), dart_target(map, d));
      EXPECT_EQ(dart_vertex(map, beta1(map, d)), dart_target(map, d));
      const Dart across = beta3(map, d);
      EXPECT_EQ(across.cell.valid(), map.opposite(half_facet(map, d)).valid());
      if (!across.cell.valid()) continue;
      EXPECT_EQ(beta3(map, across), d) << "beta3 is an involution";
      EXPECT_NE(across.cell, c);
      EXPECT_EQ(half_facet(map, across), map.opposite(half_facet(map, d)));
      EXPECT_EQ(dart_vertex(map, across), dart_target(map, d)) << "beta3 turns the edge round";
      EXPECT_EQ(dart_target(map, across), dart_vertex(map, d));
      EXPECT_EQ(beta1(map, beta3(map, beta1(map, d))), across) << "beta3 o beta1 is an involution";
    }
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      facets += o.valid() ? 0u : 2u;
      boundary += o.valid() ? 0u : 1u;
      if (!o.valid()) {
        EXPECT_EQ(canonical(map, h), h);
        EXPECT_TRUE(is_impassable(map, h));
        continue;
      }
      ++facets;
      EXPECT_EQ(map.opposite(o), h);
      EXPECT_EQ(canonical(map, h), canonical(map, o));
      EXPECT_LE(map.index(map.cell_of(canonical(map, h))), i);
      EXPECT_FALSE(is_impassable(map, h));
    }
  }
  EXPECT_EQ(facets, 2 * map.facet_count);
  EXPECT_EQ(boundary, map.boundary_facet_count);
  EXPECT_GT(darts, 0u);
}

/** Volumes round every edge, against all darts that have its vertices. Holds where no two edges have the same ends. */
void expect_edge_orbits(const Map<3>& map) {
  std::vector<std::pair<Dart, std::set<uint32_t>>> all;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    for (uint32_t e = 0; e < map.shape(c).edge_count(); ++e) {
      const Dart d = dart_of_edge(map, c, e);
      EXPECT_EQ(map.shape(c).dart_edge(d.local), e);
      const std::set<uint32_t> ends{dart_vertex(map, d), dart_target(map, d)};
      std::set<uint32_t> reached, expected;
      for_each_volume_round_edge(map, d, [&](Dart other) {
        EXPECT_EQ((std::set<uint32_t>{dart_vertex(map, other), dart_target(map, other)}), ends);
        EXPECT_TRUE(reached.insert(map.index(other.cell)).second) << "every volume once";
        return true;
      });
      for (uint32_t j = 0; j < map.cell_count; ++j) {
        const Cell o = map.cell(j);
        for (uint32_t k = 0; k < map.shape(o).dart_count(); ++k) {
          if (std::set<uint32_t>{dart_vertex(map, {o, k}), dart_target(map, {o, k})} == ends) expected.insert(j);
        }
      }
      EXPECT_EQ(reached, expected);
      int calls = 0;
      for_each_volume_round_edge(map, d, [&](Dart) { return ++calls < 1; });
      EXPECT_EQ(calls, 1);
    }
  }
}

void expect_sound(const Mesh3& mesh) {
  const auto env = mesh.build();
  expect_records(env->map);
  expect_laws(env->map);
  expect_edge_orbits(env->map);
}

Mesh3 single(uint8_t type) {
  Mesh3 mesh = mixed_mesh();
  Mesh3 one;
  one.points = mesh.points;
  for (size_t i = 0; i < mesh.types.size(); ++i) {
    if (mesh.types[i] != type) continue;
    one.cell(type, {mesh.connectivity.begin() + mesh.offsets[i], mesh.connectivity.begin() + mesh.offsets[i + 1]});
  }
  return one;
}

TEST(Map, SingleCells) {
  for (const uint8_t type : {kTetra, kHexahedron, kWedge, kPyramid, kPolyhedron}) {
    SCOPED_TRACE(static_cast<int>(type));
    const Mesh3 mesh = single(type);
    ASSERT_EQ(mesh.types.size(), 1u);
    expect_sound(mesh);
    const auto env = mesh.build();
    EXPECT_EQ(env->map.boundary_facet_count, env->map.facets_of(env->map.cell(0)));
  }
}

TEST(Map, LatticesOfBoxes) {
  const int sizes[][3] = {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {2, 2, 2}, {3, 2, 4}};
  for (const auto& size : sizes) {
    Mesh3 mesh;
    add_boxes(mesh, size[0], size[1], size[2]);
    expect_sound(mesh);
  }
}

TEST(Map, MixedCells) { expect_sound(mixed_mesh()); }

/** Wedges round one edge, closed or not; the axis must be met from both sides where the ring is open. */
TEST(Map, RingsRoundAnEdge) {
  for (int wedges = 3; wedges <= 12; ++wedges) {
    for (const bool closed : {true, false}) {
      Mesh3 mesh;
      const int64_t low = mesh.point({0, 0, 0}), high = mesh.point({0, 0, 1});
      const int around = closed ? wedges : wedges + 1;
      std::vector<int64_t> below, above;
      for (int i = 0; i < around; ++i) {
        const int of = 4 * i * (closed ? 12 : 10) / around;  // twelfths of a quarter turn, roughly
        const int quarter = of / 12 % 4, step = of % 12;
        const double x = 12 - step, y = step;
        const double p[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
        below.push_back(mesh.point({p[quarter][0], p[quarter][1], 0}));
        above.push_back(mesh.point({p[quarter][0], p[quarter][1], 1}));
      }
      for (int i = 0; i < wedges; ++i) {
        const size_t a = static_cast<size_t>(i), b = (a + 1) % below.size();
        mesh.cell(kWedge, {low, below[b], below[a], high, above[b], above[a]});
      }
      const auto env = mesh.build();
      expect_records(env->map);
      expect_laws(env->map);
      for (uint32_t start = 0; start < env->map.cell_count; ++start) {
        const Cell c = env->map.cell(start);
        uint32_t edge = 0;
        for (uint32_t d = 0; d < env->map.shape(c).dart_count(); ++d) {
          if (dart_vertex(env->map, {c, d}) == 0 && dart_target(env->map, {c, d}) == 1) edge = env->map.shape(c).dart_edge(d);
        }
        std::set<uint32_t> met;
        for_each_volume_round_edge(env->map, dart_of_edge(env->map, c, edge), [&](Dart d) {
          EXPECT_TRUE(met.insert(env->map.index(d.cell)).second);
          return true;
        });
        EXPECT_EQ(met.size(), static_cast<size_t>(wedges)) << (closed ? "closed" : "open");
      }
    }
  }
}

TEST(Map, ManyFacetsSpreadOverUnits) {
  Mesh3 mesh;  // two prisms over a polygon of 40 corners, one on the other: 42 links and 80 vertices each
  constexpr int kCorners = 40;
  for (int z = 0; z < 3; ++z) {
    for (int i = 0; i < kCorners; ++i) {
      const int side = i / 10, step = i % 10;
      const double x = 10 - step, y = step;
      const double p[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
      mesh.point({p[side][0], p[side][1], 3.0 * z});
    }
  }
  for (int z = 0; z < 2; ++z) {
    std::vector<std::vector<int64_t>> faces(2);
    for (int i = 0; i < kCorners; ++i) {
      const int64_t a = z * kCorners + i, b = z * kCorners + (i + 1) % kCorners;
      faces[0].insert(faces[0].begin(), a);
      faces[1].push_back(a + kCorners);
      faces.push_back({a, b, b + kCorners, a + kCorners});
    }
    mesh.polyhedron(faces);
  }
  expect_sound(mesh);
}

TEST(Map, PlanarMeshes) {
  Mesh2 mesh;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) mesh.point({x * 1.0, y * 1.0});
  }
  for (int64_t y = 0; y < 3; ++y) {
    for (int64_t x = 0; x < 3; ++x) {
      const int64_t a = x + 4 * y;
      if ((x + y) % 2 == 0) {
        mesh.cell(kQuad, {a, a + 1, a + 5, a + 4});
      } else if (x == 1) {
        mesh.cell(kPolygon, {a, a + 1, a + 5, a + 4});
      } else {
        mesh.cell(kTriangle, {a, a + 1, a + 5});
        mesh.cell(kTriangle, {a, a + 5, a + 4});
      }
    }
  }
  const auto env = mesh.build();
  const Map<2>& map = env->map;
  EXPECT_EQ(check_integrity(map), nullptr);
  uint32_t inner = 0;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    EXPECT_EQ(map.index(c), i);
    for (uint32_t local = 0; local < map.facets_of(c); ++local) {
      const Dart d{c, local};
      EXPECT_EQ(dart_vertex(map, beta1(map, d)), dart_target(map, d));
      const Dart across = beta2(map, d);
      if (!across.cell.valid()) continue;
      ++inner;
      EXPECT_EQ(beta2(map, across), d);
      EXPECT_EQ(dart_vertex(map, across), dart_target(map, d));
      EXPECT_EQ(dart_target(map, across), dart_vertex(map, d));
    }
  }
  EXPECT_EQ(map.boundary_facet_count, 12u);
  EXPECT_EQ(map.facet_count, inner / 2 + 12);
}

}  // namespace
