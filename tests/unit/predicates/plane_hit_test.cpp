#include "predicates/plane_hit.h"

#include <gtest/gtest.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "cases.h"
#include "oracle.h"
#include "predicates/certified_hit.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

double vertical_time(double from, double to, double plane) {
  const double a[] = {0, 0, plane}, b[] = {1, 0, plane}, c[] = {0, 1, plane};
  const double* const triangle[] = {a, b, c};
  const double p[] = {0.3, 0.3, from}, q[] = {0.3, 0.3, to};
  return crossing_time<3>(p, q, triangle);
}

TEST(PlaneHit, TimeInThePlaneIsTheLargestDoubleBelow) {
  const PredicateTally tally = run_crossing_time<2>(case_count(), 3);
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GE(tally.cases, case_count());
}

TEST(PlaneHit, TimeInSpaceIsTheLargestDoubleBelow) {
  const PredicateTally tally = run_crossing_time<3>(case_count(), 3);
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GE(tally.cases, case_count());
}

TEST(PlaneHit, TimesThatAreDoublesComeOutAsThey) {
  EXPECT_EQ(vertical_time(-1, 1, 0), 0.5);
  EXPECT_EQ(vertical_time(0, 4, 3), 0.75);
  EXPECT_EQ(vertical_time(0, 1, 0.1), 0.1);
  EXPECT_EQ(vertical_time(0, 1, 0), 0.0);
  EXPECT_EQ(vertical_time(0, 1, 1), 1.0);
  EXPECT_EQ(vertical_time(0, 0x1p53, 1), 0x1p-53);
  EXPECT_FALSE(std::signbit(vertical_time(-0.0, 1, 0)));
}

TEST(PlaneHit, OtherTimesAreRoundedDownNeverToNearest) {
  EXPECT_EQ(vertical_time(0, 3, 1), 0x1.5555555555555p-2);
  EXPECT_EQ(vertical_time(0, 3, 2), 0x1.5555555555555p-1);  // to nearest it would be ...556
  // A hair before the end of the flight, and a hair before its middle.
  EXPECT_EQ(vertical_time(-0x1p30, std::nextafter(1.0, 2.0), 1), std::nextafter(1.0, 0.0));
  EXPECT_EQ(vertical_time(-0x1p30, 0x1p30, -0x1p-60), std::nextafter(0.5, 0.0));
}

TEST(PlaneHit, TinyAndHugeFlightsHaveTimes) {
  EXPECT_EQ(vertical_time(0, DBL_TRUE_MIN * 2, DBL_TRUE_MIN), 0.5);
  EXPECT_EQ(vertical_time(-DBL_MAX, DBL_MAX, 0), 0.5);
  EXPECT_EQ(vertical_time(0, DBL_MAX, DBL_TRUE_MIN), 0.0);         // below every double but 0
  EXPECT_EQ(vertical_time(0, 2, DBL_TRUE_MIN * 3), DBL_TRUE_MIN);  // 1.5 of the smallest one
  EXPECT_EQ(vertical_time(0, 0x1p1000, 0x1p-60), 0x1p-1060);       // subnormal
  EXPECT_EQ(vertical_time(0, 3, 0x1p-1040), std::floor(0x1p34 / 3) * 0x1p-1074);
}

// Component-wise, against 320-bit arithmetic.
template <int D>
void expect_normal(const double* const* simplex, const double* unit) {
  mpz_class n[D];
  oracle::normal<D>(simplex, n);
  mpf_class square(0, 320);
  mpf_class wanted[D];
  for (int k = 0; k < D; ++k) {
    wanted[k] = mpf_class(n[k], 320);
    square += wanted[k] * wanted[k];
  }
  ASSERT_GT(sgn(square), 0);
  const mpf_class length = sqrt(square);
  mpf_class unit_square(0, 320);
  for (int k = 0; k < D; ++k) {
    ASSERT_TRUE(std::isfinite(unit[k]));
    const mpf_class given(unit[k], 320);
    unit_square += given * given;
    const mpf_class error = abs(given - mpf_class(wanted[k] / length));
    EXPECT_LE(mpf_class(error / mpf_class(1, 320)).get_d(), 4 * DBL_EPSILON / 2 * std::fabs(unit[k]) + DBL_MIN);
  }
  EXPECT_LE(std::fabs(mpf_class(sqrt(unit_square) - 1).get_d()), 1e-15);
}

