#pragma once
// Where a point is at a time of its way.

#include <algorithm>
#include <cmath>

#include "base/position.h"

namespace dsw {

/** Finds the point at a time of the way as point_at does, and gives both ends of the way to the bit. `place` may be one of
 * the ends. */
template <int D>
void point_on_way(const double* from, const double* to, double time, double* place) noexcept {
  if (time == 0 || time == 1) {
    std::copy_n(time == 0 ? from : to, D, place);
  } else {
    point_at<D>(from, to, time, place);
  }
}

/** Finds the point as point_on_way does, but never leaves the box of the whole way, for which obstacles were collected. */
template <int D>
void place_on_way(const double* from, const double* to, double time, double* place) noexcept {
  if (time == 0 || time == 1) return point_on_way<D>(from, to, time, place);
  double there[D];
  point_at<D>(from, to, time, there);
  for (int k = 0; k < D; ++k) {
    place[k] = std::clamp(there[k], std::min(from[k], to[k]), std::max(from[k], to[k]));
  }
}

/** Where a part of a step leads: p + fraction * step, both operations rounded. */
template <int D>
void place_of_step(const double* p, const double* step, double fraction, double* place) noexcept {
  for (int k = 0; k < D; ++k) place[k] = p[k] + fraction * step[k];
}

/** How far a rounded place can be beside the straight way between points whose largest coordinate this is, and more. A
 * place of a moving wall is as much beside its way; what its coordinates are larger, regions allow for. */
template <int D>
double room_of_rounding(const double* const* points, uint32_t count) noexcept {
  double largest = 0;
  for (uint32_t i = 0; i < count; ++i) largest = std::max(largest, largest_coordinate<D>(points[i]));
  return 0x1p-48 * largest;
}

}  // namespace dsw
