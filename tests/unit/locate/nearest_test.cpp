// The nearest impassable thing against brute force over everything impassable, where nothing hides it.

#include "locate/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "locate/locate.h"

namespace {

using namespace dsw;
using namespace dsw::test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

NearestResult ask(const Environment<3>& env, double x, double y, double z, double radius = kInfinity) {
  const double p[3] = {x, y, z};
  NearestResult result;
  const Cell start = locate(env, p, Cell{}, nullptr).cell;
  if (!find_nearest(env, p, start, radius, result)) result.distance = kInfinity;
  return result;
}

TEST(Nearest, WallsOfALatticeBoxByTheirCoordinates) {
  Mesh3 mesh;
  add_boxes(mesh, 4, 3, 5);
  const auto env = mesh.build();
  Random random(2);
  for (int i = 0; i < at_least(500); ++i) {
    const double p[3] = {4 * random.unit(), 3 * random.unit(), 5 * random.unit()}, size[3] = {4, 3, 5};
    double expected = kInfinity;
    for (int k = 0; k < 3; ++k) expected = std::min({expected, p[k], size[k] - p[k]});
    const NearestResult r = ask(*env, p[0], p[1], p[2]);
    ASSERT_DOUBLE_EQ(r.distance, expected);
    ASSERT_EQ(r.feature.dimension, 2);
    double length = 0, gap = 0;
    for (int k = 0; k < 3; ++k) {
      length += r.normal[k] * r.normal[k];
      gap += (p[k] - r.point[k]) * r.normal[k];
    }
    EXPECT_NEAR(length, 1, 1e-14);
    EXPECT_NEAR(gap, expected, 1e-14) << "the normal points from the obstacle to the point";
    EXPECT_EQ(ask(*env, p[0], p[1], p[2], 0.99 * expected).distance, kInfinity);
    EXPECT_EQ(ask(*env, p[0], p[1], p[2], 1.01 * expected).distance, r.distance);
  }
}

TEST(Nearest, FacesEdgesAndVerticesMarkedInside) {
  Mesh3 mesh;
  add_boxes(mesh, 10, 10, 10);
  const auto env = mesh.build();
  const auto at = [](uint32_t x, uint32_t y, uint32_t z) { return x + 11 * (y + 11 * z); };
  reserve_edge_marks(*env, 1);
  reserve_vertex_marks(*env);
  set_edge_mark(*env, at(3, 5, 5), at(4, 5, 5), true);
  set_vertex_mark(*env, at(7, 5, 5), true);
  NearestResult r = ask(*env, 3.5, 5.25, 5);
  EXPECT_EQ(r.distance, 0.25);
  EXPECT_EQ(r.feature.dimension, 1);
  EXPECT_EQ(r.point[0], 3.5);
  EXPECT_EQ(r.point[1], 5);
  EXPECT_EQ(r.normal[1], 1);
  r = ask(*env, 2, 5, 5);
  EXPECT_EQ(r.distance, 1) << "an end of the marked edge";
  EXPECT_EQ(r.feature.dimension, 1);
  r = ask(*env, 7.25, 5, 5);
  EXPECT_EQ(r.distance, 0.25);
  EXPECT_EQ(r.feature.dimension, 0);
  EXPECT_EQ(env->map.vertex(r.feature.cell, r.feature.local), at(7, 5, 5));
  r = ask(*env, 5.5, 5, 5);
  EXPECT_EQ(r.distance, 1.5);
  EXPECT_EQ(r.feature.dimension, 0) << "a tie goes to the lower dimension";
  set_vertex_mark(*env, at(7, 5, 5), false);
  EXPECT_EQ(ask(*env, 5.5, 5, 5).feature.dimension, 1);
  const Cell c = env->map.cell(5 + 10 * (5 + 10 * 5));
  set_facet_mark(*env, env->map.half_facet(c, 0), true);  // x = 5
  r = ask(*env, 5.5, 5.5, 5.5);
  EXPECT_EQ(r.distance, 0.5);
  EXPECT_EQ(r.feature.dimension, 2);
  EXPECT_EQ(env->map.index(r.feature.cell), env->map.index(c) - 1) << "the canonical side";
  set_cell_mark(*env, env->map.cell(env->map.index(c) + 1), true);
  EXPECT_EQ(ask(*env, 5.75, 5.5, 5.5).distance, 0.25);
  EXPECT_EQ(ask(*env, 5.5, 5.5, 5.5).feature.cell, r.feature.cell) << "a tie goes to the lower cell";
}

TEST(Nearest, OnlyWhatPassableCellsLeadTo) {
  Mesh3 mesh;
  add_boxes(mesh, 9, 9, 9);
  const auto env = mesh.build();
  for (uint32_t i = 0; i < env->map.cell_count; ++i) {  // a closed shell round the middle cell
    const int x = static_cast<int>(i % 9), y = static_cast<int>(i / 9 % 9), z = static_cast<int>(i / 81);
    const int far = std::max({std::abs(x - 4), std::abs(y - 4), std::abs(z - 4)});
    if (far == 2) set_cell_mark(*env, env->map.cell(i), true);
  }
  reserve_vertex_marks(*env);
  set_vertex_mark(*env, 1, true);
  const NearestResult r = ask(*env, 4.5, 4.5, 4.5);
  EXPECT_EQ(r.distance, 1.5);
  EXPECT_LE(r.volumes_visited, 27u);
}

TEST(Nearest, OnAWallTheDistanceIsZeroAndHasNoDirection) {
  Mesh3 mesh;
  add_boxes(mesh, 2, 2, 2);
  const auto env = mesh.build();
  const NearestResult r = ask(*env, 0.5, 0, 1.25, 0);
  EXPECT_EQ(r.distance, 0);
  for (const double n : r.normal) EXPECT_EQ(n, 0);
  EXPECT_EQ(r.point[0], 0.5);
  EXPECT_EQ(r.point[2], 1.25);
}

TEST(Nearest, AnyScaleAnswersInProportion) {
  for (const int exponent : {-1060, -1000, -400, 0, 400, 1000, 1018}) {
    Mesh3 mesh;
    add_boxes(mesh, 3, 3, 3);
    for (double& x : mesh.points) x = std::ldexp(x, exponent);
    const auto env = mesh.build();
    const double unit = std::ldexp(1.0, exponent);
    for (const double radius : {kInfinity, std::ldexp(1.0, exponent + 3)}) {
      const NearestResult r = ask(*env, 1.5 * unit, 0.75 * unit, 1.5 * unit, radius);
      EXPECT_EQ(r.distance, 0.75 * unit) << exponent;
      EXPECT_EQ(r.normal[1], 1) << exponent;
      EXPECT_EQ(r.point[1], 0) << exponent;
      EXPECT_EQ(r.point[0], 1.5 * unit) << exponent;
    }
  }
}

TEST(Nearest, AFarPointInAnEnormousCell) {
  Mesh3 mesh;
  const double lower[3] = {-1.7e308, -1, -1.7e308}, upper[3] = {1.7e308, 1.7e308, 1.7e308};
  add_box(mesh, lower, upper);
  const auto env = mesh.build();
  const NearestResult r = ask(*env, 1.6e308, 1e-300, -1.6e308);
  EXPECT_TRUE(std::isfinite(r.distance));
  EXPECT_NEAR(r.distance, 1, 1e300) << "rounding of the largest coordinate";
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(std::isnan(r.normal[k]) || std::isnan(r.point[k]));
}

}  // namespace
