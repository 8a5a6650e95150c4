// When a cell is valid: what is found out with few questions against all of them.
#include "environment/validity.h"

#include <gtest/gtest.h>

#include <limits>

#include "environment/moving.h"
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
    for (int i = 0; i < 4000; ++i) {
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
