#pragma once
// Pairs of boxes that overlap, by sweep and prune: strips across one axis, and in each the boxes in the order of their lower sides along
// another. Coordinates are whole steps of a frame. Rounding down keeps their order, so boxes that overlap do so there as well. A visit
// compares eight boxes that follow in a row, so boxes that are small beside all of them together cost a few instructions a pair, and one
// large box costs nothing but its own overlaps.

#include <algorithm>
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
  /** A box in steps of the frame: lower sides, and inverses of upper ones, so that a hull takes the least of all. */
  struct Steps {
    int16_t sides[8];

    int16_t low(int k) const noexcept { return sides[k]; }
    int16_t high(int k) const noexcept { return static_cast<int16_t>(~sides[kUpper + k]); }
    static Steps hull(const Steps& a, const Steps& b) noexcept {
      const ShortEight one = eight_at(a.sides), other = eight_at(b.sides), is_less = one < other,
                       least = (one & is_less) | (other & ~is_less);
      Steps made;
      std::memcpy(made.sides, &least, sizeof made.sides);
      return made;
    }
  };

  explicit BoxSweep(const Memory* memory)
      : steps_(memory),
        other_steps_(memory),
        list_(memory),
        others_(memory),
        order_(memory),
        sorted_(memory),
        found_(memory) {}

  /** Calls visit(i, k) once for each two of the boxes that overlap, and for some that nearly do. */
  template <class Visit>
  void visit_own(const Array<Box<D>>& boxes, Visit visit) {
    set_frame(boxes, boxes);
    find_steps(boxes, steps_);
    visit_own(steps_, [&](uint32_t i, const uint32_t* others, uint32_t count) {
      for (uint32_t n = 0; n < count; ++n) visit(i, others[n]);
    });
  }
  /** Calls visit(i, k) once for each box i and each of the others k that overlaps it, and for some that nearly do. */
  template <class Visit>
  void visit_between(const Array<Box<D>>& boxes, const Array<Box<D>>& others, Visit visit) {
    set_frame(boxes, others);
    find_steps(boxes, steps_);
    find_steps(others, other_steps_);
    visit_between(
        steps_, other_steps_,
        [&](uint32_t i, const uint32_t* found, uint32_t count) {
          for (uint32_t n = 0; n < count; ++n) visit(i, found[n]);
        },
        [&](uint32_t k, const uint32_t* found, uint32_t count) {
          for (uint32_t n = 0; n < count; ++n) visit(found[n], k);
        });
  }

  /** Chooses a frame that holds nearly all boxes. What is beyond it counts as at its side. */
  void set_frame(const Array<Box<D>>& boxes, const Array<Box<D>>& others) noexcept;
  Steps steps_of(const Box<D>& box) const noexcept {
    Steps steps{};
    for (int k = 0; k < D; ++k) {
      steps.sides[k] = step_of(box.lower[k], k);
      steps.sides[kUpper + k] = static_cast<int16_t>(~step_of(box.upper[k], k));
    }
    return steps;
  }
  /** Calls visit(i, others, count) for boxes and those that overlap them, or nearly do: each two once. */
  template <class Visit>
  void visit_own(const Array<Steps>& boxes, Visit visit) {
    if (boxes.size() < 2) return;
    choose_strips(boxes, boxes);
    fill(boxes, list_);
    make_room(found_, list_.row + kLanes);
    for (uint32_t s = 0; s < strips_; ++s) {
      for (uint32_t i = list_.first[s]; i < list_.end_of(s); ++i) {
        const uint32_t count = find_after(list_, i, list_, i + 1);
        if (count > 0) visit(list_.numbers[i], found_.data(), count);
      }
    }
  }
  /** Calls visit(i, others, count) for boxes and those of the others that overlap them, or nearly do, or visit_other(k, boxes, count): each two
   * once. */
  template <class Visit, class VisitOther>
  void visit_between(const Array<Steps>& boxes, const Array<Steps>& others, Visit visit, VisitOther visit_other) {
    if (boxes.empty() || others.empty()) return;
    choose_strips(boxes, others);
    fill(boxes, list_);
    fill(others, others_);
    make_room(found_, std::max(list_.row, others_.row) + kLanes);
    for (uint32_t s = 0; s < strips_; ++s) {
      uint32_t a = list_.first[s], b = others_.first[s];
      const uint32_t a_end = list_.end_of(s), b_end = others_.end_of(s);
      while (a < a_end && b < b_end) {
        if (list_.low(0)[a] <= others_.low(0)[b]) {
          const uint32_t count = find_after(list_, a, others_, b);
          if (count > 0) visit(list_.numbers[a], found_.data(), count);
          ++a;
        } else {
          const uint32_t count = find_after(others_, b, list_, a);
          if (count > 0) visit_other(others_.numbers[b], found_.data(), count);
          ++b;
        }
      }
    }
  }

 private:
  static constexpr uint32_t kLanes = 8;
  static constexpr int kUpper = 4;                              // where upper sides begin in Steps
  static constexpr int kFirstStep = -32768, kLastStep = 32766;  // of the frame; the next one is beyond all boxes

  /** Boxes in the order of the sweep, strip by strip, and beyond each strip eight that overlap none. */
  struct List {
    Array<int16_t>
        sides;  // whether its strip is a box's first; lower and upper sides along axes_[0], axes_[1], ...: a row for each
    size_t row = 0;           // how long these are
    Array<uint32_t> numbers;  // of the boxes
    Array<uint32_t> first;    // of each strip; one more at the end

    explicit List(const Memory* memory) : sides(memory), numbers(memory), first(memory) {}
    const int16_t* is_first() const { return sides.data(); }
    const int16_t* low(int k) const { return sides.data() + (2 * static_cast<size_t>(k) + 1) * row; }
    const int16_t* high(int k) const { return low(k) + row; }
    uint32_t end_of(uint32_t strip) const { return first[strip + 1] - kLanes; }
  };

  template <class T>
  static void make_room(Array<T>& array, size_t count) {
    if (array.size() < count) array.resize(count);
  }
  static ShortEight eight_at(const int16_t* first) noexcept {
    ShortEight eight;
    std::memcpy(&eight, first, sizeof eight);
    return eight;
  }
  uint32_t strip_of(int16_t step) const noexcept { return static_cast<uint32_t>(step - kFirstStep) >> strip_shift_; }

  /** Finds boxes of a list, from a place on, that begin within box i of another one and overlap it, if this strip is the first of both.
   * Puts their numbers in found_, and returns how many they are. Few branches are a matter of chance. */
  DSW_HOT uint32_t find_after(const List& of, uint32_t i, const List& list, uint32_t from) {
    const int16_t last = of.high(0)[i];
    ShortEight low[D], high[D];
    for (int k = 1; k < D; ++k) {
      low[k] = eight_of(of.low(k)[i]);
      high[k] = eight_of(of.high(k)[i]);
    }
    const ShortEight lasts = eight_of(last), is_first = eight_of(of.is_first()[i]);
    uint32_t* const found = found_.data();
    uint32_t count = 0;
    for (; list.low(0)[from] <= last; from += kLanes) {
      ShortEight beyond = (eight_at(list.low(0) + from) > lasts) | ~(is_first | eight_at(list.is_first() + from));
      for (int k = 1; k < D; ++k) {
        beyond |= (eight_at(list.low(k) + from) > high[k]) | (eight_at(list.high(k) + from) < low[k]);
      }
      uint64_t words[2];
      std::memcpy(words, &beyond, sizeof words);
      if ((words[0] & words[1]) == ~uint64_t{0}) continue;
      int16_t lanes[kLanes];
      std::memcpy(lanes, &beyond, sizeof lanes);
      for (uint32_t lane = 0; lane < kLanes; ++lane) {
        found[count] = list.numbers[from + lane];
        count += static_cast<uint32_t>(lanes[lane] + 1);
      }
    }
    return count;
  }

  int16_t step_of(double x, int k) const noexcept {
    const double at = (x - low_[k]) * scale_[k];
    return static_cast<int16_t>(kFirstStep +
                                static_cast<int>(at > 0 ? std::min(at, 1.0 * (kLastStep - kFirstStep)) : 0));
  }
  void find_steps(const Array<Box<D>>& boxes, Array<Steps>& steps) const {
    steps.resize(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i) steps[i] = steps_of(boxes[i]);
  }
  void choose_strips(const Array<Steps>& boxes, const Array<Steps>& others) noexcept;
  void sort_steps(const Array<Steps>& boxes);
  void fill(const Array<Steps>& boxes, List& list);

  Array<Steps> steps_, other_steps_;  // of boxes that are given in doubles
  List list_, others_;
  Array<uint32_t> order_, sorted_, found_;
  int axes_[D] = {};  // of the sweep, of the strips, and what is left
  double low_[D] = {}, scale_[D] = {};
  uint32_t strip_shift_ = 0, strips_ = 1;
};

