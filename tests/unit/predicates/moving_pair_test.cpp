// First times of moving pairs against moving_pair_truth.h. With DSW_EFFORT=175 about a million
// times are compared.

#include "predicates/moving_pair.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <ostream>
#include <string>
#include <vector>

#include "moving_pair_cases.h"
#include "moving_pair_truth.h"

namespace dsw {
namespace {

struct Asked {
  PairKind kind;
  MovingFamily family;
};
// GoogleTest prints it.
void PrintTo(const Asked& asked, std::ostream* to) { *to << name_of(asked.family); }

std::vector<Asked> all_families(std::initializer_list<PairKind> kinds) {
  std::vector<Asked> r;
  for (const PairKind kind : kinds) {
    for (int i = 0; i < static_cast<int>(MovingFamily::kCount); ++i) r.push_back({kind, static_cast<MovingFamily>(i)});
  }
  return r;
}
std::string name_of_test(const testing::TestParamInfo<Asked>& info) {
  const PairKind kind = info.param.kind;
  return std::string(kind == PairKind::kVertexFace ? "VertexFace"
                     : kind == PairKind::kEdgeEdge ? "EdgeEdge"
                                                   : "VertexEdge") +
         name_of(info.param.family);
}

/// The order of two first times; the same if nobody has told that they are exact.
template <int D>
int order_of(const MovingPair<D>& a, const MovingPair<D>& b) {
  FirstTouch first_a = first_touch(a), first_b = first_touch(b);
  const int order = compare_first_touches(a, first_a, b, first_b);
  first_a.is_exact = first_b.is_exact = false;
  EXPECT_EQ(compare_first_touches(a, first_a, b, first_b), order);
  return order;
}

std::string text_of(const FirstTouch& touch) {
  char number[40];
  std::snprintf(number, sizeof number, "%a", touch.time);
  return touch.touches ? number : "never";
}

/** How many answers are wrong, and in which way. */
struct Differences {
  std::uint64_t cases = 0, touches = 0, missed = 0, made_up = 0, early = 0, late = 0;
  std::string first;

  void add(const FirstTouch& found, const FirstTouch& truth, const std::string& text) {
    ++cases;
    touches += truth.touches ? 1 : 0;
    if (found.touches == truth.touches && found.time == truth.time) return;
    if (first.empty()) first = text + " found " + text_of(found) + " truth " + text_of(truth);
    if (found.touches != truth.touches) {
      ++(truth.touches ? missed : made_up);
    } else {
      ++(found.time < truth.time ? early : late);
    }
  }
  void expect_none() const {
    EXPECT_TRUE(missed == 0 && made_up == 0 && early == 0 && late == 0)
        << "of " << cases << ": missed " << missed << ", made up " << made_up << ", early " << early << ", late "
        << late << "; " << first;
    EXPECT_GE(touches, cases / 64);
  }
};

bool is_made_to_touch(MovingFamily family) {
  return family == MovingFamily::kTouchAtStart || family == MovingFamily::kTouchAtEnd ||
         family == MovingFamily::kTouchBetween;
}

template <int D>
MovingCase<D> drawn(Random& random, Asked asked) {
  MovingCase<D> r;
  draw(random, asked.family, asked.kind, r);
  return r;
}

template <int D>
class MovingPairTest : public testing::TestWithParam<Asked> {
 protected:
  MovingCase<D> next() { return drawn<D>(random_, GetParam()); }
  MovingCase<D> next_that_touches() {
    Asked asked = GetParam();
    if (D == 3 && random_.below(4) == 0) asked.kind = PairKind::kEdgeEdge;
    MovingCase<D> r = drawn<D>(random_, asked);
    for (int more = 1000; more > 0 && !first_touch(r.pair()).touches; --more) r = drawn<D>(random_, asked);
    return r;
  }

  void times_are_true() {
    Differences differences;
    for (std::uint64_t i = 0; i < cases_; ++i) {
      const MovingCase<D> c = next();
      const FirstTouch truth = true_first_touch(c.pair());
      differences.add(first_touch(c.pair()), truth, c.text());
      for (const double until : {truth.time, 0.75 * truth.time, std::fabs(random_.uniform())}) {
        const FirstTouch asked = first_touch(c.pair(), nullptr, until);
        // A touch up to that time is found, and a later one may be left out.
        ASSERT_TRUE(asked.touches ? truth.touches : !truth.touches || truth.time > until) << until << c.text();
        ASSERT_TRUE(!asked.touches || asked.time == truth.time) << until << c.text();
      }
    }
    differences.expect_none();
    if (is_made_to_touch(GetParam().family)) {
      EXPECT_EQ(differences.touches, differences.cases);
    }
  }

