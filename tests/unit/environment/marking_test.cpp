// Marks against brute force over the definition, on the map itself: facets from both sides, edges and vertices through
// all cells. In space and in the plane.

#include "environment/marking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "environment/builder.h"

#include "../../effort.h"

namespace {

using namespace dsw;

/** A lattice of n^D unit cells with three regions in stripes along x. */
template <int D>
struct Lattice {
  static constexpr uint32_t kSize = 4;
  Environment<D> env{nullptr};

  Lattice() {
    constexpr uint32_t n = kSize, m = n + 1, nz = D == 3 ? n : 1, mz = D == 3 ? m : 1;
    std::vector<double> points;
    std::vector<int64_t> cells;
    std::vector<int32_t> regions;
    for (uint32_t z = 0; z < mz; ++z) {
      for (uint32_t y = 0; y < m; ++y) {
        for (uint32_t x = 0; x < m; ++x) {
          const uint32_t at[3] = {x, y, z};
          for (int k = 0; k < D; ++k) points.push_back(at[k]);
        }
      }
    }
    for (uint32_t z = 0; z < nz; ++z) {
      for (uint32_t y = 0; y < n; ++y) {
        for (uint32_t x = 0; x < n; ++x) {
          for (uint32_t up = 0; up < (D == 3 ? 2u : 1u); ++up) {
            const int64_t base = x + m * (y + m * (z + up));
            for (const int64_t corner : {base, base + 1, base + 1 + m, base + m}) cells.push_back(corner);
          }
          regions.push_back(static_cast<int32_t>(x % 3));
        }
      }
    }
    dsw_environment_desc input{};
    input.points = points.data();
    input.point_count = points.size() / D;
    input.uniform_cell_type = D == 3 ? 12 : 9;
    input.volume_count = regions.size();
    input.connectivity = cells.data();
    input.connectivity_count = cells.size();
    input.regions = regions.data();
    BuildReport report;
    build(env, check_description<D>(input), report);
  }
};

template <int D, class Visit>
void for_each_facet(const Environment<D>& env, Visit visit) {
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    for (uint32_t f = 0; f < env.map.facets_of(c); ++f) visit(env.map.half_facet(c, f));
  }
}

