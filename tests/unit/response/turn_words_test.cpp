// The words of vertices, and what those of both ends tell of edges, for every instruction set.

#include "response/turn_words.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "base/compiler.h"
#include "response/short_edges.h"

#include "../../effort.h"

namespace {

using namespace dsw;

bool is_set(uint64_t bits, uint32_t i) { return (bits >> i & 1) != 0; }

void expect_same(const EdgeBits& a, const EdgeBits& b) {
  EXPECT_EQ(a.used, b.used);
  EXPECT_EQ(a.shared, b.shared);
  EXPECT_EQ(a.stay, b.stay);
  EXPECT_EQ(a.inwards, b.inwards);
  EXPECT_EQ(a.either, b.either);
  EXPECT_EQ(a.odd, b.odd);
}

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
    const EdgeBits bits = read_turn_words(edges.data(), nullptr, count, !all_used, words.data());
    for (uint32_t e = 0; e < 64; ++e) {
      const bool used = e < count && edges[e].ends[0] != kNone;
      const uint32_t a = used ? words[edges[e].ends[0]] : 0, b = used ? words[edges[e].ends[1]] : 0;
      const auto both = [&](uint32_t bit) { return (a & bit) != 0 && (b & bit) != 0; };
      ASSERT_EQ(is_set(bits.used, e), used) << i;
      ASSERT_EQ(is_set(bits.shared, e), used && both(TurnWord::kStays) && a >> 4 == b >> 4) << i;
      ASSERT_EQ(is_set(bits.stay, e), used && both(TurnWord::kStays)) << i;
      ASSERT_EQ(is_set(bits.inwards, e), used && both(TurnWord::kInwards)) << i;
      ASSERT_EQ(is_set(bits.either, e), used && ((a | b) & TurnWord::kInwards) != 0) << i;
      ASSERT_EQ(is_set(bits.odd, e), used && !(both(TurnWord::kMoves) && both(TurnWord::kSure))) << i;
      seen[0] += is_set(bits.used, e) ? 1 : 0;
      seen[1] += is_set(bits.shared, e) ? 1 : 0;
      seen[2] += is_set(bits.inwards, e) ? 1 : 0;
      seen[3] += is_set(bits.odd, e) ? 1 : 0;
      seen[4] += is_set(bits.stay, e) ? 1 : 0;
    }
#if DSW_X86_64
    if (DSW_CPU_HAS("avx2")) {
      expect_same(read_turn_words_avx2(edges.data(), nullptr, count, !all_used, words.data()), bits);
    }
#endif
    std::vector<uint32_t> names;
    std::vector<BodyEdge> named;
    for (uint32_t e = 0; e < count; ++e) {
      if (!is_set(bits.used, e) || random() % 3 == 0) continue;
      names.push_back(e);
      named.push_back(edges[e]);
    }
    const auto named_count = static_cast<uint32_t>(names.size());
    const EdgeBits of_named = read_turn_words(named.data(), nullptr, named_count, false, words.data());
    expect_same(read_turn_words(edges.data(), names.data(), named_count, false, words.data()), of_named);
#if DSW_X86_64
    if (DSW_CPU_HAS("avx2")) {
      expect_same(read_turn_words_avx2(edges.data(), names.data(), named_count, false, words.data()), of_named);
    }
#endif
    ASSERT_FALSE(HasFailure()) << i;
  }
  for (const uint64_t times : seen) EXPECT_GT(times, 1000u);
}

/// Cells of all forms, convex or not; vertices that stay, go or do not arrive, and free slots.
TEST(TurnWords, AreThoseOfVertices) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(14)));
  constexpr uint32_t kUnits = 16;
  uint64_t seen[4] = {};
  for (int i = 0; i < at_least(5000); ++i) {
    Map<3> map(nullptr);
    map.words.resize(kUnits * kUnitWords<3>);
    const bool all_convex = random() % 4 == 0;
    for (uint32_t u = 0; u < kUnits; ++u) {
      const uint32_t form = static_cast<uint32_t>(random() % 5) << kFormShift, convex = kConvexBit;
      map.words[u * kUnitWords<3>] = form | (all_convex || random() % 2 == 0 ? convex : 0) | (random() & 7);
    }
    if (random() % 4 == 0) map.convex_bit = 0;
    const auto count = static_cast<uint32_t>(random() % 30);
    std::vector<VertexWay> ways(count);
    std::vector<Course<3>::Vertex> turns(count);
    std::vector<uint32_t> wanted, doubtful;
    bool has_others = false;
    for (uint32_t v = 0; v < count; ++v) {
      const auto cell = [&] { return random() % 8 == 0 ? Cell{} : Cell{static_cast<uint32_t>(random() % kUnits)}; };
      ways[v].from = cell();
      ways[v].arrival = random() % 3 == 0 ? cell() : ways[v].from;
      if (random() % 4 != 0) turns[v].rank = v;
      turns[v].doubtful = random() % 4 == 0;
      turns[v].inwards = random() % 2 == 0;
      turns[v].meets = random() % 2 == 0;
      const bool stays = ways[v].from.valid() && ways[v].from == ways[v].arrival;
      const bool convex = stays && map.convex(ways[v].from);
      has_others = has_others || stays != convex;
      wanted.push_back((convex ? ways[v].from.unit << TurnWord::kBits | TurnWord::kStays : 0) |
                       (turns[v].rank != kNone ? TurnWord::kMoves : 0) | (turns[v].doubtful ? 0 : TurnWord::kSure) |
                       (turns[v].inwards ? TurnWord::kInwards : 0));
      if (turns[v].doubtful) doubtful.push_back(v);
      seen[0] += convex ? 1 : 0;
      seen[1] += stays && !convex ? 1 : 0;
      seen[2] += stays ? 0 : 1;
    }
    seen[3] += has_others ? 0 : 1;
    const auto check = [&](WriteTurnWords write) {
      std::vector<uint32_t> words(count), now(count), in_doubt(count);
      bool others = !has_others;
      in_doubt.resize(write(map, ways.data(), turns.data(), count, words.data(), now.data(), in_doubt.data(), &others));
      EXPECT_EQ(words, wanted);
      EXPECT_EQ(now, wanted);
      EXPECT_EQ(in_doubt, doubtful);
      EXPECT_EQ(others, has_others);
    };
    check(write_turn_words);
#if DSW_X86_64
    if (DSW_CPU_HAS("avx2")) check(write_turn_words_avx2);
#endif
    ASSERT_FALSE(HasFailure()) << i;
  }
  for (const uint64_t times : seen) EXPECT_GT(times, 200u);
}

}  // namespace
