#pragma once
// Arrays of points as a host lends them, and the checks of what is in them. Messages name argument, position, value.

#include <cmath>
#include <cstddef>

#include "base/error.h"

namespace dsw {

/** Points at a fixed distance; `step` counts doubles. */
struct PointArray {
  const double* data = nullptr;
  size_t step = 0;
  const double* operator[](size_t i) const { return data + i * step; }
};

/** How messages name an argument: "target", or "targets[17]" when it is an array. */
struct ArgumentName {
  const char* name;
  bool indexed;
};

/** Text of an argument's name. */
struct ElementName {
  char text[64];
  ElementName(ArgumentName argument, size_t index) noexcept;
};

/** A point as messages give it: "(1, 2, 3)". */
struct PointText {
  char text[80];
  PointText(const double* point, int dimension) noexcept;
};

/** Of a point of D coordinates. */
template <int D>
bool is_finite(const double* point) noexcept {
  if constexpr (D == 3) {
    if (!std::isfinite(point[2])) return false;
  }
  return std::isfinite(point[0]) && std::isfinite(point[1]);
}

/** Index of the first point that is not finite, or `count`. */
size_t find_non_finite(PointArray points, size_t count, int dimension) noexcept;

/** Fails with NON_FINITE and names the coordinate. */
[[noreturn]] void fail_non_finite(PointArray points, size_t index, int dimension, ArgumentName argument);

/** Throws unless all points are finite. */
inline void check_finite(PointArray points, size_t count, int dimension, ArgumentName argument) {
  const size_t bad = find_non_finite(points, count, dimension);
  if (bad != count) fail_non_finite(points, bad, dimension, argument);
}

}  // namespace dsw
