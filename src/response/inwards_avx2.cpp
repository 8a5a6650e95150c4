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
  return _mm256_blend_pd(_mm256_setzero_pd(), _mm256_loadu_pd(reinterpret_cast<const double*>(&vertex)), 7);
}

/** Notes which vertices move, and their ways. */
void start(const MovingSurface& surface, double* ways, Course<3>::Vertex* turns) noexcept {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  for (size_t v = 0; v < surface.vertex_count; ++v) {
    turns[v].inwards = turns[v].rank != kNone;
    if (!turns[v].inwards) continue;
    const __m256d to = _mm256_maskload_pd(surface.targets[v], three);
    _mm256_storeu_pd(ways + 4 * v, to - coordinates(surface.vertices[v]));
  }
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

void find_inwards_avx2(const MovingSurface& surface, double* ways, Course<3>::Vertex* turns) {
  start(surface, ways, turns);
  const BodyVertex<3>* const vertices = surface.vertices;
  for (size_t f = 0; f < surface.face_count; ++f) {
    const uint32_t(&corners)[3] = surface.faces[f].corners;
    const uint32_t a = corners[0], b = corners[1], c = corners[2];
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
