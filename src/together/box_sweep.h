#pragma once
// Boxes in the order of their lower sides along one axis. Where boxes are small beside all of them together, as those of a short step
// are, this finds what overlaps several times as fast as a grid: all is read in a row.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/memory.h"
#include "body/box.h"

namespace dsw {

/** Keeps its memory from call to call. */
template <int D>
class BoxSweep {
 public:
  explicit BoxSweep(const Memory* memory) : order_(memory), sides_(memory) {}

  /** Throws std::bad_alloc. */
  void sort(const Array<Box<D>>& boxes, int axis) {
    axis_ = axis;
    count_ = boxes.size();
    width_ = 0;
    order_.resize(count_);
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      const double x = boxes[a].lower[axis], y = boxes[b].lower[axis];
      return x != y ? x < y : a < b;
    });
    sides_.resize(2 * D * count_);
    for (size_t i = 0; i < count_; ++i) {
      const Box<D>& box = boxes[order_[i]];
      for (int k = 0; k < D; ++k) {
        lower(k)[i] = box.lower[k];
        upper(k)[i] = box.upper[k];
      }
      width_ = std::max(width_, box.upper[axis] - box.lower[axis]);
    }
  }
  /** How many boxes a visit reads in the mean that is made for each of `boxes`. */
  double mean_length(const Array<Box<D>>& boxes) const {
    double sum = 0;
    constexpr size_t kSamples = 64;
    const size_t step = std::max<size_t>(1, boxes.size() / kSamples);
    size_t samples = 0;
    for (size_t i = 0; i < boxes.size(); i += step, ++samples) {
      const auto [first, last] = range(boxes[i]);
      sum += static_cast<double>(last - first);
    }
    return samples == 0 ? 0 : sum / static_cast<double>(samples);
  }
  /** Calls visit(number) for the boxes that overlap this one. */
  template <class Visit>
  void visit(const Box<D>& box, Visit visit) const {
    const auto [first, last] = range(box);
    for (size_t i = first; i < last; ++i) {
      bool overlaps = true;
      for (int k = 0; k < D; ++k) overlaps &= lower(k)[i] <= box.upper[k] && upper(k)[i] >= box.lower[k];
      if (overlaps) visit(order_[i]);
    }
  }

 private:
  const double* lower(int k) const { return sides_.data() + size_t(2 * k) * count_; }
  const double* upper(int k) const { return sides_.data() + size_t(2 * k + 1) * count_; }
  double* lower(int k) { return sides_.data() + size_t(2 * k) * count_; }
  double* upper(int k) { return sides_.data() + size_t(2 * k + 1) * count_; }
  std::pair<size_t, size_t> range(const Box<D>& box) const {
    const double* const low = lower(axis_);
    // Both differences are rounded.
    const double from = std::nextafter(box.lower[axis_] - (1 + 0x1p-50) * width_, -Box<D>::kInfinity);
    return {static_cast<size_t>(std::lower_bound(low, low + count_, from) - low),
            static_cast<size_t>(std::upper_bound(low, low + count_, box.upper[axis_]) - low)};
  }

  Array<uint32_t> order_;
  Array<double> sides_;  // lower and upper ones of each axis, in that order
  size_t count_ = 0;
  double width_ = 0;  // the largest along the axis
  int axis_ = 0;
};

/** The axis along which boxes spread most. */
template <int D>
int longest_axis(const Array<Box<D>>& boxes) noexcept {
  Box<D> all;
  for (const Box<D>& each : boxes) {
    all.add(each.lower);
    all.add(each.upper);
  }
  int axis = 0;
  for (int k = 1; k < D; ++k) {
    if (all.upper[k] - all.lower[k] > all.upper[axis] - all.lower[axis]) axis = k;
  }
  return axis;
}

}  // namespace dsw
