// A pair goes along in many steps, each as near as the last allows: in rational numbers it never comes nearer than it may.
#include "together/hull_ways.h"

#include "thick_truth.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dsw {
namespace {

using oracle::less_by;
using oracle::Limit;
using oracle::square_of_distance;
using Points = oracle::Hull;

/** Two parts, and how far they are to be apart. */
struct Kind {
  const char* name;
  size_t counts[2];
  double wanted;
};

template <int D>
HullWays<D> ways_of(const Points& a, const Points& a_end, const Points& b, double bend) {
  HullWays<D> ways{};
  const Points* const sides[2][2] = {{&a, &a_end}, {&b, &b}};
  for (uint32_t side = 0; side < 2; ++side) {
    for (size_t i = 0; i < sides[side][0]->size(); ++i, ++ways.count[side]) {
      ways.start[side][i] = (*sides[side][0])[i].data();
      ways.end[side][i] = (*sides[side][1])[i].data();
    }
  }
  ways.bends[0].most = bend;
  return ways;
}

class HullWaysTest : public testing::TestWithParam<Kind> {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  template <int D>
  Points points(size_t count) {
    Points made(count, oracle::Vec{0, 0, 0});
    for (oracle::Vec& p : made) {
      for (size_t k = 0; k < D; ++k) p[k] = number(-1, 1);
    }
    return made;
  }
  /** Puts the first part that far from the second, along what is between them. */
  static bool put_at(Points& a, const Points& b, double distance) {
    for (int i = 0; i < 4; ++i) {
      const oracle::Apart now = oracle::apart(a, b);
      const double is = oracle::root(square_of_distance(a, b)).get_d();
      if (!(now.low > 0)) return false;
      for (oracle::Vec& p : a) {
        for (size_t k = 0; k < 3; ++k) p[k] += (distance - is) * now.way[k];
      }
    }
    return true;
  }
  /** Brings an edge along itself to where an end of it is nearly what is nearest to a point: next to that end its distances hardly differ. */
  void put_end_at(Points& a, const Points& b) {
    const oracle::Vec &from = a[0], &to = a[1], &point = b[0];
    double along = 0, square = 0;
    for (size_t k = 0; k < 3; ++k) {
      along += (point[k] - from[k]) * (to[k] - from[k]);
      square += (to[k] - from[k]) * (to[k] - from[k]);
    }
    const double share = along / square - std::ldexp(number(0, 1), -17 - static_cast<int>(random_() % 6));
    const oracle::Vec way = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    for (oracle::Vec& p : a) {
      for (size_t k = 0; k < 3; ++k) p[k] += share * way[k];
    }
  }
  /** Asks for steps along the second part, most of which come nearer by next to nothing. @return how many were allowed. */
  template <int D>
  int go_along(Points& a, const Points& b, double wanted, int steps) {
    Vec known = Vec::Zero();
    int allowed = 0;
    for (int i = 0; i < steps; ++i) {
      const oracle::Vec across = oracle::apart(a, b).way;
      const double nearer = wanted * std::ldexp(number(0, 1), -30 - static_cast<int>(random_() % 22));
      // So far that a corner which goes round another one still comes nearer.
      const double aside = random_() % 2 == 0 ? 0 : number(-1, 1) * std::sqrt(wanted * nearer);
      Points to = a;
      for (oracle::Vec& p : to) {
        p[0] -= nearer * across[0] - aside * across[1];
        p[1] -= nearer * across[1] + aside * across[0];
        if (D == 3) p[2] -= nearer * across[2];
      }
      const double bend = random_() % 2 == 0 ? 0 : wanted * 0x1p-80;
      if (time_kept(ways_of<D>(a, to, b, bend), wanted, 1, &known) < 1) continue;
      a = to;
      ++allowed;
    }
    return allowed;
  }
  /** Asks for small turns of the first part about a corner, each from a place at the limit. @return how many were allowed. */
  template <int D>
  int turn_there(Points a, const Points& b, double wanted) {
    const Limit limit(mpq_class(wanted), less_by(34)), on_way(mpq_class(wanted), less_by(33));
    int allowed = 0;
    for (int i = 0; i < 100; ++i) {
      const oracle::Vec pivot = random_() % 2 == 0 ? a[random_() % a.size()] : b[random_() % b.size()];
      const double angle = std::ldexp(number(-1, 1), -10 - static_cast<int>(random_() % 30));
      oracle::Vec axis = {0, 0, angle};
      for (size_t k = 0; D == 3 && k < 3; ++k) axis[k] = angle * number(-1, 1);
      Points to = a, middle = a;
      for (size_t v = 0; v < a.size(); ++v) {
        for (size_t k = 0; k < 3; ++k) {
          const size_t l = (k + 1) % 3, m = (k + 2) % 3;
          to[v][k] += axis[l] * (a[v][m] - pivot[m]) - axis[m] * (a[v][l] - pivot[l]);
          middle[v][k] = a[v][k] + (to[v][k] - a[v][k]) / 2;
        }
      }
      Vec known = Vec::Zero();
      if (time_kept(ways_of<D>(a, to, b, 0), wanted, 1, &known) < 1) continue;
      EXPECT_FALSE(oracle::is_nearer(to, b, limit)) << "turn " << i << " by " << angle;
      EXPECT_FALSE(oracle::is_nearer(middle, b, on_way)) << "turn " << i << " by " << angle;
      ++allowed;
      if (put_at(to, b, wanted * (1 - 0x1p-35)) && !oracle::is_nearer(to, b, limit)) a = to;
    }
    return allowed;
  }
  /** Draws two parts that far from each other, of which `missing` is missing as a share. */
  template <int D>
  void draw(const Kind& kind, bool by_end, double missing, const Limit& limit, Points& a, Points& b) {
    for (int tries = 0; tries < 1000; ++tries) {
      b = points<D>(kind.counts[1]);
      a = points<D>(kind.counts[0]);
      if (by_end) put_end_at(a, b);
      // Some meet, and of some the rounding of their places is larger than what may be missing.
      if (put_at(a, b, kind.wanted * (1 - missing)) && !oracle::is_nearer(a, b, limit)) return;
    }
    FAIL() << "no two parts are apart";
  }
  template <int D>
  void comes_no_nearer() {
    const Kind& kind = GetParam();
    int allowed = 0, turned = 0;
    for (int i = 0; i < std::max(effort_of(12), 6); ++i) {
      // What is missing of the distance where it stops, where it has lost all that it may by rounding, and a little before.
      const double shares[] = {0x1p-35, 0x1p-34 * 5 / 8, 0x1p-36};
      const Limit limit(mpq_class(kind.wanted), less_by(34));
      Points a, b;
      ASSERT_NO_FATAL_FAILURE(
          draw<D>(kind, kind.counts[0] == 2 && kind.counts[1] == 1 && i % 2 != 0, shares[i % 3], limit, a, b));
      turned += turn_there<D>(a, b, kind.wanted);
      allowed += go_along<D>(a, b, kind.wanted, 2000);
      EXPECT_FALSE(oracle::is_nearer(a, b, limit))
          << i << ": " << (1 - oracle::root(square_of_distance(a, b)).get_d() / kind.wanted) * 0x1p34;
      // Whoever leaves can always do so.
      const oracle::Vec across = oracle::apart(a, b).way;
      Points away = a;
      for (oracle::Vec& p : away) {
        for (size_t k = 0; k < D; ++k) p[k] += 0x1p-20 * across[k];
      }
      Vec known = Vec::Zero();
      EXPECT_EQ(time_kept(ways_of<D>(a, away, b, 0), kind.wanted, 1, &known), 1) << i;
    }
    EXPECT_GT(allowed, 0);
    EXPECT_GT(turned, 0);
  }

