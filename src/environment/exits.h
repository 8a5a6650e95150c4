#pragma once
// Exits: faces of the outer boundary through which particles and vertices of bodies leave. An exit changes nothing about
// what is passable.

#include <cstdint>

#include "base/memory.h"
#include "base/slot_pool.h"

namespace dsw {

/** A facet of a cell, by the cell's index, with the number of its patch. */
struct Exit {
  uint32_t cell, local;
  uint32_t patch;  // not 0

  bool operator<(const Exit& other) const noexcept {
    return cell != other.cell ? cell < other.cell : local < other.local;
  }
};

/** All exits of an environment, sorted by their facets. */
class Exits {
 public:
  explicit Exits(const Memory* memory) : all_(memory) {}

  bool empty() const noexcept { return all_.empty(); }
  const Array<Exit>& all() const noexcept { return all_; }
  /** The patch of a facet; 0: it is no exit. O(log exits). */
  uint32_t patch(uint32_t cell, uint32_t local) const noexcept;
  /** Whether a facet of the cell is an exit. */
  bool has_cell(uint32_t cell) const noexcept;
  /** Makes room for `more` further exits: adding as many then does not fail. */
  void reserve(size_t more) { reserve_more(all_, more); }
  /** Adds exits, or gives them other patches; `patch` 0 takes them away. */
  void set(const Exit* exits, size_t count) noexcept;
  /** Takes away the exits for which is_gone(exit) holds. */
  template <class IsGone>
  void remove_if(const IsGone& is_gone) noexcept {
    size_t kept = 0;
    for (const Exit exit : all_) {
      if (!is_gone(exit)) all_[kept++] = exit;
    }
    all_.erase(all_.begin() + static_cast<ptrdiff_t>(kept), all_.end());
  }
  /** Takes what a snapshot has. False, and nothing has changed: the exits are not sorted, or one has no patch. */
  bool restore(Array<Exit>&& exits) noexcept;
  uint64_t memory_bytes() const noexcept { return array_bytes(all_); }

 private:
  size_t find(uint32_t cell, uint32_t local) const noexcept;

  Array<Exit> all_;
};

}  // namespace dsw
