#include "response/turn_words.h"

#include "base/compiler.h"
#include "base/processor.h"

namespace dsw {

/** Without branches on what is found, which would be mispredicted for every other edge. */
EdgeBits read_turn_words(const BodyEdge* edges, uint32_t count, const uint32_t* words) {
  constexpr uint32_t kPlain = TurnWord::kMoves | TurnWord::kSure;
  EdgeBits bits;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t v = edges[i].ends[0];
    if (v == kNone) continue;
    const uint32_t a = words[v], b = words[edges[i].ends[1]], both = a & b;
    bits.used |= uint64_t{1} << i;
    bits.shared |= uint64_t{TurnWord::share_cell(a, b)} << i;
    bits.stay |= uint64_t{both / TurnWord::kStays & 1} << i;
    bits.inwards |= uint64_t{both / TurnWord::kInwards & 1} << i;
    bits.odd |= uint64_t{(both & kPlain) != kPlain ? 1u : 0u} << i;
  }
  return bits;
}

const ReadTurnWords kReadTurnWords = DSW_WITH_AVX2(read_turn_words);

}  // namespace dsw
