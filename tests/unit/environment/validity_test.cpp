// When a cell is valid: what is found out with few questions against all of them.
#include "environment/validity.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "environment/moving.h"
#include "predicates/filtered.h"
#include "test_mesh.h"

namespace dsw::test {
namespace {

bool is_valid(CellState state) { return state == CellState::kValid || state == CellState::kValidConvex; }

/** Sets the points of an environment of one box, all of them. */
struct MovingBox {
  explicit MovingBox(int turn) {
    Mesh3 mesh;
    std::vector<int64_t> corners;
    for (int i = 0; i < 8; ++i) {
      const int local = (i + turn) % 8;  // other numbers, other cuts
      const bool x = (local & 3) == 1 || (local & 3) == 2, y = (local & 3) >= 2, z = local >= 4;
      mesh.point({double(x), double(y), double(z)});
    }
    for (int local = 0; local < 8; ++local) corners.push_back((local + 8 - turn) % 8);
    mesh.cell(kHexahedron, corners);
    env = mesh.build();
    let_points_move(*env);
    points.assign(env->points, env->points + 24);
    rest = points;
    env->points = points.data();
    env->note_move();
  }
  bool admits_now() {
    env->checked.forget_all();
    return admits(*env, env->map.cell(0));
  }
  std::unique_ptr<Environment<3>> env;
  std::vector<double> points, rest;
};

TEST(Validity, FewQuestionsAndAllOfThemGiveOneAnswer) {
  Random random(5);
  int valid = 0, invalid = 0;
  for (int turn = 0; turn < 8; ++turn) {
    MovingBox box(turn);
    for (int i = 0; i < at_least(4000); ++i) {
      const double reach = 0.25 * (i % 8 + 1), scale = i % 3 == 0 ? 0x1p-330 : i % 3 == 1 ? 0x1p+350 : 1;
      const bool coarse = i % 2 == 0;  // many volumes that are exactly 0
      for (size_t k = 0; k < 24; ++k) {
        const double shift = coarse ? 0.5 * (random.below(5) - 2) * (random.below(8) < i % 8) : random.unit() * 2 - 1;
        box.points[k] = scale * (box.rest[k] + reach * shift);
      }
      const bool expected = is_valid(check_cell(*box.env, box.env->map.cell(0)));
      ASSERT_EQ(box.admits_now(), expected) << "turn " << turn << ", box " << i;
      (expected ? valid : invalid) += 1;
    }
  }
  EXPECT_GT(valid, 4000);
  EXPECT_GT(invalid, 4000);
}

/** Whether no vertex lies beyond a facet, all of a facet lie in its plane, and no facet has a corner that turns in. */
bool is_plainly_convex(const Environment<3>& env, Cell c) {
  const Shape shape = env.map.shape(c);
  double apex[3];
  centre(env, c, apex);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const double* plane[3];
    simplex_points(env, c, shape, shape.simplex_first(f), plane);
    for (uint32_t k = 0; k < shape.vertex_count(); ++k) {
      if (orient<3>(plane, env.point(c, k)) > 0) return false;
    }
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      if (orient<3>(plane, env.point(c, shape.dart_vertex(d))) != 0) return false;
      const double* const turn[3] = {env.point(c, shape.dart_vertex(shape.beta0(d))),
                                     env.point(c, shape.dart_vertex(d)),
                                     env.point(c, shape.dart_vertex(shape.beta1(d)))};
      if (orient<3>(turn, apex) > 0) return false;
    }
  }
  return true;
}

/** Tetrahedra that are flat, nearly flat and of any size; in some a number is missing. */
TEST(Validity, ATetrahedronIsValidIfItsVolumeIsPositive) {
  Mesh3 mesh;
  for (const auto& at : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    mesh.point({at[0], at[1], at[2]});
  }
  mesh.cell(kTetra, {0, 1, 2, 3});
  const auto env = mesh.build();
  let_points_move(*env);
  const std::vector<double> rest(env->points, env->points + 12);
  std::vector<double> points = rest;
  env->points = points.data();
  env->note_move();
  Random random(7);
  int valid = 0, invalid = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    const double scale = i % 3 == 0 ? 0x1p-330 : i % 3 == 1 ? 0x1p+350 : 1;
    for (size_t k = 0; k < 12; ++k) {
      points[k] = scale * (rest[k] + (i % 2 == 0 ? 0.5 * (random.below(5) - 2) : random.unit() * 2 - 1));
    }
    // The last vertex nearly in the plane of the others.
    for (size_t k = 0; i % 5 == 0 && k < 3; ++k) points[9 + k] = (points[k] + points[3 + k] + points[6 + k]) / 3;
    const bool is_number = i % 7 != 0;
    if (!is_number) {
      points[static_cast<size_t>(random.below(12))] =
          i % 14 == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    }
    const bool expected = is_number && is_valid(check_cell(*env, env->map.cell(0)));
    env->checked.forget_all();
    ASSERT_EQ(admits(*env, env->map.cell(0)), expected) << i;
    (expected ? valid : invalid) += 1;
  }
  EXPECT_GT(valid, 2000);
  EXPECT_GT(invalid, 2000);
}

