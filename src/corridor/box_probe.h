#pragma once
// Boxes that hold nothing impassable: what a body sweeps inside of one is free, whatever it is. Found out by
// comparisons alone, in hexahedra, which are often larger than what is swept.

#include <cstdint>

#include "environment/environment.h"

namespace dsw {

/** The box of some points, in space with room for a fourth coordinate, which lies inside of all boxes. */
template <int D>
struct Bounds {
  double low[D == 3 ? 4 : 2] = {}, high[D == 3 ? 4 : 2] = {};

  explicit Bounds(const double* x) noexcept {
    for (int k = 0; k < D; ++k) low[k] = high[k] = x[k];
  }
  void include(const double* x) noexcept {
    for (int k = 0; k < D; ++k) {
      low[k] = x[k] < low[k] ? x[k] : low[k];
      high[k] = high[k] < x[k] ? x[k] : high[k];
    }
  }
};

template <int D, class... Points>
Bounds<D> bounds(const double* first, Points... others) noexcept {
  Bounds<D> box(first);
  (box.include(others), ...);
  return box;
}

/** Floods a box as SweepFlood does what is swept; one for each thread. The flood of anything inside of the box enters
 * only cells that this one enters, if it starts in one of them, and meets only what this one meets. */
template <int D>
class BoxProbe;

template <>
class BoxProbe<3> {
 public:
  explicit BoxProbe(const Environment<3>& env) noexcept : env_(env) {}

  /** Whether it looks at cells like this one at all. */
  static bool suits(const Environment<3>& env, Cell c) noexcept { return env.map.form(c) == Form::kBox; }

  /** Whether no obstacle is met in the box, from `start`, which is passable. False also where that would take long to
   * find out: at other cells than hexahedra, and in a box that meets more than eight. */
  bool is_free(const Bounds<3>& box, Cell start) noexcept;

  /** Whether the last flood entered a cell. */
  bool has_entered(Cell c) const noexcept {
    bool found = false;
    for (uint32_t i = 0; i < count_; ++i) found = found || cells_[i] == c;
    return found;
  }

 private:
  static constexpr uint32_t kMost = 8;  // as many as meet in a vertex of a lattice

  bool enter(Cell c) noexcept;
  bool enter_neighbours(const Bounds<3>& box, Cell c) noexcept;

  const Environment<3>& env_;
  Cell cells_[kMost];
  uint32_t count_ = 0;
};

/** Says nothing: in the plane an edge's corridor tells as much sooner. Measured with boxes of eight polygons, moves of
 * edges that are 0.2 to 2 cells long took up to 1.7 times as long. */
template <>
class BoxProbe<2> {
 public:
  explicit BoxProbe(const Environment<2>&) noexcept {}
  static bool suits(const Environment<2>&, Cell) noexcept { return false; }
  bool is_free(const Bounds<2>&, Cell) noexcept { return false; }
  bool has_entered(Cell) const noexcept { return false; }
};

/** The facets of a hexahedron that may meet a box, a bit each: no side of it has all of their vertices strictly beyond,
 * so that no shift could bring them together. */
using FacetsInBox = uint32_t (*)(const double* points, const uint32_t* vertices, const Bounds<3>& box) noexcept;
uint32_t facets_in_box(const double* points, const uint32_t* vertices, const Bounds<3>& box) noexcept;
uint32_t facets_in_box_avx2(const double* points, const uint32_t* vertices, const Bounds<3>& box) noexcept;

}  // namespace dsw
