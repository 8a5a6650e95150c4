// The words of eight vertices side by side. Records of cells are loaded one by one: a gather is slow on some processors.

#include <cstddef>

#include "base/compiler.h"
#include "response/short_edges.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace {

constexpr uint32_t kVertices = 8;

/** The first or second words of eight pairs. */
template <int Shuffle>
__m256i words_of_pairs(const void* pairs) noexcept {
  const auto* const at = static_cast<const float*>(pairs);
  const __m256 mixed = _mm256_shuffle_ps(_mm256_loadu_ps(at), _mm256_loadu_ps(at + kVertices), Shuffle);
  return _mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8);
}
constexpr int kFirstOfPairs = 0x88, kSecondOfPairs = 0xdd;

__m256i splat(uint32_t x) noexcept { return _mm256_set1_epi32(static_cast<int>(x)); }

/** The first words of the records of eight cells. */
__m256i first_words(const Map<3>& map, __m256i units) noexcept {
  alignas(32) uint32_t unit[kVertices];
  _mm256_store_si256(reinterpret_cast<__m256i*>(unit), units);
  const auto word = [&](uint32_t i) { return static_cast<int>(map.record({unit[i]})[0]); };
  return _mm256_setr_epi32(word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7));
}

}  // namespace

uint32_t write_turn_words_avx2(const Map<3>& map, const VertexWay* ways, const Course<3>::Vertex* turns, uint32_t count,
                               uint32_t* words, uint32_t* now, uint32_t* in_doubt, bool* has_others) {
  using Turn = Course<3>::Vertex;
  static_assert(sizeof(VertexWay) == 8 && offsetof(VertexWay, from) == 0, "two words");
  static_assert(offsetof(Turn, doubtful) == 4 && offsetof(Turn, inwards) == 6, "bits 0 and 16 of the second word");
  static_assert(TurnWord::kMoves == 1 && TurnWord::kSure == 2 && TurnWord::kInwards == 4, "the shifts below make them");
  __m256i others = splat(0);
  uint32_t doubts = 0, v = 0;
  for (; v + kVertices <= count; v += kVertices) {
    const __m256i from = words_of_pairs<kFirstOfPairs>(ways + v), to = words_of_pairs<kSecondOfPairs>(ways + v),
                  rank = words_of_pairs<kFirstOfPairs>(turns + v), bits = words_of_pairs<kSecondOfPairs>(turns + v);
    const __m256i stays = _mm256_andnot_si256(_mm256_cmpeq_epi32(from, splat(kNone)), _mm256_cmpeq_epi32(from, to));
    const __m256i record = first_words(map, from & stays);
    const __m256i is_simplex = _mm256_cmpeq_epi32(record & splat(7u << kFormShift), splat(0)),
                  is_bent = _mm256_cmpeq_epi32(record & splat(map.convex_bit), splat(0));
    const __m256i convex = stays & _mm256_or_si256(is_simplex, is_bent ^ splat(~0u));
    others = others | (stays ^ convex);
    const __m256i of_cell = convex & (_mm256_slli_epi32(from, TurnWord::kBits) | splat(TurnWord::kStays));
    const __m256i moves = _mm256_andnot_si256(_mm256_cmpeq_epi32(rank, splat(kNone)), splat(TurnWord::kMoves));
    const __m256i sure = _mm256_andnot_si256(_mm256_slli_epi32(bits, 1), splat(TurnWord::kSure));
    const __m256i inwards = _mm256_srli_epi32(bits, 14) & splat(TurnWord::kInwards);
    const __m256i whole = of_cell | moves | sure | inwards;
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(words + v), whole);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(now + v), whole);
    auto doubtful = static_cast<uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_slli_epi32(bits, 31))));
    for (; doubtful != 0; doubtful &= doubtful - 1) in_doubt[doubts++] = v + lowest_bit(doubtful);
  }
  bool rest_has_others = false;
  const uint32_t more =
      write_turn_words(map, ways + v, turns + v, count - v, words + v, now + v, in_doubt + doubts, &rest_has_others);
  for (uint32_t i = 0; i < more; ++i) in_doubt[doubts + i] += v;
  *has_others = rest_has_others || _mm256_testz_si256(others, others) == 0;
  return doubts + more;
}

}  // namespace dsw

DSW_END_TARGET

#endif
