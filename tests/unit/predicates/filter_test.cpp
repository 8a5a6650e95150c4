// What the filter promises: a bound that holds for every order of evaluation, few fallbacks, honest counts.
#include "predicates/filtered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cases.h"
#include "oracle.h"
#include "predicates/inside_tetrahedron.h"
#include "predicates/swept_plane.h"

namespace dsw {
namespace {

/** Counts predicates that are asked, those that the filter left to integers, and those whose value is zero without the shift. */
struct CountingTally {
  std::uint64_t tests = 0;
  std::uint64_t exacts = 0;
  std::uint64_t ties = 0;

  void test() noexcept { ++tests; }
  void exact() noexcept { ++exacts; }
  void tie() noexcept { ++ties; }
};

template <int D>
void count_generic(CountingTally& tally, Scale scale) {
  Random random(11);
  PointSet<D> s;
  for (int i = 0; i < at_least(50000); ++i) {
    draw(random, Shape::kUniform, scale, 2 + 2 * D, s);
    plane_side<D>(s.at, s.at[D], tally);
    line_side<D>(s.at[0], s.at[1], s.at + 2, tally);
    compare_times<D>(s.at[0], s.at[1], s.at + 2, s.at + 2 + D, tally);
  }
}

TEST(Filter, DecidesGenericInput) {
  CountingTally plane, space;
  count_generic<2>(plane, Scale::kOne);
  count_generic<3>(space, Scale::kOne);
  EXPECT_EQ(plane.tests, 150000u);
  EXPECT_EQ(space.tests, 150000u);
  EXPECT_LT(plane.exacts, 150u);
  EXPECT_LT(space.exacts, 150u);
  EXPECT_EQ(space.ties, 0u);
}

TEST(Filter, SeesWhichFacetsOfATetrahedronAreVisible) {
  constexpr int kFacets[4][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  Random random(12);
  PointSet<3> s;
  int seen = 0, inside = 0, decided = 0, clear = 0;
  for (int i = 0; i < at_least(40000); ++i) {
    draw(random, i % 2 == 0 ? Shape::kUniform : Shape::kLattice, Scale::kOne, 5, s);
    const double* corners[4] = {s.at[0], s.at[1], s.at[2], s.at[3]};
    const double* const last[3] = {corners[0], corners[1], corners[3]};
    if (exact::orient<3>(last, corners[2]) > 0) std::swap(corners[0], corners[1]);
    uint32_t visible = 0;
    bool is_on = false;
    for (uint32_t f = 0; f < 4; ++f) {
      const double* const facet[3] = {corners[kFacets[f][0]], corners[kFacets[f][1]], corners[kFacets[f][2]]};
      const int side = exact::orient<3>(facet, s.at[4]);
      visible |= static_cast<uint32_t>(side > 0) << f;
      is_on = is_on || side == 0;
    }
    const uint32_t found = visible_facets(corners, s.at[4]);
    const bool is_decided = found != kUncertainFacets;
    if (is_decided) {
      ASSERT_FALSE(is_on);
      ASSERT_EQ(found, visible);
    }
    seen += found == 0 ? 1 : 0;
    inside += visible == 0 && !is_on ? 1 : 0;
    decided += is_decided ? 1 : 0;
    clear += is_on ? 0 : 1;
  }
  EXPECT_GT(seen, 200);
  EXPECT_GT(10 * seen, 9 * inside);
  EXPECT_GT(10 * decided, 9 * clear);
}

struct SweptCounts {
  int sides = 0, beside = 0, off = 0;
};

/** What is known of a swept triangle is true, whatever the points. */
void check_swept(const PointSet<3>& s, SweptCounts& counts) {
  const double *const p = s.at[0], *const to = s.at[1], *const q = s.at[2], *const a = s.at[3], *const b = s.at[4];
  const auto turn = [](const double* w, const double* x, const double* y, const double* z) {
    const double* const triangle[] = {w, x, y};
    return exact::orient<3>(triangle, z);
  };
  const EdgeMotion m{p, to, q};
  double lower[3], upper[3];
  for (int k = 0; k < 3; ++k) {
    lower[k] = std::min({p[k], to[k], q[k], a[k], b[k]});
    upper[k] = std::max({p[k], to[k], q[k], a[k], b[k]});
  }
  for (const double bound : {filter::bound_in_box(lower, upper), kNoBound}) {
    const SweptPlane plane(m, bound), other({p, to, a}, bound);
    const int side = plane.side(a), side_of_b = plane.side(b);
    ASSERT_TRUE(side == 0 || side == turn(p, to, q, a));
    ASSERT_TRUE(side_of_b == 0 || side_of_b == turn(p, to, q, b));
    ASSERT_EQ(plane.side(other), side);
    const bool beside = SweptEdge(m, bound).stays_beside(a, b);
    ASSERT_TRUE(!beside || turn(p, q, a, b) * turn(to, q, a, b) == 1);
    if (bound != kNoBound) continue;
    counts.sides += side != 0 ? 1 : 0;
    counts.beside += beside ? 1 : 0;
    counts.off += side != 0 && side_of_b != 0 ? 1 : 0;
  }
}

TEST(Filter, KnowsOfASweptTriangleOnlyWhatIsTrue) {
  Random random(17);
  PointSet<3> s;
  SweptCounts counts;
  for (std::uint64_t i = 0; i < case_count(); ++i) {
    draw(random, 5, s);
    if (random.below(4) == 0) {  // a short move
      for (int k = 0; k < 3; ++k) s.x[1][k] = s.x[0][k] + (s.x[1][k] - s.x[0][k]) * 0x1p-40;
    }
    ASSERT_NO_FATAL_FAILURE(check_swept(s, counts)) << i;
  }
  EXPECT_GT(counts.sides, 0);
}

TEST(Filter, KnowsMostOfShortMoves) {
  Random random(19);
  PointSet<3> s;
  SweptCounts counts;
  for (int i = 0; i < at_least(10000); ++i) {
    draw(random, Shape::kUniform, Scale::kOne, 5, s);
    for (int k = 0; k < 3; ++k) s.x[1][k] = s.x[0][k] + 0x1p-30 * s.x[1][k];
    ASSERT_NO_FATAL_FAILURE(check_swept(s, counts)) << i;
  }
  EXPECT_GT(counts.sides, 9990);
  EXPECT_GT(counts.beside, 9900);
  EXPECT_GT(counts.off, 9990);
}

TEST(Filter, KnowsByABoxWhatIsNotSmallInIt) {
  const double p[] = {0, 0, 0}, to[] = {0.5, 0, 0}, q[] = {0, 1, 0}, a[] = {0.25, 0.25, 0.5}, b[] = {0.25, 0.5, 1};
  const double lower[] = {0, 0, 0}, upper[] = {1, 1, 1}, huge[] = {1e200, 1, 1};
  const double bound = filter::bound_in_box(lower, upper);
  EXPECT_EQ(bound, kPlaneFilter3);
  EXPECT_EQ(filter::bound_in_box(lower, huge), kNoBound);
  EXPECT_EQ(filter::bound_in_box(lower, lower), kNoBound);
  EXPECT_EQ(SweptPlane({p, to, q}, bound).side(a), SweptPlane({p, to, q}).side(a));
  EXPECT_EQ(SweptEdge({p, to, q}, bound).stays_beside(a, b), SweptEdge({p, to, q}).stays_beside(a, b));
}

TEST(Filter, LeavesWhatMayOverflowToIntegers) {
  CountingTally tally;
  count_generic<3>(tally, Scale::kThreeHundred);
  EXPECT_EQ(tally.exacts, tally.tests);
}

TEST(Filter, DecidesAPlaneAcrossAnAxisWithoutIntegers) {
  CountingTally tally;
  const double a[] = {0.1, 0.2, 0.7}, b[] = {0.9, 0.3, 0.7}, c[] = {0.4, 0.8, 0.7}, q[] = {3, 4, 0.7};
  const double* const triangle[] = {a, b, c};
  const ShiftedSign side = plane_side<3>(triangle, q, tally);
  EXPECT_EQ(side.sign, 1);
  EXPECT_TRUE(side.tie);
  const double* const edge[] = {a, b};
  EXPECT_TRUE(line_side<3>(c, q, edge, tally).tie);
  EXPECT_EQ(tally.tests, 2u);
  EXPECT_EQ(tally.ties, 2u);
  EXPECT_EQ(tally.exacts, 0u);
}

TEST(Filter, CountsATieOfASlantedPlaneAsExactAndTie) {
  CountingTally tally;
  const double a[] = {0, 0, 0}, b[] = {1, 2, 3}, c[] = {-1, 5, 4}, q[] = {0, 7, 7};
  const double* const triangle[] = {a, b, c};
  EXPECT_TRUE(plane_side<3>(triangle, q, tally).tie);
  const double off[] = {0, 7, std::nextafter(7.0, 8.0)};
  EXPECT_FALSE(plane_side<3>(triangle, off, tally).tie);
  EXPECT_EQ(tally.tests, 2u);
  EXPECT_EQ(tally.exacts, 2u);
  EXPECT_EQ(tally.ties, 1u);
}

// One of the three cofactor expansions of the rows w, e1, e2.
double expanded(const double (&m)[3][3], int row) {
  const double* r = m[row];
  const double* s = m[(row + 1) % 3];
  const double* t = m[(row + 2) % 3];
  const double x = s[1] * t[2] - s[2] * t[1];
  const double y = s[2] * t[0] - s[0] * t[2];
  const double z = s[0] * t[1] - s[1] * t[0];
  return row == 1 ? r[2] * z + (r[1] * y + r[0] * x) : (r[0] * x + r[1] * y) + r[2] * z;
}

// Entries near +-1 with noise in the last bits come closest to the bound: the largest determinant has size 4 there.
TEST(Filter, BoundHoldsForEveryRowAndIsNotFarTooLarge) {
  Random random(5);
  double worst = 0;
  for (std::uint64_t i = 0; i < 2 * case_count(); ++i) {
    double x[4][3];
    for (auto& point : x) {
      for (double& c : point) {
        c = random.below(2) != 0 ? random.uniform()
                                 : (random.below(2) != 0 ? 0.5 : -0.5) + random.between(-9, 9) * 0x1p-53;
      }
    }
    double m[3][3];
    mpz_class exact[3][3];
    double bound = kPlaneFilter3;
    for (int k = 0; k < 3; ++k) {
      double extent = 0;
      for (int r = 0; r < 3; ++r) {
        m[r][k] = x[r + 1][k] - x[0][k];
        exact[r][k] = oracle::integer(x[r + 1][k]) - oracle::integer(x[0][k]);
        extent = std::fmax(extent, std::fabs(m[r][k]));
      }
      bound *= extent;
    }
    mpz_class det = 0;
    for (int k = 0; k < 3; ++k) {
      const int y = (k + 1) % 3;
      const int z = (k + 2) % 3;
      det += exact[0][k] * (exact[1][y] * exact[2][z] - exact[1][z] * exact[2][y]);
    }
    if (bound == 0) {
      ASSERT_EQ(sgn(det), 0);
      continue;
    }
    for (int row = 0; row < 3; ++row) {
      const mpz_class error = (oracle::integer(expanded(m, row)) << 2148) - det;
      // Both at 2^-3222; the error is small beside the bound, so that rounding it to a double is of no consequence.
      const mpf_class ratio = mpf_class(abs(error), 128) / mpf_class(oracle::integer(bound) << 2148, 128);
      worst = std::fmax(worst, ratio.get_d());
    }
  }
  EXPECT_LE(worst, 1.0);
  EXPECT_GT(worst, 0.04);
}

}  // namespace
}  // namespace dsw
