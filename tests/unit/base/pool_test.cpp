// Small blocks from few large ones: apart from each other, used again, and all given back.
#include "base/pool.h"

#include <gtest/gtest.h>

#include <cstring>
#include <new>
#include <vector>

namespace dsw {
namespace {

/** A host that counts, and can refuse. */
struct Host {
  size_t blocks = 0, asked = 0, refuse_from = SIZE_MAX;
  Memory memory{this, allocate, release};

  static void* allocate(void* user, size_t bytes, size_t alignment) {
    Host& host = *static_cast<Host*>(user);
    if (host.asked++ >= host.refuse_from) return nullptr;
    ++host.blocks;
    return ::operator new(bytes, std::align_val_t(alignment));
  }
  static void release(void* user, void* block, size_t, size_t alignment) {
    --static_cast<Host*>(user)->blocks;
    ::operator delete(block, std::align_val_t(alignment));
  }
};

TEST(Pool, BlocksAreApartAndGoBackTogether) {
  Host host;
  Pool pool(&host.memory);
  for (int round = 0; round < 2; ++round) {
    std::vector<Array<unsigned char>> arrays;
    for (size_t i = 0; i < 3000; ++i) {
      arrays.emplace_back(1 + i * 7 % 6000, static_cast<unsigned char>(i % 251), pool.memory());
      ASSERT_EQ(reinterpret_cast<uintptr_t>(arrays.back().data()) % kBlockAlignment, 0u);
      if (i % 3 == 0) arrays[i / 2] = Array<unsigned char>(pool.memory());
    }
    for (size_t i = 0; i < arrays.size(); ++i) {
      for (const unsigned char c : arrays[i]) ASSERT_EQ(c, i % 251);
    }
    EXPECT_GT(host.blocks, 0u);
    arrays.clear();
    EXPECT_EQ(host.blocks, 0u);
  }
}

TEST(Pool, WhatIsFreedIsUsedAgain) {
  Host host;
  Pool pool(&host.memory);
  const Array<int> kept(1, 0, pool.memory());
  for (int i = 0; i < 100000; ++i) Array<int>(static_cast<size_t>(1 + i % 50), 0, pool.memory());
  EXPECT_LE(host.asked, 3u);
}

TEST(Pool, GoesOnAfterTheHostHasRefused) {
  Host host;
  host.refuse_from = 1;
  Pool pool(&host.memory);
  {
    std::vector<Array<int>> arrays;
    EXPECT_THROW(for (int i = 0; i < 1000; ++i) arrays.emplace_back(16, i, pool.memory()), std::bad_alloc);
    EXPECT_FALSE(arrays.empty());
    for (size_t i = 0; i < arrays.size(); ++i) EXPECT_EQ(arrays[i][15], static_cast<int>(i));
    host.refuse_from = SIZE_MAX;
    arrays.emplace_back(16, 7, pool.memory());
    EXPECT_EQ(arrays.back()[0], 7);
  }
  EXPECT_EQ(host.blocks, 0u);
}

}  // namespace
}  // namespace dsw
