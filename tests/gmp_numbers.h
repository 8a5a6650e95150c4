// GMP's integers and rationals, in memory of their own. Exact tests make and destroy so many small numbers that malloc took a quarter of their
// time, and most of it under a sanitizer. Here a freed block waits in its thread for the next number of its size. The library that
// is tested has nothing to do with this memory.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace dsw::numbers {

struct Block {
  Block* next;
};

constexpr size_t kUnit = 16, kSizes = 33, kChunk = 1u << 16;  // blocks of 16, 32, ... 512 bytes

struct Pool {
  Block* free[kSizes];  // by size in units
  char *begin, *end;    // of a chunk, what nobody has had
};
inline thread_local Pool t_pool = {};

/// Chunks are kept for as long as the program runs, where a leak checker sees them.
inline void* new_chunk() {
  static std::mutex mutex;
  static Block* all = nullptr;
  auto* const chunk = static_cast<Block*>(std::malloc(kUnit + kChunk));
  if (chunk == nullptr) std::abort();  // GMP knows no other answer
  const std::lock_guard<std::mutex> lock(mutex);
  chunk->next = all;
  all = chunk;
  return reinterpret_cast<char*>(chunk) + kUnit;
}

inline size_t units_of(size_t size) { return size == 0 ? 1 : (size + kUnit - 1) / kUnit; }

inline void* allocate(size_t size) {
  const size_t units = units_of(size);
  if (units >= kSizes) {
    void* const p = std::malloc(size);
    if (p == nullptr) std::abort();
    return p;
  }
  Pool& pool = t_pool;
  if (Block* const block = pool.free[units]) {
    pool.free[units] = block->next;
    return block;
  }
  if (static_cast<size_t>(pool.end - pool.begin) < units * kUnit) {
    pool.begin = static_cast<char*>(new_chunk());
    pool.end = pool.begin + kChunk;
  }
  void* const p = pool.begin;
  pool.begin += units * kUnit;
  return p;
}

inline void release(void* p, size_t size) {
  const size_t units = units_of(size);
  if (units >= kSizes) {
    std::free(p);
    return;
  }
  auto* const block = static_cast<Block*>(p);
  Pool& pool = t_pool;
  block->next = pool.free[units];
  pool.free[units] = block;
}

inline void* resize(void* p, size_t old_size, size_t size) {
  const size_t old_units = units_of(old_size), units = units_of(size);
  if (old_units == units && units < kSizes) return p;
  if (old_units >= kSizes && units >= kSizes) {
    void* const q = std::realloc(p, size);
    if (q == nullptr) std::abort();
    return q;
  }
  void* const q = allocate(size);
  std::memcpy(q, p, old_size < size ? old_size : size);
  release(p, old_size);
  return q;
}

/// Set before the first number is made: a source has this header above its numbers.
inline const bool is_set = (mp_set_memory_functions(allocate, resize, release), true);

}  // namespace dsw::numbers
