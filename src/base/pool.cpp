#include "base/pool.h"

#include <algorithm>
#include <cstddef>

namespace dsw {

void* Pool::allocate(void* user, size_t bytes, size_t alignment) {
  Pool& pool = *static_cast<Pool*>(user);
  if (bytes > kLargest) return allocate_bytes(pool.source_, bytes, alignment);
  static_assert(kSmallAlignment <= kStep, "small blocks are not aligned better");
  const size_t steps = steps_of(bytes);
  Free*& first = pool.free_[steps];
  if (first != nullptr) {
    Free* const block = first;
    first = block->next;
    ++pool.in_use_;
    return block;
  }
  const size_t size = steps * kStep;
  if (static_cast<size_t>(pool.end_ - pool.at_) < size) pool.add_chunk(size);
  char* const block = pool.at_;
  pool.at_ += size;
  ++pool.in_use_;
  return block;
}

void Pool::release(void* user, void* block, size_t bytes, size_t alignment) {
  Pool& pool = *static_cast<Pool*>(user);
  if (bytes > kLargest) {
    release_bytes(pool.source_, block, bytes, alignment);
    return;
  }
  Free*& first = pool.free_[steps_of(bytes)];
  first = new (block) Free{first};
  if (--pool.in_use_ == 0) pool.give_back();
}

/** Throws std::bad_alloc. What was left of the chunk before stays unused. */
void Pool::add_chunk(size_t bytes) {
  const size_t wanted = chunks_ == nullptr ? kFirstChunk : std::min(2 * chunks_->bytes, kLastChunk);
  const size_t size = std::max(wanted, sizeof(Chunk) + bytes);
  char* const block = static_cast<char*>(allocate_bytes(source_, size, alignof(Chunk)));
  chunks_ = new (block) Chunk{chunks_, size};
  at_ = block + sizeof(Chunk);
  end_ = block + size;
}

void Pool::give_back() noexcept {
  while (chunks_ != nullptr) {
    Chunk* const chunk = chunks_;
    chunks_ = chunk->next;
    release_bytes(source_, chunk, chunk->bytes, alignof(Chunk));
  }
  at_ = end_ = nullptr;
  std::fill_n(free_, kLargest / kStep + 1, nullptr);
}

}  // namespace dsw
