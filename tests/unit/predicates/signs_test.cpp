// Signs of every family of point sets against GMP with the shift as a polynomial; then the cases one can do by hand.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "cases.h"
#include "oracle.h"
#include "predicates/filtered.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

constexpr std::uint64_t kSeed = 20100;

void expect_all_right(const PredicateTally& tally, double least_ties) {
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GE(tally.cases, case_count());
  EXPECT_GE(static_cast<double>(tally.ties), least_ties * static_cast<double>(tally.cases));
}

TEST(Signs, PlaneSideInThePlaneAgreesWithTheOracle) { expect_all_right(run_plane_side<2>(case_count(), kSeed), 0.2); }
TEST(Signs, PlaneSideInSpaceAgreesWithTheOracle) { expect_all_right(run_plane_side<3>(case_count(), kSeed), 0.2); }
TEST(Signs, LineSideInThePlaneAgreesWithTheOracle) { expect_all_right(run_line_side<2>(case_count(), kSeed), 0.2); }
TEST(Signs, LineSideInSpaceAgreesWithTheOracle) { expect_all_right(run_line_side<3>(case_count(), kSeed), 0.2); }
TEST(Signs, OrientInThePlaneAgreesWithTheOracle) { expect_all_right(run_orient<2>(case_count(), kSeed), 0.2); }
TEST(Signs, OrientInSpaceAgreesWithTheOracle) { expect_all_right(run_orient<3>(case_count(), kSeed), 0.2); }
TEST(Signs, TimesInThePlaneCompareAsInTheOracle) { expect_all_right(run_compare_times<2>(case_count(), kSeed), 0.03); }
TEST(Signs, TimesInSpaceCompareAsInTheOracle) { expect_all_right(run_compare_times<3>(case_count(), kSeed), 0.03); }

TEST(Signs, TheWholeOracleRunsAsTheBenchmarkCallsIt) {
  const PredicateTally tally = run_predicate_oracle(2000, 7);
  std::printf("predicates: %llu cases, %llu wrong\n", static_cast<unsigned long long>(tally.cases),
              static_cast<unsigned long long>(tally.wrong));
  EXPECT_EQ(tally.cases, 20000u);
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GT(tally.ties, 2000u);
}

TEST(Signs, ATriangleSeenCounterClockwiseHasItsViewerOutside) {
  const double a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0};
  const double* const triangle[] = {a, b, c};
  const double above[] = {0.2, 0.2, 1}, below[] = {0.2, 0.2, -1}, on[] = {5, -7, 0};
  EXPECT_EQ(orient<3>(triangle, above), 1);
  EXPECT_EQ(orient<3>(triangle, below), -1);
  EXPECT_EQ(orient<3>(triangle, on), 0);
  // On the plane the shift's z component decides: it points outside.
  const ShiftedSign tied = plane_side<3>(triangle, on, NoTally{});
  EXPECT_EQ(tied.sign, 1);
  EXPECT_TRUE(tied.tie);
}

TEST(Signs, AnEdgeOfACounterClockwisePolygonHasItsOutsideOnTheRight) {
  const double a[] = {0, 0}, b[] = {1, 0};
  const double* const edge[] = {a, b};
  const double left[] = {0.5, 1}, right[] = {0.5, -1}, on[] = {3, 0};
  EXPECT_EQ(orient<2>(edge, left), -1);
  EXPECT_EQ(orient<2>(edge, right), 1);
  // n = (0, -1): the shift moves the point up, inside.
  const ShiftedSign tied = plane_side<2>(edge, on, NoTally{});
  EXPECT_EQ(tied.sign, -1);
  EXPECT_TRUE(tied.tie);
}

TEST(Signs, AFlightThroughATriangleHasAllItsEdgesOnOneSide) {
  const double a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0};
  const double* const triangle[] = {a, b, c};
  const double p[] = {0.25, 0.25, -1}, q[] = {0.25, 0.25, 1}, beside[] = {2, 2, 1};
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 3; ++i) {
    const double* const edge[] = {triangle[i], triangle[(i + 1) % 3]};
    inside += line_side<3>(p, q, edge, NoTally{}).sign;
    outside += line_side<3>(p, beside, edge, NoTally{}).sign;
  }
  EXPECT_EQ(inside, 3);
  EXPECT_LT(outside, 3);
}

