// Four triangles side by side.

#include "walk/shear.h"

#include "base/compiler.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

#include "walk/shear_lanes.inl"

namespace dsw {
namespace {

struct Four {
  using Vector = __m256d;
  static constexpr size_t kCount = 4;
  static Vector all(double x) noexcept { return _mm256_set1_pd(x); }
  static Vector load(const double* x) noexcept { return _mm256_loadu_pd(x); }
  static __m256i first(size_t count) noexcept {
    return _mm256_cmpgt_epi64(_mm256_set1_epi64x(static_cast<long long>(count)), _mm256_set_epi64x(3, 2, 1, 0));
  }
  static Vector load(const double* x, __m256i these) noexcept { return _mm256_maskload_pd(x, these); }
  static Vector choose(__m256i these, Vector a, Vector b) noexcept {
    return _mm256_blendv_pd(b, a, _mm256_castsi256_pd(these));
  }
  static Vector min(Vector a, Vector b) noexcept { return _mm256_min_pd(a, b); }
  static Vector max(Vector a, Vector b) noexcept { return _mm256_max_pd(a, b); }
  static Vector absolute(Vector a) noexcept { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
  /** `other` where a is not positive. */
  static Vector positive_or(Vector a, Vector other) noexcept {
    return _mm256_blendv_pd(a, other, _mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_NGT_UQ));
  }
  static unsigned not_positive(Vector a) noexcept {
    return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_NGT_UQ)));
  }
  static double lowest(Vector a) noexcept {
    const __m128d two = _mm_min_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
    return _mm_cvtsd_f64(_mm_min_pd(two, _mm_unpackhi_pd(two, two)));
  }
  static double largest(Vector a) noexcept {
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
    return _mm_cvtsd_f64(_mm_max_pd(two, _mm_unpackhi_pd(two, two)));
  }
};

}  // namespace

uint64_t missed_triangles_avx2(Shear& shear, const FacetSpan<3>& triangles) noexcept {
  return ShearLanes<Four>(shear).missed(triangles);
}

bool passes_triangles_avx2(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept {
  Shear line(from, to);
  return ShearLanes<Four>(line).pass_all(triangles);
}

}  // namespace dsw

DSW_END_TARGET

#endif
