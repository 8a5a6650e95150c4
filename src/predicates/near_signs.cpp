// A filter by doubles, then WideInt.
//
// The filter. Let m_u be the largest |component| of the rounded difference u, and so on. A true dot product u.v and its
// rounded value differ by at most 3 m_u m_v ((1+e)^5 - 1) < 16e m_u m_v, with e = 2^-53: each of the D <= 3 products
// sees two roundings of differences, one of the product and at most two of sums. For (u.u)(v.w) - (u.v)(u.w), each of
// the two terms is at most 9 m_u^2 m_v m_w and sees 2 * 5 + 2 roundings: together below
// 18 * 12.1e m_u^2 m_v m_w < 218e m_u^2 m_v m_w. The constants below are larger, which pays for the roundings of the
// bounds. With every m in [2^-120, 2^120] nothing overflows, and a product that underflows errs by 2^-1075, which is
// less than e^2 times any bound. A difference that rounds to zero is zero.
//
// The integers. All axes are scaled by the same power of two, since dot products add axes.

#include "predicates/near_signs.h"

#include "base/compiler.h"
#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/integers.h"

namespace dsw {
namespace {

constexpr double kDotFilter = 32 * kUnitRoundoff, kLeanFilter = 256 * kUnitRoundoff;
constexpr double kSmallest = 0x1p-120, kLargest = 0x1p+120;

bool in_range(double m) noexcept { return m >= kSmallest && m <= kLargest; }

template <int D>
struct Difference {
  filter::Vec<D> v;
  double size;  // the largest |component|

  explicit Difference(Arrow a) noexcept
      : v(filter::difference<D>(a.to, a.from)), size(filter::highest(filter::extent(v))) {}
};

using Wide = integers::Large::Difference;

/** A difference as integers, all of which are multiples of 2^low. */
template <int D>
struct WideArrow {
  Wide v[D];

