// An Array does what a vector does, and takes all of its memory from the hooks.
#include "base/memory.h"

#include "base/search.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace {

using namespace dsw;

/** Counts what is asked for, and gives nothing from the `last`-th request on. */
struct Hooks {
  int asked = 0, held = 0, last = 1 << 30;
  Memory memory{this, allocate, release};

  static void* allocate(void* user, size_t bytes, size_t) {
    Hooks& own = *static_cast<Hooks*>(user);
    if (own.asked++ >= own.last) return nullptr;
    ++own.held;
    return std::malloc(bytes);
  }
  static void release(void* user, void* block, size_t, size_t) {
    --static_cast<Hooks*>(user)->held;
    std::free(block);
  }
};

/** Both take the same calls. */
template <class T, class Make>
void take_calls(Make make) {
  Hooks hooks;
  {
    Array<T> array(&hooks.memory);
    std::vector<T> vector;
    const auto same = [&] { return std::vector<T>(array.begin(), array.end()) == vector; };
    for (int i = 0; i < 9; ++i) array.push_back(make(i)), vector.push_back(make(i));
    array.push_back(array[3]), vector.push_back(vector[3]);  // an element of its own, at all sizes
    while (array.size() < array.capacity()) array.emplace_back(make(7)), vector.emplace_back(make(7));
    array.push_back(array.front()), vector.push_back(make(0));
    EXPECT_TRUE(same());
    array.resize(array.size() + 3), vector.resize(vector.size() + 3);
    array.resize(array.size() + 2, make(5)), vector.resize(vector.size() + 2, make(5));
    array.insert(array.begin() + 4, make(11)), vector.insert(vector.begin() + 4, make(11));
    array.insert(array.begin() + 1, 3, make(12)), vector.insert(vector.begin() + 1, 3, make(12));
    const std::vector<T> more = {make(20), make(21), make(22)};
    array.insert(array.begin() + 2, more.begin(), more.end()),
        vector.insert(vector.begin() + 2, more.begin(), more.end());
    array.insert(array.end(), {make(30), make(31)}), vector.insert(vector.end(), {make(30), make(31)});
    EXPECT_TRUE(same());
    EXPECT_EQ(array.erase(array.begin() + 2) - array.begin(), 2);
    EXPECT_EQ(array.erase(array.begin() + 3, array.begin() + 6) - array.begin(), 3);
    vector.erase(vector.begin() + 2), vector.erase(vector.begin() + 3, vector.begin() + 6);
    EXPECT_TRUE(same());
    Array<T> other(array), third(more.begin(), more.end(), &hooks.memory);
    EXPECT_TRUE(other == array && other.get_allocator() == array.get_allocator());
    other = third;  // fewer
    EXPECT_TRUE(other == third && other != array);
    third = array;  // more
    EXPECT_TRUE(third == array);
    third.assign(third.begin() + 1, third.begin() + 4), vector.assign(array.begin() + 1, array.begin() + 4);
    EXPECT_TRUE(std::vector<T>(third.begin(), third.end()) == vector);
    third.assign(2, third[1]), vector.assign(2, make(1000)), vector.assign(2, array[2]);
    EXPECT_TRUE(std::vector<T>(third.begin(), third.end()) == vector);
    other = std::move(array);
    EXPECT_TRUE(array.empty() && array.capacity() == 0);
    swap(other, array);
    array.shrink_to_fit();
    EXPECT_EQ(array.capacity(), array.size());
    array.clear();
    array.shrink_to_fit();
    EXPECT_EQ(array.data(), nullptr);
    EXPECT_GT(hooks.held, 0);
  }
  EXPECT_EQ(hooks.held, 0);
}

TEST(Array, DoesWhatAVectorDoes) {
  take_calls<uint8_t>([](int i) { return static_cast<uint8_t>(i); });
  take_calls<double>([](int i) { return i + 0.5; });
  take_calls<std::vector<int>>([](int i) { return std::vector<int>(static_cast<size_t>(i % 5), i); });
}

TEST(Array, GrowsByItsSize) {
  Array<int> array;
  size_t room = 0, moves = 0;
  for (int i = 0; i < 1000; ++i) {
    array.push_back(i);
    if (array.capacity() != room) ++moves, room = array.capacity();
  }
  EXPECT_EQ(moves, 11u);
  EXPECT_EQ(room, 1024u);
  array.reserve(5000);
  EXPECT_EQ(array.capacity(), 5000u);
}

template <class T>
void run_out(const T& value) {
  Hooks hooks;
  Array<T> array(4, value, &hooks.memory);
  const Array<T> before(array);
  hooks.last = hooks.asked;
  EXPECT_THROW(array.push_back(value), std::bad_alloc);
  EXPECT_THROW(array.resize(10), std::bad_alloc);
  EXPECT_THROW(array.assign(10, value), std::bad_alloc);
  EXPECT_THROW(array.insert(array.begin(), value), std::bad_alloc);
  EXPECT_THROW(array.reserve(SIZE_MAX / sizeof(T) + 2), std::bad_alloc);
  EXPECT_THROW(array.resize(SIZE_MAX), std::bad_alloc);
  EXPECT_TRUE(array == before);
}

TEST(Array, StaysAsItWasWhereMemoryRunsOut) {
  run_out(1.5);
  run_out(std::vector<int>{1, 2});
}

TEST(Search, FindsWhatTheStandardLibraryFinds) {
  const int numbers[] = {3, 1, 4, 1, 5};
  const auto end = numbers + 5;
  EXPECT_EQ(dsw::find(numbers, end, 1) - numbers, 1);
  EXPECT_EQ(dsw::find(numbers, end, 9), end);
  EXPECT_EQ(dsw::find_if(numbers, end, [](int n) { return n > 3; }) - numbers, 2);
  EXPECT_TRUE(dsw::any_of(numbers, end, [](int n) { return n == 5; }));
  EXPECT_FALSE(dsw::any_of(numbers, numbers, [](int) { return true; }));
  EXPECT_TRUE(dsw::all_of(numbers, end, [](int n) { return n > 0; }));
  EXPECT_FALSE(dsw::all_of(numbers, end, [](int n) { return n > 1; }));
  EXPECT_TRUE(dsw::none_of(numbers, end, [](int n) { return n > 5; }));
}

TEST(Array, KeepsWhatItHadWhereMemoryRunsOut) {
  for (int last = 0; last < 6; ++last) {
    Hooks hooks;
    Array<Array<int>> array(&hooks.memory);
    array.resize(2, Array<int>(3, 7, &hooks.memory));
    hooks.last = hooks.asked + last;
    EXPECT_THROW(array.resize(9, Array<int>(array[0])), std::bad_alloc);
    hooks.last = 1 << 30;
    ASSERT_EQ(array.size(), 2u);
    EXPECT_EQ(array[1], array[0]);
    EXPECT_EQ(array[1].size(), 3u);
  }
}

}  // namespace
