#pragma once
// What is known of the cells of an environment whose points may move: whether they are valid in its present geometry. A
// cell is looked at when it is first entered, on whatever thread, since looking at all of them would take as long as
// there are cells.

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "base/compiler.h"
#include "base/memory.h"

namespace dsw {

class CheckedCells {
 public:
  enum class Known : uint32_t {
    kNothing,
    kInvalid,
    kValid,
    kCuboid,  // valid, and a cuboid as is_cuboid says
  };
  static bool is_valid(Known known) noexcept { return known >= Known::kValid; }

  explicit CheckedCells(const Memory* memory) : stamps_(memory) {}

  /** Whether points may move; if not, nothing is kept. */
  bool active() const noexcept { return round_ != 0; }
  /** Throws std::bad_alloc. */
  void activate(size_t cells) {
    stamps_ = Array<std::atomic<uint32_t>>(cells, stamps_.get_allocator());
    forget_all();
  }

  /** For so many cells; nothing is known of those that come. Throws std::bad_alloc. */
  void make_room(size_t cells) {
    if (!active() || cells <= stamps_.size()) return;
    Array<std::atomic<uint32_t>> more(cells + cells / 2, stamps_.get_allocator());
    for (size_t i = 0; i < stamps_.size(); ++i) more[i].store(stamps_[i].load(std::memory_order_relaxed));
    stamps_.swap(more);
  }

  /** Nothing is known any more, and any cell may be looked at. */
  void forget_all() noexcept { start_round(false); }
  /** Nothing is known any more, and only cells that are opened may be looked at: the others count as invalid. */
  void close_all() noexcept { start_round(true); }
  /** A cell may be looked at, and nothing is known of it. */
  void open(uint32_t cell) noexcept { note(cell, Known::kNothing); }

  /** Whether it has been opened, or anything is known of it, since everything was forgotten last. */
  bool is_open(uint32_t cell) const noexcept { return stamps_[cell].load(std::memory_order_relaxed) >> 2 == round_; }

  Known known(uint32_t cell) const noexcept {
    const uint32_t stamp = stamps_[cell].load(std::memory_order_relaxed);
    return stamp >> 2 == round_ ? static_cast<Known>(stamp & 3u) : closed_ ? Known::kInvalid : Known::kNothing;
  }
  void prefetch(uint32_t cell) const noexcept { prefetch_line(&stamps_[cell]); }
  /** Whoever finds out comes to the same answer, so it does not matter who notes it. */
  void note(uint32_t cell, Known known) const noexcept {
    stamps_[cell].store(round_ << 2 | static_cast<uint32_t>(known), std::memory_order_relaxed);
  }
  uint64_t memory_bytes() const noexcept { return array_bytes(stamps_); }

 private:
  static constexpr uint32_t kLastRound = 0x3fffffffu;

  void start_round(bool closed) noexcept {
    closed_ = closed;
    if (++round_ <= kLastRound) return;
    for (std::atomic<uint32_t>& stamp : stamps_) stamp.store(0, std::memory_order_relaxed);
    round_ = 1;
  }

  mutable Array<std::atomic<uint32_t>> stamps_;  // by cell: round, and what is known since it began
  uint32_t round_ = 0;
  bool closed_ = false;
};

}  // namespace dsw
