// The three coordinates of a point side by side.

#include <cstddef>

#include "base/compiler.h"
#include "response/inwards.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace {

/** The coordinates of a vertex; what stands behind them would be a denormal number, which is slow. */
__m256d coordinates(const BodyVertex<3>& vertex) noexcept {
  static_assert(offsetof(BodyVertex<3>, position) == 0, "coordinates come first");
  const __m256d all = _mm256_loadu_pd(reinterpret_cast<const double*>(&vertex));
  return _mm256_blend_pd(all, _mm256_setzero_pd(), 8);
}

/** y, z, x of x, y, z. */
__m256d turned(__m256d v) noexcept { return _mm256_permute4x64_pd(v, 0xc9); }

/** For three ways, a bit each: whether they go against a normal. As `dot` of Vec, x and y first. */
uint32_t against(__m256d normal, const double* a, const double* b, const double* c) noexcept {
  const __m256d of_a = normal * _mm256_loadu_pd(a), of_b = normal * _mm256_loadu_pd(b),
                of_c = normal * _mm256_loadu_pd(c);
  const __m256d xz = _mm256_unpacklo_pd(of_a, of_b), y_ab = _mm256_unpackhi_pd(of_a, of_b),
                y_c = _mm256_permute_pd(of_c, 1);
  // The fourth lane holds nothing that counts.
  const __m256d x = _mm256_permute2f128_pd(xz, of_c, 0x20), y = _mm256_permute2f128_pd(y_ab, y_c, 0x20),
                z = _mm256_permute2f128_pd(xz, of_c, 0x31);
  const __m256d less = _mm256_cmp_pd((x + y) + z, _mm256_setzero_pd(), _CMP_LT_OQ);
  return static_cast<uint32_t>(_mm256_movemask_pd(less)) & 7;
}

}  // namespace

void keep_inwards_avx2(const BodyFace* faces, size_t count, const BodyVertex<3>* vertices, const double* ways,
                       Course<3>::Vertex* turns) {
  for (size_t f = 0; f < count; ++f) {
    const uint32_t a = faces[f].corners[0], b = faces[f].corners[1], c = faces[f].corners[2];
    if (a == kNone) continue;
    if ((uint32_t{turns[a].inwards} | uint32_t{turns[b].inwards} | uint32_t{turns[c].inwards}) == 0) continue;
    const __m256d p = coordinates(vertices[a]), u = coordinates(vertices[b]) - p, v = coordinates(vertices[c]) - p;
    const __m256d normal = turned(u * turned(v) - turned(u) * v);
    const uint32_t inwards = against(normal, ways + 4 * size_t{a}, ways + 4 * size_t{b}, ways + 4 * size_t{c});
    if (inwards == 7) continue;
    turns[a].inwards &= (inwards & 1) != 0;
    turns[b].inwards &= (inwards & 2) != 0;
    turns[c].inwards &= (inwards & 4) != 0;
  }
}

}  // namespace dsw

DSW_END_TARGET

#endif
