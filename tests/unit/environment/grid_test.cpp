// The locate grid: every bucket lists, ascending, exactly the cells whose box it may be asked for; lists are short.

#include "environment/grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

/** Points of the box of every cell find the cell in their bucket; corners and middles included. */
template <int D>
void expect_every_cell_listed(const Environment<D>& env) {
  ASSERT_EQ(env.grid.first.size(), [&] {
    size_t n = 1;
    for (const uint32_t size : env.grid.size) n *= size;
    return n + 1;
  }());
  ASSERT_EQ(env.grid.first.back(), env.grid.cells.size());
  for (size_t b = 0; b + 1 < env.grid.first.size(); ++b) {
    const auto begin = env.grid.cells.begin() + env.grid.first[b], end = env.grid.cells.begin() + env.grid.first[b + 1];
    ASSERT_TRUE(std::is_sorted(begin, end));
    ASSERT_EQ(std::adjacent_find(begin, end), end);
  }
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    double low[D], high[D];
    for (int k = 0; k < D; ++k) low[k] = high[k] = env.point(c, 0)[k];
    for (uint32_t v = 1; v < env.map.vertices_of(c); ++v) {
      for (int k = 0; k < D; ++k) {
        low[k] = std::min(low[k], env.point(c, v)[k]);
        high[k] = std::max(high[k], env.point(c, v)[k]);
      }
    }
    for (int code = 0; code < (D == 3 ? 27 : 9); ++code) {
      double p[D];
      int digits = code;
      for (int k = 0; k < D; ++k, digits /= 3) {
        p[k] = digits % 3 == 0 ? low[k] : digits % 3 == 1 ? high[k] : low[k] / 2 + high[k] / 2;
      }
      size_t bucket = 0;
      ASSERT_TRUE(find_bucket(env.grid, env.upper, p, &bucket));
      const auto begin = env.grid.cells.begin() + env.grid.first[bucket];
      ASSERT_TRUE(std::binary_search(begin, env.grid.cells.begin() + env.grid.first[bucket + 1], i)) << "cell " << i;
    }
  }
}

TEST(Grid, ListsEveryCellWhereItLies) {
  for (const double scale : {1.0, 1e-320, 1e-100, 1e100, 1e307}) {
    Mesh3 mesh = mixed_mesh();
    for (double& x : mesh.points) x *= 4 * scale;
    const auto env = mesh.build();
    build_grid(*env);
    expect_every_cell_listed(*env);
  }
  Mesh3 mesh;
  add_boxes(mesh, 20, 3, 1, -7, 1e3, 0, 0.3);
  const auto env = mesh.build();
  build_grid(*env);
  expect_every_cell_listed(*env);
}

TEST(Grid, InThePlane) {
  Mesh2 mesh;
  for (int y = 0; y <= 9; ++y) {
    for (int x = 0; x <= 9; ++x) mesh.point({x * 0.7, y * 0.1});
  }
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const int64_t a = x + 10 * y;
      if (x % 2 == 0) {
        mesh.cell(kQuad, {a, a + 1, a + 11, a + 10});
      } else {
        mesh.cell(kTriangle, {a, a + 1, a + 11});
        mesh.cell(kTriangle, {a, a + 11, a + 10});
      }
    }
  }
  const auto env = mesh.build();
  build_grid(*env);
  expect_every_cell_listed(*env);
}

TEST(Grid, StaysInProportionWhenCellsDiffer) {
  Mesh3 mesh;  // a fine block under one huge box
  add_boxes(mesh, 16, 16, 16, 0, 0, 0, 0.01);
  const double lower[3] = {-500, -500, 1}, upper[3] = {500, 500, 900};
  add_box(mesh, lower, upper);
  const auto env = mesh.build();
  build_grid(*env);
  expect_every_cell_listed(*env);
  EXPECT_LE(env->grid.cells.size(), 8u * env->map.cell_count + 64);
}

TEST(Grid, PointsBeyondTheBoxHaveNoBucket) {
  Mesh3 mesh;
  add_boxes(mesh, 2, 2, 2);
  const auto env = mesh.build();
  build_grid(*env);
  size_t bucket = 0;
  const double inside[3] = {2, 2, 2};
  EXPECT_TRUE(find_bucket(env->grid, env->upper, inside, &bucket));
  for (int k = 0; k < 3; ++k) {
    for (const double beyond : {-0x1p-1074, 0x1.0000000000001p1, -1e308, 1e308}) {
      double p[3] = {1, 1, 1};
      p[k] = beyond;
      EXPECT_FALSE(find_bucket(env->grid, env->upper, p, &bucket));
    }
  }
}

}  // namespace
