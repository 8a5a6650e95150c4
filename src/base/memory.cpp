#include "base/memory.h"

namespace dsw {

void* allocate_bytes(const Memory* memory, size_t size_bytes, size_t alignment_bytes) {
  if (memory == nullptr || memory->allocate == nullptr) {
    return ::operator new (size_bytes, std::align_val_t{alignment_bytes});
  }
  void* const block = memory->allocate(memory->user, size_bytes, alignment_bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void release_bytes(const Memory* memory, void* block, size_t size_bytes, size_t alignment_bytes) noexcept {
  if (memory == nullptr || memory->release == nullptr) {
    ::operator delete (block, size_bytes, std::align_val_t{alignment_bytes});
  } else {
    memory->release(memory->user, block, size_bytes, alignment_bytes);
  }
}

}  // namespace dsw
