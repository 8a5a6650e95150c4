#include "environment/edge_marks.h"

#include <algorithm>

#include "base/sort.h"

namespace dsw {
namespace {

constexpr uint64_t kEmpty = ~uint64_t{0};

uint64_t key_of(uint32_t a, uint32_t b) { return (uint64_t{std::min(a, b)} << 32) | std::max(a, b); }
uint64_t hash(uint64_t key) {
  key *= 0x9e3779b97f4a7c15ull;
  return key ^ (key >> 32);
}

}  // namespace

size_t EdgeMarks::find(uint64_t key) const noexcept {
  const size_t mask = slots_.size() - 1;
  size_t slot = hash(key) & mask;
  while (slots_[slot] != kEmpty && slots_[slot] != key) slot = (slot + 1) & mask;
  return slot;
}

bool EdgeMarks::contains(uint32_t a, uint32_t b) const noexcept {
  return size_ != 0 && slots_[find(key_of(a, b))] != kEmpty;
}

void EdgeMarks::rehash(size_t slot_count) {
  Array<uint64_t> old(slot_count, kEmpty, slots_.get_allocator());
  old.swap(slots_);
  for (const uint64_t key : old) {
    if (key != kEmpty) slots_[find(key)] = key;
  }
}

void EdgeMarks::reserve(size_t more) {
  size_t slots = slots_.empty() ? 16 : slots_.size();
  while (slots < 2 * (size_ + more)) slots *= 2;
  if (slots != slots_.size() && more != 0) rehash(slots);
}

bool EdgeMarks::insert(uint32_t a, uint32_t b) {
  reserve(1);
  const size_t slot = find(key_of(a, b));
  if (slots_[slot] != kEmpty) return false;
  slots_[slot] = key_of(a, b);
  ++size_;
  return true;
}

bool EdgeMarks::erase(uint32_t a, uint32_t b) noexcept {
  if (size_ == 0) return false;
  size_t hole = find(key_of(a, b));
  if (slots_[hole] == kEmpty) return false;
  const size_t mask = slots_.size() - 1;
  // Linear probing keeps no tombstones: entries that probed past the hole move back into it.
  for (size_t slot = (hole + 1) & mask; slots_[slot] != kEmpty; slot = (slot + 1) & mask) {
    const size_t home = hash(slots_[slot]) & mask;
    if (((slot - home) & mask) >= ((slot - hole) & mask)) {
      slots_[hole] = slots_[slot];
      hole = slot;
    }
  }
  slots_[hole] = kEmpty;
  --size_;
  return true;
}

void EdgeMarks::copy_sorted(Array<uint64_t>& out) const {
  out.clear();
  for (const uint64_t key : slots_) {
    if (key != kEmpty) out.push_back(key);
  }
  dsw::sort(out.begin(), out.end());
}

}  // namespace dsw
