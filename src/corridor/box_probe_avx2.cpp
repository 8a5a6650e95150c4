// Three coordinates side by side.

#include "base/compiler.h"
#include "corridor/box_probe.h"
#include "walk/standard_facets.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {

uint32_t facets_in_box_avx2(const double* points, const uint32_t* vertices, const Bounds<3>& box) noexcept {
  // Masked, so that the last point of the host's array is not read past.
  const __m256i mask = _mm256_setr_epi64x(-1, -1, -1, 0);
  const __m256d low = _mm256_loadu_pd(box.low), high = _mm256_loadu_pd(box.high);
  __m256d v[8];
  DSW_UNROLL(8)
  for (int i = 0; i < 8; ++i) v[i] = _mm256_maskload_pd(points + size_t{vertices[i]} * 3, mask);
  uint32_t met = 0;
  DSW_UNROLL(6)
  for (int f = 0; f < 6; ++f) {
    const __m256d a = v[kBoxFacets[f][0]], b = v[kBoxFacets[f][1]], c = v[kBoxFacets[f][2]], d = v[kBoxFacets[f][3]];
    const __m256d least = _mm256_min_pd(_mm256_min_pd(a, b), _mm256_min_pd(c, d)),
                  most = _mm256_max_pd(_mm256_max_pd(a, b), _mm256_max_pd(c, d));
    const __m256d beyond = _mm256_or_pd(_mm256_cmp_pd(most, low, _CMP_LT_OQ), _mm256_cmp_pd(least, high, _CMP_GT_OQ));
    met |= (_mm256_movemask_pd(beyond) == 0 ? 1u : 0u) << f;
  }
  return met;
}

}  // namespace dsw

DSW_END_TARGET

#endif