template <int D>
std::vector<uint32_t> facet_vertices(const Environment<D>& env, HalfFacet h) {
  const Cell c = env.map.cell_of(h);
  const Shape shape = env.map.shape(c);
  const uint32_t f = env.map.local_of(h, c);
  std::vector<uint32_t> out;
  for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
    for (uint32_t k = 0; k < D; ++k) out.push_back(env.map.vertex(c, shape.simplices()[s * D + k]));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

template <class T>
class MarkingTest : public testing::Test {
 protected:
  static constexpr int D = T::value;
  Lattice<D> lattice_;
  Environment<D>& env_ = lattice_.env;
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MarkingTest, Dimensions, );

TYPED_TEST(MarkingTest, CountsStayExactOverRandomMarks) {
  auto& env = this->env_;
  std::mt19937 random(static_cast<uint32_t>(seed_of(3)));
  std::vector<HalfFacet> facets;
  for_each_facet(env, [&](HalfFacet h) { facets.push_back(h); });
  reserve_vertex_marks(env);
  for (int step = 0; step < at_least(5000); ++step) {
    const bool mark = random() % 2 == 0;
    const Cell c = env.map.cell(static_cast<uint32_t>(random() % env.map.cell_count));
    const HalfFacet h = facets[random() % facets.size()];
    const uint32_t v = static_cast<uint32_t>(random() % env.map.vertex_count);
    const bool c_changes = env.map.marked(c) != mark, h_changes = env.map.facet_marked(h) != mark;
    const bool v_changes = vertex_marked(env, v) != mark;
    EXPECT_EQ(set_cell_mark(env, c, mark), c_changes);
    EXPECT_EQ(set_facet_mark(env, h, mark), h_changes);
    EXPECT_EQ(set_vertex_mark(env, v, mark), v_changes);
  }
  uint64_t cells = 0, sides = 0, boundary = 0, vertices = 0;
  for (uint32_t i = 0; i < env.map.cell_count; ++i) cells += env.map.marked(env.map.cell(i)) ? 1u : 0u;
  for (const HalfFacet h : facets) {
    const HalfFacet o = env.map.opposite(h);
    if (o.valid()) {
      EXPECT_EQ(env.map.facet_marked(h), env.map.facet_marked(o));
      EXPECT_EQ(env.map.opposite(o), h);
    }
    if (env.map.facet_marked(h)) ++(o.valid() ? sides : boundary);
  }
  for (uint32_t v = 0; v < env.map.vertex_count; ++v) vertices += vertex_marked(env, v) ? 1u : 0u;
  EXPECT_EQ(env.marked_cells, cells);
  EXPECT_EQ(env.marked_facets, sides / 2 + boundary);
  EXPECT_EQ(env.marked_vertices, vertices);
  EXPECT_GT(boundary, 0u);
}

TYPED_TEST(MarkingTest, RegionsAndTheFacetsBetweenThem) {
  auto& env = this->env_;
  const auto mark_region = [&](int32_t region, bool marked) {
    size_t count = 0;
    for_each_cell_of_region(env, region, [&](Cell c) { count += set_cell_mark(env, c, marked) ? 1u : 0u; });
    return count;
  };
  const auto mark_between = [&](int32_t a, int32_t b, bool marked) {
    size_t count = 0;
    for_each_facet_between(env, a, b, [&](HalfFacet h) { count += set_facet_mark(env, h, marked) ? 1u : 0u; });
    return count;
  };
  for (int32_t a = 0; a < 4; ++a) {
    for (int32_t b = 0; b < 4; ++b) {
      size_t wanted = 0;
      for_each_facet(env, [&](HalfFacet h) {
        const HalfFacet o = env.map.opposite(h);
        if (!o.valid() || h.word > o.word) return;
        const int32_t r = env.region(env.map.cell_of(h)), s = env.region(env.map.cell_of(o));
        wanted += (r == a && s == b) || (r == b && s == a) ? 1u : 0u;
      });
      EXPECT_EQ(mark_between(a, b, true), wanted) << a << " " << b;
      EXPECT_EQ(env.marked_facets, wanted);
      EXPECT_EQ(mark_between(b, a, false), wanted);
      EXPECT_EQ(env.marked_facets, 0u);
    }
    const size_t cells = mark_region(a, true);
    EXPECT_EQ(env.marked_cells, cells);
    EXPECT_EQ(cells == 0, a == 3);
    mark_region(a, false);
    EXPECT_EQ(env.marked_cells, 0u);
  }
}

TYPED_TEST(MarkingTest, AVertexIsImpassableThroughItsFacets) {
  auto& env = this->env_;
  std::mt19937 random(static_cast<uint32_t>(seed_of(5)));
  for (int round = 0; round < at_least(20); ++round) {
    for_each_facet(env, [&](HalfFacet h) { set_facet_mark(env, h, random() % 24 == 0); });
    for (uint32_t i = 0; i < env.map.cell_count; ++i) set_cell_mark(env, env.map.cell(i), random() % 24 == 0);
    std::vector<bool> wanted(env.map.vertex_count, false);
    for_each_facet(env, [&](HalfFacet h) {
      if (!is_impassable(env.map, h)) return;
      for (const uint32_t v : facet_vertices(env, h)) wanted[v] = true;
    });
    for (uint32_t v = 0; v < env.map.vertex_count; ++v) EXPECT_EQ(vertex_impassable(env, v), wanted[v]) << v;
  }
}

TEST(Marking, AnEdgeIsImpassableThroughTheFacesRoundIt) {
  Lattice<3> lattice;
  Environment<3>& env = lattice.env;
  std::mt19937 random(static_cast<uint32_t>(seed_of(11)));
  size_t passable = 0, impassable = 0;
  for (int round = 0; round < at_least(10); ++round) {
    for_each_facet(env, [&](HalfFacet h) { set_facet_mark(env, h, random() % 24 == 0); });
    std::vector<std::pair<uint32_t, uint32_t>> blocked;
    const auto key = [](uint32_t a, uint32_t b) { return std::make_pair(std::min(a, b), std::max(a, b)); };
    for_each_facet(env, [&](HalfFacet h) {
      if (!is_impassable(env.map, h)) return;
      const Cell c = env.map.cell_of(h);
      const Shape shape = env.map.shape(c);
      const uint32_t f = env.map.local_of(h, c);
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
        blocked.push_back(key(dart_vertex(env.map, Dart{c, d}), dart_target(env.map, Dart{c, d})));
      }
    });
    for (uint32_t i = 0; i < env.map.cell_count; ++i) {
      const Cell c = env.map.cell(i);
      for (uint32_t d = 0; d < env.map.shape(c).dart_count(); ++d) {
        const uint32_t a = dart_vertex(env.map, Dart{c, d}), b = dart_target(env.map, Dart{c, d});
        const bool wanted = std::find(blocked.begin(), blocked.end(), key(a, b)) != blocked.end();
        ASSERT_EQ(edge_impassable(env, Dart{c, d}), wanted);
        ++(wanted ? impassable : passable);
      }
    }
  }
  EXPECT_GT(passable, 100u);
  EXPECT_GT(impassable, 100u);
}

TEST(Marking, AMarkedEdgeIsOneMarkWhicheverWayItRuns) {
  Lattice<3> lattice;
  Environment<3>& env = lattice.env;
  reserve_edge_marks(env, 1);
  EXPECT_TRUE(set_edge_mark(env, 7, 6, true));
  EXPECT_FALSE(set_edge_mark(env, 6, 7, true));
  EXPECT_TRUE(edge_marked(env, 6, 7) && edge_marked(env, 7, 6));
  EXPECT_EQ(env.marked_edges, 1u);
  EXPECT_TRUE(set_edge_mark(env, 6, 7, false));
  EXPECT_FALSE(set_edge_mark(env, 6, 7, false));
  EXPECT_EQ(env.marked_edges, 0u);
}

}  // namespace
