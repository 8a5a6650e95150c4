// certified_hit.cpp for four flights, a lane for each, down to the unit normal; see there for the bounds, which hold
// here too: the expressions are the same, and fused operations leave roundings out.
#include "predicates/certified_hit.h"

#include "base/compiler.h"

#if DSW_X86_64

#include <immintrin.h>

#include "predicates/certified_hit_bounds.h"

DSW_BEGIN_TARGET("avx2,fma")

namespace dsw {
namespace {

using Four = __m256d;

// Sums of two doubles.
struct Number {
  Four high, low;
};

struct Vector {
  Number x, y, z;
};

inline Four all(double a) noexcept { return _mm256_set1_pd(a); }
inline Four absolute(Four a) noexcept { return _mm256_andnot_pd(all(-0.0), a); }
inline Four both(Four a, Four b) noexcept { return _mm256_and_pd(a, b); }
inline Four either(Four a, Four b) noexcept { return _mm256_or_pd(a, b); }
inline Four equal(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
inline Four at_most(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
inline Four less(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }

inline Number sum(Four a, Four b) noexcept {
  const Four s = a + b, from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}
inline Four is_zero(const Number& a) noexcept { return equal(a.high, all(0)); }
inline Number difference(Four a, Four b) noexcept { return sum(a, all(0) - b); }
inline Number product(const Number& a, const Number& b) noexcept {
  const Four p = a.high * b.high;
  return {p, _mm256_fmsub_pd(a.high, b.high, p) + _mm256_fmadd_pd(a.high, b.low, a.low * b.high)};
}
inline Number dot(const Vector& a, const Vector& b) noexcept {
  const Number x = product(a.x, b.x), y = product(a.y, b.y), z = product(a.z, b.z);
  const Number xy = sum(x.high, y.high), xyz = sum(xy.high, z.high);
  return sum(xyz.high, (xy.low + xyz.low) + ((x.low + y.low) + z.low));
}

// ai bj - aj bi. Clears the lanes of `rounds` where it does not round to one double.
inline Number minor(const Number& ai, const Number& aj, const Number& bi, const Number& bj, Four& rounds) noexcept {
  const Number left = product(ai, bj), right = product(aj, bi);
  const Number top = difference(left.high, right.high);
  const Number n = sum(top.high, top.low + (left.low - right.low));
  const Four products = absolute(left.high) + absolute(right.high), error = all(kNormalError) * products;
  const Four one_double = both(equal(n.high + (n.low - error), n.high), equal(n.high + (n.low + error), n.high));
  const Four exactly_zero = both(either(is_zero(ai), is_zero(bj)), either(is_zero(aj), is_zero(bi)));
  rounds = both(rounds, either(both(at_most(all(kLeastProducts), products), one_double), exactly_zero));
  return n;
}

// One point of each flight.
struct Points {
  Four x, y, z;
};

inline Points turn(Four a, Four b, Four c, Four d) noexcept {
  const Four xz0 = _mm256_unpacklo_pd(a, b), y0 = _mm256_unpackhi_pd(a, b);
  const Four xz2 = _mm256_unpacklo_pd(c, d), y2 = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(xz0, xz2, 0x20), _mm256_permute2f128_pd(y0, y2, 0x20),
          _mm256_permute2f128_pd(xz0, xz2, 0x31)};
}

template <class PointOf>
inline Points load(const PlaneFlight<3>* flights, PointOf point_of) noexcept {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const auto at = [&](int i) { return _mm256_maskload_pd(point_of(flights[i]), three); };
  return turn(at(0), at(1), at(2), at(3));
}

inline Vector difference(const Points& a, const Points& b) noexcept {
  return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

inline Four extent(const Number& a, const Number& b, const Number& c, const Number& d) noexcept {
  return _mm256_max_pd(_mm256_max_pd(absolute(a.high), absolute(b.high)),
                       _mm256_max_pd(absolute(c.high), absolute(d.high)));
}

// floor_ratio and floor_time. Clears the lanes of `certain` where the time is not.
inline Four floor_ratios(const Number& numerator, const Number& denominator, Four volume, Four& certain) noexcept {
  const Four guess = numerator.high / denominator.high;
  const Four back = guess * denominator.high, back_low = _mm256_fmsub_pd(guess, denominator.high, back);
  const Four rest = (numerator.high - back) + ((numerator.low - back_low) - guess * denominator.low);
  const Four error =
      all(kTimeSlack) * (all(2.01 * kTimeError) * volume / denominator.high + all(32 * kSquaredRoundoff));
  const Four correction = rest / denominator.high, high = guess + correction, low = correction - (high - guess);
  const Four early = less(low, all(0));
  const Four in_range = both(both(less(all(0), denominator.high), less(all(0), high)),
                             either(less(high, all(1)), both(equal(high, all(1)), early)));
  certain = both(certain, both(in_range, less(error, absolute(low))));
  return _mm256_castsi256_pd(_mm256_add_epi64(_mm256_castpd_si256(high), _mm256_castpd_si256(early)));
}

// -n/|n|, as plane_hit.cpp has it.
inline Points point_back(const Points& n) noexcept {
  const Four largest = _mm256_max_pd(_mm256_max_pd(absolute(n.x), absolute(n.y)), absolute(n.z));
  const __m256i exponent = _mm256_and_si256(_mm256_castpd_si256(largest), _mm256_set1_epi64x(0x7ff0000000000000));
  const Four scale = _mm256_castsi256_pd(_mm256_sub_epi64(_mm256_set1_epi64x(int64_t{2045} << 52), exponent));
  const Points unit = {n.x * scale, n.y * scale, n.z * scale};
  const Four length = _mm256_sqrt_pd((unit.x * unit.x + unit.y * unit.y) + unit.z * unit.z);
  return {all(0) - unit.x / length, all(0) - unit.y / length, all(0) - unit.z / length};
}

}  // namespace

uint32_t certified_hits_with_fma(const PlaneFlight<3>* flights, PlaneHit<3>* hits) noexcept {
  const Points at_p = load(flights, [](const PlaneFlight<3>& f) { return f.p; });
  const Points at_q = load(flights, [](const PlaneFlight<3>& f) { return f.q; });
  const Points at_a = load(flights, [](const PlaneFlight<3>& f) { return f.simplex[0]; });
  const Points at_b = load(flights, [](const PlaneFlight<3>& f) { return f.simplex[1]; });
  const Points at_c = load(flights, [](const PlaneFlight<3>& f) { return f.simplex[2]; });
  const Vector u = difference(at_q, at_p), w = difference(at_a, at_p);
  const Vector a = difference(at_b, at_a), b = difference(at_c, at_a);
  const Points m = {extent(u.x, w.x, a.x, b.x), extent(u.y, w.y, a.y, b.y), extent(u.z, w.z, a.z, b.z)};
  Four certain = both(at_most(all(kTimeFilterMin), _mm256_min_pd(_mm256_min_pd(m.x, m.y), m.z)),
                      at_most(_mm256_max_pd(_mm256_max_pd(m.x, m.y), m.z), all(kTimeFilterMax)));
  const Vector n = {minor(a.y, a.z, b.y, b.z, certain), minor(a.z, a.x, b.z, b.x, certain),
                    minor(a.x, a.y, b.x, b.y, certain)};
  const Four time = floor_ratios(dot(n, w), dot(n, u), m.x * m.y * m.z, certain);
  const Points normal = point_back({n.x.high, n.y.high, n.z.high});

  const Four tx0 = _mm256_unpacklo_pd(time, normal.x), tx1 = _mm256_unpackhi_pd(time, normal.x);
  const Four yz0 = _mm256_unpacklo_pd(normal.y, normal.z), yz1 = _mm256_unpackhi_pd(normal.y, normal.z);
  static_assert(sizeof(PlaneHit<3>) == sizeof(Four), "a time, then a normal");
  _mm256_storeu_pd(&hits[0].time, _mm256_permute2f128_pd(tx0, yz0, 0x20));
  _mm256_storeu_pd(&hits[1].time, _mm256_permute2f128_pd(tx1, yz1, 0x20));
  _mm256_storeu_pd(&hits[2].time, _mm256_permute2f128_pd(tx0, yz0, 0x31));
  _mm256_storeu_pd(&hits[3].time, _mm256_permute2f128_pd(tx1, yz1, 0x31));
  return static_cast<uint32_t>(_mm256_movemask_pd(certain));
}

}  // namespace dsw

DSW_END_TARGET

#endif
