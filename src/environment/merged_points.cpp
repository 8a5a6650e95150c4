#include "environment/merged_points.h"

#include <cmath>
#include <cstring>

#include "base/dimensions.h"
#include "base/disjoint_sets.h"

namespace dsw {
namespace {

/** Where a point lies in a grid of boxes twice as wide as the distance. Numbers of boxes are doubles: beyond 2^53 two points
 * within the distance have equal coordinates, so neighbours that rounding makes one box are not missed. */
template <int D>
struct GridBox {
  double at[D];

  uint64_t hash() const noexcept {
    uint64_t mixed = 0;
    for (const double x : at) {
      uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      mixed = (mixed ^ (bits >> 29) ^ bits) * 0x9e3779b97f4a7c15u;
    }
    return mixed >> 24;
  }
  bool operator==(const GridBox& o) const noexcept {
    for (int k = 0; k < D; ++k) {
      if (at[k] != o.at[k]) return false;
    }
    return true;
  }
};

/** Points by their box: a chain for each hash. */
template <int D>
class Grid {
 public:
  Grid(const double* points, uint32_t count, double distance, const Memory* memory)
      : points_(points), distance_(distance), first_(memory), next_(count, kNone, memory) {
    size_t chains = 64;
    while (chains < count) chains *= 2;
    first_.assign(chains, kNone);
  }

  void add(uint32_t i) noexcept {
    uint32_t& first = chain(box_of(i));
    next_[i] = first;
    first = i;
  }
  /** Calls visit(j) for all that were added and are one with point i. */
  template <class Visit>
  void for_each_near(uint32_t i, Visit visit) const {
    const GridBox<D> home = box_of(i);
    GridBox<D> box = home;
    visit_boxes(i, home, box, 0, visit);
  }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;

  const double* point(uint32_t i) const noexcept { return points_ + size_t{i} * D; }
  GridBox<D> box_of(uint32_t i) const noexcept {
    GridBox<D> box;
    for (int k = 0; k < D; ++k) {
      const double x = point(i)[k];
      box.at[k] = (distance_ > 0 ? std::floor(x / distance_ / 2) : x) + 0.0;  // without -0
    }
    return box;
  }
  uint32_t& chain(const GridBox<D>& box) noexcept { return first_[box.hash() & (first_.size() - 1)]; }
  uint32_t chain(const GridBox<D>& box) const noexcept { return first_[box.hash() & (first_.size() - 1)]; }

  template <class Visit>
  void visit_boxes(uint32_t i, const GridBox<D>& home, GridBox<D>& box, int axis, Visit visit) const {
    if (axis == D) {
      for (uint32_t j = chain(box); j != kNone; j = next_[j]) {
        if (box_of(j) == box && are_one(i, j)) visit(j);
      }
      return;
    }
    for (const double step : {0.0, -1.0, 1.0}) {
      box.at[axis] = home.at[axis] + step;
      if (step != 0 && (!(distance_ > 0) || box.at[axis] == home.at[axis])) continue;
      visit_boxes(i, home, box, axis + 1, visit);
    }
  }
  bool are_one(uint32_t i, uint32_t j) const noexcept {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double d = point(i)[k] - point(j)[k];
      if (!(distance_ > 0) && d != 0) return false;
      const double share = distance_ > 0 ? d / distance_ : 0;
      sum += share * share;
    }
    return sum <= 1;
  }

  const double* points_;
  double distance_;
  Array<uint32_t> first_, next_;
};

}  // namespace

template <int D>
Array<uint32_t> merged_points(const double* points, uint32_t count, double distance, const Memory* memory) {
  Grid<D> grid(points, count, distance, memory);
  DisjointSets sets(count, memory);
  for (uint32_t i = 0; i < count; ++i) {
    grid.for_each_near(i, [&](uint32_t j) { sets.join(i, j); });
    grid.add(i);
  }
  Array<uint32_t> lowest(count, 0, memory);
  for (uint32_t i = 0; i < count; ++i) lowest[i] = sets.root(i);
  return lowest;
}

DSW_INSTANTIATE(merged_points);

}  // namespace dsw
