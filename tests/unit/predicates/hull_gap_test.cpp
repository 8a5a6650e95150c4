// Bounds of distances of hulls against exact rational arithmetic: never above the distance, and hardly below.
#include "predicates/hull_gap.h"

#include "thick_truth.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <random>

namespace dsw {
namespace {

using oracle::square_of_distance;
using Points = oracle::Hull;

ConvexHull hull_of(const Points& points) {
  ConvexHull hull;
  for (const oracle::Vec& p : points) hull.points[hull.count++] = p.data();
  return hull;
}

/** How pairs of hulls are made: at random, on a lattice where much is flat or touches, long and thin, or far away. */
struct Family {
  const char* name;
  double scale = 1, stretch = 1, offset = 0;
  bool is_lattice = false;
};

class HullGapTest : public testing::TestWithParam<Family> {
 protected:
  double coordinate() {
    if (GetParam().is_lattice) return static_cast<double>(random_() % 5) - 2;
    return std::uniform_real_distribution<double>(-1, 1)(random_);
  }
  oracle::Vec point() {
    const Family& f = GetParam();
    return {f.scale * (f.offset + f.stretch * coordinate()), f.scale * coordinate(), f.scale * coordinate()};
  }
  Points points(size_t most) {
    Points made(1 + random_() % most);
    for (oracle::Vec& p : made) p = point();
    return made;
  }
  /** The second hull from the first one's side, so that small distances occur. */
  void draw(size_t most_a, Points& a, Points& b) {
    a = points(most_a);
    b = points(3);
    if (GetParam().is_lattice || random_() % 2 == 0) return;
    const double near = std::pow(10, std::uniform_real_distribution<double>(-12, 0)(random_));
    const double share = random_() % 2 == 0 ? 1 - near : std::uniform_real_distribution<double>(0, 1.02)(random_);
    for (oracle::Vec& p : b) {
      for (size_t k = 0; k < 3; ++k) p[k] += share * (a[0][k] - b[0][k]);
    }
  }
  double size_of(const Points& a, const Points& b) {
    double size = 0;
    for (const Points* each : {&a, &b}) {
      for (const oracle::Vec& p : *each) {
        for (size_t k = 0; k < 3; ++k) size = std::max(size, std::fabs(p[k] - b[0][k]));
      }
    }
    return size;
  }
  double exact(const Points& a, const Points& b) { return oracle::root(square_of_distance(a, b)).get_d(); }

  std::mt19937_64 random_{seed_of(7)};
};

/// The distance of two points with these weights.
double between(const Points& a, const double* weights, const Points& b, const double* other_weights) {
  mpq_class square = 0;
  for (size_t k = 0; k < 3; ++k) {
    mpq_class way = 0;
    for (size_t i = 0; i < a.size(); ++i) way += mpq_class(weights[i]) * (mpq_class(a[i][k]) - mpq_class(b[0][k]));
    for (size_t i = 0; i < b.size(); ++i)
      way -= mpq_class(other_weights[i]) * (mpq_class(b[i][k]) - mpq_class(b[0][k]));
    square += way * way;
  }
  return oracle::root(square).get_d();
}

/// The square of the distance between a hull, to which an exact place on the way of its first point is added, and another hull.
mpq_class square_of_grown(const Points& a, const oracle::Vec& to, double time, const Points& b) {
  using Point = oracle::Nearest<mpq_class>::Point;
  std::vector<Point> grown, other;
  for (const oracle::Vec& p : a) grown.push_back({mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])});
  for (const oracle::Vec& p : b) other.push_back({mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])});
  Point place = grown[0];
  for (size_t k = 0; k < 3; ++k) place[k] += mpq_class(time) * (mpq_class(to[k]) - place[k]);
  grown.push_back(place);
  return oracle::Nearest<mpq_class>(grown, other).square;
}

TEST_P(HullGapTest, BoundsTheDistanceFromBelowAndClosely) {
  for (int i = 0; i < at_least(400); ++i) {
    Points a, b;
    draw(4, a, b);
    const HullGap gap = find_gap<3>(hull_of(a), hull_of(b), HUGE_VAL, 0);
    const mpq_class square = square_of_distance(a, b), bound = gap.bound;
    ASSERT_LE(bound * bound, square) << i;
    ASSERT_GE(gap.bound, exact(a, b) * (1 - 0x1p-30) - 0x1p-70 * size_of(a, b)) << i;
    const double about = exact(a, b) * (1 - 0x1p-35);
    ASSERT_GE(find_gap<3>(hull_of(a), hull_of(b), HUGE_VAL, about).bound, about - 0x1p-70 * size_of(a, b)) << i;
    // Whether it is far enough apart is told as well when the search may end early.
    const double wanted = exact(a, b) * std::uniform_real_distribution<double>(0.5, 1.5)(random_);
    const bool is_far = are_far_apart<3>(hull_of(a), hull_of(b), wanted);
    const mpq_class limit = wanted;
    ASSERT_TRUE(!is_far || limit * limit <= square) << i;
    ASSERT_TRUE(is_far || gap.bound <= wanted) << i;
  }
}

