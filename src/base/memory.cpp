#include "base/memory.h"

namespace dsw {
namespace {

/** Whether plain operator new aligns so, too: the aligned form is slower. */
constexpr bool is_usual(size_t alignment_bytes) { return alignment_bytes <= __STDCPP_DEFAULT_NEW_ALIGNMENT__; }

}  // namespace

void* allocate_bytes(const Memory* memory, size_t size_bytes, size_t alignment_bytes) {
  if (memory == nullptr || memory->allocate == nullptr) {
    return is_usual(alignment_bytes) ? ::operator new(size_bytes)
                                     : ::operator new (size_bytes, std::align_val_t{alignment_bytes});
  }
  void* const block = memory->allocate(memory->user, size_bytes, alignment_bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void release_bytes(const Memory* memory, void* block, size_t size_bytes, size_t alignment_bytes) noexcept {
  if (memory == nullptr || memory->release == nullptr) {
    if (is_usual(alignment_bytes)) {
      ::operator delete(block, size_bytes);
    } else {
      ::operator delete (block, size_bytes, std::align_val_t{alignment_bytes});
    }
  } else {
    memory->release(memory->user, block, size_bytes, alignment_bytes);
  }
}

}  // namespace dsw
