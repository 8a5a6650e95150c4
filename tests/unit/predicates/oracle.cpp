#include "oracle.h"

#include <cfloat>
#include <cmath>
#include <vector>

#include "cases.h"
#include "predicates/filtered.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace oracle {

mpz_class integer(double x) {
  int exponent;
  const double fraction = std::frexp(x, &exponent);
  mpz_class r(std::ldexp(fraction, 53));
  const int shift = exponent - 53 + 1074;
  if (shift >= 0) {
    r <<= static_cast<mp_bitcnt_t>(shift);
  } else {
    mpz_tdiv_q_2exp(r.get_mpz_t(), r.get_mpz_t(), static_cast<mp_bitcnt_t>(-shift));  // they are zero
  }
  return r;
}

namespace {

// Coefficients of 1, e, e^2, ...
using Polynomial = std::vector<mpz_class>;

Polynomial subtract(const Polynomial& a, const Polynomial& b) {
  Polynomial r(a.size() > b.size() ? a.size() : b.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (i < a.size()) r[i] += a[i];
    if (i < b.size()) r[i] -= b[i];
  }
  return r;
}

Polynomial multiply(const Polynomial& a, const Polynomial& b) {
  Polynomial r(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
  }
  return r;
}

ShiftedSign sign(const Polynomial& x) {
  for (const mpz_class& c : x) {
    if (sgn(c) != 0) return {sgn(c), &c != &x[0]};
  }
  return {0, true};
}

template <int D>
struct Point {
  Polynomial x[D];
};

template <int D>
Point<D> environment(const double* x) {
  Point<D> r;
  for (int k = 0; k < D; ++k) r.x[k] = {integer(x[k])};
  return r;
}

// x + (e, e^2, e^3).
template <int D>
Point<D> body(const double* x) {
  Point<D> r;
  for (int k = 0; k < D; ++k) {
    r.x[k].resize(static_cast<std::size_t>(k) + 2);
    r.x[k][0] = integer(x[k]);
    r.x[k].back() = 1;
  }
  return r;
}

template <int D>
Point<D> operator-(const Point<D>& a, const Point<D>& b) {
  Point<D> r;
  for (int k = 0; k < D; ++k) r.x[k] = subtract(a.x[k], b.x[k]);
  return r;
}

Polynomial det(const Point<2>& a, const Point<2>& b) {
  return subtract(multiply(a.x[0], b.x[1]), multiply(a.x[1], b.x[0]));
}

Polynomial det(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Polynomial yz = subtract(multiply(b.x[1], c.x[2]), multiply(b.x[2], c.x[1]));
  const Polynomial xz = subtract(multiply(b.x[0], c.x[2]), multiply(b.x[2], c.x[0]));
  const Polynomial xy = subtract(multiply(b.x[0], c.x[1]), multiply(b.x[1], c.x[0]));
  const Polynomial part = subtract(multiply(a.x[0], yz), multiply(a.x[1], xz));
  return subtract(part, multiply(Polynomial{-1}, multiply(a.x[2], xy)));
}

// n.w for the simplex; in the plane the outside is on the right of a->b.
Polynomial along_normal(const double* const* s, const Point<2>& w) {
  return det(w, environment<2>(s[1]) - environment<2>(s[0]));
}
Polynomial along_normal(const double* const* s, const Point<3>& w) {
  const Point<3> a = environment<3>(s[0]);
  return det(environment<3>(s[1]) - a, environment<3>(s[2]) - a, w);
}

}  // namespace

template <int D>
ShiftedSign plane_side(const double* const* simplex, const double* q) {
  return sign(along_normal(simplex, body<D>(q) - environment<D>(simplex[0])));
}

template <>
ShiftedSign line_side<2>(const double* p, const double* q, const double* const* ridge) {
  const Point<2> start = body<2>(p);
  return sign(det(body<2>(q) - start, environment<2>(ridge[0]) - start));
}
template <>
ShiftedSign line_side<3>(const double* p, const double* q, const double* const* ridge) {
  const Point<3> start = body<3>(p);
  return sign(det(body<3>(q) - start, environment<3>(ridge[0]) - start, environment<3>(ridge[1]) - start));
}

