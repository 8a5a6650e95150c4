#pragma once
// A heap whose elements of equal rank leave in the same order on every platform: standard libraries are free to differ.

#include <cstddef>

#include "base/memory.h"

namespace dsw {

/** The largest is first; none follows one that is smaller than itself, its children being 2 i + 1 and 2 i + 2. */
template <class T>
class Heap {
 public:
  explicit Heap(const Memory* memory) : elements_(memory) {}

  bool empty() const noexcept { return elements_.empty(); }
  void clear() noexcept { elements_.clear(); }
  /** Throws std::bad_alloc. */
  void push(const T& element) {
    elements_.push_back(element);
    rise(elements_.size() - 1, element);
  }
  /** Takes the largest out. Not of an empty one. */
  T pop() noexcept {
    const T largest = elements_.front(), last = elements_.back();
    elements_.pop_back();
    if (elements_.empty()) return largest;
    // A gap sinks to the bottom, along the larger children and to the right between equal ones.
    const size_t count = elements_.size();
    size_t gap = 0;
    for (size_t child = 2; child - 1 < count; child = 2 * gap + 2) {
      if (child == count || elements_[child] < elements_[child - 1]) --child;
      elements_[gap] = elements_[child];
      gap = child;
    }
    rise(gap, last);
    return largest;
  }

 private:
  /** Puts an element into a gap, or above. */
  void rise(size_t gap, const T element) noexcept {
    while (gap != 0 && elements_[(gap - 1) / 2] < element) {
      elements_[gap] = elements_[(gap - 1) / 2];
      gap = (gap - 1) / 2;
    }
    elements_[gap] = element;
  }

  Array<T> elements_;
};

}  // namespace dsw
