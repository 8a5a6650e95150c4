// The predicates as the engine calls them: a floating-point filter, inline, then exact.h. filter_bounds.h has the
// bounds and their proof. Results are those of dsw::exact, whatever the filter decides.
#pragma once

#include <cmath>

#include "predicates/exact.h"
#include "predicates/filter_bounds.h"
#include "predicates/tally.h"

namespace dsw {

namespace filter {

// Answer of a filter that could not decide.
constexpr int kUncertain = 2;

inline double larger(double a, double b) noexcept { return a < b ? b : a; }
inline double smaller(double a, double b) noexcept { return b < a ? b : a; }

// Without a branch on the sign, which nobody can predict: a mispredicted one costs more than the determinant.
inline int sign_of(double value) noexcept { return 2 * static_cast<int>(value > 0) - 1; }

inline int sign_beyond(double value, double bound) noexcept {
  return std::fabs(value) > bound ? sign_of(value) : kUncertain;
}

// Rounded differences of two points, or their magnitudes. Components by name, not in an array: g++ 12 keeps loops over
// three doubles at -O2, and the round trip through memory costs four times the arithmetic.
template <int D>
struct Vec;
template <>
struct Vec<2> {
  double x, y;
};
template <>
struct Vec<3> {
  double x, y, z;
};

template <int D>
inline Vec<D> difference(const double* a, const double* b) noexcept {
  if constexpr (D == 3) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  } else {
    return {a[0] - b[0], a[1] - b[1]};
  }
}

// Largest |component| per axis over the vectors that meet in one expression.
inline Vec<2> extent(const Vec<2>& a) noexcept { return {std::fabs(a.x), std::fabs(a.y)}; }
inline Vec<3> extent(const Vec<3>& a) noexcept { return {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}; }
template <class V, class... Rest>
inline V extent(const V& a, const Rest&... rest) noexcept {
  const V one = extent(a);
  const V all = extent(rest...);
  if constexpr (sizeof(V) == sizeof(Vec<3>)) {
    return {larger(one.x, all.x), larger(one.y, all.y), larger(one.z, all.z)};
  } else {
    return {larger(one.x, all.x), larger(one.y, all.y)};
  }
}

inline double lowest(const Vec<2>& m) noexcept { return smaller(m.x, m.y); }
inline double lowest(const Vec<3>& m) noexcept { return smaller(smaller(m.x, m.y), m.z); }
inline double highest(const Vec<2>& m) noexcept { return larger(m.x, m.y); }
inline double highest(const Vec<3>& m) noexcept { return larger(larger(m.x, m.y), m.z); }

// Bound of a determinant made of vectors with this extent.
inline double bound(const Vec<2>& m) noexcept { return kPlaneFilter2 * m.x * m.y; }
inline double bound(const Vec<3>& m) noexcept { return kPlaneFilter3 * m.x * m.y * m.z; }

// Whether the sign of a determinant of these vectors is that of its rounded value.
template <class V>
inline bool certain(double det, const V& m) noexcept {
  return lowest(m) >= kFilterMin && highest(m) <= kFilterMax && std::fabs(det) > bound(m);
}

inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dot(const Vec<3>& a, const Vec<3>& b) noexcept { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline double dot(const Vec<2>& a, const Vec<2>& b) noexcept { return a.x * b.x + a.y * b.y; }

// Sign of ai bj - aj bi.
inline int minor_sign(double ai, double aj, double bi, double bj) noexcept {
  const Vec<2> m = extent(Vec<2>{ai, aj}, Vec<2>{bi, bj});
  const double det = ai * bj - aj * bi;
  if (certain(det, m)) return sign_of(det);
  return lowest(m) == 0 ? 0 : kUncertain;
}

// First sign of a x b that is not 0.
inline int first_sign(const Vec<3>& a, const Vec<3>& b) noexcept {
  int s = minor_sign(a.y, a.z, b.y, b.z);
  if (s == 0) s = minor_sign(a.z, a.x, b.z, b.x);
  if (s == 0) s = minor_sign(a.x, a.y, b.x, b.y);
  return s;
}

// First sign of (y, -x) that is not 0; a rounded difference has the sign of the true one.
inline int first_turned_sign(const Vec<2>& a) noexcept {
  if (a.y != 0) return sign_of(a.y);
  return a.x != 0 ? -sign_of(a.x) : 0;
}

// The vectors of n.(q-a).
template <int D>
struct Plane;
template <>
struct Plane<2> {
  Vec<2> w, e;

  Plane(const double* const* simplex, const double* q) noexcept
      : w(difference<2>(q, simplex[0])), e(difference<2>(simplex[1], simplex[0])) {}
  double det() const noexcept { return e.y * w.x - e.x * w.y; }
  Vec<2> reach() const noexcept { return extent(w, e); }
  int shift_sign() const noexcept { return first_turned_sign(e); }
};
template <>
struct Plane<3> {
  Vec<3> w, e1, e2;

  Plane(const double* const* simplex, const double* q) noexcept
      : w(difference<3>(q, simplex[0])),
        e1(difference<3>(simplex[1], simplex[0])),
        e2(difference<3>(simplex[2], simplex[0])) {}
  double det() const noexcept { return dot(cross(e1, e2), w); }
  Vec<3> reach() const noexcept { return extent(w, e1, e2); }
  int shift_sign() const noexcept { return first_sign(e1, e2); }
};

// Numerator and denominator of the time at one simplex, and the bound for both.
struct Ratio {
  double numerator, denominator, bound;
};

template <int D>
inline Ratio time_ratio(const double* p, const Vec<D>& u, const double* const* simplex, bool& in_range) noexcept {
  const Vec<D> w = difference<D>(simplex[0], p);
  const Vec<D> e1 = difference<D>(simplex[1], simplex[0]);
  Vec<D> n;
  Vec<D> m;
  if constexpr (D == 3) {
    const Vec<D> e2 = difference<D>(simplex[2], simplex[0]);
    n = cross(e1, e2);
    m = extent(u, w, e1, e2);
  } else {
    n = {e1.y, -e1.x};
    m = extent(u, w, e1);
  }
  in_range = in_range && lowest(m) >= kTimeFilterMin && highest(m) <= kTimeFilterMax;
  return {dot(n, w), dot(n, u), bound(m)};
}

// Sign of one ratio less the other, or kUncertain.
inline ShiftedSign compare_ratios(const Ratio& ta, const Ratio& tb, bool in_range) noexcept {
  const int sa = sign_beyond(ta.denominator, ta.bound);
  const int sb = sign_beyond(tb.denominator, tb.bound);
  if (!in_range || sa == kUncertain || sb == kUncertain) return {kUncertain, false};
  const double x = ta.numerator * tb.denominator;
  const double y = tb.numerator * ta.denominator;
  const double from_a = ta.bound * ((std::fabs(tb.numerator) + std::fabs(tb.denominator)) + 2 * tb.bound);
  const double from_b = tb.bound * (std::fabs(ta.numerator) + std::fabs(ta.denominator));
  const double rounding = 3 * kUnitRoundoff * (std::fabs(x) + std::fabs(y));
  const int s = sign_beyond(x - y, kTimeSlack * ((from_a + from_b) + rounding));
  return {s == kUncertain ? s : s * sa * sb, false};
}

template <class Tally>
ShiftedSign count(ShiftedSign result, bool exact, Tally& tally) noexcept {
  if (exact) tally.exact();
  if (result.tie) tally.tie();
  return result;
}

}  // namespace filter

// See exact.h for what each answers.
template <int D, class Tally>
inline ShiftedSign plane_side(const double* const* simplex, const double* q, Tally&& tally) noexcept {
  tally.test();
  const filter::Plane<D> plane(simplex, q);
  const double det = plane.det();
  const filter::Vec<D> m = plane.reach();
  if (filter::certain(det, m)) return {filter::sign_of(det), false};
  if (filter::lowest(m) == 0) {  // then the determinant is exactly 0
    const int shifted = plane.shift_sign();
    if (shifted != filter::kUncertain) return filter::count({shifted, true}, false, tally);
  }
  return filter::count(exact::plane_side<D>(simplex, q), true, tally);
}

template <int D, class Tally>
inline ShiftedSign line_side(const double* p, const double* q, const double* const* ridge, Tally&& tally) noexcept {
  tally.test();
  const filter::Vec<D> u = filter::difference<D>(q, p);
  const filter::Vec<D> a = filter::difference<D>(ridge[0], p);
  double det;
  filter::Vec<D> m;
  if constexpr (D == 3) {
    const filter::Vec<D> b = filter::difference<D>(ridge[1], p);
    det = filter::dot(filter::cross(u, a), b);
    m = filter::extent(u, a, b);
  } else {
    det = u.x * a.y - u.y * a.x;
    m = filter::extent(u, a);
  }
  if (filter::certain(det, m)) return {filter::sign_of(det), false};
  if (filter::lowest(m) == 0) {
    int shifted;
    if constexpr (D == 3) {
      shifted = filter::first_sign(u, filter::difference<D>(ridge[1], ridge[0]));
    } else {
      shifted = filter::first_turned_sign(u);
    }
    if (shifted != filter::kUncertain) return filter::count({shifted, true}, false, tally);
  }
  return filter::count(exact::line_side<D>(p, q, ridge), true, tally);
}

// Sign of how body segment p->q passes ridge k of a simplex: +1 on the simplex's side for one that pierces it outwards.
// In space the ridge is the edge from corner k to the next, in the plane corner k.
template <int D, class Tally>
inline int ridge_side(const double* p, const double* q, const double* const (&simplex)[D], int k,
                      Tally&& tally) noexcept {
  if constexpr (D == 3) {
    const double* ridge[2] = {simplex[k], simplex[k == 2 ? 0 : k + 1]};
    return line_side<3>(p, q, ridge, tally).sign;
  } else {
    const int side = line_side<2>(p, q, &simplex[k], tally).sign;
    return k == 0 ? -side : side;
  }
}

template <int D, class Tally>
inline ShiftedSign compare_times(const double* p, const double* q, const double* const* a, const double* const* b,
                                 Tally&& tally) noexcept {
  tally.test();
  const filter::Vec<D> u = filter::difference<D>(q, p);
  bool in_range = true;
  const filter::Ratio ta = filter::time_ratio<D>(p, u, a, in_range);
  const filter::Ratio tb = filter::time_ratio<D>(p, u, b, in_range);
  const ShiftedSign quick = filter::compare_ratios(ta, tb, in_range);
  if (quick.sign != filter::kUncertain) return quick;
  return filter::count(exact::compare_times<D>(p, q, a, b), true, tally);
}

template <int D>
inline int orient(const double* const* simplex, const double* q) noexcept {
  const filter::Plane<D> plane(simplex, q);
  const double det = plane.det();
  const filter::Vec<D> m = plane.reach();
  if (filter::certain(det, m)) return filter::sign_of(det);
  return filter::lowest(m) == 0 ? 0 : exact::orient<D>(simplex, q);
}

}  // namespace dsw
