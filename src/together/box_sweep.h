#pragma once
// Pairs of boxes that overlap, by sweep and prune: strips across one axis, and in each the boxes in the order of their lower sides along
// another. Coordinates are whole steps of a frame. Rounding down keeps their order, so boxes that overlap do so there as well. A visit
// compares eight boxes that follow in a row, so boxes that are small beside all of them together cost a few instructions a pair, and one
// large box costs nothing but its own overlaps.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/compiler.h"
#include "base/memory.h"
#include "base/sort.h"
#include "body/box.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class BoxSweep {
 public:
  explicit BoxSweep(const Memory* memory) : list_(memory), others_(memory), order_(memory), sorted_(memory) {}

  /** Calls visit(i, k) once for each two of the boxes that overlap, and for some that nearly do. */
  template <class Visit>
  void visit_own(const Array<Box<D>>& boxes, Visit visit) {
    if (boxes.size() < 2) return;
    set_frame(boxes, boxes);
    count_steps(boxes, list_);
    choose_strips(list_, list_);
    fill(list_);
    for (uint32_t s = 0; s < strips_; ++s) {
      for (uint32_t i = list_.first[s]; i < list_.end_of(s); ++i) {
        visit_after(list_, i, list_, i + 1, s, [&](uint32_t k) { visit(list_.numbers[i], list_.numbers[k]); });
      }
    }
  }
  /** Calls visit(i, k) once for each box i and each of the others k that overlaps it, and for some that nearly do. */
  template <class Visit>
  void visit_between(const Array<Box<D>>& boxes, const Array<Box<D>>& others, Visit visit) {
    if (boxes.empty() || others.empty()) return;
    set_frame(boxes, others);
    count_steps(boxes, list_);
    count_steps(others, others_);
    choose_strips(list_, others_);
    fill(list_);
    fill(others_);
    for (uint32_t s = 0; s < strips_; ++s) {
      uint32_t a = list_.first[s], b = others_.first[s];
      const uint32_t a_end = list_.end_of(s), b_end = others_.end_of(s);
      while (a < a_end && b < b_end) {
        if (list_.low(0)[a] <= others_.low(0)[b]) {
          visit_after(list_, a, others_, b, s, [&](uint32_t k) { visit(list_.numbers[a], others_.numbers[k]); });
          ++a;
        } else {
          visit_after(others_, b, list_, a, s, [&](uint32_t i) { visit(list_.numbers[i], others_.numbers[b]); });
          ++b;
        }
      }
    }
  }

 private:
  static constexpr uint32_t kLanes = 8;
  static constexpr int kFirstStep = -32768, kLastStep = 32766;  // of the frame; the next one is beyond all boxes

  struct Steps {
    int16_t low[D], high[D];
  };
  /** Boxes in the order of the sweep, strip by strip, and beyond each strip eight that overlap none. */
  struct List {
    Array<Steps> steps;       // by box
    uint64_t sizes[D] = {};   // of all boxes
    Array<int16_t> sides;     // lower and upper ones along axes_[0], along axes_[1], ...: a row for each
    size_t row = 0;           // how long these are
    Array<uint32_t> numbers;  // of the boxes
    Array<uint32_t> first;    // of each strip; one more at the end

    explicit List(const Memory* memory) : steps(memory), sides(memory), numbers(memory), first(memory) {}
    const int16_t* low(int k) const { return sides.data() + 2 * static_cast<size_t>(k) * row; }
    const int16_t* high(int k) const { return low(k) + row; }
    uint32_t end_of(uint32_t strip) const { return first[strip + 1] - kLanes; }
  };

  static ShortEight eight_at(const int16_t* first) noexcept {
    ShortEight eight;
    std::memcpy(&eight, first, sizeof eight);
    return eight;
  }
  uint32_t strip_of(int16_t step) const noexcept { return static_cast<uint32_t>(step - kFirstStep) >> strip_shift_; }

  /** Calls visit for boxes of a list, from a place on, that begin within box i of another one and overlap it, if this strip is
   * the first of both. */
  template <class Visit>
  DSW_HOT void visit_after(const List& of, uint32_t i, const List& list, uint32_t from, uint32_t strip,
                           Visit visit) const {
    const int16_t last = of.high(0)[i];
    int16_t low[D], high[D];
    for (int k = 1; k < D; ++k) {
      low[k] = of.low(k)[i];
      high[k] = of.high(k)[i];
    }
    const bool is_first = strip_of(low[1]) == strip;
    for (; list.low(0)[from] <= last; from += kLanes) {
      ShortEight beyond = eight_at(list.low(0) + from) > eight_of(last);
      for (int k = 1; k < D; ++k) {
        beyond |=
            (eight_at(list.low(k) + from) > eight_of(high[k])) | (eight_at(list.high(k) + from) < eight_of(low[k]));
      }
      uint64_t words[2];
      std::memcpy(words, &beyond, sizeof words);
      for (uint32_t half = 0; half < 2; ++half) {
        if (words[half] == ~uint64_t{0}) continue;
        for (uint32_t lane = kLanes / 2 * half; lane < kLanes / 2 * (half + 1); ++lane) {
          if (beyond[lane] == 0 && (is_first || strip_of(list.low(1)[from + lane]) == strip)) visit(from + lane);
        }
      }
    }
  }

  /** Chooses a frame that holds nearly all boxes. What is beyond it counts as at its side. */
  void set_frame(const Array<Box<D>>& boxes, const Array<Box<D>>& others) noexcept {
    constexpr uint64_t kSamples = 32, kStride = 2654435761;
    Box<D> all;
    for (const Array<Box<D>>* list : {&boxes, &others}) {
      for (const Box<D>& each : *list) all.add(each);
      if (&boxes == &others) break;
    }
    const uint64_t count = boxes.size() + others.size();
    for (int k = 0; k < D; ++k) {
      double sides[kSamples];
      for (uint64_t i = 0; i < kSamples; ++i) {
        const uint64_t at = i * kStride % count;
        sides[i] = at < boxes.size() ? boxes[at].lower[k] : others[at - boxes.size()].lower[k];
      }
      dsw::sort(sides, sides + kSamples);
      const double first = sides[2], last = sides[kSamples - 3], room = last - first;
      const double lower = std::max(all.lower[k], first - room), upper = std::min(all.upper[k], last + room);
      low_[k] = lower;
      scale_[k] = (kLastStep - kFirstStep) / (upper - lower);
      if (!(scale_[k] > 0 && scale_[k] < Box<D>::kInfinity)) scale_[k] = 0;
    }
  }
  int16_t step_of(double x, int k) const noexcept {
    const double at = (x - low_[k]) * scale_[k];
    return static_cast<int16_t>(kFirstStep +
                                static_cast<int>(at > 0 ? std::min(at, 1.0 * (kLastStep - kFirstStep)) : 0));
  }
  void count_steps(const Array<Box<D>>& boxes, List& list) {
    list.steps.resize(boxes.size());
    std::fill_n(list.sizes, D, uint64_t{0});
    for (size_t i = 0; i < boxes.size(); ++i) {
      for (int k = 0; k < D; ++k) {
        const int16_t low = step_of(boxes[i].lower[k], k), high = step_of(boxes[i].upper[k], k);
        list.steps[i].low[k] = low;
        list.steps[i].high[k] = high;
        list.sizes[k] += static_cast<uint64_t>(high - low);
      }
    }
  }

  /** How many of some pairs of boxes overlap along an axis. */
  static uint32_t overlaps_along(int k, const List& list, const List& others) noexcept {
    constexpr uint64_t kSamples = 16, kStride = 2654435761;
    uint32_t count = 0;
    for (uint64_t i = 0; i < kSamples; ++i) {
      const Steps& one = list.steps[i * kStride % list.steps.size()];
      for (uint64_t j = 0; j < kSamples; ++j) {
        const Steps& other = others.steps[(i + kSamples * (j + 1)) * kStride % others.steps.size()];
        count += static_cast<uint32_t>((one.low[k] <= other.high[k]) & (other.low[k] <= one.high[k]));
      }
    }
    return count;
  }

  /** Axes along which few boxes overlap come first. Strips are one to two times as high as boxes in the mean. */
  void choose_strips(const List& list, const List& others) noexcept {
    uint64_t sizes[D], overlaps[D];
    const uint64_t count = list.steps.size() + others.steps.size();
    for (int k = 0; k < D; ++k) {
      sizes[k] = scale_[k] == 0 ? UINT64_MAX : list.sizes[k] + others.sizes[k];
      overlaps[k] = overlaps_along(k, list, others);
      axes_[k] = k;
    }
    dsw::sort(axes_, axes_ + D,
              [&](int a, int b) { return overlaps[a] != overlaps[b] ? overlaps[a] < overlaps[b] : a < b; });
    constexpr uint32_t kMostShift = 16, kBoxesInStrip = 16;
    for (strip_shift_ = 4; strip_shift_ < kMostShift; ++strip_shift_) {
      const uint64_t height = uint64_t{1} << strip_shift_;
      if (height * count >= sizes[axes_[1]] && (uint64_t{1} << (kMostShift - strip_shift_)) * kBoxesInStrip <= count)
        break;
    }
    strips_ = 1u << (kMostShift - strip_shift_);
  }

  /** The order of boxes along the first axis, in order_. */
  void sort_steps(const List& list) {
    constexpr uint32_t kBits = 8, kDigits = 1u << kBits;
    const auto count = static_cast<uint32_t>(list.steps.size());
    const int along = axes_[0];
    order_.resize(count);
    sorted_.resize(count);
    for (uint32_t i = 0; i < count; ++i) sorted_[i] = i;
    for (const uint32_t shift : {0u, kBits}) {
      const auto digit_of = [&](uint32_t i) {
        return static_cast<uint32_t>(list.steps[i].low[along] - kFirstStep) >> shift & (kDigits - 1);
      };
      uint32_t first[kDigits] = {}, sum = 0;
      for (uint32_t i = 0; i < count; ++i) ++first[digit_of(i)];
      for (uint32_t& each : first) {
        const uint32_t before = sum;
        sum += each;
        each = before;
      }
      for (const uint32_t i : sorted_) order_[first[digit_of(i)]++] = i;
      if (shift == 0) order_.swap(sorted_);
    }
  }

  void fill(List& list) {
    const int across = axes_[1];
    sort_steps(list);
    list.first.assign(strips_ + 1, 0);
    for (const Steps& each : list.steps) {
      const uint32_t last = strip_of(each.high[across]);
      for (uint32_t s = strip_of(each.low[across]); s <= last; ++s) ++list.first[s];
    }
    uint32_t sum = 0;
    for (uint32_t& each : list.first) {
      const uint32_t count = each;
      each = sum;
      sum += count + kLanes;
    }
    list.row = sum;
    list.sides.resize(2 * D * list.row);
    list.numbers.resize(list.row);
    int16_t* const sides = list.sides.data();
    for (const uint32_t number : order_) {
      const Steps& each = list.steps[number];
      const uint32_t last = strip_of(each.high[across]);
      for (uint32_t s = strip_of(each.low[across]); s <= last; ++s) {
        const uint32_t at = list.first[s]++;
        for (int k = 0; k < D; ++k) {
          sides[2 * static_cast<size_t>(k) * list.row + at] = each.low[axes_[k]];
          sides[(2 * static_cast<size_t>(k) + 1) * list.row + at] = each.high[axes_[k]];
        }
        list.numbers[at] = number;
      }
    }
    for (uint32_t s = strips_; s > 0; --s) {
      std::fill_n(sides + list.first[s - 1], kLanes, static_cast<int16_t>(kLastStep + 1));
      list.first[s] = list.first[s - 1] + kLanes;
    }
    list.first[0] = 0;
  }

  List list_, others_;
  Array<uint32_t> order_, sorted_;
  int axes_[D] = {};  // of the sweep, of the strips, and what is left
  double low_[D] = {}, scale_[D] = {};
  uint32_t strip_shift_ = 0, strips_ = 1;
};

}  // namespace dsw
