// Memory of a host, on every system.
#pragma once

#include <cstdlib>
#if defined(_WIN32)
#include <malloc.h>
#endif

namespace dsw {

/// `size` bytes at a multiple of `alignment`, a power of two; free_aligned_block() takes them back.
inline void* aligned_block(size_t size, size_t alignment) {
#if defined(_WIN32)
  return _aligned_malloc(size, alignment);
#else
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
#endif
}
inline void free_aligned_block(void* block) {
#if defined(_WIN32)
  _aligned_free(block);
#else
  std::free(block);
#endif
}

}  // namespace dsw