  std::mt19937_64 random_{seed_of(34)};
};

class PlaneHullWaysTest : public HullWaysTest {};
class SpaceHullWaysTest : public HullWaysTest {};

TEST_P(PlaneHullWaysTest, WhatGoesAlongInManyStepsComesNoNearerThanItMay) { comes_no_nearer<2>(); }
TEST_P(SpaceHullWaysTest, WhatGoesAlongInManyStepsComesNoNearerThanItMay) { comes_no_nearer<3>(); }

const auto name_of = [](const auto& each) { return each.param.name; };
INSTANTIATE_TEST_SUITE_P(Kinds, PlaneHullWaysTest,
                         testing::Values(Kind{"vertices", {1, 1}, 0.08}, Kind{"vertex_edge", {1, 2}, 0.08},
                                         Kind{"edge_corner", {2, 1}, 0.003}, Kind{"edges", {2, 2}, 0.02},
                                         Kind{"thin", {2, 2}, 1e-5}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Kinds, SpaceHullWaysTest,
                         testing::Values(Kind{"vertex_face", {1, 3}, 0.08}, Kind{"edge_corner", {2, 1}, 0.05},
                                         Kind{"edges", {2, 2}, 0.02}, Kind{"faces", {3, 3}, 0.08},
                                         Kind{"edge_face", {2, 3}, 0.003}, Kind{"thin", {1, 3}, 1e-5}),
                         name_of);

}  // namespace
}  // namespace dsw
