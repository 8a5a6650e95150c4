#pragma once
// 64-bit keys, each once, numbered in the order of discovery, so that no result depends on a hash.

#include <algorithm>

#include "base/memory.h"
#include "base/slot_pool.h"

namespace dsw {

class KeyTable {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  explicit KeyTable(const Memory* memory) : keys_(memory), slots_(kFirstSlots, kNone, memory) {}

  uint32_t size() const { return static_cast<uint32_t>(keys_.size()); }
  uint64_t operator[](uint32_t i) const { return keys_[i]; }

  /** The number of a key, or kNone. */
  uint32_t find(uint64_t key) const noexcept { return slots_[slot_of(key)]; }

  /** Room for more keys: then inserting them cannot fail. Throws std::bad_alloc. */
  void reserve(size_t more) {
    reserve_more(keys_, more);
    while (2 * (keys_.size() + more) >= slots_.size()) grow();
  }
  /** The number of a key, which is new if it was size() before. Throws std::bad_alloc. */
  uint32_t insert(uint64_t key) {
    const size_t slot = slot_of(key);
    if (slots_[slot] != kNone) return slots_[slot];
    keys_.push_back(key);
    slots_[slot] = size() - 1;
    if (2 * keys_.size() >= slots_.size()) grow();
    return size() - 1;
  }

  void clear() noexcept {
    keys_.clear();
    std::fill(slots_.begin(), slots_.end(), kNone);
  }
  uint64_t memory_bytes() const noexcept { return array_bytes(keys_) + array_bytes(slots_); }

 private:
  static constexpr size_t kFirstSlots = 64;

  size_t slot_of(uint64_t key) const noexcept {
    const uint64_t mixed = (key ^ (key >> 29)) * 0x9e3779b97f4a7c15u;
    size_t slot = (mixed >> 32) & (slots_.size() - 1);
    while (slots_[slot] != kNone && keys_[slots_[slot]] != key) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kNone);
    for (uint32_t i = 0; i < size(); ++i) slots_[slot_of(keys_[i])] = i;
  }

  Array<uint64_t> keys_;
  Array<uint32_t> slots_;  // numbers of keys by hash, linear probing
};

/** Packs two numbers into one key; the order of a and b does not matter. */
inline uint64_t pair_key(uint32_t a, uint32_t b) { return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a; }

}  // namespace dsw
