#pragma once
// An axis-parallel box that grows. It is closed, so that what lies apart from it stays apart whatever the shift.

#include <algorithm>
#include <limits>

namespace dsw {

template <int D>
struct Box {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double lower[D], upper[D];

  Box() noexcept {
    std::fill_n(lower, D, kInfinity);
    std::fill_n(upper, D, -kInfinity);
  }

  static Box<D> everything() noexcept;
  void add(const double* point) noexcept {
    for (int k = 0; k < D; ++k) {
      lower[k] = point[k] < lower[k] ? point[k] : lower[k];
      upper[k] = upper[k] < point[k] ? point[k] : upper[k];
    }
  }
  void add(const Box<D>& other) noexcept {
    add(other.lower);
    add(other.upper);
  }
  bool empty() const noexcept { return !(lower[0] <= upper[0]); }
  bool contains(const double* point) const noexcept {
    for (int k = 0; k < D; ++k) {
      if (!(lower[k] <= point[k] && point[k] <= upper[k])) return false;
    }
    return true;
  }
  bool overlaps(const Box<D>& other) const noexcept {
    for (int k = 0; k < D; ++k) {
      if (!(lower[k] <= other.upper[k] && other.lower[k] <= upper[k])) return false;
    }
    return true;
  }
  /** Whether it overlaps the box of these points. */
  bool overlaps(const double* const* points, int count) const noexcept;
};

/** With some more room on all sides, and for rounding. No room: the box as it is. */
template <int D>
Box<D> widened(const Box<D>& box, double room) noexcept;

}  // namespace dsw
