// What the words of both ends tell of edges, for every instruction set.

#include "response/turn_words.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "base/compiler.h"

#include "../../effort.h"

namespace {

using namespace dsw;

bool is_set(uint64_t bits, uint32_t i) { return (bits >> i & 1) != 0; }

/// Few units, so that many edges stay in one cell; units with all bits; one edge in nine is a free slot.
TEST(TurnWords, TellOfEdges) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(13)));
  uint64_t seen[5] = {};
  for (int i = 0; i < at_least(20000); ++i) {
    std::vector<uint32_t> words;
    for (int v = 0; v < 12; ++v) {
      const uint32_t unit =
          random() % 4 == 0 ? static_cast<uint32_t>(random()) >> 4 : static_cast<uint32_t>(random() % 3);
      const uint32_t bits = random() % 2 == 0 ? 15 : static_cast<uint32_t>(random() % 16);
      words.push_back((bits & TurnWord::kStays) != 0 ? unit << 4 | bits : bits);
    }
    const uint32_t count = 1 + static_cast<uint32_t>(random() % 64);
    const bool all_used = random() % 2 == 0;
    std::vector<BodyEdge> edges(count);
    for (BodyEdge& edge : edges) {
      if (!all_used && random() % 9 == 0) continue;
      for (uint32_t& end : edge.ends) end = static_cast<uint32_t>(random() % words.size());
    }
    const EdgeBits bits = read_turn_words(edges.data(), count, words.data());
    for (uint32_t e = 0; e < 64; ++e) {
      const bool used = e < count && edges[e].ends[0] != kNone;
      const uint32_t a = used ? words[edges[e].ends[0]] : 0, b = used ? words[edges[e].ends[1]] : 0;
      const auto both = [&](uint32_t bit) { return (a & bit) != 0 && (b & bit) != 0; };
      ASSERT_EQ(is_set(bits.used, e), used) << i;
      ASSERT_EQ(is_set(bits.shared, e), used && both(TurnWord::kStays) && a >> 4 == b >> 4) << i;
      ASSERT_EQ(is_set(bits.stay, e), used && both(TurnWord::kStays)) << i;
      ASSERT_EQ(is_set(bits.inwards, e), used && both(TurnWord::kInwards)) << i;
      ASSERT_EQ(is_set(bits.odd, e), used && !(both(TurnWord::kMoves) && both(TurnWord::kSure))) << i;
      seen[0] += is_set(bits.used, e) ? 1 : 0;
      seen[1] += is_set(bits.shared, e) ? 1 : 0;
      seen[2] += is_set(bits.inwards, e) ? 1 : 0;
      seen[3] += is_set(bits.odd, e) ? 1 : 0;
      seen[4] += is_set(bits.stay, e) ? 1 : 0;
    }
#if DSW_X86_64
    if (DSW_CPU_HAS("avx2")) {
      const EdgeBits lanes = read_turn_words_avx2(edges.data(), count, words.data());
      ASSERT_EQ(lanes.used, bits.used) << i;
      ASSERT_EQ(lanes.shared, bits.shared) << i;
      ASSERT_EQ(lanes.stay, bits.stay) << i;
      ASSERT_EQ(lanes.inwards, bits.inwards) << i;
      ASSERT_EQ(lanes.odd, bits.odd) << i;
    }
#endif
  }
  for (const uint64_t times : seen) EXPECT_GT(times, 1000u);
}

}  // namespace
