#include "base/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "../../effort.h"
#include "base/function_ref.h"

namespace {

struct Pair {
  uint32_t key;
  double value;
  bool operator==(const Pair& o) const { return key == o.key && value == o.value; }
};

TEST(SortTest, SortsWhatTheStandardSortsInAnyOrder) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(1)));
  int few = 0, many = 0;
  for (int n = 0; n < effort_of(600); ++n) {
    const size_t count = n < 40 ? static_cast<size_t>(n) : random() % 3000;
    const auto values = static_cast<uint32_t>(1 + random() % (n % 3 == 0 ? 5 : 100000));
    std::vector<uint32_t> given(count);
    for (uint32_t& x : given) x = static_cast<uint32_t>(random() % values);
    if (n % 4 == 1) std::sort(given.begin(), given.end());
    if (n % 4 == 2) std::sort(given.begin(), given.end(), std::greater<>());
    std::vector<uint32_t> expected = given, up = given, down = given;
    std::sort(expected.begin(), expected.end());
    dsw::sort(up.begin(), up.end());
    EXPECT_EQ(up, expected);
    std::reverse(expected.begin(), expected.end());
    dsw::sort(down.data(), down.data() + count, [](uint32_t a, uint32_t b) { return a > b; });
    EXPECT_EQ(down, expected);
    ++(count <= 16 ? few : many);
  }
  EXPECT_GT(few, 0);
  EXPECT_GT(many, 0);
}

TEST(SortTest, KeepsRecordsWhole) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(2)));
  std::vector<Pair> given;
  for (uint32_t i = 0; i < 5000; ++i) given.push_back({i, 0.5 * i});
  std::vector<Pair> sorted = given;
  std::shuffle(sorted.begin(), sorted.end(), random);
  EXPECT_FALSE(sorted == given);
  dsw::sort(sorted.begin(), sorted.end(), [](const Pair& a, const Pair& b) { return a.key < b.key; });
  EXPECT_TRUE(sorted == given);
}

TEST(SortTest, KeepsTheOrderOfUpToSixteenThatAreEqual) {
  std::vector<Pair> all;
  for (uint32_t i = 0; i < 16; ++i) all.push_back({i % 3, 1.0 * i});
  std::vector<Pair> expected = all;
  const auto before = [](const Pair& a, const Pair& b) { return a.key < b.key; };
  std::stable_sort(expected.begin(), expected.end(), before);
  dsw::sort(all.begin(), all.end(), before);
  EXPECT_TRUE(all == expected);
}

TEST(SortTest, ComparesNoMoreThanItsBound) {
  constexpr size_t kCount = 100000;
  std::vector<uint32_t> numbers(kCount);
  std::mt19937 random(static_cast<uint32_t>(seed_of(3)));
  for (const int order : {0, 1, 2, 3}) {  // random, down, a saw, all equal
    for (uint32_t i = 0; i < kCount; ++i) {
      numbers[i] = order == 0 ? static_cast<uint32_t>(random()) : order == 1 ? kCount - i : order == 2 ? i % 317 : 7;
    }
    uint64_t compared = 0;
    dsw::sort(numbers.begin(), numbers.end(), [&](uint32_t a, uint32_t b) {
      ++compared;
      return a < b;
    });
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    EXPECT_LT(compared, 40 * kCount);  // n^(4/3) is 46 n
  }
}

TEST(FunctionRefTest, CallsWhatItRefersTo) {
  int sum = 0;
  const auto add = [&](const int& x, int times) {
    sum += x * times;
    return sum > 10;
  };
  const dsw::FunctionRef<bool(const int&, int)> ref = add;
  const dsw::FunctionRef<bool(const int&, int)> copy = ref;
  EXPECT_FALSE(ref(2, 3));
  EXPECT_TRUE(copy(3, 2));
  EXPECT_EQ(sum, 12);
}

}  // namespace