// With the shift a flight through a shared vertex or edge leaves a cell exactly once.
TEST(Signs, AFlightThroughAVertexPiercesExactlyOneTriangleOfAFan) {
  const double centre[] = {0, 0, 0};
  const double ring[6][3] = {{2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}};
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      const double p[] = {static_cast<double>(-x), static_cast<double>(-y), -1};
      const double q[] = {static_cast<double>(x), static_cast<double>(y), 1};
      int pierced = 0;
      for (int i = 0; i < 6; ++i) {
        const double* const t[] = {centre, ring[i], ring[(i + 1) % 6]};
        if (plane_side<3>(t, p, NoTally{}).sign >= 0 || plane_side<3>(t, q, NoTally{}).sign <= 0) continue;
        int all = 0;
        for (int k = 0; k < 3; ++k) {
          const double* const edge[] = {t[k], t[(k + 1) % 3]};
          all += line_side<3>(p, q, edge, NoTally{}).sign;
        }
        pierced += all == 3 ? 1 : 0;
      }
      EXPECT_EQ(pierced, 1) << x << " " << y;
    }
  }
}

TEST(Signs, APointOneUlpOffAPlaneIsNotOnIt) {
  const double a[] = {0.1, 0.2, 0.7}, b[] = {0.9, 0.3, 0.7}, c[] = {0.4, 0.8, 0.7};
  const double* const triangle[] = {a, b, c};
  const double on[] = {0.5, 0.5, 0.7};
  const double above[] = {0.5, 0.5, 0.70000000000000007}, below[] = {0.5, 0.5, 0.69999999999999984};
  EXPECT_EQ(orient<3>(triangle, on), 0);
  EXPECT_EQ(orient<3>(triangle, above), 1);
  EXPECT_EQ(orient<3>(triangle, below), -1);
}

TEST(Signs, TheLargestDoublesBesideTheSmallestStillHaveASign) {
  const double huge = 1.7976931348623157e308, tiny = 4.9406564584124654e-324;
  const double a[] = {-huge, -huge, 0}, b[] = {huge, -huge, 0}, c[] = {-huge, huge, 0};
  const double* const triangle[] = {a, b, c};
  const double above[] = {0, 0, tiny}, below[] = {tiny, -tiny, -tiny};
  EXPECT_EQ(orient<3>(triangle, above), 1);
  EXPECT_EQ(orient<3>(triangle, below), -1);
  EXPECT_FALSE(plane_side<3>(triangle, above, NoTally{}).tie);
}

TEST(Signs, ADegenerateTriangleIsTheOnlyOneWithoutASide) {
  const double a[] = {0, 0, 0}, b[] = {1, 1, 1}, c[] = {3, 3, 3}, q[] = {1, 2, 5};
  const double* const triangle[] = {a, b, c};
  const ShiftedSign side = plane_side<3>(triangle, q, NoTally{});
  EXPECT_EQ(side.sign, 0);
  EXPECT_TRUE(side.tie);
}

// They are refused before they come here; should one slip through, sanitizers must have nothing to say.
TEST(Signs, NonFiniteCoordinatesOnlyMakeTheAnswerMeaningless) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double odd[] = {infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), 4.9406564584124654e-324};
  Random random(4);
  PointSet<3> s;
  for (int i = 0; i < at_least(2000); ++i) {
    draw(random, kMaxPoints, s);
    for (int k = 0; k < 8; ++k) s.x[random.below(kMaxPoints)][random.below(3)] = odd[random.below(4)];
    ASSERT_LE(std::abs(plane_side<3>(s.at, s.at[3], NoTally{}).sign), 1);
    ASSERT_LE(std::abs(line_side<3>(s.at[0], s.at[1], s.at + 2, NoTally{}).sign), 1);
    ASSERT_LE(std::abs(compare_times<3>(s.at[0], s.at[1], s.at + 2, s.at + 5, NoTally{}).sign), 1);
    const double t = plane_hit<3>(s.at[0], s.at[1], s.at + 2).time;
    ASSERT_TRUE(t >= 0 && t <= 1);
  }
}

TEST(Signs, TimesAtOnePlaneAreEqualAndTimesAtTwoAreOrdered) {
  const double p[] = {0.3, 0.1, -1}, q[] = {0.3, 0.1, 1};
  const double a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0}, d[] = {4, 9, 0}, e[] = {1, 0, 0.5};
  const double* const first[] = {a, b, c};
  const double* const same[] = {b, d, c};
  const double* const turned[] = {a, c, b};
  const double* const later[] = {a, e, c};
  EXPECT_EQ(compare_times<3>(p, q, first, same, NoTally{}).sign, 0);
  EXPECT_TRUE(compare_times<3>(p, q, first, turned, NoTally{}).tie);
  EXPECT_EQ(compare_times<3>(p, q, first, turned, NoTally{}).sign, 0);
  EXPECT_EQ(compare_times<3>(p, q, first, later, NoTally{}).sign, -1);
  EXPECT_EQ(compare_times<3>(p, q, later, turned, NoTally{}).sign, 1);
  EXPECT_FALSE(compare_times<3>(p, q, later, turned, NoTally{}).tie);
}

}  // namespace
}  // namespace dsw
