// Memory for hosts of the tests: std::aligned_alloc is not everywhere.
#ifndef DARTSWEEP_TESTS_ALIGNED_MEMORY_H
#define DARTSWEEP_TESTS_ALIGNED_MEMORY_H

#include <cstddef>
#include <new>

inline void* allocate_aligned(std::size_t size, std::size_t alignment) {
  return ::operator new (size, std::align_val_t{alignment}, std::nothrow);
}

inline void release_aligned(void* block, std::size_t alignment) {
  ::operator delete (block, std::align_val_t{alignment}, std::nothrow);
}

#endif
