#pragma once
// Pairs of boxes that have much in common, found in one go: boxes in the order of a curve that fills space, and boxes round
// runs of them.

#include <algorithm>
#include <cstdint>
#include <utility>

#include "environment/box_tree.h"

namespace dsw {

/** Two numbers of items, the lower one first. */
struct ItemPair {
  uint32_t low, high;
};

template <int D>
class BoxPairs {
 public:
  /** Takes `count` boxes, box_of(i). Pairs are those that have a length in common along all axes but one, and meet along that one. Two
   * intervals whose ends are less than `room` apart count as if they had a length in common. Throws std::bad_alloc. */
  template <class BoxOf>
  BoxPairs(const BoxOf& box_of, uint32_t count, double room, const Memory* memory)
      : room_(room), order_(memory), bounds_(memory), nodes_(memory), level_first_(memory) {
    if (count == 0) return;
    sort(box_of, count, memory);
    bounds_.reserve(count);
    for (const uint32_t i : order_) bounds_.push_back(bounds(box_of(i)));
    enclose(count);
  }

  /** Calls visit(i, j) once for each pair, in an order that no result may depend on. */
  template <class Visit>
  void for_each(Visit visit) const {
    if (order_.empty()) return;
    visit_within(static_cast<uint32_t>(level_first_.size() - 1), 0, visit);
  }

 private:
  static constexpr uint32_t kFan = 4;  // items of a node of level 0, nodes of another node
  static constexpr int kBits = D == 3 ? 21 : 31;
  struct Bounds {
    double lower[D], upper[D];
  };
  struct Keyed {
    uint64_t key;
    uint32_t item;
  };

  static uint64_t spread(uint64_t x) noexcept {
    if (D == 3) {
      x = (x | x << 32) & 0x001f00000000ffffu;
      x = (x | x << 16) & 0x001f0000ff0000ffu;
      x = (x | x << 8) & 0x100f00f00f00f00fu;
      x = (x | x << 4) & 0x10c30c30c30c30c3u;
      return (x | x << 2) & 0x1249249249249249u;
    }
    x = (x | x << 16) & 0x0000ffff0000ffffu;
    x = (x | x << 8) & 0x00ff00ff00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
    x = (x | x << 2) & 0x3333333333333333u;
    return (x | x << 1) & 0x5555555555555555u;
  }

  template <class BoxOf>
  void sort(const BoxOf& box_of, uint32_t count, const Memory* memory) {
    Bounds all = bounds(box_of(0));
    for (uint32_t i = 1; i < count; ++i) add(all, bounds(box_of(i)));
    double scale[D];
    for (int k = 0; k < D; ++k) {
      const double width = all.upper[k] / 2 - all.lower[k] / 2;
      scale[k] = width > 0 ? static_cast<double>((uint64_t{1} << kBits) - 1) / width : 0;
    }
    Array<Keyed> keyed(count, Keyed{}, memory), other(count, Keyed{}, memory);
    for (uint32_t i = 0; i < count; ++i) {
      uint64_t key = 0;
      const ClosedBox<D>& box = box_of(i);
      for (int k = 0; k < D; ++k) {
        const double middle = box.lower[k] / 4 + box.upper[k] / 4 - all.lower[k] / 2;
        const double at = std::min(std::max(middle * scale[k], 0.0), static_cast<double>((uint64_t{1} << kBits) - 1));
        key |= spread(at == at ? static_cast<uint64_t>(at) : 0) << k;
      }
      keyed[i] = {key, i};
    }
    sort_by_key(keyed, other);
    order_.resize(count);
    for (uint32_t i = 0; i < count; ++i) order_[i] = keyed[i].item;
  }
  static void sort_by_key(Array<Keyed>& items, Array<Keyed>& other) {
    constexpr int kDigit = 11;
    uint32_t places[1u << kDigit];
    for (int shift = 0; shift < 64; shift += kDigit) {
      std::fill(std::begin(places), std::end(places), 0u);
      for (const Keyed& each : items) ++places[each.key >> shift & ((1u << kDigit) - 1)];
      uint32_t sum = 0;
      for (uint32_t& place : places) sum += std::exchange(place, sum);
      for (const Keyed& each : items) other[places[each.key >> shift & ((1u << kDigit) - 1)]++] = each;
      items.swap(other);
    }
  }

