// Events of a swept edge against polynomials in the infinitesimal over GMP: every body point x is x + (e, e^2, e^3).

#include "predicates/sweep_events.h"

#include <gtest/gtest.h>

#include <array>

#include "cases.h"
#include "oracle.h"

namespace dsw {
namespace {

/** Coefficients of 1, e, e^2, ... */
struct Poly {
  std::array<mpz_class, 16> c;

  int sign() const {
    for (const mpz_class& each : c) {
      if (sgn(each) != 0) return sgn(each);
    }
    return 0;
  }
};
Poly operator-(const Poly& a, const Poly& b) {
  Poly r;
  for (size_t i = 0; i < r.c.size(); ++i) r.c[i] = a.c[i] - b.c[i];
  return r;
}
Poly operator+(const Poly& a, const Poly& b) {
  Poly r;
  for (size_t i = 0; i < r.c.size(); ++i) r.c[i] = a.c[i] + b.c[i];
  return r;
}
Poly operator*(const Poly& a, const Poly& b) {
  Poly r;
  for (size_t i = 0; i < r.c.size(); ++i) {
    for (size_t j = 0; sgn(a.c[i]) != 0 && i + j < r.c.size(); ++j) r.c[i + j] += a.c[i] * b.c[j];
  }
  return r;
}

using Point = std::array<Poly, 3>;

Point fixed(const double* x) {
  Point r;
  for (size_t k = 0; k < 3; ++k) r[k].c[0] = oracle::integer(x[k]);
  return r;
}
Point shifted(const double* x) {
  Point r = fixed(x);
  for (size_t k = 0; k < 3; ++k) r[k].c[k + 1] = oracle::integer(1.0);
  return r;
}
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Poly dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Ratio {
  Poly numerator, denominator;

  /** Whether it lies in [0, 1]: then the event can take place. */
  bool takes_place() const {
    const int turn = denominator.sign();
    return turn != 0 && numerator.sign() * turn >= 0 && (numerator - denominator).sign() * turn <= 0;
  }
};

Ratio ratio_of(const EdgeMotion& m, const SweepEvent& event) {
  const Point p = shifted(m.p), to = shifted(m.to), q = shifted(m.q);
  const Point a = fixed(event.points[0]), b = fixed(event.points[1]);
  if (!event.of_edge) {
    const Point n = cross(b - a, fixed(event.points[2]) - a);
    return {dot(n, a - p), dot(n, to - p)};
  }
  const auto line = [&](const Point& x) { return dot(q - x, cross(a - x, b - x)); };
  return {line(p), line(p) - line(to)};
}

bool is_time_of(double t, const Ratio& ratio) {
  size_t k = 0;
  while (sgn(ratio.denominator.c[k]) == 0) ++k;
  const mpz_class &n = ratio.numerator.c[k], &d = ratio.denominator.c[k];
  return sgn(d) > 0 ? oracle::is_time_below(t, n, d) : oracle::is_time_below(t, -n, -d);
}

TEST(SweepEvents, OrderAndTimesAreThoseOfThePolynomials) {
  Random random(41);
  PointSet<3> s;
  int compared = 0, ties = 0, vanishing = 0, deep = 0;
  for (int i = 0; i < 60000; ++i) {
    draw(random, 8, s);
    // Often something stands twice: an end on an obstacle's vertex, two lines with a common point or the same line.
    if (random.below(3) == 0) std::copy_n(s.x[random.between(3, 7)], 3, s.x[random.below(3)]);
    if (random.below(4) == 0) std::copy_n(s.x[random.between(3, 4)], 3, s.x[random.between(6, 7)]);
    const EdgeMotion m{s.at[0], s.at[1], s.at[2]};
    const SweepEvent a{{s.at[3], s.at[4], s.at[5]}, random.below(3) != 0};
    const SweepEvent b{{s.at[5], s.at[6], s.at[7]}, random.below(3) != 0};
    const Ratio ra = ratio_of(m, a), rb = ratio_of(m, b);
    if (!ra.takes_place() || !rb.takes_place()) continue;
    const Poly left = ra.numerator * rb.denominator, right = rb.numerator * ra.denominator;
    const int truth = (left - right).sign() * ra.denominator.sign() * rb.denominator.sign();
    const ShiftedSign found = compare_events(m, a, b);
    ASSERT_EQ(found.sign, truth) << i;
    ASSERT_EQ(compare_events(m, b, a).sign, -truth) << i;
    ASSERT_TRUE(is_time_of(event_time(m, a), ra)) << i;
    ASSERT_TRUE(is_time_of(event_time(m, b), rb)) << i;
    ++compared;
    ties += found.tie ? 1 : 0;
    vanishing += sgn(ra.denominator.c[0]) == 0 || sgn(rb.denominator.c[0]) == 0 ? 1 : 0;
    deep += found.tie && sgn((left - right).c[1]) == 0 && truth != 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 3000);
  EXPECT_GT(ties, 300);
  EXPECT_GT(vanishing, 30);
  EXPECT_GT(deep, 30);
}

TEST(SweepEvents, SidesOfTheSweptPlaneAreThoseOfThePolynomials) {
  Random random(43);
  PointSet<3> s;
  int ties = 0;
  for (int i = 0; i < 30000; ++i) {
    draw(random, 4, s);
    const EdgeMotion m{s.at[0], s.at[1], s.at[2]};
    const Point p = shifted(m.p);
    const Poly truth = dot(cross(shifted(m.to) - p, shifted(m.q) - p), fixed(s.at[3]) - p);
    const ShiftedSign found = swept_side(m, s.at[3]);
    ASSERT_EQ(found.sign, truth.sign()) << i;
    ASSERT_EQ(found.tie, sgn(truth.c[0]) == 0) << i;
    ties += found.tie ? 1 : 0;
  }
  EXPECT_GT(ties, 1000);
}

}  // namespace
}  // namespace dsw
