// Four ridges side by side.

#include "base/compiler.h"
#include "corridor/facet_pass.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace {

/** Three coordinates, a lane for each point. */
struct Lanes {
  __m256d x, y, z;

  Lanes operator-(const Lanes& o) const noexcept { return {x - o.x, y - o.y, z - o.z}; }
};

Lanes all(const double* p) noexcept { return {_mm256_set1_pd(p[0]), _mm256_set1_pd(p[1]), _mm256_set1_pd(p[2])}; }

// Masked, so that the last point of the host's array is not read past.
__m256d read(const double* point) noexcept { return _mm256_maskload_pd(point, _mm256_setr_epi64x(-1, -1, -1, 0)); }

/** Four points as they are read. */
Lanes transposed(const __m256d (&c)[4]) noexcept {
  const __m256d xy01 = _mm256_unpacklo_pd(c[0], c[1]), xy23 = _mm256_unpacklo_pd(c[2], c[3]),
                y01 = _mm256_unpackhi_pd(c[0], c[1]), y23 = _mm256_unpackhi_pd(c[2], c[3]);
  return {_mm256_permute2f128_pd(xy01, xy23, 0x20), _mm256_permute2f128_pd(y01, y23, 0x20),
          _mm256_permute2f128_pd(xy01, xy23, 0x31)};
}

/** For each lane the next one. */
Lanes next(const Lanes& a) noexcept {
  return {_mm256_permute4x64_pd(a.x, 0x39), _mm256_permute4x64_pd(a.y, 0x39), _mm256_permute4x64_pd(a.z, 0x39)};
}

Lanes cross(const Lanes& a, const Lanes& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
__m256d dot(const Lanes& a, const Lanes& b) noexcept { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

__m256d magnitude(__m256d a) noexcept { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
/** The largest magnitudes of some vectors. */
Lanes extent(const Lanes& a) noexcept { return {magnitude(a.x), magnitude(a.y), magnitude(a.z)}; }
template <class... Rest>
Lanes extent(const Lanes& a, const Rest&... rest) noexcept {
  const Lanes one = extent(a), others = extent(rest...);
  return {_mm256_max_pd(one.x, others.x), _mm256_max_pd(one.y, others.y), _mm256_max_pd(one.z, others.z)};
}

/** Whether determinants with this extent are certainly positive: in all lanes, but for the third one of a triangle,
 * which has no ridge there. */
bool all_positive(__m256d det, const Lanes& most, bool triangle) noexcept {
  const __m256d bound = _mm256_set1_pd(kPlaneFilter3) * most.x * most.y * most.z;
  const __m256d low = _mm256_min_pd(_mm256_min_pd(most.x, most.y), most.z),
                high = _mm256_max_pd(_mm256_max_pd(most.x, most.y), most.z);
  const __m256d in_range = _mm256_and_pd(_mm256_cmp_pd(low, _mm256_set1_pd(kFilterMin), _CMP_GE_OQ),
                                         _mm256_cmp_pd(high, _mm256_set1_pd(kFilterMax), _CMP_LE_OQ));
  const __m256d passed = _mm256_and_pd(in_range, _mm256_cmp_pd(det, bound, _CMP_GT_OQ));
  return (_mm256_movemask_pd(passed) | (triangle ? 4 : 0)) == 15;
}

}  // namespace

bool passes_facet_avx2(const double* const* corners, const double* from, const double* to) noexcept {
  const __m256d c[4] = {read(corners[0]), read(corners[1]), read(corners[2]), read(corners[3])};
  const Lanes start = all(from), a = transposed(c) - start, b = next(a), way = all(to) - start;
  return all_positive(dot(cross(a, b), way), extent(a, b, way), corners[2] == corners[3]);
}

bool keeps_to_facet_avx2(const double* const* corners, const EdgeWay& edge) noexcept {
  const __m256d c[4] = {read(corners[0]), read(corners[1]), read(corners[2]), read(corners[3])};
  const __m256d ends[4] = {read(edge.first), read(edge.first_to), read(edge.other), read(edge.other_to)};
  __m256d low = ends[0], high = ends[0];
  DSW_UNROLL(4)
  for (int i = 0; i < 4; ++i) {
    low = _mm256_min_pd(_mm256_min_pd(low, ends[i]), c[i]);
    high = _mm256_max_pd(_mm256_max_pd(high, ends[i]), c[i]);
  }
  const __m256d reach = high - low;
  const Lanes reaches{_mm256_permute4x64_pd(reach, 0x00), _mm256_permute4x64_pd(reach, 0x55),
                      _mm256_permute4x64_pd(reach, 0xaa)};

  const Lanes points = transposed(c), first_to = all(edge.first_to), other = all(edge.other),
              other_to = all(edge.other_to);
  const Lanes a = points - other, a_to = points - other_to, normal = cross(a, next(a)),
              normal_to = cross(a_to, next(a_to));
  const __m256d turned = _mm256_set1_pd(edge.from_first ? 0.0 : -0.0);
  const Lanes first = all(edge.first);
  __m256d least = _mm256_min_pd(_mm256_min_pd(_mm256_xor_pd(dot(normal, other - first), turned),
                                              _mm256_xor_pd(dot(normal, other - first_to), turned)),
                                _mm256_xor_pd(dot(normal_to, other_to - first_to), turned));
  if (edge.at_once) least = _mm256_min_pd(least, _mm256_xor_pd(dot(normal_to, other_to - first), turned));
  return all_positive(least, reaches, corners[2] == corners[3]);
}

}  // namespace dsw

DSW_END_TARGET

#endif
