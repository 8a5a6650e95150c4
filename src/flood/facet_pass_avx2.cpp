// Four ridges side by side.

#include "base/target.h"
#include "flood/facet_pass.h"

#if defined(__x86_64__)

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {

bool passes_facet_avx2(const double* const* corners, const double* from, const double* to) noexcept {
  // Masked, so that the last point of the host's array is not read past.
  const __m256i mask = _mm256_setr_epi64x(-1, -1, -1, 0);
  const __m256d start = _mm256_maskload_pd(from, mask);
  __m256d c[4];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) c[i] = _mm256_maskload_pd(corners[i], mask) - start;
  const __m256d way = _mm256_maskload_pd(to, mask) - start;
  // A lane for each corner a, and for the next one b.
  const __m256d xy01 = _mm256_unpacklo_pd(c[0], c[1]), xy23 = _mm256_unpacklo_pd(c[2], c[3]),
                y01 = _mm256_unpackhi_pd(c[0], c[1]), y23 = _mm256_unpackhi_pd(c[2], c[3]);
  const __m256d ax = _mm256_permute2f128_pd(xy01, xy23, 0x20), az = _mm256_permute2f128_pd(xy01, xy23, 0x31),
                ay = _mm256_permute2f128_pd(y01, y23, 0x20);
  const __m256d bx = _mm256_permute4x64_pd(ax, 0x39), by = _mm256_permute4x64_pd(ay, 0x39),
                bz = _mm256_permute4x64_pd(az, 0x39);
  const __m256d wx = _mm256_permute4x64_pd(way, 0x00), wy = _mm256_permute4x64_pd(way, 0x55),
                wz = _mm256_permute4x64_pd(way, 0xaa);
  const __m256d det = ((ay * bz - az * by) * wx + (az * bx - ax * bz) * wy) + (ax * by - ay * bx) * wz;

  const __m256d sign = _mm256_set1_pd(-0.0);
  const auto extent = [&](__m256d a, __m256d b, __m256d w) {
    return _mm256_max_pd(_mm256_max_pd(_mm256_andnot_pd(sign, a), _mm256_andnot_pd(sign, b)),
                         _mm256_andnot_pd(sign, w));
  };
  const __m256d mx = extent(ax, bx, wx), my = extent(ay, by, wy), mz = extent(az, bz, wz);
  const __m256d bound = _mm256_set1_pd(kPlaneFilter3) * mx * my * mz;
  const __m256d least = _mm256_min_pd(_mm256_min_pd(mx, my), mz), most = _mm256_max_pd(_mm256_max_pd(mx, my), mz);
  const __m256d in_range = _mm256_and_pd(_mm256_cmp_pd(least, _mm256_set1_pd(kFilterMin), _CMP_GE_OQ),
                                         _mm256_cmp_pd(most, _mm256_set1_pd(kFilterMax), _CMP_LE_OQ));
  const __m256d passed = _mm256_and_pd(in_range, _mm256_cmp_pd(det, bound, _CMP_GT_OQ));
  const int none = corners[2] == corners[3] ? 4 : 0;  // a triangle has no ridge between these
  return (_mm256_movemask_pd(passed) | none) == 15;
}

}  // namespace dsw

DSW_END_TARGET

#endif
