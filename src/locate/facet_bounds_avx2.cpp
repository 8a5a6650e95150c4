// Four triangles side by side.

#include "locate/facet_bounds.h"

#include "base/target.h"

#if defined(__x86_64__)

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace facet_bounds_avx2 {
namespace {

struct Four {
  __m256d x;

  static Four all(double a) noexcept { return {_mm256_set1_pd(a)}; }
  static Four min(const Four& a, const Four& b) noexcept { return {_mm256_min_pd(a.x, b.x)}; }
  static Four max(const Four& a, const Four& b) noexcept { return {_mm256_max_pd(a.x, b.x)}; }
  static Four if_positive(const Four& a, const Four& yes, const Four& no) noexcept {
    return {_mm256_blendv_pd(no.x, yes.x, _mm256_cmp_pd(a.x, _mm256_setzero_pd(), _CMP_GT_OQ))};
  }
  template <int A, int B, int C, int D>
  Four turned() const noexcept {
    return {_mm256_permute4x64_pd(x, A | B << 2 | C << 4 | D << 6)};
  }
};

inline Four operator+(const Four& a, const Four& b) noexcept { return {_mm256_add_pd(a.x, b.x)}; }
inline Four operator-(const Four& a, const Four& b) noexcept { return {_mm256_sub_pd(a.x, b.x)}; }
inline Four operator*(const Four& a, const Four& b) noexcept { return {_mm256_mul_pd(a.x, b.x)}; }
inline Four operator/(const Four& a, const Four& b) noexcept { return {_mm256_div_pd(a.x, b.x)}; }
inline Four absolute(const Four& a) noexcept { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.x)}; }
inline Four root(const Four& a) noexcept { return {_mm256_sqrt_pd(a.x)}; }
inline void store(const Four& a, double* out) noexcept { _mm256_storeu_pd(out, a.x); }

/** Masked, so that the last point of the host's array is not read past. */
template <int D>
__m256d load(const double* point) noexcept {
  return _mm256_maskload_pd(point, _mm256_setr_epi64x(-1, -1, D == 3 ? -1 : 0, 0));
}
template <int D>
void read(const double* const* points, Four& x, Four& y, Four& z) noexcept {
  const __m256d p0 = load<D>(points[0]), p1 = load<D>(points[1]), p2 = load<D>(points[2]), p3 = load<D>(points[3]);
  const __m256d xz01 = _mm256_unpacklo_pd(p0, p1), xz23 = _mm256_unpacklo_pd(p2, p3), y01 = _mm256_unpackhi_pd(p0, p1),
                y23 = _mm256_unpackhi_pd(p2, p3);
  x.x = _mm256_permute2f128_pd(xz01, xz23, 0x20);
  y.x = _mm256_permute2f128_pd(y01, y23, 0x20);
  z.x = _mm256_permute2f128_pd(xz01, xz23, 0x31);
}

#include "locate/facet_bounds.inl"

}  // namespace
}  // namespace facet_bounds_avx2

template <int D>
BoundsKernel<D> avx2_bounds() noexcept {
  return facet_bounds_avx2::this_kernel<D>();
}
template BoundsKernel<2> avx2_bounds() noexcept;
template BoundsKernel<3> avx2_bounds() noexcept;

}  // namespace dsw

DSW_END_TARGET

#endif
