#pragma once
// One object in the host's memory, if it is needed.

#include <utility>

#include "base/memory.h"

namespace dsw {

template <class T>
class Owned {
 public:
  explicit Owned(const Memory* memory) : memory_(memory) {}
  ~Owned() {
    if (object_ != nullptr) destroy();
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;

  /** Where there is none yet. */
  template <class... Arguments>
  DSW_COLD void make(Arguments&&... arguments) {
    void* const block = allocate_bytes(memory_, sizeof(T), alignof(T));
    try {
      object_ = new (block) T(std::forward<Arguments>(arguments)...);
    } catch (...) {
      release_bytes(memory_, block, sizeof(T), alignof(T));
      throw;
    }
  }
  T* get() const { return object_; }
  /** The caller owns it, and its memory, from now on. */
  T* release() noexcept { return std::exchange(object_, nullptr); }

 private:
  DSW_COLD void destroy() noexcept {
    object_->~T();
    release_bytes(memory_, object_, sizeof(T), alignof(T));
  }

  const Memory* memory_;
  T* object_ = nullptr;
};

}  // namespace dsw
