#pragma once
// Which particles are in a cell: lists by a hash of the cell, so that memory follows the particles alone.

#include "base/memory.h"
#include "base/slot_pool.h"
#include "map/map.h"

namespace dsw {

class CellParticles {
 public:
  explicit CellParticles(const Memory* memory) : nodes_(memory), heads_(memory) {}

  /** Room for the slots below `count`: then nothing below can fail. Throws std::bad_alloc and changes nothing. */
  void reserve(size_t count);
  /** Notes the cell of a particle, in place of the one that was noted; none: it is no longer there. */
  void put(uint32_t slot, Cell cell) noexcept {
    if (nodes_[slot].cell == cell) return;
    unlink(slot);
    nodes_[slot].cell = cell;
    link(slot);
  }
  /** Calls visit(slot) for the particles in a cell, in any order. */
  template <class Visit>
  void for_each(Cell cell, Visit visit) const {
    if (nodes_.empty()) return;
    for (uint32_t slot = heads_[place_of(cell)]; slot != kEnd; slot = nodes_[slot].next) {
      if (nodes_[slot].cell == cell) visit(slot);
    }
  }
  uint64_t memory_bytes() const noexcept { return array_bytes(nodes_) + array_bytes(heads_); }

 private:
  static constexpr uint32_t kEnd = 0xffffffffu;

  struct Node {
    Cell cell;
    uint32_t next = kEnd, previous = kEnd;  // of the same list
  };

  size_t place_of(Cell cell) const noexcept {
    const uint64_t mixed = cell.unit * uint64_t{0x9e3779b97f4a7c15u};
    return static_cast<size_t>(mixed >> 32) & (heads_.size() - 1);
  }
  void link(uint32_t slot) noexcept;
  void unlink(uint32_t slot) noexcept;

  Array<Node> nodes_;      // by slot
  Array<uint32_t> heads_;  // a power of two
};

}  // namespace dsw