TEST_P(HullGapTest, WhatMeetsIsNeverSurelyApart) {
  int apart = 0;
  for (int i = 0; i < at_least(400); ++i) {
    Points a, b;
    draw(4, a, b);
    const bool is_apart = are_surely_apart<3>(hull_of(a), hull_of(b));
    ASSERT_TRUE(!is_apart || square_of_distance(a, b) > 0) << i;
    apart += is_apart ? 1 : 0;
  }
  EXPECT_GT(apart, 0);
}

TEST_P(HullGapTest, BoundsTheDistancesAtBothEndsOfAWay) {
  for (int i = 0; i < at_least(400); ++i) {
    Points a, b;
    draw(3, a, b);
    Points a_end = a, b_end = b;
    // Steps that hardly change anything are those that many digits are for.
    const double step = std::pow(10, std::uniform_real_distribution<double>(-16, 0)(random_));
    for (Points* const each : {&a_end, &b_end}) {
      const oracle::Vec to = point();
      for (oracle::Vec& p : *each) {
        for (size_t k = 0; k < 3; ++k) p[k] += step * (to[k] - p[k]);
      }
    }
    const ConvexHull start[2] = {hull_of(a), hull_of(b)}, end[2] = {hull_of(a_end), hull_of(b_end)};
    const GapAtEnds gap = find_gap_at_ends<3>(start, end);
    const mpq_class first = gap.start, last = gap.end;
    ASSERT_LE(first * first, square_of_distance(a, b)) << i;
    ASSERT_LE(last * last, square_of_distance(a_end, b_end)) << i;
    ASSERT_GE(gap.start, exact(a, b) * (1 - 0x1p-48) - 0x1p-69 * size_of(a, b)) << i;
    // What stands shows the same at both ends.
    ASSERT_EQ(find_gap_at_ends<3>(start, start).end, gap.start) << i;
  }
}

