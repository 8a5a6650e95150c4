// A box of a level is at most as large as a cell, so that one which overlaps a given box is noted at most one cell
// below it. Cells' numbers come from coordinates times a power of two, rounded at most where that underflows: in order
// all the same, and that is what counts.

#include "body/box_grid.h"

#include <algorithm>
#include <cmath>

#include "base/position.h"
#include "base/slot_pool.h"

namespace dsw {
namespace {

// Least size of cells as a share of the coordinates, 2^-40: their numbers stay well below 2^50.
constexpr double kLeastShare = 0x1p-40, kFarthest = 0x1p50;
constexpr size_t kMostLevels = 2048;

}  // namespace

template <int D>
void BoxGrid<D>::reserve(size_t count) {
  if (count <= items_.size()) return;
  reserve_more(items_, count - items_.size());
  levels_.resize(std::max(levels_.size(), std::min(count, kMostLevels)));
  size_t heads = std::max<size_t>(heads_.size(), 8);
  while (heads < count) heads *= 2;
  if (heads != heads_.size()) {
    Array<uint32_t> fresh(heads, kEnd, heads_.get_allocator());
    heads_.swap(fresh);
    for (uint32_t i = 0; i < items_.size(); ++i) {
      if (items_[i].exponent != kNone) link(i, level_of(items_[i].exponent));
    }
  }
  items_.resize(count);
}

template <int D>
void BoxGrid<D>::put(uint32_t number, const Box<D>& box, double size) noexcept {
  Item& item = items_[number];
  const int32_t exponent = exponent_of(box, size);
  if (item.exponent == exponent) {
    // Most moves are short: it stays in its list.
    const Level& same = level_of(exponent);
    if (place_of(same, item.box) == place_of(same, box)) {
      item.box = box;
      return;
    }
  }
  remove(number);
  item.box = box;
  item.exponent = exponent;
  Level& level = level_of(exponent);
  ++level.count;
  link(number, level);
}

template <int D>
void BoxGrid<D>::remove(uint32_t number) noexcept {
  if (number >= items_.size() || items_[number].exponent == kNone) return;
  Item& item = items_[number];
  Level& level = level_of(item.exponent);
  uint32_t* at = &heads_[head_of(place_of(level, item.box), item.exponent)];
  while (*at != number) at = &items_[*at].next;
  *at = item.next;
  item = Item{};
  if (--level.count != 0) return;
  level = levels_[--level_count_];
}

template <int D>
void BoxGrid<D>::link(uint32_t number, const Level& level) noexcept {
  Item& item = items_[number];
  uint32_t& head = heads_[head_of(place_of(level, item.box), item.exponent)];
  item.next = head;
  head = number;
}

template <int D>
typename BoxGrid<D>::Level& BoxGrid<D>::level_of(int32_t exponent) noexcept {
  for (uint32_t k = 0; k < level_count_; ++k) {
    if (levels_[k].exponent == exponent) return levels_[k];
  }
  Level& fresh = levels_[level_count_++];
  fresh = {exponent, 0, std::ldexp(1.0, -exponent)};
  return fresh;
}

template <int D>
int32_t BoxGrid<D>::exponent_of(const Box<D>& box, double size) noexcept {
  for (int k = 0; k < D; ++k) size = std::max(size, box.upper[k] - box.lower[k]);
  size = std::max(size, largest_coordinate<D>(box.lower, box.upper) * kLeastShare);
  if (!(size < 0x1p1000)) return kHuge;  // kHuge - 1
  int exponent = kTiny;
  if (size > 0) std::frexp(size, &exponent);  // size < 2^exponent
  return std::max(exponent, kTiny);
}

/** The cells in which boxes that overlap this one are noted; everywhere if that is less work. */
template <int D>
typename BoxGrid<D>::Look BoxGrid<D>::find_range(const Level& level, const Box<D>& box, Range& range) const noexcept {
  if (level.exponent == kHuge) return Look::kEverywhere;
  double cells = 1;
  for (int k = 0; k < D; ++k) {
    const double low = box.lower[k] * level.inverse, high = box.upper[k] * level.inverse;
    if (low > kFarthest || high < -kFarthest) return Look::kNowhere;
    range.low[k] = floor_of(std::max(low, -kFarthest)) - 1;
    range.high[k] = floor_of(std::min(high, kFarthest));
    cells *= static_cast<double>(range.high[k] - range.low[k]) + 1;
  }
  return cells <= static_cast<double>(items_.size()) + 8 ? Look::kRange : Look::kEverywhere;
}

template <int D>
bool BoxGrid<D>::visit(const Box<D>& box, FunctionRef<bool(uint32_t)> visit) const {
  for (uint32_t k = 0; k < level_count_; ++k) {
    const Level& level = levels_[k];
    Range range{};
    const Look look = find_range(level, box, range);
    if (look == Look::kNowhere) continue;
    if (look == Look::kEverywhere) {
      for (uint32_t i = 0; i < items_.size(); ++i) {
        if (items_[i].exponent == level.exponent && items_[i].box.overlaps(box) && !visit(i)) return false;
      }
      continue;
    }
    Place at;
    for (at.x[0] = range.low[0]; at.x[0] <= range.high[0]; ++at.x[0]) {
      for (at.x[1] = range.low[1]; at.x[1] <= range.high[1]; ++at.x[1]) {
        for (at.x[2] = range.low[2]; at.x[2] <= range.high[2]; ++at.x[2]) {
          for (uint32_t i = heads_[head_of(at, level.exponent)]; i != kEnd; i = items_[i].next) {
            const Item& item = items_[i];
            if (item.exponent != level.exponent || !item.box.overlaps(box)) continue;
            // Other cells share the list.
            if (place_of(level, item.box) == at && !visit(i)) return false;
          }
        }
      }
    }
  }
  return true;
}

template class BoxGrid<2>;
template class BoxGrid<3>;

}  // namespace dsw
