#pragma once
// A tree of boxes over the cells of an environment: which cells may contain a point. Cells are sorted along a
// Hilbert curve, and eight boxes make a group. Boxes are rounded to 16 bits an axis. Rounding is monotone, so no
// cell is lost by it.

#include <atomic>
#include <cstdint>

#include "base/memory.h"
#include "map/map.h"

namespace dsw {

template <int D>
struct Environment;

template <int D>
class CellTree {
 public:
  explicit CellTree(const Memory* memory)
      : cells_(Allocator<uint32_t>(memory)), groups_(Allocator<Group>(memory)), memory_(memory) {}

  /** Sorts the cells that there are and fits their boxes. Throws std::bad_alloc. O(cells). */
  void build(const Environment<D>& env);
  /** Fits all boxes to the points as they are now. O(cells). */
  void fit(const Environment<D>& env) noexcept;

  /** Calls look(index) for each cell of the tree whose box holds the point, and for some others. */
  template <class Look>
  void visit(const double* point, Look&& look) const noexcept {
    int16_t at[D];
    for (int k = 0; k < D; ++k) {
      if (!(point[k] >= lower_[k] && point[k] <= upper_[k])) return;
      at[k] = step(k, point[k]);
    }
    struct Node {
      uint32_t level, group;
    } nodes[kWidth * kMostLevels];
    uint32_t count = 0;
    nodes[count++] = {level_count_ - 1, 0};
    while (count != 0) {
      const Node node = nodes[--count];
      uint32_t held = boxes_that_hold(groups_[level_first_[node.level] + node.group], at);
      for (; held != 0; held &= held - 1) {
        const uint32_t child = node.group * kWidth + static_cast<uint32_t>(__builtin_ctz(held));
        if (node.level != 0) {
          __builtin_prefetch(&groups_[level_first_[node.level - 1] + child]);
          nodes[count++] = {node.level - 1, child};
        } else {
          look(cells_[child]);
        }
      }
    }
  }
  size_t cell_count() const noexcept { return cells_.size(); }
  uint64_t memory_bytes() const noexcept { return sizeof *this + array_bytes(cells_) + array_bytes(groups_); }

  std::atomic<uint64_t> version{0};       // of the points that the boxes are fitted to
  mutable std::atomic<uint64_t> wear{0};  // cells looked at because they are not in the tree
  size_t made_before = 0;                 // how many of the cells made since the first tree are in it
  CellTree* older = nullptr;              // may still be read

 private:
  static constexpr uint32_t kWidth = 8, kMostLevels = 12;
  static constexpr int kLastStep = 65535;

  /** A number for each of eight boxes: the processor compares them side by side. */
  using Lanes = int16_t __attribute__((vector_size(2 * kWidth)));
  /** Eight boxes. One that is not used has its lower bounds above its upper ones. */
  struct Group {
    Lanes lower[D], upper[D];
  };

  /** Monotone in x. An axis that cannot be divided in doubles has one step. */
  int16_t step(int k, double x) const noexcept {
    const double at = (x - lower_[k]) * steps_per_unit_[k];
    return static_cast<int16_t>(at >= kLastStep ? INT16_MAX : at > 0 ? static_cast<int>(at) + INT16_MIN : INT16_MIN);
  }
  /** A bit for each of the boxes that hold a place. */
  static uint32_t boxes_that_hold(const Group& group, const int16_t* at) noexcept {
    Lanes beyond = {};
    for (int k = 0; k < D; ++k) {
      const Lanes place = at[k] - Lanes{};
      beyond |= (group.lower[k] > place) | (group.upper[k] < place);
    }
    const Lanes bits = ~beyond & Lanes{1, 2, 4, 8, 16, 32, 64, 128};
    int held = 0;
    for (uint32_t i = 0; i < kWidth; ++i) held |= bits[i];
    return static_cast<uint32_t>(held);
  }
  void set_frame(const Environment<D>& env) noexcept;
  void sort_cells(const Environment<D>& env);

  Array<uint32_t> cells_;  // indices
  Array<Group> groups_;    // of cells, of groups of cells, and so on; the last one is alone
  uint32_t level_first_[kMostLevels] = {};
  uint32_t level_count_ = 0;
  double lower_[D] = {}, upper_[D] = {}, steps_per_unit_[D] = {};  // box of all cells
  const Memory* memory_;
};

}  // namespace dsw
