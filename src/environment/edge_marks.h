#pragma once
// The set of marked edges, by their two vertices, so that a mark does not depend on which cell names the edge.

#include <cstdint>

#include "base/memory.h"

namespace dsw {

/** Open addressing with linear probing; iteration order never reaches a result. */
class EdgeMarks {
 public:
  explicit EdgeMarks(const Memory* memory) : slots_(memory) {}

  bool contains(uint32_t a, uint32_t b) const noexcept;
  /** Makes room for `more` further edges, so that as many inserts cannot fail. */
  void reserve(size_t more);
  bool insert(uint32_t a, uint32_t b);          // whether it is new
  bool erase(uint32_t a, uint32_t b) noexcept;  // whether it was there
  size_t size() const noexcept { return size_; }
  uint64_t memory_bytes() const noexcept { return array_bytes(slots_); }
  /** The keys, sorted: lower vertex in the high half. */
  void copy_sorted(Array<uint64_t>& out) const;

 private:
  size_t find(uint64_t key) const noexcept;
  void rehash(size_t slot_count);

  Array<uint64_t> slots_;  // kEmpty or a key; size is 0 or a power of two
  size_t size_ = 0;
};

}  // namespace dsw
