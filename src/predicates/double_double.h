// Numbers as unevaluated sums of two doubles, |low| <= half an ulp of high. Private to this folder.
//
// Sources: T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18 (1971); M.
// Joldes, J.-M. Muller, V. Popescu, Tight and rigorous error bounds for basic building blocks of double-word
// arithmetic, ACM TOMS 44 (2017). The bounds that matter here are derived where they are used.
#pragma once

#include "base/compiler.h"

namespace dsw {
namespace dd {

// Right only without contraction to FMA, see cmake/floating_point.cmake. Everything is inlined, as `Split` is also compiled
// for machines that have FMA.

struct Number {
  double high, low;
};

// a + b exactly.
DSW_HOT Number sum(double a, double b) noexcept {
  const double s = a + b, from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}
// a + b exactly if |a| >= |b| or a = 0.
DSW_HOT Number fast_sum(double a, double b) noexcept {
  const double s = a + b;
  return {s, b - (s - a)};
}

// a * b exactly, if nothing under- or overflows: for machines with FMA ...
struct Fused {
  static DSW_HOT Number product(double a, double b) noexcept {
    const double p = a * b;
    return {p, fused_multiply_add(a, b, -p)};
  }
};

// ... and for all others, for |a|, |b| < 2^970.
struct Split {
  static DSW_HOT Number product(double a, double b) noexcept {
    const double p = a * b;
    const Number x = halves(a), y = halves(b);
    return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
  }

 private:
  static DSW_HOT Number halves(double a) noexcept {
    const double scaled = a * 0x1.0000002p27, high = scaled - (scaled - a);
    return {high, a - high};
  }
};

// a * b with an error below 8u^2 |a b|; |low| < 3.01u |a b|, not normalized.
DSW_HOT Number product(const Number& a, const Number& b) noexcept {
  const Number p = Split::product(a.high, b.high);
  return {p.high, p.low + (a.high * b.low + a.low * b.high)};
}

// A sum of normalized numbers that loses 3u^2 of their magnitudes.
DSW_HOT Number add(const Number& a, const Number& b) noexcept {
  const Number s = sum(a.high, b.high), t = sum(a.low, b.low);
  const Number v = fast_sum(s.high, s.low + t.high);
  return fast_sum(v.high, t.low + v.low);
}

// A normalized product that loses 8u^2 of itself.
DSW_HOT Number multiply(const Number& a, const Number& b) noexcept {
  const Number p = product(a, b);
  return fast_sum(p.high, p.low);
}

DSW_HOT Number negative(const Number& a) noexcept { return {-a.high, -a.low}; }

// p q - r s.
DSW_HOT Number minor_of(const Number& p, const Number& q, const Number& r, const Number& s) noexcept {
  return add(multiply(p, q), negative(multiply(r, s)));
}

}  // namespace dd
}  // namespace dsw
