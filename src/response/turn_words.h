#pragma once
// What is known of the turn of a vertex in one word, and what the words of both ends tell of edges.

#include "base/compiler.h"
#include "body/body.h"

namespace dsw {

/** Whether a vertex moves, is not in doubt, goes inwards, stays in a convex cell, whose unit stands above these bits. */
struct TurnWord {
  static constexpr uint32_t kMoves = 1, kSure = 2, kInwards = 4, kStays = 8, kBits = 4;

  /** Whether two vertices stay in the same convex cell: 1 or 0. */
  static uint32_t share_cell(uint32_t a, uint32_t b) { return ((a ^ b) < 1u << kBits ? 1u : 0u) & (a & b) / kStays; }
};

/** A bit for each of some edges. */
struct EdgeBits {
  uint64_t used = 0;     // no free slot. The others are bits of these
  uint64_t shared = 0;   // both ends stay in the same convex cell
  uint64_t stay = 0;     // each end stays in a convex cell
  uint64_t inwards = 0;  // both ends go inwards
  uint64_t either = 0;   // an end goes inwards
  uint64_t odd = 0;      // an end does not move, or is in doubt
};

/** Reads the words of both ends of at most 64 edges. @param names the numbers of edges, none of which is a free slot; null: all from the
 * first on. @param may_be_free whether some of the edges may be free slots. @param words by vertex. */
using ReadTurnWords = EdgeBits (*)(const BodyEdge* edges, const uint32_t* names, uint32_t count, bool may_be_free,
                                   const uint32_t* words);

/** The fastest of this processor; all give the same bits. */
extern const ReadTurnWords kReadTurnWords;

EdgeBits read_turn_words(const BodyEdge* edges, const uint32_t* names, uint32_t count, bool may_be_free,
                         const uint32_t* words);
#if DSW_X86_64
EdgeBits read_turn_words_avx2(const BodyEdge* edges, const uint32_t* names, uint32_t count, bool may_be_free,
                              const uint32_t* words);
#endif

}  // namespace dsw