template <int D>
void BoxSweep<D>::set_frame(const Array<Box<D>>& boxes, const Array<Box<D>>& others) noexcept {
  constexpr uint64_t kSamples = 32, kStride = 2654435761;
  const bool is_one = &boxes == &others;
  Box<D> all;
  for (const Box<D>& each : boxes) all.add(each);
  for (size_t i = 0; !is_one && i < others.size(); ++i) all.add(others[i]);
  const uint64_t count = boxes.size() + (is_one ? 0 : others.size());
  for (int k = 0; k < D && count > 0; ++k) {
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

/** Axes along which few of some pairs of boxes overlap come first. Strips are at least as high as all boxes in the mean: so boxes are
 * in few strips, also where a few of them are much larger than the others. */
template <int D>
void BoxSweep<D>::choose_strips(const Array<Steps>& boxes, const Array<Steps>& others) noexcept {
  constexpr uint64_t kSamples = 16, kStride = 2654435761;
  constexpr uint32_t kMostShift = 16, kBoxesInStrip = 16;
  uint32_t overlaps[D] = {};
  for (uint64_t i = 0; i < kSamples; ++i) {
    const Steps& one = boxes[i * kStride % boxes.size()];
    for (uint64_t j = 0; j < kSamples; ++j) {
      const Steps& other = others[(i + kSamples * (j + 1)) * kStride % others.size()];
      for (int k = 0; k < D; ++k)
        overlaps[k] += static_cast<uint32_t>((one.low(k) <= other.high(k)) && (other.low(k) <= one.high(k)));
    }
  }
  for (int k = 0; k < D; ++k) axes_[k] = k;
  dsw::sort(axes_, axes_ + D,
            [&](int a, int b) { return overlaps[a] != overlaps[b] ? overlaps[a] < overlaps[b] : a < b; });
  const uint64_t count = boxes.size() + others.size();
  uint64_t size = 0;
  for (const Array<Steps>* list : {&boxes, &others}) {
    for (const Steps& each : *list) size += static_cast<uint32_t>(each.high(axes_[1]) - each.low(axes_[1]));
  }
  size /= count;
  for (strip_shift_ = scale_[axes_[1]] == 0 ? kMostShift : 4; strip_shift_ < kMostShift; ++strip_shift_) {
    const uint64_t strips = uint64_t{1} << (kMostShift - strip_shift_);
    if (uint64_t{1} << strip_shift_ >= size && strips * kBoxesInStrip <= count) break;
  }
  strips_ = 1u << (kMostShift - strip_shift_);
}

/** The order of boxes along the first axis, in order_. */
template <int D>
void BoxSweep<D>::sort_steps(const Array<Steps>& boxes) {
  constexpr uint32_t kBits = 8, kDigits = 1u << kBits;
  const auto count = static_cast<uint32_t>(boxes.size());
  const int along = axes_[0];
  order_.resize(count);
  sorted_.resize(count);
  for (uint32_t i = 0; i < count; ++i) sorted_[i] = i;
  for (const uint32_t shift : {0u, kBits}) {
    const auto digit_of = [&](uint32_t i) {
      return static_cast<uint32_t>(boxes[i].low(along) - kFirstStep) >> shift & (kDigits - 1);
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

template <int D>
void BoxSweep<D>::fill(const Array<Steps>& boxes, List& list) {
  const int across = axes_[1];
  sort_steps(boxes);
  list.first.assign(strips_ + 1, 0);
  for (const Steps& each : boxes) {
    const uint32_t last = strip_of(each.high(across));
    for (uint32_t s = strip_of(each.low(across)); s <= last; ++s) ++list.first[s];
  }
  uint32_t sum = 0;
  for (uint32_t& each : list.first) {
    const uint32_t count = each;
    each = sum;
    sum += count + kLanes;
  }
  list.row = sum;
  make_room(list.sides, (2 * D + 1) * list.row);
  make_room(list.numbers, list.row);
  int16_t* const is_first = list.sides.data();
  for (const uint32_t number : order_) {
    const Steps& each = boxes[number];
    const uint32_t begin = strip_of(each.low(across)), last = strip_of(each.high(across));
    for (uint32_t s = begin; s <= last; ++s) {
      const uint32_t at = list.first[s]++;
      is_first[at] = s == begin ? -1 : 0;
      int16_t* side = is_first + list.row + at;
      for (int k = 0; k < D; ++k, side += 2 * list.row) {
        side[0] = each.low(axes_[k]);
        side[list.row] = each.high(axes_[k]);
      }
      list.numbers[at] = number;
    }
  }
  for (uint32_t s = strips_; s > 0; --s) {
    std::fill_n(is_first + list.row + list.first[s - 1], kLanes, static_cast<int16_t>(kLastStep + 1));
    list.first[s] = list.first[s - 1] + kLanes;
  }
  list.first[0] = 0;
}

}  // namespace dsw
