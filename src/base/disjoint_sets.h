#pragma once
// Numbers that are joined to sets.

#include "base/memory.h"

namespace dsw {

/** The numbers 0 .. count-1, at first each a set of its own. Union by the lower number with path halving. */
class DisjointSets {
 public:
  DisjointSets(uint32_t count, const Memory* memory) : parents_(count, 0, memory) {
    for (uint32_t i = 0; i < count; ++i) parents_[i] = i;
  }
  /** The lowest number in the set of i. */
  uint32_t root(uint32_t i) noexcept {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  /** Returns whether i and j were in different sets. */
  bool join(uint32_t i, uint32_t j) noexcept {
    const uint32_t a = root(i), b = root(j);
    parents_[a < b ? b : a] = a < b ? a : b;
    return a != b;
  }

 private:
  Array<uint32_t> parents_;
};

}  // namespace dsw
