#pragma once
// A tree of boxes over the cells of an environment, or over the obstacles at its cells: which cells may contain a
// point, and at which ones obstacles may be near it. Eight boxes make a group, and groups are sorted along a Hilbert
// curve. Eight cells with neighbouring indices make a group where they lie side by side, as they do in most meshes: then
// the tree is made five to eight times faster. All other cells are sorted along the curve one by one. Boxes are rounded to 16 bits
// an axis. Rounding is monotone, so no cell is lost by it.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "base/compiler.h"
#include "base/memory.h"
#include "base/nearest_first.h"
#include "base/parallel.h"
#include "map/map.h"

namespace dsw {

template <int D>
struct Environment;

/** What a cell's box holds: the cell, or the obstacles at it (obstacles.h). */
enum class BoxOf : uint32_t { kCell, kObstacles };

template <int D>
class CellTree {
 public:
  explicit CellTree(const Memory* memory, BoxOf content = BoxOf::kCell)
      : cells_(Allocator<uint32_t>(memory)), groups_(Allocator<Group>(memory)), content_(content), memory_(memory) {}

  /** Sorts the cells that there are and fits their boxes. Throws std::bad_alloc. O(cells), shared out. */
  void build(const Environment<D>& env, const Parallel& parallel);
  /** Sorts the cells with these indices and fits their boxes. Throws std::bad_alloc. O(cells). */
  void build(const Environment<D>& env, const Array<uint32_t>& cells);
  /** Fits all boxes to the points as they are now. O(cells), shared out over threads of our own. */
  void fit(const Environment<D>& env, const Parallel& parallel) noexcept;

  /** Calls look(index) for each cell of the tree whose box holds the point, and for some others. */
  template <class Look>
  void visit(const double* point, Look&& look) const noexcept {
    int16_t at[D];
    for (int k = 0; k < D; ++k) {
      if (!(point[k] >= lower_[k] && point[k] <= upper_[k])) return;
      at[k] = step(k, point[k]);
    }
    descend(at, at, [&](uint32_t cell) {
      look(cell);
      return true;
    });
  }
  /** Calls look(index) for each cell of the tree whose box overlaps a closed box, and for some others, until it returns
   * false; whether it never did. */
  template <class Look>
  bool visit_box(const double* lower, const double* upper, Look&& look) const {
    int16_t from[D], to[D];
    for (int k = 0; k < D; ++k) {
      if (!(upper[k] >= lower_[k] && lower[k] <= upper_[k])) return true;
      from[k] = step(k, lower[k]);
      to[k] = step(k, upper[k]);
    }
    return descend(from, to, look);
  }
  /** Calls look(index) for each cell of the tree whose box comes within `reach` of the point, and for some others.
   * Near boxes come first as a rule. `look` returns the reach from then on. False, and nothing is called: the point is
   * too far outside for these numbers. Distances to boxes are rounded down by more than the rounding errors of
   * distances in doubles, which are below 2^-40 of the length of the tree. */
  template <class Look>
  bool visit_near(const double* point, double reach, Look&& look) const {
    float at[D], weights[D];
    double coarsest = HUGE_VAL;
    for (int k = 0; k < D; ++k) {
      if (steps_per_unit_[k] > 0) coarsest = std::min(coarsest, steps_per_unit_[k]);
    }
    for (int k = 0; k < D; ++k) {
      const double place = (point[k] - lower_[k]) * steps_per_unit_[k] + INT16_MIN;
      if (!(std::fabs(place) < kFarthest)) return false;
      at[k] = static_cast<float>(place);
      weights[k] = steps_per_unit_[k] > 0 ? static_cast<float>(coarsest / steps_per_unit_[k]) : 0;
    }
    if (cells_.empty()) return true;
    const auto limit_of = [&](double distance) {  // in the longest steps; not less than 0 where that is no number
      const double steps = distance * coarsest;
      return steps > 0 ? static_cast<float>(std::min(1e9, 1.0001 * steps + 0.001)) : 0.001f;
    };
    visit_nearest_first<kMostLevels>(
        level_count_, limit_of(reach),
        [&](uint32_t level, uint32_t group, float* distances) {
          measure(groups_[level_first_[level] + group], at, weights, distances);
        },
        [&](uint32_t box, float) { return limit_of(look(cells_[box])); });
    return true;
  }
  const Array<uint32_t>& cells() const noexcept { return cells_; }
  /** The length of its diagonal. */
  double length() const noexcept {
    double square = 0;
    for (int k = 0; k < D; ++k) square += (upper_[k] - lower_[k]) * (upper_[k] - lower_[k]);
    return std::sqrt(square);
  }
  size_t cell_count() const noexcept { return cells_.size(); }
  uint64_t memory_bytes() const noexcept { return sizeof *this + array_bytes(cells_) + array_bytes(groups_); }

  std::atomic<uint64_t> version{0};       // of the points that the boxes are fitted to
  mutable std::atomic<uint64_t> wear{0};  // cells looked at because they are not in the tree
  size_t made_before = 0;                 // how many of the cells made since the first tree are in it
  CellTree* older = nullptr;              // may still be read

 private:
  static constexpr uint32_t kWidth = kBoxesInGroup, kMostLevels = 12;
  static constexpr int kLastStep = 65535;
  static constexpr double kFarthest = 1e6;  // steps, of which a float keeps a sixteenth

  /** A number for each of eight boxes: the processor compares them side by side. */
  using Lanes = ShortEight;
  /** Eight boxes. One that is not used has its lower bounds above its upper ones. */
  struct Group {
    Lanes lower[D], upper[D];
  };

