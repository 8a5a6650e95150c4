#pragma once
// Facets in rows, one for each coordinate of a corner: triangles in space, segments in the plane. Several are read side
// by side, and in the order in which they lie in memory.

#include <algorithm>
#include <cstring>

#include "base/memory.h"

namespace dsw {

/** Some facets of rows, one after the other. */
template <int D>
class FacetSpan {
 public:
  FacetSpan(const double* values, size_t room, size_t count) noexcept : values_(values), room_(room), count_(count) {}

  size_t size() const noexcept { return count_; }
  FacetSpan part(size_t first, size_t count) const noexcept { return {values_ + first, room_, count}; }
  /** Coordinate `axis` of corner `corner` of all facets. */
  const double* row(int corner, int axis) const noexcept {
    return values_ + static_cast<size_t>(D * corner + axis) * room_;
  }

 private:
  const double* values_;
  size_t room_, count_;
};

template <int D>
class FacetRows {
 public:
  explicit FacetRows(const Allocator<double>& allocator) : values_(allocator) {}

  size_t size() const noexcept { return size_; }
  uint64_t memory_bytes() const noexcept { return array_bytes(values_); }
  FacetSpan<D> span(size_t first, size_t count) const noexcept {
    return {values_.data() + begin_ + first, room_, count};
  }

  /** Makes room. Throws std::bad_alloc, and then nothing has changed. */
  void reserve(size_t count) {
    if (count <= room_) return;
    const size_t room = count == 1 ? 1 : count + count / 2 + 2;
    Array<double> values(kRows * room, 0, values_.get_allocator());
    for (size_t r = 0; r < kRows; ++r) {
      std::copy_n(values_.data() + r * room_ + begin_, size_, values.data() + r * room);
    }
    values_ = std::move(values);
    begin_ = 0;
    room_ = room;
  }
  void clear() noexcept { size_ = 0; }
  /** Puts `added` facets, which the caller then sets, where `removed` are. There is room. */
  void replace(size_t at, size_t removed, size_t added) noexcept {
    const size_t rest = size_ - at - removed, size = at + added + rest;
    // The shorter part moves: sequences are changed at their ends most of the time.
    size_t begin = at < rest ? begin_ + removed - added : begin_;
    if (at < rest ? begin_ + removed < added : begin + size > room_) begin = (room_ - size) / 2;
    const size_t from = begin_ + at + removed, to = begin + at + added;
    if (to > from) move(from, to, rest);
    move(begin_, begin, at);
    if (to < from) move(from, to, rest);
    begin_ = begin;
    size_ = size;
  }
  void set(size_t at, int corner, const double* point) noexcept {
    for (int axis = 0; axis < D; ++axis) values_[start(corner, axis) + at] = point[axis];
  }

 private:
  static constexpr size_t kRows = D * D;

  size_t start(int corner, int axis) const noexcept { return static_cast<size_t>(D * corner + axis) * room_ + begin_; }
  void move(size_t from, size_t to, size_t count) noexcept {
    if (from == to || count == 0) return;
    for (double* row = values_.data(); row != values_.data() + kRows * room_; row += room_) {
      std::memmove(row + to, row + from, count * sizeof(double));
    }
  }

  Array<double> values_;
  size_t begin_ = 0, size_ = 0, room_ = 0;  // of a row: it has room at either end
};

}  // namespace dsw
