#pragma once
// What one flood knows of the environment's lines, by their two vertices. Emptied by a new stamp; keeps its memory.

#include <utility>

#include "base/memory.h"

namespace dsw {

class LineTable {
 public:
  explicit LineTable(const Memory* memory) : slots_(kFirstSlots, Slot{}, memory) {}

  void clear() {
    used_ = 0;
    if (++stamp_ != 0) return;
    slots_.assign(slots_.size(), Slot{});
    stamp_ = 1;
  }

  /** The value of line a b, computed when it is asked for first. */
  template <class Compute>
  uint32_t value(uint32_t a, uint32_t b, Compute compute) {
    if (b < a) std::swap(a, b);
    size_t slot = slot_of(a, b);
    for (; slots_[slot].stamp == stamp_; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot].a == a && slots_[slot].b == b) return slots_[slot].value;
    }
    const uint32_t value = compute();
    slots_[slot] = {a, b, stamp_, value};
    if (2 * ++used_ > slots_.size()) grow();
    return value;
  }

 private:
  struct Slot {
    uint32_t a = 0, b = 0, stamp = 0, value = 0;
  };
  static constexpr size_t kFirstSlots = 64;

  size_t slot_of(uint32_t a, uint32_t b) const {
    const uint64_t key = (uint64_t{a} * 0x9e3779b97f4a7c15u) ^ (uint64_t{b} * 0xc2b2ae3d27d4eb4fu);
    return (key >> 32) & (slots_.size() - 1);
  }
  void grow() {
    Array<Slot> old(2 * slots_.size(), Slot{}, slots_.get_allocator());
    old.swap(slots_);
    for (const Slot& each : old) {
      if (each.stamp != stamp_) continue;
      size_t slot = slot_of(each.a, each.b);
      while (slots_[slot].stamp == stamp_) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = each;
    }
  }

  Array<Slot> slots_;
  size_t used_ = 0;
  uint32_t stamp_ = 1;  // slots of another stamp are empty
};

}  // namespace dsw
