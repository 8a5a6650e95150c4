#pragma once
// Sorting in a range. std::sort is seven functions for each kind of element, eight times the code of this one.

#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include "base/compiler.h"

namespace dsw {

/** Gaps of Sedgewick's for Shell's method (1986): of n elements no more than O(n^(4/3)) are compared, whatever their order. */
constexpr std::ptrdiff_t kSortGaps[] = {1,     8,      23,      77,      281,      1073,     4193,      16577,
                                        65921, 262913, 1050113, 4197377, 16783361, 67121153, 268460033, 1073790977};
constexpr std::ptrdiff_t kFewToSort = 16;  // no more are inserted one by one

template <class It, class Less>
DSW_NOINLINE void sort_many(It first, std::ptrdiff_t count, Less less) {
  std::size_t at = 0;
  while (count > kFewToSort && at + 1 < std::size(kSortGaps) && kSortGaps[at + 1] < count) ++at;
  for (;; --at) {
    const std::ptrdiff_t gap = kSortGaps[at];
    for (std::ptrdiff_t i = gap; i < count; ++i) {
      if (!less(first[i], first[i - gap])) continue;
      auto moved = std::move(first[i]);
      std::ptrdiff_t to = i;
      do {
        first[to] = std::move(first[to - gap]);
        to -= gap;
      } while (to >= gap && less(moved, first[to - gap]));
      first[to] = std::move(moved);
    }
    if (at == 0) return;
  }
}

/** Sorts a range. Elements that are neither before nor behind each other must be the same, or their order is not certain. */
template <class It, class Less = std::less<>>
inline void sort(It first, It last, Less less = {}) {
  if (last - first > 1) sort_many(first, last - first, less);
}

}  // namespace dsw
