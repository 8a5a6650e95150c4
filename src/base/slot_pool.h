#pragma once
// Generational slots: an index that is given out again gets a higher generation, so that an old id is recognised. The
// order in which slots are reused (last released first) depends on the calls alone.

#include <algorithm>
#include <cstdint>
#include <new>
#include <utility>

#include "base/assert.h"
#include "base/memory.h"

namespace dsw {

/** Makes room for `more` elements, growing by doubling so that single appends stay cheap. */
template <class T>
void reserve_more(Array<T>& array, size_t more) {
  if (more > array.max_size() - array.size()) throw std::bad_alloc();
  const size_t wanted = array.size() + more;
  if (wanted > array.capacity()) array.reserve(std::max(wanted, 2 * array.capacity()));
}

class SlotPool {
 public:
  struct Slot {
    uint32_t index, generation;
  };
  static constexpr uint32_t kLastGeneration = 0x7fffffffu;

  /** Slots are retired after `last_generation`; a lower one is for tests. */
  explicit SlotPool(const Memory* memory, uint32_t last_generation = kLastGeneration)
      : words_(memory), free_(memory), last_(last_generation) {}

  /** A copy has room for what its original has room for: releases cannot fail either. Throws std::bad_alloc. */
  SlotPool(const SlotPool& other) : words_(other.words_), free_(other.free_), last_(other.last_), alive_(other.alive_) {
    words_.reserve(other.words_.capacity());
    free_.reserve(other.free_.capacity());
  }
  SlotPool(SlotPool&&) noexcept = default;
  SlotPool& operator=(const SlotPool& other) { return *this = SlotPool(other); }
  SlotPool& operator=(SlotPool&&) = default;
  ~SlotPool() = default;

  /** Takes the slots 0 .. count - 1 of an empty pool. */
  void start(size_t count) {
    words_.assign(count, 1);
    alive_ = count;
  }
  /** Makes room, so that `more` calls of acquire, and every release, cannot fail. */
  void reserve(size_t more) {
    const size_t fresh = more > free_.size() ? more - free_.size() : 0;
    reserve(more, words_.size() + fresh - free_.size());
  }
  /** Makes room for `more` calls of acquire and for `releases` releases, so that none of them can fail. */
  void reserve(size_t more, size_t releases) {
    const size_t fresh = more > free_.size() ? more - free_.size() : 0;
    if (fresh > UINT32_MAX - words_.size()) throw std::bad_alloc();
    reserve_more(words_, fresh);
    reserve_more(free_, releases);
  }
  /** Gives back room that is not used. Before the next release, room must be made again. Throws std::bad_alloc. */
  void shrink_to_fit() {
    words_.shrink_to_fit();
    free_.shrink_to_fit();
  }
  /** Index that the call number `k` of acquire from now on will give, if nothing is released before. */
  uint32_t upcoming(size_t k) const noexcept {
    return k < free_.size() ? free_[free_.size() - 1 - k] : static_cast<uint32_t>(words_.size() + k - free_.size());
  }
  /** Room must have been made. */
  Slot acquire() noexcept {
    if (!free_.empty()) {
      const uint32_t index = free_.back();
      free_.pop_back();
      words_[index] = (words_[index] & ~kFreeBit) + 1;
      ++alive_;
      return {index, words_[index]};
    }
    DSW_ASSERT(words_.size() < words_.capacity());
    words_.push_back(1);
    ++alive_;
    return {static_cast<uint32_t>(words_.size() - 1), 1};
  }
  void release(uint32_t index) noexcept {
    DSW_ASSERT(index < words_.size() && (words_[index] & kFreeBit) == 0);
    if (words_[index] < last_) free_.push_back(index);  // else it is retired: its next generation would wrap
    words_[index] |= kFreeBit;
    --alive_;
  }
  /** Whether a slot that is alive has a next generation. */
  bool can_renew(uint32_t index) const noexcept { return words_[index] < last_; }
  /** Gives a slot that is alive its next generation: what it held has been replaced. */
  void renew(uint32_t index) noexcept {
    DSW_ASSERT(can_renew(index));
    ++words_[index];
  }
  bool alive(uint32_t index, uint32_t generation) const noexcept {
    return index < words_.size() && words_[index] == generation && (generation & kFreeBit) == 0;
  }
  /** Generation of a slot that is alive. */
  uint32_t generation(uint32_t index) const noexcept { return words_[index]; }
  /** Slots ever used: indices are below. */
  size_t slot_count() const noexcept { return words_.size(); }
  size_t alive_count() const noexcept { return alive_; }
  uint64_t memory_bytes() const noexcept { return array_bytes(words_) + array_bytes(free_); }

  /** All that a pool knows, for snapshots: a word for each slot, and the free ones in the order of their release. */
  const Array<uint32_t>& words() const noexcept { return words_; }
  const Array<uint32_t>& free_slots() const noexcept { return free_; }
  /** Takes over what words() and free_slots() of another pool were. False if no pool has them: then this one is
   * useless. Throws std::bad_alloc. */
  bool restore(Array<uint32_t>&& words, Array<uint32_t>&& free) {
    words_ = std::move(words);
    free_ = std::move(free);
    alive_ = 0;
    size_t waiting = 0;
    for (const uint32_t word : words_) {
      const uint32_t generation = word & ~kFreeBit;
      if (generation == 0 || generation > last_) return false;
      alive_ += (word & kFreeBit) == 0 ? 1 : 0;
      waiting += (word & kFreeBit) != 0 && generation < last_ ? 1 : 0;
    }
    Array<uint8_t> seen(words_.size(), 0, words_.get_allocator());
    for (const uint32_t index : free_) {
      if (index >= words_.size() || (words_[index] & kFreeBit) == 0 || seen[index]++ != 0) return false;
      if ((words_[index] & ~kFreeBit) == last_) return false;
    }
    return free_.size() == waiting;
  }

 private:
  static constexpr uint32_t kFreeBit = 0x80000000u;

  Array<uint32_t> words_;  // generation; with kFreeBit when the slot is free or retired
  Array<uint32_t> free_;
  uint32_t last_;
  size_t alive_ = 0;
};

}  // namespace dsw
