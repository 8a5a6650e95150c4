#pragma once
// Positions: D doubles, lent by a host or stored.

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/fp_rules.h"

namespace dsw {

/** Whether two positions have the same coordinates. */
template <int D>
inline bool is_same_place(const double* a, const double* b) noexcept {
  return a[0] == b[0] && a[1] == b[1] && (D == 2 || a[D - 1] == b[D - 1]);
}

/** To compare with others; overflows to infinity, which compares as it should. */
template <int D>
inline double distance_squared(const double* a, const double* b) noexcept {
  const double x = a[0] - b[0], y = a[1] - b[1], z = D == 3 ? a[D - 1] - b[D - 1] : 0;
  return (x * x + y * y) + z * z;
}

/** The largest magnitude of a coordinate of some points. */
template <int D, class... Points>
inline double largest_coordinate(const Points*... points) noexcept {
  double largest = 0;
  for (const double* const p : {points...}) {
    for (int k = 0; k < D; ++k) largest = std::max(largest, std::fabs(p[k]));
  }
  return largest;
}

/** The power of two that brings `largest` near 1, where its exponent is beyond `most`; 1 elsewhere, for bits to stay. */
inline double scale_to_one(double largest, int most) noexcept {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent > most || exponent < -most ? std::ldexp(1.0, std::clamp(-exponent, -1000, 1000)) : 1;
}

/** p + time * (q - p), rounded; also where q - p is too large for a double. `out` may be p or q. */
template <int D>
inline void point_at(const double* p, const double* q, double time, double* out) noexcept {
  for (int k = 0; k < D; ++k) {
    const double step = q[k] - p[k];
    out[k] = std::isfinite(step) ? p[k] + time * step : (1 - time) * p[k] + time * q[k];
  }
}

}  // namespace dsw