  WideArrow(Arrow a, int low) noexcept {
    for (int k = 0; k < D; ++k) {
      v[k] = integers::Large::coordinate(a.to[k], low) - integers::Large::coordinate(a.from[k], low);
    }
  }
};

/** The lowest bit in use. */
template <int D, int Count>
int lowest_bit_of(const Arrow (&arrows)[Count]) noexcept {
  int low = 4096;
  for (const Arrow& a : arrows) {
    const double* const points[] = {a.from, a.to};
    const integers::Span<D> span(points);
    for (int k = 0; k < D; ++k) {
      const bool is_zero = a.from[k] == 0 && a.to[k] == 0;
      if (!is_zero && span.low[k] < low) low = span.low[k];
    }
  }
  return low;
}

using WideDot = WideInt<2 * Wide::kCapacity + 2>;

template <int D>
WideDot wide_dot(const WideArrow<D>& a, const WideArrow<D>& b) noexcept {
  const auto plane = a.v[0] * b.v[0] + a.v[1] * b.v[1];
  if constexpr (D == 2) {
    return plane;
  } else {
    return plane + a.v[2] * b.v[2];
  }
}

template <int D>
DSW_NOINLINE int exact_dot_sign(Arrow u, Arrow v) noexcept {
  const int low = lowest_bit_of<D>({u, v});
  return wide_dot(WideArrow<D>(u, low), WideArrow<D>(v, low)).sign();
}

template <int D>
DSW_NOINLINE int exact_lean_sign(Arrow u, Arrow v, Arrow w) noexcept {
  const int low = lowest_bit_of<D>({u, v, w});
  const WideArrow<D> a(u, low), b(v, low), c(w, low);
  return compare(wide_dot(a, a) * wide_dot(b, c), wide_dot(a, b) * wide_dot(a, c));
}

DSW_NOINLINE int exact_volume_sign(Arrow u, Arrow v, Arrow w) noexcept {
  const int low = lowest_bit_of<3>({u, v, w});
  const WideArrow<3> a(u, low), b(v, low), c(w, low);
  const auto minor = [&](int i, int j) { return a.v[i] * b.v[j] - a.v[j] * b.v[i]; };
  return (minor(1, 2) * c.v[0] + minor(2, 0) * c.v[1] + minor(0, 1) * c.v[2]).sign();
}

}  // namespace

template <int D>
int dot_sign(Arrow u, Arrow v) noexcept {
  const Difference<D> a(u), b(v);
  if (a.size == 0 || b.size == 0) return 0;
  const double value = filter::dot(a.v, b.v);
  if (in_range(a.size) && in_range(b.size) && std::fabs(value) > kDotFilter * a.size * b.size) {
    return filter::sign_of(value);
  }
  return exact_dot_sign<D>(u, v);
}

template <int D>
int lean_sign(Arrow u, Arrow v, Arrow w) noexcept {
  const Difference<D> a(u), b(v), c(w);
  if (a.size == 0 || b.size == 0 || c.size == 0) return 0;
  const double value = filter::dot(a.v, a.v) * filter::dot(b.v, c.v) - filter::dot(a.v, b.v) * filter::dot(a.v, c.v);
  if (in_range(a.size) && in_range(b.size) && in_range(c.size) &&
      std::fabs(value) > kLeanFilter * (a.size * a.size) * (b.size * c.size)) {
    return filter::sign_of(value);
  }
  return exact_lean_sign<D>(u, v, w);
}

int volume_sign(Arrow u, Arrow v, Arrow w) noexcept {
  const Difference<3> a(u), b(v), c(w);
  const filter::Vec<3> m = filter::extent(a.v, b.v, c.v);
  const double value = filter::dot(filter::cross(a.v, b.v), c.v);
  if (filter::certain(value, m)) return filter::sign_of(value);
  if (filter::lowest(m) == 0) return 0;
  return exact_volume_sign(u, v, w);
}

// A value that is 0 has the sign of its first coefficient in the shift (e, e^2, e^3) that is not 0. The coefficient of
// a component is the value for the axis.
namespace {
constexpr double kOrigin[3] = {0, 0, 0}, kAxes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

template <int D>
int shifted_dot_sign(Arrow u, Arrow to_body) noexcept {
  int sign = dot_sign<D>(u, to_body);
  for (int k = 0; k < D && sign == 0; ++k) sign = dot_sign<D>(u, {kOrigin, kAxes[k]});
  return sign;
}

template <int D>
int shifted_lean_sign(Arrow u, Arrow v, Arrow to_body) noexcept {
  int sign = lean_sign<D>(u, v, to_body);
  for (int k = 0; k < D && sign == 0; ++k) sign = lean_sign<D>(u, v, {kOrigin, kAxes[k]});
  return sign;
}

double exact_share(Arrow u, Arrow v, Arrow w) noexcept {
  constexpr int kBits = 59;
  const int low = lowest_bit_of<3>({u, v, w});
  const WideArrow<3> a(u, low), b(v, low), c(w, low);
  const auto uu = wide_dot(a, a), uv = wide_dot(a, b);
  const auto part = uu * wide_dot(b, c) - uv * wide_dot(a, c);
  const auto whole = uu * wide_dot(b, b) - uv * uv;
  if (part.sign() <= 0 || whole.sign() <= 0) return 0;
  if (compare(part, whole) >= 0) return 1;
  const std::uint64_t share = limbs::scaled_quotient(part.limb(), part.size(), kBits, whole.limb(), whole.size());
  return static_cast<double>(share) * 0x1p-59;
}

template int shifted_dot_sign<2>(Arrow, Arrow) noexcept;
template int shifted_dot_sign<3>(Arrow, Arrow) noexcept;
template int shifted_lean_sign<2>(Arrow, Arrow, Arrow) noexcept;
template int shifted_lean_sign<3>(Arrow, Arrow, Arrow) noexcept;
template int dot_sign<2>(Arrow, Arrow) noexcept;
template int dot_sign<3>(Arrow, Arrow) noexcept;
template int lean_sign<2>(Arrow, Arrow, Arrow) noexcept;
template int lean_sign<3>(Arrow, Arrow, Arrow) noexcept;

}  // namespace dsw
