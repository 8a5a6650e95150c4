#pragma once
// Boxes by number, and which of them overlap another box: a hashed grid for each size of boxes, in powers of two, so
// that what is found and what it costs depend on what lies near, at any scale. A box is noted once, in the cell of its
// lower corner.

#include <cstdint>

#include "base/function_ref.h"
#include "base/memory.h"
#include "body/box.h"

namespace dsw {

template <int D>
class BoxGrid {
 public:
  explicit BoxGrid(const Memory* memory) : items_(memory), heads_(memory), levels_(memory) {}

  /** Room for the numbers below `count`: then nothing below can fail. Throws std::bad_alloc and changes nothing. */
  void reserve(size_t count);
  /** Notes a box, in place of the one with this number. `size` is that of things it is looked for with, if larger. */
  void put(uint32_t number, const Box<D>& box, double size = 0) noexcept;
  /** Nothing if there is none. */
  void remove(uint32_t number) noexcept;

  /** Calls visit(number) for each box that overlaps this one, in any order, until it is false; whether it never was. */
  bool visit(const Box<D>& box, FunctionRef<bool(uint32_t)> visit) const;

  bool empty() const noexcept { return level_count_ == 0; }
  uint64_t memory_bytes() const noexcept { return array_bytes(items_) + array_bytes(heads_) + array_bytes(levels_); }

 private:
  static constexpr uint32_t kEnd = 0xffffffffu;
  static constexpr int32_t kNone = -4096, kHuge = 1001, kTiny = -1000;  // exponents; of kHuge ones all are looked at

  struct Item {
    Box<D> box;
    int32_t exponent = kNone;
    uint32_t next = kEnd;
  };
  /** Boxes that are no larger than 2^exponent. */
  struct Level {
    int32_t exponent;
    uint32_t count;
    double inverse;  // 2^-exponent
  };
  /** In the plane the last number is 0, as in ranges. */
  struct Place {
    int64_t x[3];
    bool operator==(const Place& o) const { return x[0] == o.x[0] && x[1] == o.x[1] && x[2] == o.x[2]; }
  };
  struct Range {
    int64_t low[3], high[3];
  };
  enum class Look { kNowhere, kRange, kEverywhere };

  Look find_range(const Level& level, const Box<D>& box, Range& range) const noexcept;
  static int64_t floor_of(double x) noexcept {  // of one well below 2^63
    const auto whole = static_cast<int64_t>(x);
    return whole - (static_cast<double>(whole) > x ? 1 : 0);
  }
  static Place place_of(const Level& level, const Box<D>& box) noexcept {
    Place at{};
    if (level.exponent == kHuge) return at;
    for (int k = 0; k < D; ++k) at.x[k] = floor_of(box.lower[k] * level.inverse);
    return at;
  }
  static int32_t exponent_of(const Box<D>& box, double size) noexcept;
  size_t head_of(const Place& at, int32_t exponent) const noexcept {
    uint64_t hash = static_cast<uint32_t>(exponent);
    constexpr uint64_t kFactors[3] = {0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu, 0x165667b19e3779f9u};
    for (int k = 0; k < D; ++k) hash += static_cast<uint64_t>(at.x[k]) * kFactors[k];
    hash = (hash ^ hash >> 32) * kFactors[0];
    return static_cast<size_t>(hash >> 32) & (heads_.size() - 1);
  }
  Level& level_of(int32_t exponent) noexcept;
  void link(uint32_t number, const Level& level) noexcept;

  Array<Item> items_;      // by number
  Array<uint32_t> heads_;  // a power of two
  Array<Level> levels_;    // the first are in use
  uint32_t level_count_ = 0;
};

}  // namespace dsw
