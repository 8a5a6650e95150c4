// Let u = 2^-53; S_k = |e1_i e2_j| + |e1_j e2_i| for component k of n = e1 x e2; m_k the largest |component| on axis k of
// e1, e2, a-p, q-p, and M = mx my mz. Differences of doubles are exact as two doubles. Then
//   n_k: two products (8u^2 each of its own size), an exact difference of the high parts, low parts below 6.02u S_k summed
//        in two additions:                                       error < 22u^2 S_k, |n_k| <= S_k(1 + u)
//   n.w: the errors of n_k, three products of 8u^2, exact sums of the high parts, low parts below 5.1u in four additions:
//        3 * 22u^2 * 2M + 28u^2 * 3 * 2M                         error < 301u^2 M
// With roundings in M and S_k themselves: kTimeError = 320u^2 and kNormalError = 24u^2. Products of numbers in
// [2^-140, 2^160] that underflow add less than 2^-740, against u^2 M > 2^-526; S_k is tested against 2^-500 for the same
// reason.
//   t = N/d: quotient of the high parts, residual N - t0 d with an error below 8u^2 N, its quotient by the high part of d
//        (4u^2), and the sum: < 32u^2 t. With E the error of N and d, t <= 1:  error < 2.01 E / d + 32u^2.
#include "predicates/certified_hit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "predicates/double_double.h"
#include "predicates/filter_bounds.h"

namespace dsw {
namespace {

using dd::Number;

constexpr double kSquaredRoundoff = kUnitRoundoff * kUnitRoundoff;
constexpr double kTimeError = 320 * kSquaredRoundoff;
constexpr double kNormalError = 24 * kSquaredRoundoff;
constexpr double kLeastProducts = 0x1p-500;

struct Vector {
  Number x, y, z;
};

DSW_DD Vector difference(const double* a, const double* b) noexcept {
  return {dd::sum(a[0], -b[0]), dd::sum(a[1], -b[1]), dd::sum(a[2], -b[2])};
}

// ai bj - aj bi, not normalized.
template <class Exact>
DSW_DD Number minor(const Number& ai, const Number& aj, const Number& bi, const Number& bj) noexcept {
  const Number left = dd::product<Exact>(ai, bj), right = dd::product<Exact>(aj, bi);
  const Number top = dd::sum(left.high, -right.high);
  return dd::sum(top.high, top.low + (left.low - right.low));
}

template <class Exact>
DSW_DD Number dot(const Vector& a, const Vector& b) noexcept {
  const Number x = dd::product<Exact>(a.x, b.x), y = dd::product<Exact>(a.y, b.y), z = dd::product<Exact>(a.z, b.z);
  const Number xy = dd::sum(x.high, y.high), xyz = dd::sum(xy.high, z.high);
  return dd::sum(xyz.high, (xy.low + xyz.low) + ((x.low + y.low) + z.low));
}

DSW_DD double extent(const Number& a, const Number& b, const Number& c, const Number& d) noexcept {
  return std::max(std::max(std::fabs(a.high), std::fabs(b.high)), std::max(std::fabs(c.high), std::fabs(d.high)));
}

// Whether the component, known as n with the error of the products of its minor, rounds to one double; also when it is
// exactly 0 because all its products are.
DSW_DD bool round_component(const Number& n, const Number& ai, const Number& aj, const Number& bi, const Number& bj,
                            double* out) noexcept {
  *out = n.high;
  const double left = ai.high * bj.high, right = aj.high * bi.high;
  const double products = std::fabs(left) + std::fabs(right), error = kNormalError * products;
  if (products >= kLeastProducts) return (n.high + (n.low - error) == n.high) & (n.high + (n.low + error) == n.high);
  return (ai.high == 0 || bj.high == 0) && (aj.high == 0 || bi.high == 0);
}

// Largest double <= the time that is high + low, with an error below `error`.
DSW_DD bool floor_time(const Number& t, double error, double* time) noexcept {
  if (!(t.high > 0 && t.high <= 1) || !(std::fabs(t.low) > error)) return false;
  std::int64_t bits;
  std::memcpy(&bits, &t.high, sizeof bits);
  bits -= t.low < 0 ? 1 : 0;  // the double before a positive one
  std::memcpy(time, &bits, sizeof bits);
  return t.high < 1 || t.low < 0;
}

template <class Exact>
DSW_DD bool certify(const double* p, const double* q, const double* const* triangle, bool with_normal,
                    CertifiedHit* hit) noexcept {
  const Vector u = difference(q, p), w = difference(triangle[0], p);
  const Vector a = difference(triangle[1], triangle[0]), b = difference(triangle[2], triangle[0]);
  const double mx = extent(u.x, w.x, a.x, b.x), my = extent(u.y, w.y, a.y, b.y), mz = extent(u.z, w.z, a.z, b.z);
  if (!(std::min(std::min(mx, my), mz) >= kTimeFilterMin && std::max(std::max(mx, my), mz) <= kTimeFilterMax))
    return false;
  const Vector n = {minor<Exact>(a.y, a.z, b.y, b.z), minor<Exact>(a.z, a.x, b.z, b.x),
                    minor<Exact>(a.x, a.y, b.x, b.y)};
  if (with_normal && !(round_component(n.x, a.y, a.z, b.y, b.z, hit->normal) &
                       round_component(n.y, a.z, a.x, b.z, b.x, hit->normal + 1) &
                       round_component(n.z, a.x, a.y, b.x, b.y, hit->normal + 2)))
    return false;
  const Number top = dot<Exact>(n, w), bottom = dot<Exact>(n, u);
  if (!(bottom.high > 0)) return false;
  const double guess = top.high / bottom.high;
  const Number back = Exact::product(guess, bottom.high);
  const double rest = (top.high - back.high) + ((top.low - back.low) - guess * bottom.low);
  const double error = kTimeSlack * (2.01 * kTimeError * (mx * my * mz) / bottom.high + 32 * kSquaredRoundoff);
  return floor_time(dd::fast_sum(guess, rest / bottom.high), error, &hit->time);
}

#if defined(__x86_64__)
__attribute__((target("fma"))) bool certify_fused(const double* p, const double* q, const double* const* triangle,
                                                  bool with_normal, CertifiedHit* hit) noexcept {
  return certify<dd::Fused>(p, q, triangle, with_normal, hit);
}
#endif

using Certify = bool (*)(const double*, const double*, const double* const*, bool, CertifiedHit*) noexcept;

Certify choose() noexcept {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("fma")) return certify_fused;
#endif
  return certified_hit_without_fma;
}

const Certify kCertify = choose();

}  // namespace

bool certified_hit_without_fma(const double* p, const double* q, const double* const* triangle, bool with_normal,
                               CertifiedHit* hit) noexcept {
  return certify<dd::Split>(p, q, triangle, with_normal, hit);
}

bool certified_hit(const double* p, const double* q, const double* const* triangle, bool with_normal,
                   CertifiedHit* hit) noexcept {
  return kCertify(p, q, triangle, with_normal, hit);
}

}  // namespace dsw