  static Group nothing() noexcept {
    Group group;
    for (int k = 0; k < D; ++k) {
      group.lower[k] = eight_of(INT16_MAX);
      group.upper[k] = eight_of(INT16_MIN);
    }
    return group;
  }
  /** The box of a group. */
  struct Hull {
    int16_t lower[D], upper[D];

    explicit Hull(const Group& group) noexcept {
      for (int k = 0; k < D; ++k) {
        lower[k] = group.lower[k][0];
        upper[k] = group.upper[k][0];
        for (uint32_t i = 1; i < kWidth; ++i) {
          lower[k] = std::min<int16_t>(lower[k], group.lower[k][i]);
          upper[k] = std::max<int16_t>(upper[k], group.upper[k][i]);
        }
      }
    }
  };

  /** Monotone in x. An axis that cannot be divided in doubles has one step. */
  int16_t step(int k, double x) const noexcept {
    const double at = (x - lower_[k]) * steps_per_unit_[k];
    return static_cast<int16_t>(at >= kLastStep ? INT16_MAX : at > 0 ? static_cast<int>(at) + INT16_MIN : INT16_MIN);
  }
  /** Calls look(index) for the cells whose boxes overlap that of these steps, until it returns false. */
  template <class Look>
  bool descend(const int16_t* from, const int16_t* to, Look&& look) const {
    struct Node {
      uint32_t level, group;
    } nodes[kWidth * kMostLevels];
    uint32_t count = 0;
    if (cells_.empty()) return true;
    nodes[count++] = {level_count_ - 1, 0};
    while (count != 0) {
      const Node node = nodes[--count];
      uint32_t held = boxes_that_overlap(groups_[level_first_[node.level] + node.group], from, to);
      for (; held != 0; held &= held - 1) {
        const uint32_t box = node.group * kWidth + lowest_bit(held);
        if (node.level != 0) {
          prefetch_line(&groups_[level_first_[node.level - 1] + box]);
          nodes[count++] = {node.level - 1, box};
        } else if (!look(cells_[box])) {
          return false;
        }
      }
    }
    return true;
  }
  /** A bit for each of the boxes that are used and overlap a box. */
  static uint32_t boxes_that_overlap(const Group& group, const int16_t* from, const int16_t* to) noexcept {
    Lanes beyond = group.lower[0] > group.upper[0];
    for (int k = 0; k < D; ++k) beyond |= (group.lower[k] > eight_of(to[k])) | (group.upper[k] < eight_of(from[k]));
    const Lanes bits = ~beyond & Lanes{1, 2, 4, 8, 16, 32, 64, 128};
    int held = 0;
    for (uint32_t i = 0; i < kWidth; ++i) held |= bits[i];
    return static_cast<uint32_t>(held);
  }
  /** How far eight boxes are, in the longest steps. A step begins at its number and ends before the next one; half a
   * step more is left for rounding. Boxes that are not used are infinitely far. */
  static void measure(const Group& group, const float* at, const float* weights, float* distances) noexcept {
    float squares[kWidth] = {};
    for (int k = 0; k < D; ++k) {
      for (uint32_t i = 0; i < kWidth; ++i) {
        const float below = static_cast<float>(group.lower[k][i]) - 0.5f - at[k];
        const float above = at[k] - static_cast<float>(group.upper[k][i]) - 1.5f;
        const float gap = std::max(std::max(below, above), 0.0f) * weights[k];
        squares[i] += gap * gap;
      }
    }
    for (uint32_t i = 0; i < kWidth; ++i) {
      distances[i] = group.lower[0][i] > group.upper[0][i] ? HUGE_VALF : std::sqrt(squares[i]);
    }
  }
  struct Keys;

  void set_frame(const Environment<D>& env) noexcept;
  size_t set_levels() noexcept;
  void arrange(const Environment<D>& env, const Parallel& parallel);
  void group_neighbours(const Environment<D>& env, const Parallel& parallel, Keys& keys);
  void keep_neighbours(const Parallel& parallel, Keys& keys);
  void group_others(const Environment<D>& env, const Parallel& parallel, Keys& keys);
  void fit_group(const Environment<D>& env, size_t group) noexcept;
  void fit_upper(const Parallel& parallel);
  void put_in_order(Keys& keys) noexcept;
  size_t leaf_groups() const noexcept { return (cells_.size() + kWidth - 1) / kWidth; }

  Array<uint32_t> cells_;  // indices: those of group g of level 0 begin at 8 g
  Array<Group> groups_;    // of cells, of groups of cells, and so on; the last one is alone
  uint32_t level_first_[kMostLevels] = {};
  uint32_t level_count_ = 0;
  double lower_[D] = {}, upper_[D] = {}, steps_per_unit_[D] = {};  // box of all cells
  BoxOf content_;
  const Memory* memory_;
};

/** A tree that readers may still have looked at keeps those that it replaced. All of them go; null is allowed. */
template <int D>
void release_with_older(const Memory* memory, CellTree<D>* tree) noexcept {
  while (tree != nullptr) {
    CellTree<D>* const older = tree->older;
    tree->~CellTree();
    release_bytes(memory, tree, sizeof *tree, alignof(CellTree<D>));
    tree = older;
  }
}
template <int D>
uint64_t memory_bytes_with_older(const CellTree<D>* tree) noexcept {
  uint64_t sum = 0;
  for (; tree != nullptr; tree = tree->older) sum += tree->memory_bytes();
  return sum;
}

}  // namespace dsw
