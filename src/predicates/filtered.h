// The predicates as the engine calls them: a floating-point filter, inline, then exact.h. filter_bounds.h has the
// bounds and their proof. Results are those of dsw::exact, whatever the filter settles.
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

inline int sign_beyond(double value, double bound) noexcept {
  return value > bound ? 1 : (value < -bound ? -1 : kUncertain);
}

// Rounded differences of two points.
template <int D>
struct Vec {
  double v[D];
};

template <int D>
Vec<D> difference(const double* x, const double* y) noexcept {
  Vec<D> r;
  for (int k = 0; k < D; ++k) r.v[k] = x[k] - y[k];
  return r;
}

// Largest |component| per axis over the vectors that meet in one expression.
template <int D>
struct Extent {
  double m[D];

  void set(const Vec<D>& a) noexcept {
    for (int k = 0; k < D; ++k) m[k] = std::fabs(a.v[k]);
  }
  void add(const Vec<D>& a) noexcept {
    for (int k = 0; k < D; ++k) m[k] = larger(m[k], std::fabs(a.v[k]));
  }
  double lowest() const noexcept {
    double r = m[0];
    for (int k = 1; k < D; ++k) r = smaller(r, m[k]);
    return r;
  }
  double highest() const noexcept {
    double r = m[0];
    for (int k = 1; k < D; ++k) r = larger(r, m[k]);
    return r;
  }
  // Bound of a determinant made of these vectors.
  double bound() const noexcept {
    if constexpr (D == 3) {
      return kPlaneFilter3 * m[0] * m[1] * m[2];
    } else {
      return kPlaneFilter2 * m[0] * m[1];
    }
  }
};

