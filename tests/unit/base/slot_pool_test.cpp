#include "base/slot_pool.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "../../aligned_memory.h"

#include "../../effort.h"

namespace {

using dsw::SlotPool;

TEST(SlotPool, GivesOutIndicesInOrderFromGenerationOne) {
  SlotPool pool(nullptr);
  pool.reserve(3);
  for (uint32_t i = 0; i < 3; ++i) {
    const SlotPool::Slot slot = pool.acquire();
    EXPECT_EQ(slot.index, i);
    EXPECT_EQ(slot.generation, 1u);
    EXPECT_TRUE(pool.alive(i, 1));
  }
  EXPECT_EQ(pool.alive_count(), 3u);
  EXPECT_EQ(pool.slot_count(), 3u);
}

TEST(SlotPool, AReusedSlotHasTheNextGeneration) {
  SlotPool pool(nullptr);
  pool.reserve(2);
  pool.acquire();
  pool.acquire();
  pool.release(0);
  pool.release(1);
  EXPECT_FALSE(pool.alive(0, 1));
  pool.reserve(2);
  const SlotPool::Slot last_released = pool.acquire(), first_released = pool.acquire();
  EXPECT_EQ(last_released.index, 1u);
  EXPECT_EQ(first_released.index, 0u);
  EXPECT_EQ(last_released.generation, 2u);
  EXPECT_FALSE(pool.alive(1, 1));
  EXPECT_TRUE(pool.alive(1, 2));
  EXPECT_EQ(pool.generation(1), 2u);
  EXPECT_EQ(pool.slot_count(), 2u);
}

TEST(SlotPool, IdsThatWereNeverGivenOutAreNotAlive) {
  SlotPool pool(nullptr);
  pool.reserve(1);
  pool.acquire();
  EXPECT_FALSE(pool.alive(0, 0));
  EXPECT_FALSE(pool.alive(0, 2));
  EXPECT_FALSE(pool.alive(1, 1));
  EXPECT_FALSE(pool.alive(UINT32_MAX, 1));
  EXPECT_FALSE(pool.alive(0, 0x80000001u));
  pool.release(0);
  EXPECT_FALSE(pool.alive(0, 1));
  EXPECT_FALSE(pool.alive(0, 2));
  EXPECT_FALSE(pool.alive(0, 0x80000001u));  // how a free slot is stored
}

TEST(SlotPool, ASlotWhoseGenerationWouldWrapIsRetired) {
  SlotPool pool(nullptr, 3);
  for (uint32_t generation = 1; generation <= 3; ++generation) {
    pool.reserve(1);
    const SlotPool::Slot slot = pool.acquire();
    EXPECT_EQ(slot.index, 0u);
    EXPECT_EQ(slot.generation, generation);
    pool.release(0);
  }
  pool.reserve(1);
  const SlotPool::Slot fresh = pool.acquire();
  EXPECT_EQ(fresh.index, 1u);
  EXPECT_EQ(fresh.generation, 1u);
  EXPECT_FALSE(pool.alive(0, 3));
  EXPECT_EQ(pool.alive_count(), 1u);
}

struct Host {
  size_t blocks = 0;
  bool refuse = false;
  static void* allocate(void* user, size_t size, size_t alignment) {
    Host& host = *static_cast<Host*>(user);
    if (host.refuse) return nullptr;
    ++host.blocks;
    return allocate_aligned(size, alignment);
  }
  static void release(void* user, void* block, size_t, size_t alignment) {
    --static_cast<Host*>(user)->blocks;
    release_aligned(block, alignment);
  }
};

TEST(SlotPool, AfterReserveNothingAllocates) {
  Host host;
  const dsw::Memory memory{&host, Host::allocate, Host::release};
  {
    SlotPool pool(&memory);
    pool.reserve(100);
    host.refuse = true;
    for (int i = 0; i < 100; ++i) pool.acquire();
    for (uint32_t i = 0; i < 100; ++i) pool.release(i);
    pool.reserve(100);
    for (int i = 0; i < 100; ++i) pool.acquire();
    EXPECT_THROW(pool.reserve(1), std::bad_alloc);
    EXPECT_EQ(pool.alive_count(), 100u);
    EXPECT_TRUE(pool.alive(99, 2));
  }
  EXPECT_EQ(host.blocks, 0u);
}

TEST(SlotPool, AgreesWithAPlainModelOverManyRandomCalls) {
  SlotPool pool(nullptr, 4);
  std::mt19937 random(static_cast<uint32_t>(seed_of(7)));
  std::vector<SlotPool::Slot> alive, dead;
  for (int step = 0; step < at_least(20000); ++step) {
    if (alive.empty() || random() % 2 == 0) {
      pool.reserve(1);
      alive.push_back(pool.acquire());
    } else {
      const size_t at = random() % alive.size();
      pool.release(alive[at].index);
      dead.push_back(alive[at]);
      alive[at] = alive.back();
      alive.pop_back();
    }
    ASSERT_EQ(pool.alive_count(), alive.size());
  }
  for (const SlotPool::Slot slot : alive) EXPECT_TRUE(pool.alive(slot.index, slot.generation));
  for (const SlotPool::Slot slot : dead) EXPECT_FALSE(pool.alive(slot.index, slot.generation));
}

TEST(ReserveMore, GrowsByDoubling) {
  dsw::Array<int> array;
  size_t moves = 0;
  for (int i = 0; i < 1000; ++i) {
    const size_t before = array.capacity();
    dsw::reserve_more(array, 1);
    moves += array.capacity() != before ? 1 : 0;
    array.push_back(i);
  }
  EXPECT_LE(moves, 11u);
  EXPECT_THROW(dsw::reserve_more(array, SIZE_MAX), std::bad_alloc);
}

TEST(SlotPool, ACopyHasRoomForEveryRelease) {
  SlotPool pool(nullptr);
  pool.reserve(100);
  for (int i = 0; i < 100; ++i) pool.acquire();
  SlotPool copy(pool), assigned(nullptr);
  assigned = pool;
  for (SlotPool* each : {&copy, &assigned}) {
    EXPECT_EQ(each->alive_count(), 100u);
    const uint64_t bytes = each->memory_bytes();
    for (uint32_t i = 0; i < 100; ++i) each->release(i);
    EXPECT_EQ(each->memory_bytes(), bytes);
  }
  EXPECT_EQ(pool.alive_count(), 100u);
}

TEST(SlotPool, TellsWhatItWillGiveOutAndRenews) {
  SlotPool pool(nullptr, 2);
  pool.start(3);
  EXPECT_EQ(pool.alive_count(), 3u);
  pool.reserve(3, 2);
  EXPECT_TRUE(pool.can_renew(1));
  pool.renew(1);
  EXPECT_TRUE(pool.alive(1, 2));
  EXPECT_FALSE(pool.alive(1, 1));
  EXPECT_FALSE(pool.can_renew(1));
  pool.release(0);
  pool.release(2);
  const uint32_t wanted[3] = {pool.upcoming(0), pool.upcoming(1), pool.upcoming(2)};
  EXPECT_EQ(wanted[2], 3u);
  for (const uint32_t index : wanted) EXPECT_EQ(pool.acquire().index, index);
}

}  // namespace
