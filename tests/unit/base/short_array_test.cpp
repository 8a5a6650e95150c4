// Few numbers in place: what a vector would hold, however it is moved, copied and cut, and whenever it grows beyond.
#include "base/short_array.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dsw {
namespace {

using Short = ShortArray<uint32_t, 4>;

void expect_same(const Short& array, const std::vector<uint32_t>& expected) {
  ASSERT_EQ(array.size(), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), array.begin()));
  EXPECT_EQ(array.empty(), expected.empty());
}

TEST(ShortArray, HoldsWhatAVectorHolds) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(3)));
  const Memory* const memory = nullptr;
  Short array(memory), other(memory);
  std::vector<uint32_t> expected, of_other;
  for (int i = 0; i < at_least(20000); ++i) {
    const auto value = static_cast<uint32_t>(random() % 9);
    const size_t at = expected.empty() ? 0 : random() % (expected.size() + 1);
    switch (random() % 12) {
      case 0:
      case 1:
      case 2:
        array.push_back(value);
        expected.push_back(value);
        break;
      case 3:
        array.insert(array.begin() + at, value);
        expected.insert(expected.begin() + static_cast<ptrdiff_t>(at), value);
        break;
      case 4:
        if (at == expected.size()) break;
        array.erase(array.begin() + at);
        expected.erase(expected.begin() + static_cast<ptrdiff_t>(at));
        break;
      case 5:
        array.erase(array.begin() + at, array.end());
        expected.resize(at);
        break;
      case 6:
        array.resize(value);
        expected.resize(value, 0);
        break;
      case 7:
        std::swap(array, other);
        std::swap(expected, of_other);
        break;
      case 8:
        other = array;
        of_other = expected;
        break;
      case 9:
        other = std::move(array);
        of_other = expected;
        expected.clear();
        array.clear();
        break;
      case 10:
        array.append(other.begin(), other.end());
        expected.insert(expected.end(), of_other.begin(), of_other.end());
        if (expected.size() > 40) array.clear(), expected.clear();
        break;
      default:
        array.assign({value, 1, value});
        expected = {value, 1, value};
    }
    expect_same(array, expected);
    expect_same(Short(other), of_other);
    EXPECT_EQ(array == other, expected == of_other);
    EXPECT_EQ(array < other, expected < of_other);
  }
}

TEST(ShortArray, TakesMemoryOnlyBeyondItsPlace) {
  struct Host {
    size_t blocks = 0, asked = 0;
    Memory memory{this, allocate, release};
    static void* allocate(void* user, size_t bytes, size_t) {
      ++static_cast<Host*>(user)->blocks;
      ++static_cast<Host*>(user)->asked;
      return ::operator new(bytes);
    }
    static void release(void* user, void* block, size_t, size_t) {
      --static_cast<Host*>(user)->blocks;
      ::operator delete(block);
    }
  } host;
  {
    Short array(&host.memory);
    for (uint32_t i = 0; i < 4; ++i) array.push_back(i);
    const Short copy = array;
    EXPECT_EQ(host.asked, 0u);
    array.push_back(4);
    EXPECT_EQ(host.blocks, 1u);
    Short moved = std::move(array);
    EXPECT_EQ(host.asked, 1u);
    EXPECT_EQ(moved[4], 4u);
    EXPECT_TRUE(array.empty());  // NOLINT(bugprone-use-after-move): it holds nothing
    array.push_back(7);
    EXPECT_EQ(array[0], 7u);
  }
  EXPECT_EQ(host.blocks, 0u);
}

}  // namespace
}  // namespace dsw