  void sides_are_true() {
    for (std::uint64_t i = 0; i < cases_; ++i) {
      const MovingCase<D> c = next();
      ASSERT_EQ(kept_side(c.pair()), true_kept_side(c.pair())) << c.text();
    }
  }

  void names_do_not_matter() {
    Differences differences;
    for (std::uint64_t i = 0; i < cases_; ++i) {
      const MovingCase<D> c = next();
      MovingCase<D> other = c;
      rename(random_, other);
      const FirstTouch touch = first_touch(c.pair());
      differences.add(first_touch(other.pair()), touch, c.text() + " renamed " + other.text());
      if (touch.touches) {
        ASSERT_EQ(order_of(c.pair(), other.pair()), 0) << c.text() << other.text();
      }
    }
    differences.expect_none();
  }

  /** Pairs are compared that have much in common, so that many first times are equal or nearly so. */
  void comparisons_are_true() {
    for (std::uint64_t i = 0; i < cases_; ++i) {
      const MovingCase<D> a = next_that_touches();
      MovingCase<D> b = a;
      if (random_.below(4) == 0) b = next_that_touches();
      rename(random_, b);
      if (random_.below(2) == 0) shear(random_, b);
      if (random_.below(2) == 0) nudge(random_, b);
      if (!first_touch(b.pair()).touches) continue;
      const int truth = true_compare(a.pair(), b.pair());
      ASSERT_EQ(order_of(a.pair(), b.pair()), truth) << a.text() << b.text();
      ASSERT_EQ(order_of(b.pair(), a.pair()), -truth) << a.text() << b.text();
    }
  }

