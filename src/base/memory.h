#pragma once
// Memory through the host's hooks: an allocator for std::vector that every container of the library uses.

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "dartsweep/context.h"

namespace dsw {

/** Where memory comes from. Lives in the context; a null pointer to it means the C++ runtime. */
struct Memory {
  void* user = nullptr;
  dsw_allocate_fn allocate = nullptr;
  dsw_release_fn release = nullptr;
};

/** Blocks for small objects start at multiples of this. Every type's alignment divides it. */
constexpr size_t kBlockAlignment = alignof(std::max_align_t) > 16 ? alignof(std::max_align_t) : 16;

/** Throws std::bad_alloc when the hook returns null. */
void* allocate_bytes(const Memory* memory, size_t size_bytes, size_t alignment_bytes);
void release_bytes(const Memory* memory, void* block, size_t size_bytes, size_t alignment_bytes) noexcept;

/** Blocks of a page and more start on a cache line, so that records of 32 and 64 bytes never straddle two. */
template <class T>
struct Allocator {
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  const Memory* memory = nullptr;

  Allocator() = default;
  Allocator(const Memory* source) : memory(source) {}
  template <class U>
  Allocator(const Allocator<U>& other) : memory(other.memory) {}

  static constexpr size_t alignment(size_t bytes) { return bytes >= 4096 ? 64 : kBlockAlignment; }
  T* allocate(size_t count) {
    static_assert(alignof(T) <= kBlockAlignment, "small blocks are aligned like this");
    if (count > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
    const size_t bytes = count * sizeof(T);
    return static_cast<T*>(allocate_bytes(memory, bytes, alignment(bytes)));
  }
  void deallocate(T* block, size_t count) noexcept {
    const size_t bytes = count * sizeof(T);
    release_bytes(memory, block, bytes, alignment(bytes));
  }
  template <class U>
  bool operator==(const Allocator<U>& other) const {
    return memory == other.memory;
  }
  template <class U>
  bool operator!=(const Allocator<U>& other) const {
    return memory != other.memory;
  }
};

template <class T>
using Array = std::vector<T, Allocator<T>>;

template <class T>
uint64_t array_bytes(const Array<T>& array) {
  return static_cast<uint64_t>(array.capacity()) * sizeof(T);
}

}  // namespace dsw
