// The laws of the combinatorial map on tiny meshes: all pairs of cell types glued, rings round an edge, polyhedra.

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "map/dart.h"
#include "map/integrity.h"
#include "small_meshes.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;

class BetaTest : public testing::TestWithParam<SmallMesh> {};
class PlanarBetaTest : public testing::TestWithParam<SmallMesh> {};

std::string name_of(const testing::TestParamInfo<SmallMesh>& info) {
  std::string name = info.param.name;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}

/** Calls visit for all darts of a map. */
template <int D, class Visit>
void for_each_dart(const Map<D>& map, const Visit& visit) {
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    for (uint32_t d = 0; d < map.shape(c).dart_count(); ++d) visit(Dart{c, d});
  }
}

TEST_P(BetaTest, Laws) {
  Environment<3> env(nullptr);
  build_mesh(env, GetParam());
  const Map<3>& map = env.map;
  ASSERT_STREQ(check_integrity(map), nullptr);
  uint32_t missing = 0;
  for_each_dart(map, [&](Dart d) {
    const uint32_t from = dart_vertex(map, d), to = dart_target(map, d);
    EXPECT_NE(from, to);
    const Dart b2 = beta2(map, d);
    EXPECT_EQ(beta2(map, b2), d);
    EXPECT_EQ(dart_vertex(map, b2), to);
    EXPECT_EQ(dart_target(map, b2), from);
    EXPECT_EQ(half_facet(map, beta1(map, d)), half_facet(map, d));
    const Dart b3 = beta3(map, d);
    if (!b3.cell.valid()) {
      ++missing;
      EXPECT_FALSE(map.opposite(half_facet(map, d)).valid());
      EXPECT_FALSE(beta3(map, beta1(map, d)).cell.valid()) << "a whole facet has a far side, or none of it";
      return;
    }
    EXPECT_NE(b3.cell, d.cell);
    EXPECT_EQ(beta3(map, b3), d);
    EXPECT_EQ(dart_vertex(map, b3), to);
    EXPECT_EQ(dart_target(map, b3), from);
    EXPECT_EQ(half_facet(map, b3), map.opposite(half_facet(map, d)));
    // beta1 o beta3 is an involution: the facet is the same loop seen from both sides.
    const Dart there = beta1(map, beta3(map, d));
    EXPECT_EQ(beta1(map, beta3(map, there)), d);
  });
  uint32_t boundary_darts = 0, facets = 0, boundary = 0;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    EXPECT_EQ(map.index(c), i);
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      EXPECT_EQ(map.cell_of(h), c);
      EXPECT_EQ(map.local_of(h, c), f);
      EXPECT_EQ(canonical(map, h), canonical(map, canonical(map, h)));
      if (canonical(map, h) == h) ++facets;
      if (map.opposite(h).valid()) {
        EXPECT_EQ(canonical(map, h), canonical(map, map.opposite(h)));
      } else {
        ++boundary;
        boundary_darts += map.shape(c).facet_size(f);
      }
    }
  }
  EXPECT_EQ(missing, boundary_darts);
  EXPECT_EQ(facets, map.facet_count);
  EXPECT_EQ(boundary, map.boundary_facet_count);
}

TEST_P(BetaTest, EveryWalkRoundAnEdgeVisitsTheSameVolumesOnce) {
  Environment<3> env(nullptr);
  build_mesh(env, GetParam());
  const Map<3>& map = env.map;
  using Edge = std::pair<uint32_t, uint32_t>;
  std::map<Edge, std::set<uint32_t>> volumes;  // by vertices: in these meshes they name an edge
  for_each_dart(map, [&](Dart d) {
    const Edge edge = std::minmax(dart_vertex(map, d), dart_target(map, d));
    volumes[edge].insert(map.index(d.cell));
  });
  size_t longest = 0;
  for_each_dart(map, [&](Dart d) {
    const Edge edge = std::minmax(dart_vertex(map, d), dart_target(map, d));
    std::set<uint32_t> seen;
    uint32_t visits = 0;
    for_each_volume_round_edge(map, d, [&](Dart e) {
      EXPECT_EQ(Edge(std::minmax(dart_vertex(map, e), dart_target(map, e))), edge);
      seen.insert(map.index(e.cell));
      ++visits;
      return visits < 1000;
    });
    EXPECT_EQ(seen, volumes[edge]);
    EXPECT_EQ(visits, seen.size());
    longest = std::max(longest, seen.size());
    uint32_t stopped = 0;
    for_each_volume_round_edge(map, d, [&](Dart) { return ++stopped < 1; });
    EXPECT_EQ(stopped, 1u);
  });
  if (GetParam().name.rfind("ring", 0) == 0) {
    EXPECT_EQ(longest, map.cell_count);
  }
}

TEST_P(BetaTest, DartsOfEdges) {
  Environment<3> env(nullptr);
  build_mesh(env, GetParam());
  const Map<3>& map = env.map;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    for (uint32_t e = 0; e < map.shape(c).edge_count(); ++e) {
      const Dart d = dart_of_edge(map, c, e);
      EXPECT_EQ(map.shape(c).dart_edge(d.local), e);
      EXPECT_LT(d.local, beta2(map, d).local) << "the first of the two";
    }
  }
}

/** V - E + F - C is 1 for every part that is a ball. */
TEST_P(BetaTest, EulerCharacteristic) {
  Environment<3> env(nullptr);
  build_mesh(env, GetParam());
  const Map<3>& map = env.map;
  std::set<uint32_t> vertices;
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for_each_dart(map, [&](Dart d) {
    vertices.insert(dart_vertex(map, d));
    edges.insert(std::minmax(dart_vertex(map, d), dart_target(map, d)));
  });
  EXPECT_EQ(vertices.size() + map.facet_count, edges.size() + map.cell_count + env.part_count);
}

INSTANTIATE_TEST_SUITE_P(Small, BetaTest, testing::ValuesIn(small_meshes()), name_of);

TEST_P(PlanarBetaTest, Laws) {
  Environment<2> env(nullptr);
  build_mesh(env, GetParam());
  const Map<2>& map = env.map;
  ASSERT_STREQ(check_integrity(map), nullptr);
  uint32_t missing = 0;
  std::set<uint32_t> vertices;
  for_each_dart(map, [&](Dart d) {
    vertices.insert(dart_vertex(map, d));
    Dart e = d;
    for (uint32_t k = 0; k < map.facets_of(d.cell); ++k) e = beta1(map, e);
    EXPECT_EQ(e, d);
    const Dart b2 = beta2(map, d);
    if (!b2.cell.valid()) {
      ++missing;
      return;
    }
    EXPECT_EQ(beta2(map, b2), d);
    EXPECT_EQ(dart_vertex(map, b2), dart_target(map, d));
    EXPECT_EQ(dart_target(map, b2), dart_vertex(map, d));
  });
  EXPECT_EQ(missing, map.boundary_facet_count);
  EXPECT_EQ(vertices.size() + map.cell_count, map.facet_count + env.part_count) << "V - E + F is 1 for a disc";
}

INSTANTIATE_TEST_SUITE_P(Small, PlanarBetaTest, testing::ValuesIn(planar_meshes()), name_of);

}  // namespace
