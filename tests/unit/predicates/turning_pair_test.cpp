// First times of pairs that turn against moving_pair_truth.h. With DSW_EFFORT=250 about a million times are compared.

#include "predicates/turning_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "moving_pair_truth.h"
#include "turning_pair_cases.h"

namespace dsw {
namespace {

struct AskedTurning {
  PairKind kind;
  TurningFamily family;
  int turning;
};
// GoogleTest prints it.
void PrintTo(const AskedTurning& asked, std::ostream* to) { *to << name_of(asked.family) << ' ' << asked.turning; }

std::vector<AskedTurning> all_turning_families() {
  std::vector<AskedTurning> r;
  for (const PairKind kind : {PairKind::kVertexFace, PairKind::kEdgeEdge, PairKind::kVertexEdge}) {
    for (int family = 0; family < static_cast<int>(TurningFamily::kCount); ++family) {
      for (int turning = 1; turning < 4; ++turning) r.push_back({kind, static_cast<TurningFamily>(family), turning});
    }
  }
  return r;
}
std::string name_of_turning_test(const testing::TestParamInfo<AskedTurning>& info) {
  static constexpr const char* kKinds[] = {"VertexFace", "EdgeEdge", "VertexEdge"};
  static constexpr const char* kTurning[] = {"", "FirstTurns", "SecondTurns", "BothTurn"};
  return std::string(kKinds[static_cast<int>(info.param.kind)]) + name_of(info.param.family) +
         kTurning[info.param.turning];
}

class TurningPairTest : public testing::TestWithParam<AskedTurning> {
 protected:
  template <int D>
  TurningCase<D> next() {
    return draw_turning<D>(random_, GetParam().family, GetParam().kind, GetParam().turning);
  }

  template <int D>
  void times_are_true() {
    for (std::uint64_t i = 0; i < cases_; ++i) {
      const TurningCase<D> c = next<D>();
      const FirstTouch found = first_touch(c.pair()), truth = true_first_touch(c.pair());
      ASSERT_EQ(found.touches, truth.touches) << c.text();
      ASSERT_EQ(found.time, truth.time) << c.text();
      for (const double until : {truth.time, 0.75 * truth.time, std::fabs(random_.uniform())}) {
        const FirstTouch asked = first_touch(c.pair(), nullptr, {until, i % 2 == 0});
        // A touch up to that time is found, and a later one may be left out.
        ASSERT_TRUE(asked.touches ? truth.touches : !truth.touches || truth.time > until) << until << c.text();
        ASSERT_TRUE(!asked.touches || asked.time == truth.time) << until << c.text();
      }
    }
  }

  /** Pairs are compared that have much in common, so that many first times are equal or nearly so. */
  template <int D>
  void orders_are_true() {
    for (std::uint64_t i = 0; i < cases_ / 8 + 1; ++i) {
      const TurningCase<D> a = next<D>();
      TurningCase<D> b = a;
      nudge(random_, b);
      if (random_.below(3) == 0) b.turns[static_cast<std::size_t>(random_.below(2))] = false;
      const FirstTouch first_a = first_touch(a.pair());
      FirstTouch first_b = first_touch(b.pair());
      if (!first_a.touches || !first_b.touches) continue;
      const int truth = true_compare(a.pair(), b.pair());
      ASSERT_EQ(compare_first_touches(a.pair(), first_a, b.pair(), first_b), truth) << a.text() << b.text();
      first_b.is_exact = false;
      ASSERT_EQ(compare_first_touches(b.pair(), first_b, a.pair(), first_a), -truth) << a.text() << b.text();
    }
  }

