// Doubles as integers, and the expressions of the predicates over them. Private to this folder.
//
// Each axis is scaled by its own power of two, so that its coordinates become integers: determinants are multiplied by
// a positive number and ratios of them by nothing. Two kinds of integers carry the same expressions:
//  - Small: every axis spans at most 62 bits from its lowest set bit to its highest. Differences are 64-bit, minors
//    128-bit, determinants 256-bit machine integers, without a branch. Nearly all ties of ordinary coordinates.
//  - Large: WideInt, for any doubles. 2098 bits hold 2^-1074 beside 2^1024.
#pragma once

#include <cstdint>
#include <cstring>

#include "base/compiler.h"
#include "predicates/wide_int.h"

namespace dsw {
namespace integers {

// Magnitude * 2^(exponent - 1075); magnitude below 2^53.
struct Decoded {
  std::uint64_t magnitude;
  int exponent;
  bool negative;
};

inline std::uint64_t bits_of(double x) noexcept {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
inline double of_bits(std::uint64_t bits) noexcept {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

// Narrows an interval of doubles above 0, given by their bits, to two neighbours. sign_at(t) is `before`, 1 or -1, up to the first
// one and -before from the second one on. Steps double from `at` on, so after a good guess few signs are asked. Returns `before`,
// or another sign that was met at a.
template <class SignAt>
int narrow_sign_change(std::uint64_t* a, std::uint64_t* b, std::uint64_t at, int before, SignAt sign_at) {
  for (std::uint64_t step = 1; *b - *a > 1; step *= 2) {
    if (at <= *a || at >= *b) at = *a + (*b - *a) / 2;
    const int sign = sign_at(of_bits(at));
    if (sign == before) {
      *a = at;
      at += step;
    } else if (sign == -before) {
      *b = at;
      at -= step < at ? step : at;
    } else {
      *a = at;
      return sign;
    }
  }
  return before;
}

inline Decoded decode(double x) noexcept {
  const std::uint64_t bits = bits_of(x);
  const std::uint64_t fraction = bits & 0xfffffffffffffu;
  const int exponent = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t hidden = exponent != 0 ? 1 : 0;
  return {fraction | (hidden << 52), exponent + (exponent == 0 ? 1 : 0), (bits >> 63) != 0};
}

// Lowest and highest + 1 bit in use on each axis, over some points.
template <int D>
struct Span {
  int low[D];
  int width = 0;      // the largest number of bits from the lowest to the highest
  bool small = true;  // never of numbers that are not finite

  template <int Count>
  explicit Span(const double* const (&points)[Count]) noexcept {
    for (int k = 0; k < D; ++k) {
      int lowest = 4096;
      std::uint64_t largest = 0;  // the bits of positive doubles are in their order
      for (int i = 0; i < Count; ++i) {
        const Decoded d = decode(points[i][k]);
        const std::uint64_t bits = bits_of(points[i][k]) << 1;
        largest = bits > largest ? bits : largest;
        // The bit set here only keeps a zero, which counts for neither end, from an undefined count.
        const int lo =
            d.magnitude != 0 ? d.exponent + static_cast<int>(lowest_bit(d.magnitude | (std::uint64_t{1} << 53))) : 4096;
        lowest = lo < lowest ? lo : lowest;
      }
      low[k] = 0;
      if (largest == 0) continue;
      low[k] = lowest;
      const Decoded d = decode(of_bits(largest >> 1));
      const int bits = d.exponent + 1 + static_cast<int>(highest_bit(d.magnitude)) - lowest;
      width = bits > width ? bits : width;
      small = small && d.exponent < 0x7ff;
    }
    small = small && width <= 62;
  }
};

// Two's complement, little-endian.
struct Int256 {
  std::uint64_t limb[4];
};

inline int sign(std::int64_t x) noexcept { return (x > 0) - (x < 0); }
inline int sign(Int128 x) noexcept { return (x > 0) - (x < 0); }
inline int sign(const Int256& x) noexcept {
  if (static_cast<std::int64_t>(x.limb[3]) < 0) return -1;
  return (x.limb[0] | x.limb[1] | x.limb[2] | x.limb[3]) != 0 ? 1 : 0;
}
template <int N>
int sign(const WideInt<N>& x) noexcept {
  return x.sign();
}

inline WideInt<2> wide(Int128 x) noexcept {
  const Uint128 magnitude = x < 0 ? -static_cast<Uint128>(x) : static_cast<Uint128>(x);
  const std::uint64_t parts[2] = {static_cast<std::uint64_t>(magnitude), static_cast<std::uint64_t>(magnitude >> 64)};
  return WideInt<2>(parts, 2, x < 0);
}
inline WideInt<2> wide(std::int64_t x) noexcept { return wide(static_cast<Int128>(x)); }
inline WideInt<4> wide(const Int256& x) noexcept {
  const bool negative = static_cast<std::int64_t>(x.limb[3]) < 0;
  const std::uint64_t flip = negative ? ~std::uint64_t{0} : 0;
  std::uint64_t parts[4];
  Uint128 carry = negative ? 1 : 0;
  for (int i = 0; i < 4; ++i) {
    carry += x.limb[i] ^ flip;
    parts[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  return WideInt<4>(parts, 4, negative);
}
template <int N>
const WideInt<N>& wide(const WideInt<N>& x) noexcept {
  return x;
}

struct Small {
  using Coordinate = std::int64_t;
  using Difference = std::int64_t;  // below 2^63
  using Minor = Int128;             // below 2^127
  using Det = Int256;               // below 2^192

  // low is the lowest set bit of the whole axis, so the result is an integer of the digits of x, and no product is rounded: the
  // first one lies between x and the result. There are two products because 2^up may be too large for a double.
  static Coordinate coordinate(double x, int low) noexcept {
    const int up = 1075 - low, half = up / 2;
    const auto power_of_two = [](int exponent) { return of_bits(static_cast<std::uint64_t>(1023 + exponent) << 52); };
    return static_cast<std::int64_t>(x * power_of_two(half) * power_of_two(up - half));
  }
  static Difference subtract(Coordinate a, Coordinate b) noexcept { return a - b; }
  static Difference negate(Difference a) noexcept { return -a; }
  static Minor dot2(Difference a, Difference b, Difference c, Difference d) noexcept {
    return static_cast<Int128>(a) * b + static_cast<Int128>(c) * d;
  }
  static Minor minor(Difference a, Difference b, Difference c, Difference d) noexcept {
    return static_cast<Int128>(a) * b - static_cast<Int128>(c) * d;
  }
  static Det dot3(const Minor* n, const Difference* w) noexcept {
    Det sum = {{0, 0, 0, 0}};
    for (int k = 0; k < 3; ++k) accumulate(sum, n[k], w[k]);
    return sum;
  }

 private:
  // sum += a * b, signs by two's complement: the low half of a is unsigned, and an unsigned b is 2^64 too large where
  // b < 0.
  static void accumulate(Det& sum, Int128 a, std::int64_t b) noexcept {
    const std::uint64_t low = static_cast<std::uint64_t>(a);
    const std::int64_t high = static_cast<std::int64_t>(a >> 64);
    const Uint128 bottom = static_cast<Uint128>(low) * static_cast<std::uint64_t>(b);
    const Int128 top =
        static_cast<Int128>(high) * b + static_cast<Int128>(bottom >> 64) - static_cast<Int128>(b < 0 ? low : 0);
    const std::uint64_t part[4] = {static_cast<std::uint64_t>(bottom), static_cast<std::uint64_t>(top),
                                   static_cast<std::uint64_t>(top >> 64), top < 0 ? ~std::uint64_t{0} : 0};
    Uint128 carry = 0;
    for (int i = 0; i < 4; ++i) {
      carry += static_cast<Uint128>(sum.limb[i]) + part[i];
      sum.limb[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
  }
};

struct Large {
  using Coordinate = WideInt<33>;
  using Difference = WideInt<34>;
  using Minor = WideInt<69>;
  using Det = WideInt<105>;

  static Coordinate coordinate(double x, int low) noexcept {
    const Decoded d = decode(x);
    if (d.magnitude == 0) return {};
    const int zeros = static_cast<int>(lowest_bit(d.magnitude));
    return Coordinate(d.magnitude >> zeros, d.negative, d.exponent + zeros - low);
  }
  static Difference subtract(const Coordinate& a, const Coordinate& b) noexcept { return a - b; }
  static Difference negate(const Difference& a) noexcept { return -a; }
  static Minor dot2(const Difference& a, const Difference& b, const Difference& c, const Difference& d) noexcept {
    return a * b + c * d;
  }
  static Minor minor(const Difference& a, const Difference& b, const Difference& c, const Difference& d) noexcept {
    return a * b - c * d;
  }
  static Det dot3(const Minor* n, const Difference* w) noexcept { return n[0] * w[0] + n[1] * w[1] + n[2] * w[2]; }
};

template <class R, int D>
struct Vec {
  typename R::Difference v[D];
};

// Normals and values of n.w, by dimension.
template <class R, int D>
struct Kind;
template <class R>
struct Kind<R, 2> {
  using Component = typename R::Difference;
  using Value = typename R::Minor;
};
template <class R>
struct Kind<R, 3> {
  using Component = typename R::Minor;
  using Value = typename R::Det;
};

template <class R, int D>
struct Normal {
  typename Kind<R, D>::Component v[D];

  // Sign of the first component that is not 0: what the shift decides.
  int first_sign() const noexcept {
    for (int k = 0; k < D; ++k) {
      const int s = sign(v[k]);
      if (s != 0) return s;
    }
    return 0;
  }
};

template <class R, int D, int Count>
class Points {
 public:
  Points(const double* const (&points)[Count], const Span<D>& span) noexcept : span_(span) {
    for (int i = 0; i < Count; ++i) {
      for (int k = 0; k < D; ++k) x_[i][k] = R::coordinate(points[i][k], span.low[k]);
    }
  }
  const Span<D>& span() const noexcept { return span_; }
  // Point i - point j.
  Vec<R, D> difference(int i, int j) const noexcept {
    Vec<R, D> r;
    for (int k = 0; k < D; ++k) r.v[k] = R::subtract(x_[i][k], x_[j][k]);
    return r;
  }
  // Normal of the simplex that starts at point i.
  Normal<R, D> normal(int i) const noexcept;

 private:
  const Span<D>& span_;
  typename R::Coordinate x_[Count][D];
};

template <class R>
Normal<R, 3> cross(const Vec<R, 3>& a, const Vec<R, 3>& b) noexcept {
  return {{R::minor(a.v[1], b.v[2], a.v[2], b.v[1]), R::minor(a.v[2], b.v[0], a.v[0], b.v[2]),
           R::minor(a.v[0], b.v[1], a.v[1], b.v[0])}};
}

template <class R>
Normal<R, 2> turned(const Vec<R, 2>& a) noexcept {
  return {{a.v[1], R::negate(a.v[0])}};
}

template <class R>
typename R::Det dot(const Normal<R, 3>& n, const Vec<R, 3>& w) noexcept {
  return R::dot3(n.v, w.v);
}
template <class R>
typename R::Minor dot(const Normal<R, 2>& n, const Vec<R, 2>& w) noexcept {
  return R::dot2(n.v[0], w.v[0], n.v[1], w.v[1]);
}

template <class R, int D, int Count>
Normal<R, D> Points<R, D, Count>::normal(int i) const noexcept {
  if constexpr (D == 3) {
    return cross<R>(difference(i + 1, i), difference(i + 2, i));
  } else {
    return turned<R>(difference(i + 1, i));
  }
}

// The wide integers take kilobytes of stack: kept out of the frames of the small path.
template <int D, int Count, class Expression>
DSW_NOINLINE auto evaluate_large(const double* const (&points)[Count], const Span<D>& span,
                                 Expression expression) noexcept {
  return expression(Points<Large, D, Count>(points, span));
}

// The expression over the smallest integers that hold these points.
template <int D, int Count, class Expression>
auto evaluate(const double* const (&points)[Count], Expression expression) noexcept {
  const Span<D> span(points);
  if (span.small) return expression(Points<Small, D, Count>(points, span));
  return evaluate_large<D, Count>(points, span, expression);
}

}  // namespace integers
}  // namespace dsw
