#pragma once
// Many small blocks that live for a short time, cut from few large ones of the host. All of these go back when no small
// block is left, so nothing is kept between one use and the next.

#include "base/memory.h"

namespace dsw {

/** A pool of memory that one thread at a time may use. */
class Pool {
 public:
  explicit Pool(const Memory* source) : source_(source), hooks_{this, allocate, release} {}
  ~Pool() { give_back(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /** For arrays: where this memory comes from. */
  const Memory* memory() const { return &hooks_; }

 private:
  struct Free {
    Free* next;
  };
  /** Begins a large block; small ones follow. */
  struct alignas(kBlockAlignment) Chunk {
    Chunk* next;
    size_t bytes;
  };
  static constexpr size_t kStep = 64, kLargest = 4096, kFirstChunk = 16384, kLastChunk = 65536;

  /** A free block has room for what links it. */
  static constexpr size_t steps_of(size_t bytes) { return bytes == 0 ? 1 : (bytes + kStep - 1) / kStep; }
  static void* allocate(void* user, size_t bytes, size_t alignment);
  static void release(void* user, void* block, size_t bytes, size_t alignment);
  void add_chunk(size_t bytes);
  void give_back() noexcept;

  const Memory* source_;
  Memory hooks_;
  Chunk* chunks_ = nullptr;
  char *at_ = nullptr, *end_ = nullptr;  // what is left of the last chunk
  size_t in_use_ = 0;                    // small blocks
  Free* free_[kLargest / kStep + 1] = {};
};

}  // namespace dsw