template <int D>
bool compare_times(const double* p, const double* q, const double* const* a, const double* const* b,
                   ShiftedSign& result) {
  const Point<D> start = body<D>(p);
  const Point<D> u = body<D>(q) - start;
  const Polynomial da = along_normal(a, u);
  const Polynomial db = along_normal(b, u);
  if (sgn(da[0]) == 0 || sgn(db[0]) == 0) return false;
  const Polynomial na = along_normal(a, environment<D>(a[0]) - start);
  const Polynomial nb = along_normal(b, environment<D>(b[0]) - start);
  result = sign(subtract(multiply(na, db), multiply(nb, da)));
  result.sign *= sgn(da[0]) * sgn(db[0]);
  return true;
}

template <int D>
void normal(const double* const* simplex, mpz_class* n) {
  for (int k = 0; k < D; ++k) {
    Point<D> axis;
    for (int j = 0; j < D; ++j) axis.x[j] = {mpz_class(j == k ? 1 : 0)};
    n[k] = along_normal(simplex, axis)[0];
  }
}

template <int D>
void time(const double* p, const double* q, const double* const* simplex, mpz_class& numerator,
          mpz_class& denominator) {
  const Point<D> start = environment<D>(p);
  numerator = along_normal(simplex, environment<D>(simplex[0]) - start)[0];
  denominator = along_normal(simplex, environment<D>(q) - start)[0];
}

bool is_time_below(double t, const mpz_class& numerator, const mpz_class& denominator) {
  if (sgn(numerator) <= 0) return t == 0 && !std::signbit(t);
  if (numerator >= denominator) return t == 1;
  if (!(t >= 0 && t < 1)) return false;
  const mpz_class scaled = numerator << 1074;
  return integer(t) * denominator <= scaled && integer(std::nextafter(t, 2.0)) * denominator > scaled;
}

template ShiftedSign plane_side<2>(const double* const*, const double*);
template ShiftedSign plane_side<3>(const double* const*, const double*);
template bool compare_times<2>(const double*, const double*, const double* const*, const double* const*, ShiftedSign&);
template bool compare_times<3>(const double*, const double*, const double* const*, const double* const*, ShiftedSign&);
template void normal<2>(const double* const*, mpz_class*);
template void normal<3>(const double* const*, mpz_class*);
template void time<2>(const double*, const double*, const double* const*, mpz_class&, mpz_class&);
template void time<3>(const double*, const double*, const double* const*, mpz_class&, mpz_class&);

}  // namespace oracle

namespace {

bool same(ShiftedSign a, ShiftedSign b) { return a.sign == b.sign && a.tie == b.tie; }

void note(PredicateTally& tally, ShiftedSign truth, ShiftedSign exact, ShiftedSign filtered) {
  ++tally.cases;
  if (truth.tie) ++tally.ties;
  if (!same(truth, exact) || !same(truth, filtered)) ++tally.wrong;
}

void merge(PredicateTally& into, const PredicateTally& part) {
  into.cases += part.cases;
  into.wrong += part.wrong;
  into.ties += part.ties;
}

template <int D>
void run_all(std::uint64_t cases, std::uint64_t seed, PredicateTally& tally) {
  merge(tally, run_plane_side<D>(cases, seed));
  merge(tally, run_line_side<D>(cases, seed + 1));
  merge(tally, run_compare_times<D>(cases, seed + 2));
  merge(tally, run_orient<D>(cases, seed + 3));
  merge(tally, run_crossing_time<D>(cases, seed + 4));
}

/** Draws sets of points for `test` until it has counted so many cases. */
template <int D, class Test>
PredicateTally run(std::uint64_t cases, std::uint64_t seed, int points, Test test) {
  PredicateTally tally;
  Random random(seed);
  PointSet<D> s;
  while (tally.cases < cases) {
    draw(random, points, s);
    test(s, tally);
  }
  return tally;
}

}  // namespace

