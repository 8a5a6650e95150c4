#pragma once
// What changes of the topology did to half-facets, so that a body forgets the corridors that name them when it is used
// next, instead of all bodies at each change.

#include "base/key_table.h"
#include "corridor/corridor.h"
#include "topology/edit.h"

namespace dsw {

template <int D>
class GoneFacets {
 public:
  explicit GoneFacets(const Memory* memory) : words_(memory), last_(memory) {}

  /** Room for the half-facets of an edit that is prepared. Throws std::bad_alloc. */
  void reserve(const Edit<D>& edit);
  /** Notes those that go or lead elsewhere. There is room; before it is finished. */
  void note(const Edit<D>& edit) noexcept;
  /** Whether notes should be dropped before more are made: they are many. All bodies have to be up to date then. */
  bool is_full() const noexcept;
  void clear() noexcept;

  /** Grows with each note. */
  uint64_t number() const noexcept { return number_; }
  /** Whether a corridor that was up to date when the number was `since` names what has changed. O(facets). */
  bool are_in(const Corridor<D>& corridor, uint64_t since) const noexcept;
  uint64_t memory_bytes() const noexcept { return words_.memory_bytes() + array_bytes(last_); }

 private:
  KeyTable words_;
  Array<uint64_t> last_;  // by word's number in the table: when it was noted last
  uint64_t number_ = 0;
};

}  // namespace dsw