template <int D>
void check_normals() {
  Random random(17);
  PointSet<D> s;
  int checked = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    draw(random, D + 2, s);
    double unit[D];
    unit_normal<D>(s.at, unit);
    mpz_class n[D];
    oracle::normal<D>(s.at, n);
    bool flat = true;
    for (const mpz_class& c : n) flat = flat && sgn(c) == 0;
    if (flat) {
      for (const double c : unit) EXPECT_EQ(c, 0.0);
      continue;
    }
    ++checked;
    expect_normal<D>(s.at, unit);
    const PlaneHit<D> hit = plane_hit<D>(s.at[D], s.at[D + 1], s.at);
    for (int k = 0; k < D; ++k) {
      EXPECT_EQ(hit.normal[k], -unit[k]);
      EXPECT_FALSE(hit.normal[k] == 0 && std::signbit(hit.normal[k]));
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(checked, 10000);
}

TEST(PlaneHit, NormalInThePlaneIsAccurateAtEveryScale) { check_normals<2>(); }
TEST(PlaneHit, NormalInSpaceIsAccurateAtEveryScale) { check_normals<3>(); }

/** Random flights through random triangles, ordinary ones: general ones, or flat across an axis as the walls of a
 * lattice. */
void check_certified(bool across_an_axis) {
  std::mt19937_64 random(seed_of(23));
  std::uniform_real_distribution<double> coordinate(-1, 1);
  int contacts = 0, settled = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    double x[5][3];
    for (auto& point : x) {
      for (double& c : point) c = coordinate(random);
    }
    if (across_an_axis) x[3][i % 3] = x[4][i % 3] = x[2][i % 3];
    const double* const triangle[] = {x[2], x[3], x[4]};
    const double *p = x[0], *q = x[1];
    if (orient<3>(triangle, p) >= 0 || orient<3>(triangle, q) <= 0) continue;
    ++contacts;
    CertifiedHit fast, split;
    PlaneHit<3> inwards;
    ASSERT_FALSE(quick_plane_hit(q, p, triangle, &inwards));
    const bool is_known_free = certified_hit(p, q, triangle, true, &fast);
    ASSERT_EQ(certified_hit_without_fma(p, q, triangle, true, &split), is_known_free);
    if (!is_known_free) continue;
    ++settled;
    ASSERT_EQ(fast.time, split.time);
    mpz_class numerator, denominator;
    oracle::time<3>(p, q, triangle, numerator, denominator);
    ASSERT_TRUE(oracle::is_time_below(fast.time, numerator, denominator));
    mpz_class n[3];
    oracle::normal<3>(triangle, n);
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(fast.normal[k], split.normal[k]);
      EXPECT_EQ(sgn(n[k]) == 0, fast.normal[k] == 0);
    }
    double unit[3];
    unit_normal<3>(triangle, unit);
    const PlaneHit<3> hit = plane_hit<3>(p, q, triangle);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(hit.normal[k], -unit[k]);
  }
  EXPECT_GT(contacts, 3000);
  EXPECT_EQ(settled, contacts);
}

TEST(PlaneHit, OrdinaryContactsAreSettledWithoutIntegers) { check_certified(false); }
TEST(PlaneHit, WallsAcrossAnAxisAreSettledWithoutIntegers) { check_certified(true); }

/** Flights through random triangles at every scale, on lattices too, where times are doubles and components 0. */
TEST(PlaneHit, FlightsSideBySideAreThoseOneByOne) {
  std::mt19937_64 random(seed_of(29));
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const double scales[] = {1, 1, 1, 1e3, 1e-60, 1e60, 1e-150, 1e200};
  std::vector<std::array<std::array<double, 3>, 5>> points;
  while (points.size() < 3000) {
    std::array<std::array<double, 3>, 5> x;
    const double scale = scales[random() % 8];
    const bool lattice = random() % 4 == 0;
    for (auto& point : x) {
      for (double& c : point) c = scale * (lattice ? std::round(3 * coordinate(random)) : coordinate(random));
    }
    const double* const triangle[] = {x[2].data(), x[3].data(), x[4].data()};
    if (orient<3>(triangle, x[0].data()) < 0 && orient<3>(triangle, x[1].data()) > 0) points.push_back(x);
  }
  std::vector<PlaneFlight<3>> flights;
  for (const auto& x : points) flights.push_back({x[0].data(), x[1].data(), {x[2].data(), x[3].data(), x[4].data()}});
  uint32_t count = 0;
  for (size_t first = 0; first + count <= flights.size(); first += count, count = (count + 1) % 11) {
    std::vector<PlaneHit<3>> hits(count);
    plane_hits(flights.data() + first, count, hits.data());
    for (uint32_t i = 0; i < count; ++i) {
      const PlaneFlight<3>& f = flights[first + i];
      const PlaneHit<3> alone = plane_hit<3>(f.p, f.q, f.simplex);
      ASSERT_EQ(std::memcmp(&hits[i], &alone, sizeof alone), 0);
    }
  }
}

TEST(PlaneHit, NormalPointsBackToTheFlightAndIsExactAcrossAnAxis) {
  const double a[] = {0, 0, 7}, b[] = {0.1, 0, 7}, c[] = {0, 0.3, 7};
  const double* const triangle[] = {a, b, c};
  const double p[] = {0.01, 0.01, 0}, q[] = {0.01, 0.01, 28};
  const PlaneHit<3> hit = plane_hit<3>(p, q, triangle);
  EXPECT_EQ(hit.time, 0.25);
  EXPECT_EQ(hit.normal[0], 0.0);
  EXPECT_EQ(hit.normal[1], 0.0);
  EXPECT_EQ(hit.normal[2], -1.0);
}

}  // namespace
}  // namespace dsw
