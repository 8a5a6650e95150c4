// The checks that the knot is judged by can say no.
#include <gtest/gtest.h>

#include <cmath>

#include "apart.h"
#include "knot_type.h"

namespace knot {
namespace {

TEST(ApartTest, TouchingIsNotApart) {
  const Point o = {0, 0, 0}, x = {1, 0, 0}, half = {0.5, 0, 0};
  EXPECT_FALSE(are_apart(o, x, {0.5, -1, 0}, {0.5, 1, 0}));
  EXPECT_FALSE(are_apart(o, x, half, {0.5, 1, 1}));
  EXPECT_FALSE(are_apart(o, x, half, {2, 0, 0})) << "in one line";
  EXPECT_FALSE(are_apart(o, x, x, {1, 1, 1}));
  EXPECT_TRUE(are_apart(o, x, {1.5, 0, 0}, {2, 0, 0}));
  EXPECT_TRUE(are_apart(o, x, {0.5, -1, 0x1p-60}, {0.5, 1, 0x1p-60}));
  EXPECT_TRUE(are_apart(o, x, {0.5, 0x1p-60, 0}, {0.5, 1, 0}));
}

TEST(ApartTest, ItIsExact) {
  // Far from the origin, where the differences of coordinates are known and their products are rounded.
  const double tenth = 0.1, step = 0x1p-53;
  for (int i = 1; i < 200; ++i) {
    const double y = tenth * i, x = y * (1 + 3 * step);
    const Point a = {-x, -y, 0}, b = {x, y, 0}, c = {0, 0, 0}, d = {y, -x, 1};
    EXPECT_FALSE(are_apart(a, b, c, d)) << i;
    const Point beside = {0, std::ldexp(1.0, -1000 + 900), 0};
    EXPECT_TRUE(are_apart(a, b, beside, {0, 1, 0})) << i;
  }
}

std::vector<Point> closed_outside(std::vector<Point> way) {
  way.insert(way.begin(), Point{-9, way.front()[1], 0});
  way.push_back({9, way.back()[1], 0});
  return way;
}

TEST(KnotTest, DeterminantsTellKnotsApart) {
  EXPECT_EQ(determinant(closed_outside({{-1, 0, 0}, {1, 0.5, 0}})), 1);
  // A loop, over itself; then through it.
  const std::vector<Point> loop = {{-3, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {-1, 2, 1}, {-1, -1, 1}};
  EXPECT_EQ(determinant(closed_outside(loop)), 1);
  for (const double under : {-1.0, 1.0}) {
    std::vector<Point> tied = loop;
    for (const Point& p : {Point{1, -1, under}, Point{1, 0.5, under}, Point{1, 1, 1}, Point{3, 1, 1}})
      tied.push_back(p);
    EXPECT_EQ(determinant(closed_outside(tied)), under < 0 ? 3 : 1);
  }
}

TEST(KnotTest, TurnsAreCounted) {
  EXPECT_NEAR(turns_round_axis({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}}), 1, 1e-12);
}

}  // namespace
}  // namespace knot
