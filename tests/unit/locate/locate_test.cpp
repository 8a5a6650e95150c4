// Locating: every way to ask gives the cell that contains the shifted point; classify gives what lies exactly there.
// On lattices both are known from the coordinates alone.

#include "locate/locate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "environment/marking.h"
#include "environment/moving.h"
#include "environment/test_mesh.h"
#include "locate/classify.h"
#include "locate/inside.h"

namespace {

using namespace dsw;
using namespace dsw::test;

/** The lattice cell of x + e: on a common side the upper one. -1 outside. */
int cell_along(double x, int count) { return x < 0 || x >= count ? -1 : static_cast<int>(std::floor(x)); }

template <int D>
void expect_everywhere(Environment<D>& env, const double* p, Cell expected) {
  for (const TreeUse use : {TreeUse::kLeftOut, TreeUse::kAtOnce}) {
    env.index.set_use(use);
    if (use == TreeUse::kAtOnce) env.index.build(env);
    const bool tree = use == TreeUse::kAtOnce;
    EXPECT_EQ(locate(env, p, Cell{}, nullptr).cell, expected) << "tree " << tree;
    for (uint32_t hint = 0; hint < env.map.cell_count; ++hint) {
      EXPECT_EQ(locate(env, p, env.map.cell(hint), nullptr).cell, expected) << "tree " << tree << " hint " << hint;
    }
  }
}

TEST(Locate, LatticePointsBelongToTheUpperCell) {
  Mesh3 mesh;
  add_boxes(mesh, 3, 2, 2);
  const auto env = mesh.build();
  for (int code = 0; code < 11 * 9 * 9; ++code) {  // halves from -1 on
    const double p[3] = {code % 11 * 0.5 - 1, code / 11 % 9 * 0.5 - 1, code / 99 * 0.5 - 1};
    const int x = cell_along(p[0], 3), y = cell_along(p[1], 2), z = cell_along(p[2], 2);
    const bool inside = x >= 0 && y >= 0 && z >= 0;
    const Cell expected = inside ? env->map.cell(static_cast<uint32_t>(x + 3 * (y + 2 * z))) : Cell{};
    expect_everywhere(*env, p, expected);
    if (HasFailure()) FAIL() << p[0] << " " << p[1] << " " << p[2];
  }
}

TEST(Locate, RoundACornerTheWalkLeavesAndTheScanFinds) {
  Mesh3 mesh;  // a bent row of boxes: the straight way between its ends leads outside
  add_boxes(mesh, 5, 5, 1, 0, 0, 0, 1, [](int x, int y, int) { return x == 0 || y == 4 || x == 4; });
  const auto env = mesh.build();
  for (uint32_t i = 0; i < env->map.cell_count; ++i) {
    double p[3];
    centre(*env, env->map.cell(i), p);
    expect_everywhere(*env, p, env->map.cell(i));
  }
  const double hole[3] = {2.5, 1.5, 0.5}, huge[3] = {1e300, -1e300, 0.5};
  expect_everywhere(*env, hole, Cell{});
  expect_everywhere(*env, huge, Cell{});
}

TEST(Locate, ImpassableCellsAreWalkedThrough) {
  Mesh3 mesh;
  add_boxes(mesh, 7, 1, 1);
  const auto env = mesh.build();
  for (uint32_t i = 1; i < 6; ++i) env->map.record(env->map.cell(i))[0] |= kMarkBit;
  CastCounters counters;
  const double p[3] = {6.5, 0.5, 0.25};
  EXPECT_EQ(locate(*env, p, env->map.cell(0), &counters).cell, env->map.cell(6));
  EXPECT_EQ(counters.casts, 1u);
  EXPECT_EQ(counters.volumes_visited, 7u);
}

TEST(Locate, EveryPointHasExactlyOneCell) {
  const auto env = mixed_mesh().build();
  Random random(17);
  uint32_t inside = 0;
  for (int i = 0; i < at_least(2000); ++i) {
    const double p[3] = {random.below(17) * 0.25 - 1, random.below(17) * 0.25 - 1.5, random.below(17) * 0.25 - 1.5};
    Cell holder;
    for (uint32_t c = 0; c < env->map.cell_count; ++c) {
      if (!contains(*env, env->map.cell(c), p)) continue;
      ASSERT_FALSE(holder.valid()) << "in two cells";
      holder = env->map.cell(c);
    }
    inside += holder.valid() ? 1u : 0u;
    expect_everywhere(*env, p, holder);
  }
  EXPECT_GT(inside, 50u);
}

TEST(Locate, InThePlane) {
  Mesh2 mesh;
  add_squares(mesh, 3, 3);
  const auto env = mesh.build();
  for (int code = 0; code < 81; ++code) {
    const double p[2] = {code % 9 * 0.5 - 0.5, code / 9 * 0.5 - 0.5};
    const int x = cell_along(p[0], 3), y = cell_along(p[1], 3);
    expect_everywhere(*env, p, x >= 0 && y >= 0 ? env->map.cell(static_cast<uint32_t>(x + 3 * y)) : Cell{});
  }
}

/** The first cell in the order of indices that contains a point: what locate promises, also where cells overlap. */
template <int D>
Cell first_that_contains(const Environment<D>& env, const double* p) {
  for (uint32_t i = 0; i < env.map.index_count(); ++i) {
    const Cell c = env.map.cell(i);
    if (c.valid() && admits(env, c) && contains(env, c, p)) return c;
  }
  return {};
}

/** Vertices wander, so that cells turn inside out and lie over each other; some are nowhere. */
template <int D>
void expect_the_first_of_all(Environment<D>& env, const std::vector<double>& points, uint64_t seed) {
  Random random(seed);
  env.index.build(env);
  let_points_move(env);
  int inside = 0, bad = 0;
  for (int round = 0; round < at_least(12); ++round) {
    std::vector<double> moved = points;
    for (double& x : moved) x += 0.2 * round * (random.unit() - 0.5) + 7 * round;
    if (round % 3 == 2) moved[static_cast<size_t>(random.below(50))] = std::nan("");
    env.points = moved.data();
    env.note_move();
    env.checked.forget_all();
    for (int i = 0; i < 300; ++i) {
      double p[D];
      const auto v = static_cast<uint32_t>(random.below(static_cast<int>(env.map.vertex_count)));
      for (int k = 0; k < D; ++k) {
        const double free = 7 * round + 8 * random.unit() - 1, of_vertex = env.point(v)[k];
        p[k] = i % 4 == 0 && std::isfinite(of_vertex) ? of_vertex : i % 4 == 1 ? std::floor(free) : free;
      }
      const Cell expected = first_that_contains(env, p);
      inside += expected.valid() ? 1 : 0;
      ASSERT_EQ(locate(env, p, Cell{}, nullptr).cell, expected) << "round " << round << ", point " << i;
    }
    for_each_cell(env.map, [&](Cell c) { bad += admits(env, c) ? 0 : 1; });
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(bad, 50);
}

TEST(Locate, OfMovedPointsTheFirstCellOfAll) {
  Mesh3 boxes = mixed_mesh();
  add_boxes(boxes, 6, 6, 6, 20, 20, 20);
  for (double& x : boxes.points) x = x < 15 ? x : x - 20;  // the parts overlap, too
  const auto in_space = boxes.build();
  expect_the_first_of_all(*in_space, boxes.points, 5);
  for (const bool cut : {false, true}) {
    Mesh2 squares;
    add_squares(squares, 6, 6, cut);
    const auto in_plane = squares.build();
    expect_the_first_of_all(*in_plane, squares.points, 6);
  }
}

/** A marked facet can be seen from both of its cells. The one with the lower index is told, with or without a tree. */
TEST(Touched, IsSeenFromTheLowerCellHoweverCellsAreFound) {
  Mesh3 mesh;
  add_boxes(mesh, 5, 4, 3);
  Random random(8);
  for (size_t i = mesh.types.size(); i > 1; --i) {
    const auto j = static_cast<size_t>(random.below(static_cast<int>(i)));
    for (size_t k = 0; k < 8; ++k) std::swap(mesh.connectivity[8 * (i - 1) + k], mesh.connectivity[8 * j + k]);
  }
  const auto env = mesh.build();
  for (uint32_t i = 0; i < env->map.cell_count; ++i) {
    const Cell c = env->map.cell(i);
    for (uint32_t f = 0; f < env->map.facets_of(c); ++f) set_facet_mark(*env, env->map.half_facet(c, f), true);
  }
  int inner = 0;
  for (int code = 0; code < 11 * 9 * 7; ++code) {  // halves
    const double p[3] = {code % 11 * 0.5, code / 11 % 9 * 0.5, code / 99 * 0.5};
    env->index.set_use(TreeUse::kLeftOut);
    const SeenObstacle scanned = find_touched(*env, p);
    env->index.set_use(TreeUse::kAtOnce);
    env->index.build(*env);
    const SeenObstacle found = find_touched(*env, p);
    EXPECT_EQ(found.cell, scanned.cell) << code;
    EXPECT_EQ(found.side, scanned.side) << code;
    EXPECT_EQ(found.feature.cell, scanned.feature.cell) << code;
    EXPECT_EQ(found.feature.local, scanned.feature.local) << code;
    if (!found.side.valid() || !env->map.opposite(found.side).valid()) continue;
    ++inner;
    const Cell beyond = env->map.cell_of(env->map.opposite(found.side));
    EXPECT_LT(env->map.index(found.cell), env->map.index(beyond)) << code;
  }
  EXPECT_GT(inner, 100);
}

TEST(Classify, LatticePointsByTheirCoordinates) {
  Mesh3 mesh;
  add_boxes(mesh, 2, 2, 2);
  const auto env = mesh.build();
  for (int code = 0; code < 17 * 17 * 17; ++code) {  // quarters from -1 on: cuts of faces are among them
    const double p[3] = {code % 17 * 0.25 - 1, code / 17 % 17 * 0.25 - 1, code / 289 * 0.25 - 1};
    for (uint32_t i = 0; i < 8; ++i) {
      const Cell c = env->map.cell(i);
      const double* low = env->point(c, 0);
      int free_axes = 0;
      bool closed = true;
      for (int k = 0; k < 3; ++k) {
        closed = closed && p[k] >= low[k] && p[k] <= low[k] + 1;
        free_axes += p[k] > low[k] && p[k] < low[k] + 1 ? 1 : 0;
      }
      bool inside = !closed;
      const FeatureRef feature = classify(*env, p, c, &inside);
      ASSERT_EQ(inside, closed);
      if (!closed) continue;
      ASSERT_EQ(feature.dimension, free_axes);
      ASSERT_EQ(feature.cell, c);
      const Shape shape = env->map.shape(c);
      // The feature named is the one whose vertices span the point: on each axis that is not free all agree with it.
      for (uint32_t d = 0; d < shape.dart_count(); ++d) {
        const bool of_edge = feature.dimension == 1 && shape.dart_edge(d) == feature.local;
        const bool of_face = feature.dimension == 2 && shape.dart_facet(d) == feature.local;
        const bool of_vertex = feature.dimension == 0 && shape.dart_vertex(d) == feature.local;
        if (!of_edge && !of_face && !of_vertex) continue;
        for (int k = 0; k < 3; ++k) {
          if (p[k] == low[k] || p[k] == low[k] + 1) {
            ASSERT_EQ(env->point(c, shape.dart_vertex(d))[k], p[k]);
          }
        }
      }
    }
  }
}

TEST(Classify, ExactBesideAWarpedFaceAndAtAnyScale) {
  for (const double scale : {1.0, 0x1p-900, 0x1p900}) {
    Mesh3 mesh;
    add_boxes(mesh, 1, 1, 1);
    mesh.points[3 * 7 + 2] = 1.5;  // the corner (1, 1, 1) up: the top is cut from vertex 4 at (0, 0, 1) to it
    for (double& x : mesh.points) x *= scale;
    const auto env = mesh.build();
    const Cell c = env->map.cell(0);
    const auto dimension = [&](double x, double y, double z) {
      const double p[3] = {x * scale, y * scale, z * scale};
      bool inside = false;
      const FeatureRef feature = classify(*env, p, c, &inside);
      return inside ? feature.dimension : -1;
    };
    EXPECT_EQ(dimension(0.5, 0.5, 1.25), 2) << "the cut lies in the face, it is no edge";
    EXPECT_EQ(dimension(0.5, 0.5, std::nextafter(1.25, 2)), -1);
    EXPECT_EQ(dimension(0.5, 0.5, std::nextafter(1.25, 1)), 3);
    EXPECT_EQ(dimension(0.75, 0.25, 1.125), 2);
    EXPECT_EQ(dimension(1, 0.5, 1.25), 1);
    EXPECT_EQ(dimension(1, 0.5, std::nextafter(1.25, 1)), 2);
    EXPECT_EQ(dimension(1, 0.5, std::nextafter(1.25, 2)), -1);
    EXPECT_EQ(dimension(1, 1, 1.5), 0);
    EXPECT_EQ(dimension(1, 1, 1), 1);
  }
}

}  // namespace