// n, from the edges of the simplex at its first point.
inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) noexcept {
  return {{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2], a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}
inline double dot(const Vec<3>& a, const Vec<3>& b) noexcept {
  return (a.v[0] * b.v[0] + a.v[1] * b.v[1]) + a.v[2] * b.v[2];
}
inline double dot(const Vec<2>& a, const Vec<2>& b) noexcept { return a.v[0] * b.v[0] + a.v[1] * b.v[1]; }

// Sign of a[i] b[j] - a[j] b[i].
inline int minor_sign(const Vec<3>& a, const Vec<3>& b, int i, int j) noexcept {
  const double mi = larger(std::fabs(a.v[i]), std::fabs(b.v[i]));
  const double mj = larger(std::fabs(a.v[j]), std::fabs(b.v[j]));
  if (mi == 0 || mj == 0) return 0;
  if (smaller(mi, mj) < kFilterMin || larger(mi, mj) > kFilterMax) return kUncertain;
  return sign_beyond(a.v[i] * b.v[j] - a.v[j] * b.v[i], kPlaneFilter2 * mi * mj);
}

// First sign of a x b that is not 0.
inline int first_sign(const Vec<3>& a, const Vec<3>& b) noexcept {
  int s = minor_sign(a, b, 1, 2);
  if (s == 0) s = minor_sign(a, b, 2, 0);
  if (s == 0) s = minor_sign(a, b, 0, 1);
  return s;
}

// First sign of (y, -x); a rounded difference has the sign of the true one.
inline int first_turned_sign(const Vec<2>& a) noexcept {
  if (a.v[1] != 0) return a.v[1] > 0 ? 1 : -1;
  return a.v[0] < 0 ? 1 : (a.v[0] > 0 ? -1 : 0);
}

// Numerator and denominator of the time at one simplex, and the bound for both.
struct Ratio {
  double numerator, denominator, bound;
};

// Sign of n.(q-a): `exact zero` (0) when one axis has no extent.
template <int D>
int settle(double det, const Extent<D>& extent) noexcept {
  const double low = extent.lowest();
  if (low >= kFilterMin && extent.highest() <= kFilterMax) return sign_beyond(det, extent.bound());
  return low == 0 ? 0 : kUncertain;
}

template <int D>
struct Plane {
  Vec<D> w, e1, e2;  // e2 in space only
  Extent<D> extent;

  Plane(const double* const* simplex, const double* q) noexcept {
    w = difference<D>(q, simplex[0]);
    e1 = difference<D>(simplex[1], simplex[0]);
    extent.set(w);
    extent.add(e1);
    if constexpr (D == 3) {
      e2 = difference<D>(simplex[2], simplex[0]);
      extent.add(e2);
    }
  }
  double det() const noexcept {
    if constexpr (D == 3) {
      return dot(cross(e1, e2), w);
    } else {
      return e1.v[1] * w.v[0] - e1.v[0] * w.v[1];
    }
  }
  int shift_sign() const noexcept {
    if constexpr (D == 3) {
      return first_sign(e1, e2);
    } else {
      return first_turned_sign(e1);
    }
  }
};

template <int D>
Ratio time_ratio(const double* p, const Vec<D>& u, const double* const* simplex, bool& in_range) noexcept {
  const Vec<D> w = difference<D>(simplex[0], p);
  const Vec<D> e1 = difference<D>(simplex[1], simplex[0]);
  Extent<D> extent;
  extent.set(u);
  extent.add(w);
  extent.add(e1);
  Vec<D> n;
  if constexpr (D == 3) {
    const Vec<D> e2 = difference<D>(simplex[2], simplex[0]);
    extent.add(e2);
    n = cross(e1, e2);
  } else {
    n = {{e1.v[1], -e1.v[0]}};
  }
  in_range = in_range && extent.lowest() >= kTimeFilterMin && extent.highest() <= kTimeFilterMax;
  return {dot(n, w), dot(n, u), extent.bound()};
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
  const int s = filter::settle<D>(plane.det(), plane.extent);
  if (s == 1 || s == -1) return {s, false};
  if (s == 0) {
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
  filter::Extent<D> extent;
  extent.set(u);
  extent.add(a);
  int s;
  if constexpr (D == 3) {
    const filter::Vec<D> b = filter::difference<D>(ridge[1], p);
    extent.add(b);
    s = filter::settle<D>(filter::dot(filter::cross(u, a), b), extent);
  } else {
    s = filter::settle<D>(u.v[0] * a.v[1] - u.v[1] * a.v[0], extent);
  }
  if (s == 1 || s == -1) return {s, false};
  if (s == 0) {
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

template <int D, class Tally>
inline ShiftedSign compare_times(const double* p, const double* q, const double* const* a, const double* const* b,
                                 Tally&& tally) noexcept {
  tally.test();
  const filter::Vec<D> u = filter::difference<D>(q, p);
  bool in_range = true;
  const filter::Ratio ta = filter::time_ratio<D>(p, u, a, in_range);
  const filter::Ratio tb = filter::time_ratio<D>(p, u, b, in_range);
  const int sa = filter::sign_beyond(ta.denominator, ta.bound);
  const int sb = filter::sign_beyond(tb.denominator, tb.bound);
  if (in_range && sa != filter::kUncertain && sb != filter::kUncertain) {
    const double x = ta.numerator * tb.denominator;
    const double y = tb.numerator * ta.denominator;
    const double from_a = ta.bound * ((std::fabs(tb.numerator) + std::fabs(tb.denominator)) + 2 * tb.bound);
    const double from_b = tb.bound * (std::fabs(ta.numerator) + std::fabs(ta.denominator));
    const double rounding = 3 * kUnitRoundoff * (std::fabs(x) + std::fabs(y));
    const int s = filter::sign_beyond(x - y, kTimeSlack * ((from_a + from_b) + rounding));
    if (s != filter::kUncertain) return {s * sa * sb, false};
  }
  return filter::count(exact::compare_times<D>(p, q, a, b), true, tally);
}

template <int D>
inline int orient(const double* const* simplex, const double* q) noexcept {
  const filter::Plane<D> plane(simplex, q);
  const int s = filter::settle<D>(plane.det(), plane.extent);
  return s != filter::kUncertain ? s : exact::orient<D>(simplex, q);
}

}  // namespace dsw
