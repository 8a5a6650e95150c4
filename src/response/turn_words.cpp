#include "response/turn_words.h"

#include "base/compiler.h"
#include "base/processor.h"

namespace dsw {

// Without branches on what is found, which would be mispredicted for every other edge.
EdgeBits read_turn_words(const BodyEdge* edges, const uint32_t* names, uint32_t count,
                         [[maybe_unused]] bool may_be_free, const uint32_t* words) {
  constexpr uint32_t kPlain = TurnWord::kMoves | TurnWord::kSure;
  EdgeBits bits;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t(&ends)[2] = edges[names == nullptr ? i : names[i]].ends;
    if (ends[0] == kNone) continue;
    const uint32_t a = words[ends[0]], b = words[ends[1]], both = a & b;
    bits.used |= uint64_t{1} << i;
    bits.shared |= uint64_t{TurnWord::share_cell(a, b)} << i;
    bits.stay |= uint64_t{both / TurnWord::kStays & 1} << i;
    bits.inwards |= uint64_t{both / TurnWord::kInwards & 1} << i;
    bits.either |= uint64_t{(a | b) / TurnWord::kInwards & 1} << i;
    bits.odd |= uint64_t{(both & kPlain) != kPlain ? 1u : 0u} << i;
  }
  return bits;
}

const ReadTurnWords kReadTurnWords = DSW_WITH_AVX2(read_turn_words);

}  // namespace dsw
