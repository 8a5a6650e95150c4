// What the cells round a ridge have to be, one thing after the other. moving_corridors_test.cpp has ways of all kinds.
#include "corridor/ridge_rings.h"

#include <gtest/gtest.h>

#include "edge_ground.h"
#include "locate/locate.h"

namespace dsw::test {
namespace {

/** Eight triangles round vertex 0; in space eight tetrahedra round the ridge from vertex 0 to vertex 8. An edge goes past
 * it. Its ends stay in the cells 3 and 7; before, it passes the cells in between on one side, then those on the other. */
template <class Dimension>
class RidgeRingsTest : public testing::Test {
 protected:
  static constexpr int D = Dimension::value;
  static constexpr uint32_t kCells = 8, kFirst = D == 2 ? 1 : 2;

  RidgeRingsTest() { build({}); }
  void build(const std::vector<uint32_t>& left_out) {
    TestMesh<D> mesh;
    const auto point = [&](double x, double y, double z) { D == 2 ? mesh.point({x, y}) : mesh.point({x, y, z}); };
    point(0, 0, 0);
    if (D == 3) point(0.05, 0.02, 2);
    for (uint32_t i = 0; i < kCells; ++i) {
      const double angle = 0.78539816339744831 * (i + 0.5);
      point(2 * std::cos(angle), 2 * std::sin(angle), 1.1);
    }
    for (uint32_t i = 0; i < kCells; ++i) {
      if (std::find(left_out.begin(), left_out.end(), i) != left_out.end()) continue;
      if (D == 2) mesh.cell(kTriangle, {0, spoke(i), spoke(i + 1)});
      if (D == 3) mesh.cell(kTetra, {0, spoke(i), spoke(i + 1), 1});
    }
    env_ = mesh.build();
    reserve_vertex_marks(*env_);
    reserve_edge_marks(*env_, 8);
  }
  static uint32_t spoke(uint32_t i) { return kFirst + i % kCells; }
  Cell cell(uint32_t i) const { return env_->map.cell(i % kCells); }
  /** Between cell i and the next. */
  HalfFacet facet_after(uint32_t i) const {
    const Map<D>& map = env_->map;
    for (uint32_t f = 0; f <= D; ++f) {
      const HalfFacet h = map.half_facet(cell(i), f), o = map.opposite(h);
      if (o.valid() && map.cell_of(o) == cell(i + 1)) return h;
    }
    return {};
  }
  /** At the rim of a cell. */
  HalfFacet rim(uint32_t i) const {
    for (uint32_t f = 0; f <= D; ++f) {
      const HalfFacet h = env_->map.half_facet(cell(i), f);
      if (!env_->map.opposite(h).valid()) return h;
    }
    return {};
  }
  /** Whether the edge is known to be free, whichever way it goes. */
  bool are_free(double low = -0.05, double high = 0.06) {
    const auto at = [&](double x, double y) {
      Point<D> p{x, y};
      if (D == 3) p[2] = 1;
      return p;
    };
    KnownRings<D> rings(*env_);
    const Way<D> up{{at(-1.5, low), at(1.4, low)}, {at(-1.45, high), at(1.42, high)}};
    const Way<D> down{{up.to[0], up.to[1]}, {up.from[0], up.from[1]}};
    const Way<D> back{{up.from[1], up.from[0]}, {up.to[1], up.to[0]}};
    const Cell start = locate(*env_, up.from[0].data(), Cell{}, nullptr).cell;
    const Cell other = locate(*env_, up.from[1].data(), Cell{}, nullptr).cell;
    const bool free[3] = {rings.are_free(up, start), rings.are_free(down, start), rings.are_free(back, other)};
    EXPECT_TRUE(free[0] == free[1] && free[0] == free[2]);
    return free[0];
  }

