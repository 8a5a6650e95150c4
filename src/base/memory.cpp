#include "base/memory.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace dsw {
namespace {

constexpr size_t kHugePage = size_t{1} << 21;

/** Large arrays are read here and there: huge pages save most of the address translations that miss. Advice only. */
bool wants_huge_pages(size_t size_bytes) { return size_bytes >= 2 * kHugePage; }

size_t own_alignment(size_t size_bytes, size_t alignment_bytes) {
  return wants_huge_pages(size_bytes) ? kHugePage : alignment_bytes;
}

}  // namespace

void* allocate_bytes(const Memory* memory, size_t size_bytes, size_t alignment_bytes) {
  if (memory == nullptr || memory->allocate == nullptr) {
    void* const own = ::operator new (size_bytes, std::align_val_t{own_alignment(size_bytes, alignment_bytes)});
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (wants_huge_pages(size_bytes)) madvise(own, size_bytes & ~(kHugePage - 1), MADV_HUGEPAGE);
#endif
    return own;
  }
  void* const block = memory->allocate(memory->user, size_bytes, alignment_bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void release_bytes(const Memory* memory, void* block, size_t size_bytes, size_t alignment_bytes) noexcept {
  if (memory == nullptr || memory->release == nullptr) {
    ::operator delete (block, size_bytes, std::align_val_t{own_alignment(size_bytes, alignment_bytes)});
  } else {
    memory->release(memory->user, block, size_bytes, alignment_bytes);
  }
}

}  // namespace dsw