  const std::uint64_t cases_ = case_count() / 700 + 1;
  Random random_{static_cast<std::uint64_t>(GetParam().family) * 16 + static_cast<std::uint64_t>(GetParam().kind) * 4 +
                 static_cast<std::uint64_t>(GetParam().turning)};
};

INSTANTIATE_TEST_SUITE_P(All, TurningPairTest, testing::ValuesIn(all_turning_families()), name_of_turning_test);
TEST_P(TurningPairTest, TimesAreTrue) {
  if (GetParam().kind == PairKind::kVertexEdge) {
    times_are_true<2>();
  } else {
    times_are_true<3>();
  }
}
TEST_P(TurningPairTest, OrdersAreTrue) {
  if (GetParam().kind == PairKind::kVertexEdge) {
    orders_are_true<2>();
  } else {
    orders_are_true<3>();
  }
}

/** All lengths of a pair times a power of two. */
template <int D>
TurningCase<D> scaled_by(TurningCase<D> c, int bits) {
  const auto scale = [bits](double& x) { x = std::ldexp(x, bits); };
  for (auto* points : {&c.points.start, &c.points.end}) {
    for (auto& x : *points) std::for_each(x.begin(), x.end(), scale);
  }
  for (TurningWay& way : c.ways) {
    for (double* const point : {way.centre, way.place[0], way.place[1]}) std::for_each(point, point + 3, scale);
  }
  return c;
}

template <int D>
void lengths_may_be_of_any_size(PairKind kind) {
  Random random(88);
  const auto cases = static_cast<std::uint64_t>(std::max(16, effort_of(64)));
  std::uint64_t touching = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const auto family = i % 2 == 0 ? TurningFamily::kRandom : TurningFamily::kHinged;
    const TurningCase<D> c = draw_turning<D>(random, family, kind, 1 + random.below(3));
    const FirstTouch truth = true_first_touch(c.pair());
    touching += truth.touches ? 1 : 0;
    for (const int bits : {-900, -120, -95, 95, 120, 900, 1010}) {
      const TurningCase<D> other = scaled_by(c, bits);
      const FirstTouch found = first_touch(other.pair());
      ASSERT_EQ(found.touches, truth.touches) << other.text();
      ASSERT_EQ(found.time, truth.time) << other.text();
    }
  }
  EXPECT_GT(touching, cases / 50);
}

TEST(TurningPairTest, LengthsMayBeOfAnySize) {
  lengths_may_be_of_any_size<3>(PairKind::kVertexFace);
  lengths_may_be_of_any_size<3>(PairKind::kEdgeEdge);
  lengths_may_be_of_any_size<2>(PairKind::kVertexEdge);
}

/** A vertex that goes round by half a turn about z, at a radius of 1 from (0, -1, 0) to (0, 1, 0). */
template <int D>
TurningCase<D> half_turn(const MovingCase<D>& points) {
  TurningCase<D> c;
  c.points = points;
  c.ways[0] = c.ways[1] = {{{0, 0, 0, 1}, {0, 0, 1, 0}}, {}, {}};
  c.turns = {true, false};
  return c;
}

template <int D>
void expect_touch(const TurningCase<D>& c, bool touches, double time) {
  for (const FirstTouch& each : {first_touch(c.pair()), true_first_touch(c.pair())}) {
    EXPECT_EQ(each.touches, touches) << c.text();
    EXPECT_EQ(each.time, time) << c.text();
  }
}

TEST(TurningPairTest, ACircleTouchesAWallHalfWay) {
  const std::array<std::array<double, 2>, 3> wall{{{0, -1}, {1, -3}, {1, 3}}};
  TurningCase<2> c = half_turn<2>({PairKind::kVertexEdge, wall, wall});
  expect_touch(c, true, 0.5);
  for (size_t i = 1; i < 3; ++i) c.points.start[i][0] = c.points.end[i][0] = std::nextafter(1.0, 2);
  expect_touch(c, false, 0);
}

TEST(TurningPairTest, TheArcAndNotTheChordTouches) {
  // The chord is on the axis x = 0.
  const std::array<std::array<double, 3>, 4> at{{{0, -1, 0}, {0.75, -3, -3}, {0.75, 3, -3}, {0.75, 0, 5}}};
  const TurningCase<3> c = half_turn<3>({PairKind::kVertexFace, at, at});
  const FirstTouch touch = first_touch(c.pair());
  EXPECT_TRUE(touch.touches);
  EXPECT_LT(touch.time, 0.5);
  expect_touch(c, true, touch.time);
}

TEST(TurningPairTest, BothOnOneWayNeverMeet) {
  const std::array<std::array<double, 3>, 4> at{{{0.5, -1, 2}, {3, 1, 0}, {1, 4, 0}, {0, 1, 5}}};
  TurningCase<3> c = half_turn<3>({PairKind::kVertexFace, at, at});
  c.turns[1] = true;
  expect_touch(c, false, 0);
  c.points.start[0] = c.points.start[2];
  expect_touch(c, true, 0);
}

TEST(TurningPairTest, LengthsOfQuaternionsDoNotMatterForPlaces) {
  const std::array<std::array<double, 2>, 3> wall{{{0, -1}, {0, 1}, {0, 5}}};
  TurningCase<2> c = half_turn<2>({PairKind::kVertexEdge, wall, wall});
  expect_touch(c, true, 1);
  c.ways[0].turn[1][2] = 0x1p-700;
  expect_touch(c, true, 1);
  c.ways[0].turn[0][3] = -0x1p-900;
  expect_touch(c, true, 1);
}

TEST(TurningPairTest, AQuaternionMayNotVanish) {
  TurningWay way{{{1, 2, 3, 4}, {-2, -4, -6, -8}}, {}, {}};
  EXPECT_FALSE(has_turn<3>(way));
  way.turn[1][0] = std::nextafter(-2.0, 0);
  EXPECT_TRUE(has_turn<3>(way));
  EXPECT_FALSE(has_turn<2>(way));
  way = {{{0, 0, 0, 1}, {0, 0, 0, 0}}, {}, {}};
  EXPECT_FALSE(has_turn<3>(way));
}

}  // namespace
}  // namespace dsw