  std::unique_ptr<Environment<D>> env_;
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RidgeRingsTest, Dimensions, );

TYPED_TEST(RidgeRingsTest, ARidgeMayBePassedWhereAllCellsRoundItArePassable) {
  EXPECT_TRUE(this->are_free());
  EXPECT_TRUE(this->are_free(-0.05, 0)) << "it ends in the middle";
}

TYPED_TEST(RidgeRingsTest, EachFacetAtTheRidgeCounts) {
  for (uint32_t i = 0; i < 8; ++i) {
    ASSERT_TRUE(this->facet_after(i).valid());
    set_facet_mark(*this->env_, this->facet_after(i), true);
    EXPECT_FALSE(this->are_free()) << i;
    set_facet_mark(*this->env_, this->facet_after(i), false);
    ASSERT_TRUE(this->rim(i).valid());
    set_facet_mark(*this->env_, this->rim(i), true);
    EXPECT_TRUE(this->are_free()) << i;
  }
}

TYPED_TEST(RidgeRingsTest, EachCellAtTheRidgeCounts) {
  for (uint32_t i = 0; i < 8; ++i) {
    set_cell_mark(*this->env_, this->cell(i), true);
    EXPECT_FALSE(this->are_free()) << i;
    set_cell_mark(*this->env_, this->cell(i), false);
  }
}

TYPED_TEST(RidgeRingsTest, TheRidgeItselfCounts) {
  constexpr uint32_t kMost = TestFixture::D - 1;
  for (uint32_t v = 0; v < this->env_->map.vertex_count; ++v) {
    set_vertex_mark(*this->env_, v, true);
    EXPECT_EQ(this->are_free(), kMost == 2 || v >= kMost) << v << ": in space an edge meets no vertex";
    set_vertex_mark(*this->env_, v, false);
  }
  if constexpr (kMost == 2) {
    for (uint32_t i = 0; i < 8; ++i) set_edge_mark(*this->env_, i % 2, this->spoke(i), true);
    EXPECT_TRUE(this->are_free());
    set_edge_mark(*this->env_, 0, 1, true);
    EXPECT_FALSE(this->are_free());
  }
}

TYPED_TEST(RidgeRingsTest, TheOuterBoundaryCounts) {
  for (const uint32_t i : {0u, 1u, 2u, 4u, 5u, 6u}) {
    this->build({i});
    EXPECT_FALSE(this->are_free()) << i;
    EXPECT_EQ(this->are_free(-0.05, -0.01), i < 3) << "it does not come to the ridge";
  }
  this->build({0, 2});
  EXPECT_FALSE(this->are_free()) << "two fans touch each other in the ridge";
}

/** Two walls divide what is round the ridge into two fans, and the paths of the ends come through both. Which one comes first
 * does not matter. */
TYPED_TEST(RidgeRingsTest, AllFansThatAreReachedCount) {
  constexpr int kAxes = TestFixture::D;
  Environment<kAxes>& env = *this->env_;
  for (const uint32_t wall : {0u, 4u}) set_facet_mark(env, this->facet_after(wall), true);
  RidgeRings<kAxes> rings(env);
  std::vector<std::vector<uint32_t>> found;
  for (const bool swapped : {false, true}) {
    const HalfFacet through[2] = {this->facet_after(2), this->facet_after(6)};
    const Array<uint32_t> paths[2] = {{{through[swapped ? 1 : 0].word}, nullptr},
                                      {{through[swapped ? 0 : 1].word}, nullptr}};
    const double from[3] = {-1.5, -0.05, 1}, from_to[3] = {-1.45, 0.06, 1}, to[3] = {1.4, -0.05, 1},
                 to_to[3] = {1.42, 0.06, 1};
    ASSERT_TRUE(rings.find(KnownRings<kAxes>::none(), EdgeWay::of_both(from, from_to, to, to_to), paths));
    const CandidateView<kAxes> features = rings.features();
    const Candidate* const ridge = std::find_if(features.begin(), features.end(), [](const Candidate& each) {
      return each.name.vertices[0] == 0 && each.name.vertices[1] == (kAxes == 3 ? 1u : 0u);
    });
    ASSERT_NE(ridge, features.end());
    EXPECT_EQ(ridge->plane_end - ridge->first_plane, 4u) << "each wall from both sides";
    found.push_back(
        {static_cast<uint32_t>(features.last - features.first), canonical(env.map, ridge->name.facet).word});
  }
  EXPECT_EQ(found[0], found[1]);
}

TYPED_TEST(RidgeRingsTest, CellsThatAreNotValidAnyMoreCount) {
  constexpr int kAxes = TestFixture::D;
  Environment<kAxes>& env = *this->env_;
  let_points_move(env);
  std::vector<double> points(env.points, env.points + size_t{kAxes} * env.map.vertex_count);
  const auto move = [&](uint32_t spoke, double angle) {
    double* const p = &points[kAxes * this->spoke(spoke)];
    p[0] = 2 * std::cos(angle);
    p[1] = 2 * std::sin(angle);
    env.points = points.data();
    env.note_move();
    env.checked.forget_all();
  };
  move(1, 1.3);
  EXPECT_TRUE(this->are_free());
  move(1, 2.1);  // beyond the next
  ASSERT_FALSE(admits(env, this->cell(1)));
  EXPECT_FALSE(this->are_free());
  move(1, 1.2);
  EXPECT_TRUE(this->are_free());
}

/** Tetrahedra, pyramids, prisms and hexahedra; it does not matter on which way. */
TEST(RidgeRings, KnowConvexCellsOfAllForms) {
  const Mesh3 mesh = mixed_mesh();
  const auto env = mesh.build();
  Obstacles<3> obstacles(*env);
  obstacles.collect();
  KnownRings<3> rings(*env);
  const Point<3> of_cells[] = {
      {0.51, 0.52, 0.53}, {0.49, 0.51, 1.2}, {0.5, -0.2, 1.7}, {1.3, 0.52, 0.31}, {0.52, 0.51, -0.4}};
  int known = 0, all = 0;
  for (const Point<3>& p : of_cells) {
    const Cell start = locate(*env, p.data(), Cell{}, nullptr).cell;
    ASSERT_TRUE(start.valid());
    for (const Point<3>& to : of_cells) {
      Point<3> q = p;
      for (size_t k = 0; k < 3; ++k) q[k] += 0.01;
      for (const Way<3>& way : {Way<3>{{p, q}, {to, q}}, Way<3>{{q, p}, {q, to}}}) {
        const bool is_free = rings.are_free(way, start);
        ASSERT_FALSE(is_free && obstacles.touch(way));
        known += is_free ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GE(known, all / 2);
}

/** Along a row of boxes: each one that is entered has four more ridges to ask about. */
TEST(RidgeRings, GiveUpWhereTooManyRidgesAreAsked) {
  Mesh3 mesh;
  add_boxes(mesh, 200, 1, 1);
  const auto env = mesh.build();
  KnownRings<3> rings(*env);
  for (const double end : {10.0, 30.0, 60.0, 190.0, 20.0}) {
    const Way<3> way{{{0.5, 0.4, 0.6}, {0.7, 0.5, 0.5}}, {{end + 0.5, 0.4, 0.6}, {end + 0.7, 0.5, 0.5}}};
    const Way<3> back{{way.to[0], way.to[1]}, {way.from[0], way.from[1]}};
    EXPECT_EQ(rings.are_free(way, env->map.cell(0)), end < 40) << end;
    EXPECT_EQ(rings.are_free(back, env->map.cell(static_cast<uint32_t>(end))), end < 40) << end;
  }
}

/** One end goes straight through a polygon that is not convex, and passes two of its sides. The edge passes both at all
 * times after that, and yet a corner of the polygon comes in its way. */
TEST(RidgeRings, KnowNothingOfWhatIsNotConvex) {
  for (const bool is_free : {true, false}) {
    Mesh2 mesh;
    for (const double y : {0.0, 1.0, 2.0}) {
      for (const double x : {-2.0, 0.0, 1.0, 2.0, 3.0}) mesh.point({x, y});
    }
    mesh.cell(kQuad, {5, 6, 11, 10});
    mesh.cell(kPolygon, {1, 2, 3, 8, 7, 12, 11, 6});
    mesh.cell(kQuad, {3, 4, 9, 8});
    mesh.cell(kQuad, {7, 8, 13, 12});
    const auto env = mesh.build();
    set_cell_mark(*env, env->map.cell(3), true);
    const double end = is_free ? 1.35 : 1.5;
    const Way<2> way{{{-0.05, 1.15}, {-1, 1.3}}, {{2.9, 0.65}, {-1, end}}};
    Obstacles<2> obstacles(*env);
    obstacles.collect();
    ASSERT_EQ(obstacles.touch(way), !is_free);
    KnownRings<2> rings(*env);
    EXPECT_FALSE(rings.are_free(way, env->map.cell(0)));
  }
}

}  // namespace
}  // namespace dsw::test
