// Eight triangles side by side.

#include "walk/shear.h"

#include "base/compiler.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_UNSET_REGISTERS
DSW_BEGIN_TARGET("avx2,avx512f,avx512vl,avx512dq")

#include "walk/shear_lanes.inl"

namespace dsw {
namespace {

struct Eight {
  using Vector = __m512d;
  static constexpr size_t kCount = 8;
  static Vector all(double x) noexcept { return _mm512_set1_pd(x); }
  static Vector load(const double* x) noexcept { return _mm512_loadu_pd(x); }
  static __mmask8 first(size_t count) noexcept { return static_cast<__mmask8>((1u << count) - 1); }
  static Vector load(const double* x, __mmask8 these) noexcept { return _mm512_maskz_loadu_pd(these, x); }
  static Vector choose(__mmask8 these, Vector a, Vector b) noexcept { return _mm512_mask_blend_pd(these, b, a); }
  static Vector min(Vector a, Vector b) noexcept { return _mm512_min_pd(a, b); }
  static Vector max(Vector a, Vector b) noexcept { return _mm512_max_pd(a, b); }
  static Vector absolute(Vector a) noexcept { return _mm512_abs_pd(a); }
  /** `other` where a is not positive. */
  static Vector positive_or(Vector a, Vector other) noexcept {
    return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_NGT_UQ), a, other);
  }
  static unsigned not_positive(Vector a) noexcept { return _mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_NGT_UQ); }
  static double lowest(Vector a) noexcept { return _mm512_reduce_min_pd(a); }
  static double largest(Vector a) noexcept { return _mm512_reduce_max_pd(a); }
};

constexpr size_t kFew = 4;  // then half a register does

}  // namespace

uint64_t missed_triangles_avx512(Shear& shear, const FacetSpan<3>& triangles) noexcept {
  return triangles.size() <= kFew ? missed_triangles_avx2(shear, triangles)
                                  : ShearLanes<Eight>(shear).missed(triangles);
}

bool passes_triangles_avx512(const double* from, const double* to, const FacetSpan<3>& triangles) noexcept {
  if (triangles.size() <= kFew) return passes_triangles_avx2(from, to, triangles);
  Shear line(from, to);
  return ShearLanes<Eight>(line).pass_all(triangles);
}

}  // namespace dsw

DSW_END_TARGET

#endif