// Boxes of the lattice with vertices on edges and facets cut in two, as cuts leave them: flat facets in one plane,
// vertices in a line.
TEST(Validity, ConvexIfNoVertexIsBeyondAFacet) {
  const std::vector<std::vector<int64_t>> faces = {{0, 4, 7, 3},    {1, 8, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2},
                                                   {0, 3, 9, 8, 1}, {9, 2, 8},       {4, 5, 6, 7}, {3, 2, 9}};
  Mesh3 mesh;
  for (int i = 0; i < 8; ++i) {
    const bool x = (i & 3) == 1 || (i & 3) == 2, y = (i & 3) >= 2;
    mesh.point({x ? 4.0 : 0.0, y ? 4.0 : 0.0, i >= 4 ? 4.0 : 0.0});
  }
  mesh.point({4, 2, 0});
  mesh.point({3, 3, 0});
  mesh.polyhedron(faces);
  const auto env = mesh.build();
  let_points_move(*env);
  std::vector<double> points(env->points, env->points + 30);
  const std::vector<double> rest = points;
  env->points = points.data();
  env->note_move();
  const Cell c = env->map.cell(0);
  ASSERT_EQ(check_cell(*env, c), CellState::kValidConvex);
  Random random(8);
  int convex = 0, others = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    const double scale = i % 3 == 0 ? 0x1p-330 : i % 3 == 1 ? 0x1p+350 : 1;
    for (size_t k = 0; k < 30; ++k) {
      const int shift = random.below(8) == 0 ? random.below(3) - 1 : 0;
      points[k] = scale * (rest[k] + (i % 2 == 0 && k < 24 ? 0 : shift));
    }
    const CellState state = check_cell(*env, c);
    if (!is_valid(state)) continue;
    ASSERT_EQ(state == CellState::kValidConvex, is_plainly_convex(*env, c)) << i;
    (state == CellState::kValidConvex ? convex : others) += 1;
  }
  EXPECT_GT(convex, 500);
  EXPECT_GT(others, 500);
}

TEST(Validity, HexahedraStayFlatUntilPointsMove) {
  Mesh3 mesh;
  add_boxes(mesh, 2, 1, 1);
  const auto env = mesh.build();
  const Cell c = env->map.cell(0);
  let_points_move(*env);
  EXPECT_FALSE(env->has_moved());
  EXPECT_TRUE(env->map.convex(c));
  EXPECT_TRUE(admits(*env, c));
  mesh.points[2] -= 0.25;  // the first vertex: three facets of the first box bend
  env->points = mesh.points.data();
  env->note_move();
  EXPECT_TRUE(env->has_moved());
  EXPECT_FALSE(env->map.convex(c));
  EXPECT_TRUE(admits(*env, c));
}

TEST(Validity, PointsThatAreNoNumbers) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    MovingBox box(0);
    for (size_t k = 0; k < 24; ++k) {
      box.points = box.rest;
      EXPECT_TRUE(box.admits_now());
      box.points[k] = bad;
      EXPECT_FALSE(box.admits_now());
      box.points[k] = -bad;
      EXPECT_FALSE(box.admits_now());
    }
  }
}

// A prism over a facet that is not convex, seen from its centre: only its cut makes it valid.
TEST(Validity, DependsOnTheCut) {
  for (int turn = 0; turn < 8; ++turn) {
    MovingBox box(turn);
    for (size_t v = 0; v < 8; ++v) {
      if (box.rest[3 * v] == 1 && box.rest[3 * v + 1] == 1) box.points[3 * v] = box.points[3 * v + 1] = 0.45;
    }
    EXPECT_EQ(box.admits_now(), is_valid(check_cell(*box.env, box.env->map.cell(0)))) << turn;
  }
}

}  // namespace
}  // namespace dsw::test
