// Edges with a common vertex, beside exact first times of each far end and the other edge.

#include "predicates/moving_hinge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../../effort.h"
#include "predicates/moving_pair.h"
#include "scenes/random.h"

namespace dsw {
namespace {

struct Case {
  double start[3][3], end[3][3];
};

Case random_case(scenes::Random& random, double way, bool is_coarse) {
  Case made;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto round = [&](double x) { return is_coarse ? std::floor(2 * x) : x; };
      made.start[i][k] = round(random.uniform(-1, 1));
      made.end[i][k] = made.start[i][k] + round(way * random.uniform(-1, 1));
    }
  }
  return made;
}

bool touches(const Case& of, int far, int other) {
  MovingPair<3> pair{PairKind::kEdgeEdge, {}, {}};
  const int points[4] = {far, far, 0, other};
  for (int i = 0; i < 4; ++i) {
    pair.start[i] = of.start[points[i]];
    pair.end[i] = of.end[points[i]];
  }
  return first_touch(pair).touches;
}

bool is_sure(const Case& of) {
  const double* const start[3] = {of.start[0], of.start[1], of.start[2]};
  const double* const end[3] = {of.end[0], of.end[1], of.end[2]};
  return stays_open(start, end);
}

TEST(MovingHinge, WhatStaysOpenNeverTouches) {
  scenes::Random random(51);
  int sure = 0, all = 0, touching = 0;
  for (int i = 0; i < effort_of(4000); ++i) {
    for (const double way : {0.1, 1.0, 4.0}) {
      const Case of = random_case(random, way, i % 3 == 0);
      const bool open = is_sure(of), touch = touches(of, 1, 2) || touches(of, 2, 1);
      EXPECT_FALSE(open && touch) << i << " " << way;
      sure += open ? 1 : 0;
      touching += touch ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(touching, 0);
  EXPECT_GT(sure, all / 2);
}

TEST(MovingHinge, OneThatOpensWideOrTurnsFarIsKnown) {
  // The second edge turns by 170 degrees round the first end, from 5 to 175 degrees, and then beyond a straight line.
  const Case wide = {{{0, 0, 0}, {1, 0, 0}, {0.996, 0.087, 0}}, {{3, 1, 2}, {4, 1, 2}, {2.004, 1.087, 2}}};
  EXPECT_TRUE(is_sure(wide));
  const Case straight = {{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 0, 1}, {1, 0, 1}, {-1, 0, 1}}};
  EXPECT_TRUE(is_sure(straight));
  const Case closes = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {1, -1, 0}}};
  EXPECT_FALSE(is_sure(closes));
}

}  // namespace
}  // namespace dsw