template <int D>
PredicateTally run_plane_side(std::uint64_t cases, std::uint64_t seed) {
  return run<D>(cases, seed, D + 1, [](const PointSet<D>& s, PredicateTally& tally) {
    note(tally, oracle::plane_side<D>(s.at, s.at[D]), exact::plane_side<D>(s.at, s.at[D]),
         plane_side<D>(s.at, s.at[D], NoTally{}));
  });
}

template <int D>
PredicateTally run_line_side(std::uint64_t cases, std::uint64_t seed) {
  return run<D>(cases, seed, D + 1, [](const PointSet<D>& s, PredicateTally& tally) {
    note(tally, oracle::line_side<D>(s.at[0], s.at[1], s.at + 2), exact::line_side<D>(s.at[0], s.at[1], s.at + 2),
         line_side<D>(s.at[0], s.at[1], s.at + 2, NoTally{}));
  });
}

template <int D>
PredicateTally run_compare_times(std::uint64_t cases, std::uint64_t seed) {
  return run<D>(cases, seed, 2 + 2 * D, [](const PointSet<D>& s, PredicateTally& tally) {
    const double* const* a = s.at + 2;
    const double* const* b = s.at + 2 + D;
    ShiftedSign truth;
    if (!oracle::compare_times<D>(s.at[0], s.at[1], a, b, truth)) return;
    note(tally, truth, exact::compare_times<D>(s.at[0], s.at[1], a, b),
         compare_times<D>(s.at[0], s.at[1], a, b, NoTally{}));
  });
}

template <int D>
PredicateTally run_orient(std::uint64_t cases, std::uint64_t seed) {
  return run<D>(cases, seed, D + 1, [](const PointSet<D>& s, PredicateTally& tally) {
    mpz_class n[D];
    oracle::normal<D>(s.at, n);
    mpz_class value = 0;
    for (int k = 0; k < D; ++k) value += n[k] * (oracle::integer(s.x[D][k]) - oracle::integer(s.x[0][k]));
    const int truth = sgn(value);
    ++tally.cases;
    if (truth == 0) ++tally.ties;
    if (exact::orient<D>(s.at, s.at[D]) != truth || orient<D>(s.at, s.at[D]) != truth) ++tally.wrong;
  });
}

template <int D>
PredicateTally run_crossing_time(std::uint64_t cases, std::uint64_t seed) {
  return run<D>(cases, seed, 2 + D, [](const PointSet<D>& s, PredicateTally& tally) {
    const double* const* simplex = s.at + 2;
    mpz_class numerator, denominator;
    oracle::time<D>(s.at[0], s.at[1], simplex, numerator, denominator);
    if (sgn(denominator) == 0) return;
    const bool turned = sgn(denominator) < 0;
    const double* p = s.at[turned ? 1 : 0];
    const double* q = s.at[turned ? 0 : 1];
    if (turned) oracle::time<D>(p, q, simplex, numerator, denominator);
    const double t = crossing_time<D>(p, q, simplex);
    ++tally.cases;
    if (sgn(numerator) == 0) ++tally.ties;
    if (!oracle::is_time_below(t, numerator, denominator) || plane_hit<D>(p, q, simplex).time != t) ++tally.wrong;
  });
}

PredicateTally run_predicate_oracle(std::uint64_t cases, std::uint64_t seed) {
  PredicateTally tally;
  run_all<2>(cases, seed, tally);
  run_all<3>(cases, seed + 16, tally);
  return tally;
}

template PredicateTally run_plane_side<2>(std::uint64_t, std::uint64_t);
template PredicateTally run_plane_side<3>(std::uint64_t, std::uint64_t);
template PredicateTally run_line_side<2>(std::uint64_t, std::uint64_t);
template PredicateTally run_line_side<3>(std::uint64_t, std::uint64_t);
template PredicateTally run_compare_times<2>(std::uint64_t, std::uint64_t);
template PredicateTally run_compare_times<3>(std::uint64_t, std::uint64_t);
template PredicateTally run_orient<2>(std::uint64_t, std::uint64_t);
template PredicateTally run_orient<3>(std::uint64_t, std::uint64_t);
template PredicateTally run_crossing_time<2>(std::uint64_t, std::uint64_t);
template PredicateTally run_crossing_time<3>(std::uint64_t, std::uint64_t);

}  // namespace dsw
