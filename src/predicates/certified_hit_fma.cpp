// certified_hit.cpp with the three axes side by side; see there for the bounds, which hold here too: the expressions
// are the same, and fused operations leave roundings out.
#include "predicates/certified_hit.h"

#include "base/compiler.h"

#if DSW_X86_64

#include <immintrin.h>

#include "predicates/certified_hit_bounds.h"

DSW_BEGIN_TARGET("avx2,fma")

namespace dsw {
namespace {

// x, y, z and a 0, each a sum of two doubles.
struct Vector {
  __m256d high, low;
};

inline __m256d absolute(__m256d a) noexcept { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
inline __m256d next_axis(__m256d a) noexcept { return _mm256_permute4x64_pd(a, _MM_SHUFFLE(3, 0, 2, 1)); }

inline Vector sum(__m256d a, __m256d b) noexcept {
  const __m256d s = _mm256_add_pd(a, b), from_b = _mm256_sub_pd(s, a);
  return {s, _mm256_add_pd(_mm256_sub_pd(a, _mm256_sub_pd(s, from_b)), _mm256_sub_pd(b, from_b))};
}
inline Vector difference(__m256d a, __m256d b) noexcept { return sum(a, _mm256_sub_pd(_mm256_setzero_pd(), b)); }

inline Vector product(const Vector& a, const Vector& b) noexcept {
  const __m256d p = _mm256_mul_pd(a.high, b.high);
  const __m256d cross = _mm256_fmadd_pd(a.high, b.low, _mm256_mul_pd(a.low, b.high));
  return {p, _mm256_add_pd(_mm256_fmsub_pd(a.high, b.high, p), cross)};
}

// Two numbers side by side.
struct Pair {
  __m128d high, low;
};

inline Pair sum(__m128d a, __m128d b) noexcept {
  const __m128d s = _mm_add_pd(a, b), from_b = _mm_sub_pd(s, a);
  return {s, _mm_add_pd(_mm_sub_pd(a, _mm_sub_pd(s, from_b)), _mm_sub_pd(b, from_b))};
}

// The sums over the axes of both.
inline Pair add_axes(const Vector& a, const Vector& b) noexcept {
  const __m256d xz = _mm256_unpacklo_pd(a.high, b.high), y = _mm256_unpackhi_pd(a.high, b.high);
  const __m256d low_xz = _mm256_unpacklo_pd(a.low, b.low), low_y = _mm256_unpackhi_pd(a.low, b.low);
  const Pair xy = sum(_mm256_castpd256_pd128(xz), _mm256_castpd256_pd128(y));
  const Pair xyz = sum(xy.high, _mm256_extractf128_pd(xz, 1));
  const __m128d low = _mm_add_pd(_mm_add_pd(_mm256_castpd256_pd128(low_xz), _mm256_castpd256_pd128(low_y)),
                                 _mm256_extractf128_pd(low_xz, 1));
  return sum(xyz.high, _mm_add_pd(_mm_add_pd(xy.low, xyz.low), low));
}

}  // namespace

bool certified_hit_with_fma(const double* p, const double* q, const double* const* triangle, bool with_normal,
                            CertifiedHit* hit) noexcept {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const __m256d zero = _mm256_setzero_pd();
  const __m256d at_p = _mm256_maskload_pd(p, three), at_a = _mm256_maskload_pd(triangle[0], three);
  const Vector u = difference(_mm256_maskload_pd(q, three), at_p), w = difference(at_a, at_p);
  const Vector a = difference(_mm256_maskload_pd(triangle[1], three), at_a);
  const Vector b = difference(_mm256_maskload_pd(triangle[2], three), at_a);
  const __m256d extent = _mm256_max_pd(_mm256_max_pd(absolute(u.high), absolute(w.high)),
                                       _mm256_max_pd(absolute(a.high), absolute(b.high)));
  const int in_range =
      _mm256_movemask_pd(_mm256_and_pd(_mm256_cmp_pd(extent, _mm256_set1_pd(kTimeFilterMin), _CMP_GE_OQ),
                                       _mm256_cmp_pd(extent, _mm256_set1_pd(kTimeFilterMax), _CMP_LE_OQ)));
  if (in_range != 7) return false;

  // Component k of the normal stands on axis k + 1 until it is turned.
  const Vector next_a = {next_axis(a.high), next_axis(a.low)}, next_b = {next_axis(b.high), next_axis(b.low)};
  const Vector left = product(a, next_b), right = product(next_a, b);
  const Vector top = difference(left.high, right.high);
  const Vector turned = sum(top.high, _mm256_add_pd(top.low, _mm256_sub_pd(left.low, right.low)));
  if (with_normal) {
    const __m256d products = _mm256_add_pd(absolute(left.high), absolute(right.high));
    const __m256d error = _mm256_mul_pd(_mm256_set1_pd(kNormalError), products);
    const auto is_zero = [&](__m256d x) { return _mm256_cmp_pd(x, zero, _CMP_EQ_OQ); };
    const __m256d exactly_zero = _mm256_and_pd(_mm256_or_pd(is_zero(a.high), is_zero(next_b.high)),
                                               _mm256_or_pd(is_zero(next_a.high), is_zero(b.high)));
    const auto rounds_to_itself = [&](__m256d low) {
      return _mm256_cmp_pd(_mm256_add_pd(turned.high, low), turned.high, _CMP_EQ_OQ);
    };
    const __m256d rounded = _mm256_and_pd(_mm256_cmp_pd(products, _mm256_set1_pd(kLeastProducts), _CMP_GE_OQ),
                                          _mm256_and_pd(rounds_to_itself(_mm256_sub_pd(turned.low, error)),
                                                        rounds_to_itself(_mm256_add_pd(turned.low, error))));
    if (_mm256_movemask_pd(_mm256_or_pd(rounded, exactly_zero)) != 15) return false;
  }
  const Vector n = {next_axis(turned.high), next_axis(turned.low)};
  _mm256_maskstore_pd(hit->normal, three, n.high);

  const Pair ratio = add_axes(product(n, w), product(n, u));
  const dd::Number numerator = {_mm_cvtsd_f64(ratio.high), _mm_cvtsd_f64(ratio.low)};
  const dd::Number denominator = {_mm_cvtsd_f64(_mm_unpackhi_pd(ratio.high, ratio.high)),
                                  _mm_cvtsd_f64(_mm_unpackhi_pd(ratio.low, ratio.low))};
  const __m128d mxy = _mm256_castpd256_pd128(extent);
  const double volume =
      _mm_cvtsd_f64(mxy) * _mm_cvtsd_f64(_mm_unpackhi_pd(mxy, mxy)) * _mm_cvtsd_f64(_mm256_extractf128_pd(extent, 1));
  return floor_ratio<dd::Fused>(numerator, denominator, volume, &hit->time);
}

}  // namespace dsw

DSW_END_TARGET

#endif
