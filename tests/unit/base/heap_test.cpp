// A heap of our own: sorted, and its ties come in one order.
#include "base/heap.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace dsw {
namespace {

struct Ranked {
  uint32_t rank, name;
  bool operator<(const Ranked& o) const { return rank < o.rank; }
};

TEST(Heap, LargestComeFirst) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(7)));
  Heap<uint32_t> heap(nullptr);
  std::vector<uint32_t> sorted;
  for (int i = 0; i < at_least(5000); ++i) {
    if (random() % 3 != 0 || heap.empty()) {
      const auto x = static_cast<uint32_t>(random() % 100);
      heap.push(x);
      sorted.insert(std::upper_bound(sorted.begin(), sorted.end(), x), x);
    } else {
      ASSERT_EQ(heap.pop(), sorted.back());
      sorted.pop_back();
    }
    ASSERT_EQ(heap.empty(), sorted.empty());
  }
  heap.clear();
  EXPECT_TRUE(heap.empty());
}

/** Written down, so that each platform has to agree. */
TEST(Heap, TiesHaveOneOrder) {
  Heap<Ranked> heap(nullptr);
  for (uint32_t i = 0; i < 12; ++i) heap.push({i % 2, i});
  std::vector<uint32_t> names;
  while (!heap.empty()) names.push_back(heap.pop().name);
  EXPECT_EQ(names, (std::vector<uint32_t>{1, 5, 11, 3, 9, 7, 6, 2, 10, 8, 4, 0}));
}

#if defined(__GLIBCXX__)

/** Results of releases before this heap came from that library's, and recordings keep some. */
TEST(Heap, TiesComeAsTheyDidFromTheStandardLibrary) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(8)));
  Heap<Ranked> heap(nullptr);
  std::vector<Ranked> other;
  for (uint32_t i = 0; i < 20000; ++i) {
    if (random() % 5 < (i < 10000 ? 3 : 2) || heap.empty()) {
      const Ranked x{static_cast<uint32_t>(random() % 8), i};
      heap.push(x);
      other.push_back(x);
      std::push_heap(other.begin(), other.end());
    } else {
      std::pop_heap(other.begin(), other.end());
      ASSERT_EQ(heap.pop().name, other.back().name);
      other.pop_back();
    }
  }
}

#endif

}  // namespace
}  // namespace dsw