TEST_P(HullGapTest, AHullGrowsUntilItComesTooNear) {
  for (int i = 0; i < at_least(400); ++i) {
    Points a, b;
    draw(3, a, b);
    const oracle::Vec to = point();
    // Also far below the distance: then all of the way is nearly free.
    const double share = std::pow(10, std::uniform_real_distribution<double>(-14, 0)(random_));
    const double wanted = exact(a, b) * (random_() % 2 == 0 ? share : 1 - share);
    if (!(wanted > 0) || !are_far_apart<3>(hull_of(a), hull_of(b), wanted)) continue;
    HullGap at;
    const double time = time_apart<3>(hull_of(a), to.data(), hull_of(b), wanted, &at);
    ASSERT_TRUE(time >= 0 && time <= 1) << i;
    double largest = 0;
    for (size_t k = 0; k < 3; ++k) largest = std::max({largest, std::fabs(a[0][k]), std::fabs(to[k])});
    const auto distance_at = [&](double t) { return oracle::root(square_of_grown(a, to, t, b)).get_d(); };
    ASSERT_GE(distance_at(time), wanted * (1 - 0x1p-48) - 0x1p-99 * largest - 0x1p-1072) << i;
    if (time == 1) continue;
    ASSERT_TRUE(are_far_apart_until<3>(hull_of(a), to.data(), time, hull_of(b), wanted)) << i;
    ASSERT_GE(at.bound, wanted) << i;
    ASSERT_NEAR(length(at.normal), 1, 1e-12) << i;
    Points grown = a;
    grown.push_back(a[0]);
    point_at<3>(a[0].data(), to.data(), time, grown.back().data());
    const double reached = between(grown, at.weights, b, at.other_weights);
    ASSERT_LE(reached, exact(grown, b) * (1 + 0x1p-20) + 0x1p-46 * size_of(a, b) + 0x1p-51 * largest) << i;
    const double later = time * (1 + 0x1p-40) + 0x1p-50;
    ASSERT_TRUE(later >= 1 || distance_at(later) < wanted * (1 + 0x1p-29) + 0x1p-68 * size_of(a, b))
        << i << ' ' << time;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, HullGapTest,
                         testing::Values(Family{"random"}, Family{"lattice", 1, 1, 0, true}, Family{"thin", 1, 1e4},
                                         Family{"flat", 1, 1e-6}, Family{"very_thin", 1, 1e9}, Family{"far", 1, 1, 1e9},
                                         Family{"last_digits", 1024, 1, 0x1p42}, Family{"huge", 1e300},
                                         Family{"tiny", 1e-300}),
                         [](const auto& made) { return std::string(made.param.name); });

/// The bound of a denormal distance is not above it, and as close to it as other bounds are.
TEST(HullGap, DenormalDistancesAreTold) {
  std::mt19937_64 random(seed_of(8));
  for (int i = 0; i < at_least(1000); ++i) {
    const auto any = [&] { return 1e-300 * std::uniform_real_distribution<double>(-1, 1)(random); };
    const auto parts = static_cast<double>(random() >> (12 + random() % 52));
    const double room = std::max(parts, 1.0) * 0x1p-1074, at[2] = {0, room}, b[2] = {-1e-300, 0},
                 c[2] = {1e-300, any()};
    const ConvexHull point{{at}, 1}, edge{{b, c}, 2};
    // Straight above a flat edge nothing is rounded.
    const double flat[2] = {1e-300, 0};
    const ConvexHull ground{{b, flat}, 2};
    ASSERT_TRUE(are_far_apart<2>(point, ground, room * (1 - 0x1p-34) - 0x1p-1066)) << i << ' ' << room;
    ASSERT_FALSE(are_far_apart<2>(point, ground, std::nextafter(room, 1.0))) << i << ' ' << room;
    const Points hull{{{at[0], at[1], 0}}}, other{{{b[0], b[1], 0}}, {{c[0], c[1], 0}}};
    const mpq_class bound = find_gap<2>(point, edge, HUGE_VAL, 0).bound;
    ASSERT_LE(bound * bound, square_of_distance(hull, other)) << i;
  }
}

TEST(HullGap, InThePlaneAHullIsFlat) {
  const double a[2] = {0, 2}, b[2] = {-1, 0}, c[2] = {1, 0}, to[2] = {0, -2};
  const ConvexHull point{{a}, 1}, wall{{b, c}, 2};
  EXPECT_TRUE(are_far_apart<2>(point, wall, 1.999));
  EXPECT_FALSE(are_far_apart<2>(point, wall, 2.001));
  HullGap at;
  EXPECT_NEAR(time_apart<2>(point, to, wall, 0.5, &at), 0.375, 1e-12);
  EXPECT_NEAR(at.normal.y(), 1, 1e-12);
}

TEST(HullGap, OfAVeryLongWayTheFirstBitIsFound) {
  const double p[3] = {0, 0, 2}, to[3] = {0, 0, -1e300}, a[3] = {-1, -1, 0}, b[3] = {2, 0, 0}, c[3] = {0, 2, 0};
  HullGap at;
  EXPECT_NEAR(time_apart<3>({{p}, 1}, to, {{a, b, c}, 3}, 0.5, &at) * 1e300, 1.5, 1e-9);
}

/** The way stays 174 radii from a point, and ends where coordinates have some 2,000 bits more than that. */
TEST(HullGap, OfAVeryLongWayBesideAPointItIsKnownThatItIsFree) {
  const double tiny = 0x1p-992, radius = 0x1.4p-1000;
  const double from[2] = {1.8426 * tiny, 1.767 * tiny}, to[2] = {0x1.e4p1023, 0x1.7ep996},
               beside[2] = {1.0022 * tiny, 1.656 * tiny};
  const double ahead[2] = {4 * tiny, 1.767 * tiny};
  HullGap at;
  EXPECT_EQ(time_apart<2>({{from}, 1}, to, {{beside}, 1}, radius, &at), 1);
  EXPECT_TRUE(are_far_apart<2>({{from, to}, 2}, {{beside}, 1}, radius));
  EXPECT_FALSE(are_far_apart<2>({{from, to}, 2}, {{ahead}, 1}, radius));
}

TEST(HullGap, OfWhatIsTooFarAwayForDoublesNothingIsKnown) {
  const double a[3] = {1e308, 0, 0}, b[3] = {-1e308, 0, 0};
  EXPECT_EQ(find_gap<3>({{a}, 1}, {{b}, 1}, 1, 1).bound, 0);
}

}  // namespace
}  // namespace dsw
