// An array does what a vector does: values, room, what it asks of the host's memory, and what is left when memory runs out.
#include "base/array.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace dsw {
namespace {

/** A host that counts what it gives, and refuses from a given number of bytes on. */
struct CountingHost {
  size_t held = 0, most = SIZE_MAX;
  int asked = 0;
  Memory memory{this, allocate, release};

  static void* allocate(void* user, size_t size_bytes, size_t) {
    auto& host = *static_cast<CountingHost*>(user);
    ++host.asked;
    if (host.held + size_bytes > host.most) return nullptr;
    host.held += size_bytes;
    return ::operator new(size_bytes);
  }
  static void release(void* user, void* block, size_t size_bytes, size_t) {
    static_cast<CountingHost*>(user)->held -= size_bytes;
    ::operator delete(block);
  }
};

struct AsNumber {
  static uint32_t of(uint32_t value) { return value; }
};
/** Longer than what a string holds in place. */
struct AsString {
  static std::string of(uint32_t value) { return std::string(24, static_cast<char>('a' + value)); }
};

template <class T>
using Vector = std::vector<T, Allocator<T>>;

/** Two arrays and the vectors that they are compared with, and what both ask of their hosts. */
template <class Values>
class Pair {
  using T = decltype(Values::of(0));

 public:
  void change(std::mt19937& random) {
    const T value = Values::of(static_cast<uint32_t>(random() % 9));
    const size_t size = expected_.size(), at = random() % (size + 1), count = random() % 12;
    const auto there = static_cast<ptrdiff_t>(at);
    switch (random() % 16) {
      case 0:
      case 1:
      case 2:
        return both([&](auto& a) { a.push_back(value); });
      case 3:
        return both([&](auto& a) {
          if (!a.empty()) a.push_back(a[at % size]);
        });
      case 4:
        return both([&](auto& a) { a.insert(a.begin() + there, value); });
      case 5:
        return both([&](auto& a) { a.insert(a.begin() + there, count, value); });
      case 6:
        return both([&](auto& a) {
          if (at < size) a.erase(a.begin() + there);
        });
      case 7:
        return both([&](auto& a) { a.erase(a.begin() + there, a.end()); });
      case 8:
        return both([&](auto& a) { a.resize(count); });
      case 9:
        return both([&](auto& a) { a.assign(count, value); });
      case 10:
        other_ = array_;
        other_expected_ = expected_;
        return;
      case 11:
        array_.insert(array_.begin() + there, other_.begin(), other_.end());
        expected_.insert(expected_.begin() + there, other_expected_.begin(), other_expected_.end());
        return;
      case 12:
        std::swap(array_, other_);
        std::swap(expected_, other_expected_);
        return;
      case 13:
        return both([&](auto& a) { a.reserve(3 * count); });
      case 14:
        return both([&](auto& a) { a.shrink_to_fit(); });
      default:
        return both([&](auto& a) {
          if (!a.empty()) a.pop_back();
        });
    }
  }
  void expect_same() const {
    ASSERT_EQ(array_.size(), expected_.size());
    EXPECT_TRUE(std::equal(expected_.begin(), expected_.end(), array_.begin()));
    EXPECT_EQ(array_.capacity(), expected_.capacity());
    EXPECT_EQ(array_ == other_, expected_ == other_expected_);
    EXPECT_EQ(array_ < other_, expected_ < other_expected_);
    EXPECT_EQ(host_.held, host_of_vectors_.held);
  }

 private:
  template <class Change>
  void both(const Change& change) {
    change(array_);
    change(expected_);
  }

  CountingHost host_, host_of_vectors_;
  Array<T> array_{Allocator<T>(&host_.memory)}, other_{Allocator<T>(&host_.memory)};
  Vector<T> expected_{Allocator<T>(&host_of_vectors_.memory)}, other_expected_{Allocator<T>(&host_of_vectors_.memory)};
};

template <class Values>
class ArrayTest : public testing::Test {};
using Kinds = testing::Types<AsNumber, AsString>;
TYPED_TEST_SUITE(ArrayTest, Kinds);

TYPED_TEST(ArrayTest, HoldsWhatAVectorHoldsInTheSameRoom) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    Pair<TypeParam> pair;
    for (int i = 0; i < 300 && !this->HasFailure(); ++i) {
      pair.change(random);
      pair.expect_same();
    }
  }
}

TYPED_TEST(ArrayTest, IsAsBeforeWhenMemoryRunsOut) {
  CountingHost host;
  using T = decltype(TypeParam::of(0));
  {
    Array<T> array{Allocator<T>(&host.memory)};
    for (uint32_t i = 0; i < 4; ++i) array.push_back(TypeParam::of(i));
    const size_t held = host.most = host.held;
    EXPECT_THROW(array.push_back(TypeParam::of(4)), std::bad_alloc);
    EXPECT_THROW(array.resize(9), std::bad_alloc);
    EXPECT_THROW(array.reserve(9), std::bad_alloc);
    EXPECT_THROW(array.assign(9, TypeParam::of(4)), std::bad_alloc);
    EXPECT_THROW(Array<T>(array).size(), std::bad_alloc);
    EXPECT_EQ(host.held, held);
    ASSERT_EQ(array.size(), 4u);
    for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(array[i], TypeParam::of(i));
  }
  EXPECT_EQ(host.held, 0u);
}

TEST(Array, RefusesMoreThanCanBeAddressed) {
  Array<uint64_t> array(3, 7);
  EXPECT_THROW(array.reserve(SIZE_MAX / 8), std::length_error);
  EXPECT_THROW(array.insert(array.end(), SIZE_MAX / 8, 7), std::length_error);
  EXPECT_EQ(array, Array<uint64_t>({7, 7, 7}));
}

TEST(Array, AssignedArraysKeepTheirRoom) {
  CountingHost host;
  using Inner = Array<uint32_t>;
  const Inner five(5, 1u, &host.memory);
  Array<Inner> array(2, five, &host.memory);
  const Array<Inner> other(2, Inner(4, 2u, &host.memory), &host.memory);
  const int asked = host.asked;
  array = other;
  EXPECT_EQ(array, other);
  EXPECT_EQ(host.asked, asked);
}

}  // namespace
}  // namespace dsw
