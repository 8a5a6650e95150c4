// Sides of normals that rounding could turn, against rationals.
#include "contact/normals.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include "../../gmp_numbers.h"

#include <cmath>
#include <random>

namespace {

using namespace dsw;

// An edge that moves all but along itself: what its motion has across it is lost in the rounding of a normal.
TEST(SwingNormal, LooksToWhereTheEdgeComesFrom) {
  std::mt19937_64 random(seed_of(1));
  std::uniform_real_distribution<double> place(-8, 8);
  int nearly_along = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    const double p[2] = {place(random), place(random)}, q[2] = {place(random), place(random)};
    const double far = place(random), share = std::fabs(place(random)) / 8;
    double to[2], at[2];
    for (int k = 0; k < 2; ++k) {
      to[k] = p[k] + far * (p[k] - q[k]);
      at[k] = q[k] + share * (p[k] - q[k]);
    }
    mpq_class exact[3][2];
    for (int k = 0; k < 2; ++k) exact[0][k] = q[k], exact[1][k] = p[k], exact[2][k] = to[k];
    const mpq_class turn = (exact[1][0] - exact[0][0]) * (exact[2][1] - exact[0][1]) -
                           (exact[1][1] - exact[0][1]) * (exact[2][0] - exact[0][0]);
    const Vec normal = swing_normal({p, to, q}, to, at);
    EXPECT_NEAR(std::hypot(normal.x(), normal.y()), 1, 1e-15);
    if (sgn(turn) == 0) {
      EXPECT_LT(normal.x() * (to[0] - p[0]) + normal.y() * (to[1] - p[1]), 0);
      continue;
    }
    ++nearly_along;
    // Where the edge turns to its left, it comes from its right.
    const double left[2] = {q[1] - at[1], at[0] - q[0]};
    EXPECT_EQ(std::signbit(normal.x()), std::signbit(-sgn(turn) * left[0])) << i;
    EXPECT_EQ(std::signbit(normal.y()), std::signbit(-sgn(turn) * left[1])) << i;
  }
  EXPECT_GT(nearly_along, 1000);
}

// What lies on the end about which the edge turns says nothing of the edge's direction, nor does an end there.
TEST(SwingNormal, HasALengthWhereTheEdgeHasNone) {
  const double p[2] = {0, 0}, q[2] = {1, 0}, to[2] = {2, 2};
  const double end[2] = {1, 1};
  EXPECT_EQ(swing_normal({p, to, q}, end, q).x(), -1);
  const Vec back = swing_normal({p, to, q}, q, q);
  EXPECT_LT(back.x(), 0);
  EXPECT_EQ(back.x(), back.y());
}

}  // namespace