  /** Level by level: nodes round items, nodes round these, up to one. */
  void enclose(uint32_t count) {
    level_first_.push_back(0);
    for (uint32_t first = 0; first < count; first += kFan) {
      Bounds all = bounds_[first];
      for (uint32_t i = first + 1; i < std::min(first + kFan, count); ++i) add(all, bounds_[i]);
      nodes_.push_back(all);
    }
    for (size_t below = 0; nodes_.size() - below > 1; below = level_first_.back()) {
      const size_t end = nodes_.size();
      level_first_.push_back(static_cast<uint32_t>(end));
      for (size_t first = below; first < end; first += kFan) {
        Bounds all = nodes_[first];
        for (size_t i = first + 1; i < std::min(first + kFan, end); ++i) add(all, nodes_[i]);
        nodes_.push_back(all);
      }
    }
  }
  static Bounds bounds(const ClosedBox<D>& box) noexcept {
    Bounds made;
    std::copy_n(box.lower, D, made.lower);
    std::copy_n(box.upper, D, made.upper);
    return made;
  }
  static void add(Bounds& all, const Bounds& one) noexcept {
    for (int k = 0; k < D; ++k) {
      all.lower[k] = std::min(all.lower[k], one.lower[k]);
      all.upper[k] = std::max(all.upper[k], one.upper[k]);
    }
  }
  bool may_pair(const Bounds& a, const Bounds& b) const noexcept {
    int apart = 0, touching = 0;
    for (int k = 0; k < D; ++k) {
      const double low = std::max(a.lower[k], b.lower[k]), high = std::min(a.upper[k], b.upper[k]) + room_;
      apart += low > high ? 1 : 0;
      touching += low < high ? 0 : 1;
    }
    return apart == 0 && touching <= 1;
  }

  uint32_t end_of(uint32_t level) const noexcept {
    return static_cast<uint32_t>(level + 1 < level_first_.size() ? level_first_[level + 1] : nodes_.size()) -
           level_first_[level];
  }
  const Bounds& node(uint32_t level, uint32_t i) const noexcept { return nodes_[level_first_[level] + i]; }
  /** One behind the last child of a node: a node of the level below, or an item. */
  uint32_t last_child(uint32_t level, uint32_t i) const noexcept {
    return std::min(kFan * (i + 1), level == 0 ? static_cast<uint32_t>(order_.size()) : end_of(level - 1));
  }

  template <class Visit>
  void visit_within(uint32_t level, uint32_t at, const Visit& visit) const {
    const uint32_t end = last_child(level, at);
    for (uint32_t i = kFan * at; i < end; ++i) {
      if (level != 0) visit_within(level - 1, i, visit);
      for (uint32_t j = i + 1; j < end; ++j) {
        if (level == 0) {
          visit_items(i, j, visit);
        } else if (may_pair(node(level - 1, i), node(level - 1, j))) {
          visit_between(level - 1, i, j, visit);
        }
      }
    }
  }
  /** Visits the pairs of two nodes of one level whose boxes pair. */
  template <class Visit>
  void visit_between(uint32_t level, uint32_t a, uint32_t b, const Visit& visit) const {
    const uint32_t end_a = last_child(level, a), end_b = last_child(level, b);
    for (uint32_t i = kFan * a; i < end_a; ++i) {
      if (!may_pair(level == 0 ? bounds_[i] : node(level - 1, i), node(level, b))) continue;
      for (uint32_t j = kFan * b; j < end_b; ++j) {
        if (level == 0) {
          visit_items(i, j, visit);
        } else if (may_pair(node(level - 1, i), node(level - 1, j))) {
          visit_between(level - 1, i, j, visit);
        }
      }
    }
  }
  template <class Visit>
  void visit_items(uint32_t at, uint32_t other, const Visit& visit) const {
    if (!may_pair(bounds_[at], bounds_[other])) return;
    const uint32_t i = order_[at], j = order_[other];
    i < j ? visit(i, j) : visit(j, i);
  }

  double room_;
  Array<uint32_t> order_;         // items along the curve
  Array<Bounds> bounds_, nodes_;  // of the items in this order; of nodes, level by level
  Array<uint32_t> level_first_;   // of each level in nodes_
};

}  // namespace dsw
