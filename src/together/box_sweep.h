#pragma once
// Pairs of boxes that overlap, by sweep and prune: strips across one axis, and in each the boxes in the order of their lower sides along
// another. A visit reads what follows in a row, so boxes that are small beside all of them together cost a few comparisons a pair, and
// one large box costs nothing but its own overlaps.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/memory.h"
#include "base/sort.h"
#include "body/box.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class BoxSweep {
 public:
  explicit BoxSweep(const Memory* memory) : order_(memory), list_(memory), others_(memory) {}

  /** Calls visit(i, k) once for each two of the boxes that overlap. */
  template <class Visit>
  void visit_own(const Array<Box<D>>& boxes, Visit visit) {
    if (boxes.size() < 2) return;
    choose_strips(boxes, boxes);
    fill(boxes, list_);
    for (uint32_t s = 0; s < strips_; ++s) {
      const Entry* const end = list_.entries.data() + list_.first[s + 1];
      for (const Entry* each = list_.entries.data() + list_.first[s]; each < end; ++each) {
        visit_after(*each, each + 1, end, s, [&](const Entry& other) {
          if (boxes[each->number].overlaps(boxes[other.number])) visit(each->number, other.number);
        });
      }
    }
  }
  /** Calls visit(i, k) once for each box i and each of the others k that overlaps it. */
  template <class Visit>
  void visit_between(const Array<Box<D>>& boxes, const Array<Box<D>>& others, Visit visit) {
    if (boxes.empty() || others.empty()) return;
    choose_strips(boxes, others);
    fill(boxes, list_);
    fill(others, others_);
    const auto meet = [&](uint32_t i, uint32_t k) {
      if (boxes[i].overlaps(others[k])) visit(i, k);
    };
    for (uint32_t s = 0; s < strips_; ++s) {
      const Entry *a = list_.entries.data() + list_.first[s], *const a_end = list_.entries.data() + list_.first[s + 1];
      const Entry *b = others_.entries.data() + others_.first[s], *const b_end =
                                                                      others_.entries.data() + others_.first[s + 1];
      while (a < a_end && b < b_end) {
        if (a->key <= b->key) {
          visit_after(*a, b, b_end, s, [&](const Entry& other) { meet(a->number, other.number); });
          ++a;
        } else {
          visit_after(*b, a, a_end, s, [&](const Entry& other) { meet(other.number, b->number); });
          ++b;
        }
      }
    }
  }

 private:
  /** A box in a strip. Keys are in the order of coordinates along the axis of the sweep, but some are equal. */
  struct Entry {
    double low[D - 1], high[D - 1];  // along the other axes; the first is that of the strips
    uint32_t key, last_key, number, first_strip;
  };
  struct List {
    Array<Entry> entries;   // strip by strip
    Array<uint32_t> first;  // of each strip; one more at the end
    explicit List(const Memory* memory) : entries(memory), first(memory) {}
  };

  static uint32_t key_of(double x) noexcept {
    uint64_t bits;
    x += 0.0;  // -0 is 0
    std::memcpy(&bits, &x, sizeof bits);
    const uint64_t sign = uint64_t{1} << 63;
    bits = (bits & sign) != 0 ? ~bits : bits | sign;
    return static_cast<uint32_t>(bits >> 32);
  }
  uint32_t strip_of(double x) const noexcept {
    const double at = (x - low_) * scale_;
    return at >= strips_ - 1 ? strips_ - 1 : at > 0 ? static_cast<uint32_t>(at) : 0;
  }

  /** Calls visit for entries from a place on that begin within this one and overlap it, if this strip is the first of both. */
  template <class Visit>
  static void visit_after(const Entry& each, const Entry* from, const Entry* end, uint32_t strip, Visit visit) {
    for (; from < end && from->key <= each.last_key; ++from) {
      bool overlaps = (each.first_strip == strip) | (from->first_strip == strip);
      for (int k = 0; k < D - 1; ++k) overlaps &= (from->low[k] <= each.high[k]) & (from->high[k] >= each.low[k]);
      if (overlaps) visit(*from);
    }
  }

  /** How many of some pairs of boxes overlap along an axis. */
  static size_t overlaps_along(int k, const Array<Box<D>>& boxes, const Array<Box<D>>& others) noexcept {
    constexpr uint64_t kSamples = 24, kStride = 2654435761;
    size_t count = 0;
    for (uint64_t i = 0; i < kSamples; ++i) {
      const Box<D>& one = boxes[i * kStride % boxes.size()];
      for (uint64_t j = 0; j < kSamples; ++j) {
        const Box<D>& other = others[(i + kSamples * (j + 1)) * kStride % others.size()];
        count += (one.lower[k] <= other.upper[k]) & (other.lower[k] <= one.upper[k]);
      }
    }
    return count;
  }

  /** Axes along which few boxes overlap come first. Strips are twice as high as boxes in the mean. */
  void choose_strips(const Array<Box<D>>& boxes, const Array<Box<D>>& others) noexcept {
    size_t overlaps[D];
    for (int k = 0; k < D; ++k) {
      overlaps[k] = overlaps_along(k, boxes, others);
      axes_[k] = k;
    }
    dsw::sort(axes_, axes_ + D,
              [&](int a, int b) { return overlaps[a] != overlaps[b] ? overlaps[a] < overlaps[b] : a < b; });
    const int k = axes_[1];
    double lower = Box<D>::kInfinity, upper = -Box<D>::kInfinity, sizes = 0;
    for (const Array<Box<D>>* list : {&boxes, &others}) {
      for (const Box<D>& each : *list) {
        lower = std::min(lower, each.lower[k]);
        upper = std::max(upper, each.upper[k]);
        sizes += each.upper[k] - each.lower[k];
      }
      if (&boxes == &others) break;
    }
    const size_t count = &boxes == &others ? boxes.size() : boxes.size() + others.size();
    const double room = upper - lower, most = static_cast<double>(std::min(1 + count / 8, kMostStrips)),
                 wanted = std::min(most, room / (2 * sizes / static_cast<double>(count)));
    low_ = lower;
    scale_ = wanted / room;
    strips_ = wanted >= 2 && std::isfinite(scale_) && scale_ > 0 ? static_cast<uint32_t>(wanted) : 1;
  }

  void fill(const Array<Box<D>>& boxes, List& list) {
    const int along = axes_[0], across = axes_[1];
    order_.resize(boxes.size());
    list.first.assign(strips_ + 1, 0);
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      order_[i] = uint64_t{key_of(boxes[i].lower[along])} << 32 | i;
      const uint32_t last = strip_of(boxes[i].upper[across]);
      for (uint32_t s = strip_of(boxes[i].lower[across]); s <= last; ++s) ++list.first[s];
    }
    dsw::sort(order_.begin(), order_.end());
    uint32_t sum = 0;
    for (uint32_t& each : list.first) {
      const uint32_t count = each;
      each = sum;
      sum += count;
    }
    list.entries.resize(sum);
    for (const uint64_t each : order_) {
      const uint32_t number = static_cast<uint32_t>(each);
      const Box<D>& box = boxes[number];
      Entry entry;
      for (int k = 0; k < D - 1; ++k) {
        entry.low[k] = box.lower[axes_[k + 1]];
        entry.high[k] = box.upper[axes_[k + 1]];
      }
      entry.key = static_cast<uint32_t>(each >> 32);
      entry.last_key = key_of(box.upper[along]);
      entry.number = number;
      entry.first_strip = strip_of(box.lower[across]);
      const uint32_t last = strip_of(box.upper[across]);
      for (uint32_t s = entry.first_strip; s <= last; ++s) list.entries[list.first[s]++] = entry;
    }
    for (uint32_t s = strips_; s > 0; --s) list.first[s] = list.first[s - 1];
    list.first[0] = 0;
  }

  static constexpr size_t kMostStrips = 4096;
  Array<uint64_t> order_;  // keys and numbers
  List list_, others_;
  int axes_[D] = {};  // of the sweep, of the strips, and what is left
  double low_ = 0, scale_ = 0;
  uint32_t strips_ = 1;
};

}  // namespace dsw
