// Eight edges side by side. Words are loaded one by one: a gather is slow on some processors.

#include "base/compiler.h"
#include "response/turn_words.h"

#if DSW_X86_64

#include <immintrin.h>

DSW_BEGIN_TARGET("avx2")

namespace dsw {
namespace {

constexpr uint32_t kLanes = 8;

/** Gives the highest bit of each of eight lanes. */
uint64_t signs(__m256i lanes) noexcept { return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(lanes))); }

/** What the words of both ends of eight edges tell; edge(i) is one of them. */
template <class Edge>
EdgeBits read_eight(Edge edge, const uint32_t* words) noexcept {
  static_assert(TurnWord::kMoves == 1 && TurnWord::kSure == 2 && TurnWord::kInwards == 4 && TurnWord::kStays == 8 &&
                    TurnWord::kBits == 4,
                "the shifts below bring these bits to the top");
  const auto words_of = [&](uint32_t end) {
    const auto word = [&](uint32_t i) { return static_cast<int>(words[edge(i).ends[end]]); };
    return _mm256_setr_epi32(word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7));
  };
  const __m256i a = words_of(0), b = words_of(1), both = a & b;
  const __m256i same = _mm256_cmpeq_epi32(_mm256_srli_epi32(a ^ b, 4), _mm256_setzero_si256());
  EdgeBits bits;
  bits.used = 0xff;
  bits.stay = signs(_mm256_slli_epi32(both, 28));
  bits.shared = signs(same) & bits.stay;
  bits.inwards = signs(_mm256_slli_epi32(both, 29));
  bits.either = signs(_mm256_slli_epi32(a | b, 29));
  bits.odd = signs(_mm256_slli_epi32(both, 31) & _mm256_slli_epi32(both, 30)) ^ 0xff;
  return bits;
}

/** Whether none of eight edges is a free slot; false also where vertices have very high numbers. */
bool are_used(const BodyEdge* e) noexcept {
  uint32_t all = 0;
  DSW_UNROLL(8)
  for (uint32_t i = 0; i < kLanes; ++i) all |= e[i].ends[0];
  return all >> 31 == 0;
}

void add(const EdgeBits& some, uint32_t place, EdgeBits& bits) noexcept {
  bits.used |= some.used << place;
  bits.shared |= some.shared << place;
  bits.stay |= some.stay << place;
  bits.inwards |= some.inwards << place;
  bits.either |= some.either << place;
  bits.odd |= some.odd << place;
}

/** Where the next eight of so many edges begin; the last eight are some of them once more. */
constexpr uint32_t first_of_eight(uint32_t next, uint32_t count) {
  return next + kLanes <= count ? next : count - kLanes;
}

}  // namespace

EdgeBits read_turn_words_avx2(const BodyEdge* edges, const uint32_t* names, uint32_t count, bool may_be_free,
                              const uint32_t* words) {
  EdgeBits bits;
  if (count < kLanes) return read_turn_words(edges, names, count, may_be_free, words);
  for (uint32_t next = 0; next < count; next += kLanes) {
    const uint32_t i = first_of_eight(next, count);
    const BodyEdge* const some = edges + i;
    if (names != nullptr) {
      add(read_eight([&](uint32_t lane) -> const BodyEdge& { return edges[names[i + lane]]; }, words), i, bits);
    } else if (!may_be_free || are_used(some)) {
      add(read_eight([&](uint32_t lane) -> const BodyEdge& { return some[lane]; }, words), i, bits);
    } else {
      add(read_turn_words(some, nullptr, kLanes, true, words), i, bits);
    }
  }
  return bits;
}

}  // namespace dsw

DSW_END_TARGET

#endif
