// Events of a swept edge against polynomials in the infinitesimal over GMP: every body point x is x + (e, e^2, e^3).

#include "predicates/sweep_events.h"

#include <gtest/gtest.h>

#include <algorithm>
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

template <int D>
using Point = std::array<Poly, D>;

template <int D>
Point<D> fixed(const double* x) {
  Point<D> r;
  for (size_t k = 0; k < D; ++k) r[k].c[0] = oracle::integer(x[k]);
  return r;
}
template <int D>
Point<D> shifted(const double* x) {
  Point<D> r = fixed<D>(x);
  for (size_t k = 0; k < D; ++k) r[k].c[k + 1] = oracle::integer(1.0);
  return r;
}
template <size_t D>
std::array<Poly, D> operator-(const std::array<Poly, D>& a, const std::array<Poly, D>& b) {
  std::array<Poly, D> r;
  for (size_t k = 0; k < D; ++k) r[k] = a[k] - b[k];
  return r;
}
Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Poly dot(const Point<3>& a, const Point<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/** a x b in the plane. */
Poly cross(const Point<2>& a, const Point<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

struct Ratio {
  Poly numerator, denominator;

  /** Whether it lies in [0, 1]: then the event can take place. */
  bool takes_place() const {
    const int turn = denominator.sign();
    return turn != 0 && numerator.sign() * turn >= 0 && (numerator - denominator).sign() * turn <= 0;
  }
};

template <int D>
Ratio ratio_of(const double* from, const double* target, const SweepEvent& event);

template <>
Ratio ratio_of<3>(const double* from, const double* target, const SweepEvent& event) {
  const Point<3> p = shifted<3>(from), to = shifted<3>(target);
  if (event.kind == EventKind::kVertex) {
    const Point<3> a = fixed<3>(event.points[0]);
    const Point<3> n = cross(fixed<3>(event.points[1]) - a, fixed<3>(event.points[2]) - a);
    return {dot(n, a - p), dot(n, to - p)};
  }
  const Point<3> y = shifted<3>(event.points[0]), w = fixed<3>(event.points[2]);
  const Point<3> z = event.kind == EventKind::kEdge ? fixed<3>(event.points[1]) : shifted<3>(event.points[1]);
  const auto value = [&](const Point<3>& x) { return dot(y - x, cross(z - x, w - x)); };
  return {value(p), value(p) - value(to)};
}

/** The line a b is met by p, or the point v by the edge p q: the area of either three points changes its sign. */
template <>
Ratio ratio_of<2>(const double* from, const double* target, const SweepEvent& event) {
  const Point<2> p = shifted<2>(from), to = shifted<2>(target), b = fixed<2>(event.points[1]);
  const Point<2> a = event.kind == EventKind::kEdge ? shifted<2>(event.points[0]) : fixed<2>(event.points[0]);
  const auto value = [&](const Point<2>& x) { return cross(a - x, b - x); };
  return {value(p), value(p) - value(to)};
}

bool is_time_of(double t, const Ratio& ratio) {
  size_t k = 0;
  while (sgn(ratio.denominator.c[k]) == 0) ++k;
  const mpz_class &n = ratio.numerator.c[k], &d = ratio.denominator.c[k];
  return sgn(d) > 0 ? oracle::is_time_below(t, n, d) : oracle::is_time_below(t, -n, -d);
}

/** Counts of what a test has seen, so that it cannot pass by seeing nothing. */
struct Seen {
  int compared = 0, ties = 0, vanishing = 0, deep = 0, equal = 0;
};

/** Compares two events of a vertex's move both ways, and their times. Nothing, unless both take place. */
template <int D>
void check_events(const double* p, const double* to, const SweepEvent& a, const SweepEvent& b, Seen& seen) {
  const Ratio ra = ratio_of<D>(p, to, a), rb = ratio_of<D>(p, to, b);
  if (!ra.takes_place() || !rb.takes_place()) return;
  const Poly left = ra.numerator * rb.denominator, right = rb.numerator * ra.denominator;
  const int truth = (left - right).sign() * ra.denominator.sign() * rb.denominator.sign();
  const ShiftedSign found = compare_events<D>(p, to, a, b);
  ASSERT_EQ(found.sign, truth);
  ASSERT_EQ(compare_events<D>(p, to, b, a).sign, -truth);
  ASSERT_TRUE(is_time_of(event_time<D>(p, to, a), ra));
  ASSERT_TRUE(is_time_of(event_time<D>(p, to, b), rb));
  ++seen.compared;
  seen.ties += found.tie ? 1 : 0;
  seen.vanishing += sgn(ra.denominator.c[0]) == 0 || sgn(rb.denominator.c[0]) == 0 ? 1 : 0;
  seen.deep += found.tie && sgn((left - right).c[1]) == 0 && truth != 0 ? 1 : 0;
  seen.equal += truth == 0 ? 1 : 0;
}

constexpr EventKind kAllKinds[] = {EventKind::kVertex, EventKind::kEdge, EventKind::kFace};

/** All kinds against each other; families of points with every scale. */
TEST(SweepEvents, OrderAndTimesAreThoseOfThePolynomials) {
  Random random(41);
  PointSet<3> s;
  Seen seen[3][3];
  const int cases = std::max(1500, static_cast<int>(case_count() * 3 / 5));
  for (int i = 0; i < cases; ++i) {
    draw(random, 8, s);
    // Often something stands twice: an end on an obstacle's vertex, a common end q, two lines with a common point or
    // the same.
    if (random.below(3) == 0) std::copy_n(s.x[random.between(2, 7)], 3, s.x[random.below(3)]);
    if (random.below(3) == 0) std::copy_n(s.x[2], 3, s.x[5]);
    if (random.below(4) == 0) std::copy_n(s.x[random.between(3, 4)], 3, s.x[random.between(6, 7)]);
    if (random.below(6) == 0) std::copy_n(s.x[4], 3, s.x[7]);
    const int x = random.below(3), y = random.below(3);
    SCOPED_TRACE(i);
    check_events<3>(s.at[0], s.at[1], {{s.at[2], s.at[3], s.at[4]}, kAllKinds[x]},
                    {{s.at[5], s.at[6], s.at[7]}, kAllKinds[y]}, seen[x][y]);
    if (HasFatalFailure()) return;
  }
  for (const auto& row : seen) {
    for (const Seen& each : row) {
      EXPECT_GT(each.compared, cases / 150);
      EXPECT_GT(each.ties, cases / 2000);
    }
  }
  EXPECT_GT(seen[1][1].vanishing + seen[1][2].vanishing + seen[2][2].vanishing, cases / 1200);
  EXPECT_GT(seen[1][1].deep + seen[1][2].deep + seen[2][2].deep, cases / 4000);
}

/** Points of a 3 x 3 x 3 lattice: two in three comparisons are ties, many are decided by high powers of e or by
 * nothing. */
TEST(SweepEvents, OrderOnASmallLattice) {
  Random random(47);
  double x[8][3];
  Seen seen;
  const int cases = std::max(1500, static_cast<int>(case_count() * 3 / 5));
  for (int i = 0; i < cases; ++i) {
    for (auto& point : x) {
      for (double& each : point) each = random.below(3);
    }
    if (random.below(2) == 0) std::copy_n(x[2], 3, x[5]);  // two events of one edge or of neighbouring faces
    SCOPED_TRACE(i);
    check_events<3>(x[0], x[1], {{x[2], x[3], x[4]}, kAllKinds[random.below(3)]},
                    {{x[5], x[6], x[7]}, kAllKinds[random.below(3)]}, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.compared, cases / 6);
  EXPECT_GT(seen.ties, cases / 12);
  EXPECT_GT(seen.vanishing, cases / 60);
  EXPECT_GT(seen.deep, cases / 60);
  EXPECT_GT(seen.equal, cases / 200);
}

/** The plane: families of points with every scale, and a 3 x 3 lattice. */
TEST(SweepEvents, OrderInThePlane) {
  Random random(53);
  PointSet<2> s;
  Seen seen[2][2];
  const int cases = std::max(1000, static_cast<int>(case_count() * 2 / 5));
  for (int i = 0; i < cases; ++i) {
    if (random.below(2) == 0) {
      draw(random, 6, s);
    } else {
      for (int k = 0; k < 12; ++k) s.x[k / 2][k % 2] = random.below(3);
    }
    if (random.below(3) == 0) std::copy_n(s.x[random.between(2, 5)], 2, s.x[random.below(2)]);
    if (random.below(2) == 0) std::copy_n(s.x[2], 2, s.x[4]);
    const int x = random.below(2), y = random.below(2);
    SCOPED_TRACE(i);
    check_events<2>(s.at[0], s.at[1], {{s.at[2], s.at[3]}, kAllKinds[x]}, {{s.at[4], s.at[5]}, kAllKinds[y]},
                    seen[x][y]);
    if (HasFatalFailure()) return;
  }
  for (const auto& row : seen) {
    for (const Seen& each : row) {
      EXPECT_GT(each.compared, cases / 50);
      EXPECT_GT(each.ties, cases / 100);
    }
  }
  EXPECT_GT(seen[0][0].equal, cases / 1000);
  EXPECT_GT(seen[1][1].equal, cases / 1000);
  EXPECT_GT(seen[1][1].vanishing, cases / 500);
  EXPECT_GT(seen[1][1].deep, cases / 500);
}

TEST(SweepEvents, SidesOfTheSweptPlaneAreThoseOfThePolynomials) {
  Random random(43);
  PointSet<3> s;
  int ties = 0;
  for (int i = 0; i < at_least(30000); ++i) {
    draw(random, 4, s);
    const EdgeMotion m{s.at[0], s.at[1], s.at[2]};
    const Point<3> p = shifted<3>(m.p);
    const Poly truth = dot(cross(shifted<3>(m.to) - p, shifted<3>(m.q) - p), fixed<3>(s.at[3]) - p);
    const ShiftedSign found = swept_side(m, s.at[3]);
    ASSERT_EQ(found.sign, truth.sign()) << i;
    ASSERT_EQ(found.tie, sgn(truth.c[0]) == 0) << i;
    ties += found.tie ? 1 : 0;
  }
  EXPECT_GT(ties, 1000);
}

}  // namespace
}  // namespace dsw