  const std::uint64_t cases_ = case_count() / 400;
  Random random_{static_cast<std::uint64_t>(GetParam().family) * 8 + static_cast<std::uint64_t>(GetParam().kind)};
};

class SpaceMovingPairTest : public MovingPairTest<3> {};
INSTANTIATE_TEST_SUITE_P(All, SpaceMovingPairTest,
                         testing::ValuesIn(all_families({PairKind::kVertexFace, PairKind::kEdgeEdge})), name_of_test);
TEST_P(SpaceMovingPairTest, TimesAreTrue) { times_are_true(); }
TEST_P(SpaceMovingPairTest, SidesAreTrue) { sides_are_true(); }
TEST_P(SpaceMovingPairTest, NamesDoNotMatter) { names_do_not_matter(); }
TEST_P(SpaceMovingPairTest, ComparisonsAreTrue) { comparisons_are_true(); }

class PlaneMovingPairTest : public MovingPairTest<2> {};
INSTANTIATE_TEST_SUITE_P(All, PlaneMovingPairTest, testing::ValuesIn(all_families({PairKind::kVertexEdge})),
                         name_of_test);
TEST_P(PlaneMovingPairTest, TimesAreTrue) { times_are_true(); }
TEST_P(PlaneMovingPairTest, SidesAreTrue) { sides_are_true(); }
TEST_P(PlaneMovingPairTest, NamesDoNotMatter) { names_do_not_matter(); }
TEST_P(PlaneMovingPairTest, ComparisonsAreTrue) { comparisons_are_true(); }

/** What hardly moves and is nearly flat: rounding may turn the sign of the volume. */
template <size_t D>
void sides_of_flat_ones_are_true(PairKind kind) {
  Random random{D};
  std::uint64_t below = 0, above = 0;
  const std::uint64_t cases = case_count() / 100;
  for (std::uint64_t i = 0; i < cases; ++i) {
    MovingCase<static_cast<int>(D)> c{kind, {}, {}};
    double weights[D + 1] = {}, rest = 1;
    for (size_t j = 1; j < D; ++j) rest -= weights[j] = random.uniform() / 2;
    weights[D] = rest;
    for (size_t k = 0; k < D; ++k) {
      double sum = 0;
      for (size_t j = 1; j <= D; ++j) {
        c.start[j][k] = random.uniform() * std::ldexp(1.0, random.below(12));
        sum += weights[j] * c.start[j][k];
      }
      c.start[0][k] = sum;
    }
    c.end = c.start;
    if (i % 4 == 0) c.end[i % (D + 1)][0] = std::nextafter(c.end[i % (D + 1)][0], 8);
    const int truth = true_kept_side(c.pair());
    below += truth < 0 ? 1 : 0;
    above += truth > 0 ? 1 : 0;
    ASSERT_EQ(kept_side(c.pair()), truth) << c.text();
  }
  EXPECT_GE(below, cases / 8);
  EXPECT_GE(above, cases / 8);
}
TEST(MovingPairTest, SidesOfWhatIsNearlyFlatAreTrue) {
  sides_of_flat_ones_are_true<2>(PairKind::kVertexEdge);
  sides_of_flat_ones_are_true<3>(PairKind::kVertexFace);
  sides_of_flat_ones_are_true<3>(PairKind::kEdgeEdge);
}

/** Times that follow from how a pair is made; the truth has to know them, too. */
template <int D>
void expect_time(const MovingCase<D>& c, bool touches, double time) {
  for (const FirstTouch& each : {first_touch(c.pair()), true_first_touch(c.pair())}) {
    EXPECT_EQ(each.touches, touches) << c.text();
    EXPECT_EQ(each.time, time) << c.text();
  }
}

TEST(MovingPairTest, AVertexFallsOnATriangle) {
  const MovingCase<3> falls{PairKind::kVertexFace,
                            {{{1, 1, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}},
                            {{{1, 1, -3}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  expect_time(falls, true, 0.25);
  MovingCase<3> beside = falls;
  beside.start[0] = beside.end[0] = {3, 1, 1};
  beside.end[0][2] = -2;
  expect_time(beside, true, 1.0 / 3);  // rounded down
  beside.start[0][0] = beside.end[0][0] = std::nextafter(3.0, 4);
  expect_time(beside, false, 0);
}

TEST(MovingPairTest, ATimeIsTheDoubleBelowTheRootOfAHalf) {
  // The area is a multiple of 1 - 2 t^2.
  const MovingCase<2> turns{PairKind::kVertexEdge, {{{0, -1}, {0, 0}, {4, 0}}}, {{{2, -1}, {0, 0}, {4, -4}}}};
  expect_time(turns, true, std::nextafter(std::sqrt(0.5), 0));
}

TEST(MovingPairTest, EdgesGrazeInTheMiddle) {
  // The volume is a multiple of (1 - 2 t)^2.
  MovingCase<3> grazes{PairKind::kEdgeEdge,
                       {{{0, 0, 0}, {4, 4, 0}, {2, 1, -1}, {2, 1, 1}}},
                       {{{0, 0, 0}, {4, -4, 0}, {0, -1, -1}, {0, -1, 1}}}};
  expect_time(grazes, true, 0.5);
  grazes.start[1][1] = std::nextafter(4.0, 5);
  expect_time(grazes, false, 0);
}

TEST(MovingPairTest, FiveTimesAreBetweenADoubleAndTheNext) {
  // m/n. The first is a double, the second is above it by 1 / (n n'), the others are between them.
  const double first[2] = {0x31415927p0, 0x1p30}, second[2] = {0xdbcbab1p0, 0x11d97969p0};
  const std::array<std::array<double, 2>, 5> times{{{first[0], first[1]},
                                                    {second[0], second[1]},
                                                    {first[0] + second[0], first[1] + second[1]},
                                                    {2 * first[0] + second[0], 2 * first[1] + second[1]},
                                                    {first[0] + 2 * second[0], first[1] + 2 * second[1]}}};
  // The vertex stays at 0. One end of the edge passes 0 at time k/l, the line of the edge contains 0 at time m/n, too.
  std::vector<MovingCase<2>> cases;
  for (const auto& [m, n] : times) {
    for (const auto& [k, l] : times) {
      for (const double side : {-1.0, 1.0}) {
        const MovingCase<2> c{
            PairKind::kVertexEdge, {{{0, 0}, {-m, side}, {0, -k}}}, {{{0, 0}, {n - m, side}, {0, l - k}}}};
        expect_time(c, true, first[0] / first[1]);
        cases.push_back(c);
      }
    }
  }
  for (const MovingCase<2>& a : cases) {
    for (const MovingCase<2>& b : cases) {
      ASSERT_EQ(order_of(a.pair(), b.pair()), true_compare(a.pair(), b.pair())) << a.text() << b.text();
    }
  }
}

TEST(MovingPairTest, RootsBetweenOneAndTheDoubleBeforeIt) {
  // Two roots of the volume are there. The pair touches at one of them.
  const double before_one = std::nextafter(1.0, 0);
  const MovingCase<3> points{PairKind::kEdgeEdge,
                             {{{0x1.ec23b37cdfe54p-5, -0x1.01ed6d3c92e38p+462, 0x1.29bce934ed8d4p+446},
                               {0x1.17966288f981ap+236, 0x0p+0, -0x1.ba4568b12262p+442},
                               {-0x1.b3e7f27d8fea4p-1010, -0x1.7513b6290f6bp+171, -0x1.fb7aa748051c4p-957},
                               {-0x1.93896125f80c8p+422, 0x0p+0, -0x1.f510769738354p+950}}},
                             {{{-0x1.b982bcb049842p-132, 0x0p+0, 0x1.1c8176948f0f2p+377},
                               {0x0p+0, 0x0p+0, 0x0p+0},
                               {0x1.f35699ac199bap+92, 0x0.0000000001a2dp-1022, -0x1.a7c07264f9a12p-826},
                               {-0x1.097372daf46e4p-236, 0x1.fcd0d6ce0416p-521, 0x1.00dad3eaecdfap+368}}}};
  expect_time(points, true, before_one);
  const MovingCase<3> spread{PairKind::kEdgeEdge,
                             {{{0x1p-745, 0x1p+664, 0x1p+529},
                               {0x1.0b74p-361, -0x1p+134, -0x1p+880},
                               {-0x1.0b728p+204, 0x1p-153, 0x1.4p+202},
                               {-0x1.0b72p+322, -0x1.21bcp+10, -0x1p+60}}},
                             {{{-0x1p-813, 0x1p-765, -0x1p-794},
                               {-0x1.62243p-441, 0x1p-195, -0x1.8p-714},
                               {0x1.622418p-120, -0x1p-349, 0x0p+0},
                               {0x1.62241p-569, 0x1.d998p-140, -0x1.8p+539}}}};
  expect_time(spread, true, before_one);
}

TEST(MovingPairTest, TwoRootsAreBetweenADoubleAndTheNextAndOneIsBesideIt) {
  const MovingCase<3> close{PairKind::kVertexFace,
                            {{{-0x1.b77ff8c578cp-3, 0x1.a6aa07f875c4p-1, -0x1.f4fa8f79117fp-1},
                              {0x1.1637e5dde0ce6p+0, 0x1.4edd28b02861p+0, 0x1.e04a7dd331bacp+0},
                              {0x1.1373923e83fa1p+1, 0x1.9bdfdc63d7b1p+2, -0x1.8c9e0dda46f17p+3},
                              {0x1.fd73232bc8a68p-2, 0x1.51d5828deda0cp+0, -0x1.37510fa6163ep+1}}},
                            {{{0x1.4a27201f5ba5ap-1, 0x1.51176c167c50dp+0, -0x1.5ae6f80454ee5p+0},
                              {-0x1.4ea847622a06cp+0, 0x1.2f966a113024ap-1, -0x1.68c4a816fb297p+2},
                              {-0x1.73d792a8725fcp+1, -0x1.c64a0e118e60ap+2, 0x1.f898b85386288p+3},
                              {-0x1.b17e6f17103e8p-2, 0x1.26ad5c77e0656p-1, 0x1.a6a096a64158ep-1}}}};
  expect_time(close, true, 0x1.9999999999999p-2);
}

TEST(MovingPairTest, WhatLiesInOneLineTouches) {
  const MovingCase<3> edges{PairKind::kEdgeEdge,
                            {{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}}},
                            {{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 0}}}};
  expect_time(edges, true, 0.5);
  const MovingCase<3> flat{PairKind::kVertexFace,
                           {{{5, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
                           {{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}};
  expect_time(flat, true, 0.75);
}

TEST(MovingPairTest, PointsMeetAtTheEnd) {
  const MovingCase<3> points{PairKind::kEdgeEdge,
                             {{{0, 0, 0}, {0, 0, 0}, {1, 2, 3}, {1, 2, 3}}},
                             {{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}}}};
  expect_time(points, true, 1);
}

}  // namespace
}  // namespace dsw
