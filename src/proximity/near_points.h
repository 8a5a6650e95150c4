#pragma once
// Where two simplices are nearest to each other, in doubles, if it is known that the nearest points lie inside of both.

#include <cstdint>

#include "base/vec.h"

namespace dsw {

/** Where two simplices are nearest, and in which direction. */
struct NearPoints {
  double weights[3] = {1, 0, 0}, obstacle_weights[3] = {1, 0, 0};
  Vec point, obstacle_point, normal;
  double distance = 0;
  bool has_normal = true;  // else the points are too close to tell it
};

/** Finds the nearest points of a part with the points p and an obstacle with the points a. One of the two is a single
 * point, or both are edges of space. */
template <int D>
NearPoints find_near_points(const double* const* p, uint32_t count, const double* const* a, uint32_t obstacle_count);

}  // namespace dsw
