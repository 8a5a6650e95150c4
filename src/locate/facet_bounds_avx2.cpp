// Eight triangles side by side.

#include "locate/facet_bounds.h"

#include "base/compiler.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace facet_bounds_avx2 {
namespace {

struct Lanes {
  __m256 x;

  static Lanes all(float a) noexcept { return {_mm256_set1_ps(a)}; }
  static Lanes min(const Lanes& a, const Lanes& b) noexcept { return {_mm256_min_ps(a.x, b.x)}; }
  static Lanes max(const Lanes& a, const Lanes& b) noexcept { return {_mm256_max_ps(a.x, b.x)}; }
  /** Lanes in another order, within each four. */
  template <int A, int B, int C, int D>
  Lanes turned() const noexcept {
    return {_mm256_permute_ps(x, A | B << 2 | C << 4 | D << 6)};
  }
};

inline Lanes operator+(const Lanes& a, const Lanes& b) noexcept { return {_mm256_add_ps(a.x, b.x)}; }
inline Lanes operator-(const Lanes& a, const Lanes& b) noexcept { return {_mm256_sub_ps(a.x, b.x)}; }
inline Lanes operator*(const Lanes& a, const Lanes& b) noexcept { return {_mm256_mul_ps(a.x, b.x)}; }
inline Lanes operator/(const Lanes& a, const Lanes& b) noexcept { return {_mm256_div_ps(a.x, b.x)}; }
inline Lanes absolute(const Lanes& a) noexcept { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.x)}; }
/** Zero elsewhere. */
inline Lanes where_above(const Lanes& a, float limit, const Lanes& yes) noexcept {
  return {_mm256_and_ps(_mm256_cmp_ps(a.x, _mm256_set1_ps(limit), _CMP_GT_OQ), yes.x)};
}
inline Lanes where_not_above(const Lanes& a, float limit, const Lanes& yes) noexcept {
  return {_mm256_andnot_ps(_mm256_cmp_ps(a.x, _mm256_set1_ps(limit), _CMP_GT_OQ), yes.x)};
}
inline Lanes root(const Lanes& a) noexcept { return {_mm256_sqrt_ps(a.x)}; }
inline void store(const Lanes& a, float* out) noexcept { _mm256_storeu_ps(out, a.x); }

/** Eight points: scaled differences from the segment's first one. */
template <int D>
DSW_HOT void read(const SegmentFrame<D>& frame, const double* const* points, Lanes& x, Lanes& y, Lanes& z) noexcept {
  // Masked, so that the last point of the host's array is not read past.
  const __m256i mask = _mm256_setr_epi64x(-1, -1, D == 3 ? -1 : 0, 0);
  const __m256d first = _mm256_maskload_pd(frame.first, mask), scale = _mm256_set1_pd(frame.scale);
  const auto one = [&](int i) {
    return _mm256_cvtpd_ps(_mm256_mul_pd(_mm256_sub_pd(_mm256_maskload_pd(points[i], mask), first), scale));
  };
  const auto two = [&](int i) { return _mm256_insertf128_ps(_mm256_castps128_ps256(one(i)), one(i + 4), 1); };
  const __m256 p0 = two(0), p1 = two(1), p2 = two(2), p3 = two(3);
  const __m256 xy01 = _mm256_unpacklo_ps(p0, p1), xy23 = _mm256_unpacklo_ps(p2, p3), z01 = _mm256_unpackhi_ps(p0, p1),
               z23 = _mm256_unpackhi_ps(p2, p3);
  x.x = _mm256_shuffle_ps(xy01, xy23, 0x44);
  y.x = _mm256_shuffle_ps(xy01, xy23, 0xee);
  z.x = _mm256_shuffle_ps(z01, z23, 0x44);
}

#include "locate/facet_bounds.inl"

}  // namespace
}  // namespace facet_bounds_avx2

template <int D>
BoundsKernel<D> avx2_bounds() noexcept {
  return {facet_bounds_avx2::triangle_bounds<D>, facet_bounds_avx2::tetrahedra_bounds};
}
template BoundsKernel<2> avx2_bounds() noexcept;
template BoundsKernel<3> avx2_bounds() noexcept;

}  // namespace dsw

DSW_END_TARGET

#endif
