#pragma once
// Lower bounds of distances between convex hulls of a few points. A bound is certified: it follows from one direction,
// and every rounding goes against it. So it holds however the direction was found.

#include <cstdint>

#include "base/vec.h"

namespace dsw {

/** The convex hull of one to six points: of a triangle at two times at most. */
struct ConvexHull {
  static constexpr uint32_t kMost = 6;
  const double* points[kMost] = {};
  uint32_t count = 0;
};

/** How far two hulls are apart. The bound can be of a second search (HullPair's `within`): the distance is not less than it. */
struct HullGap {
  double bound = 0;     // not more than the distance; 0 if nothing is certain
  double distance = 0;  // rounded, between the points below
  Vec normal;           // unit, rounded, from the second hull to the first: shows the bound. Zero if there is none
  double weights[ConvexHull::kMost] = {},
         other_weights[ConvexHull::kMost] = {};  // of the points that are nearest to each other, rounded
};

/** The search ends as soon as it is certain that the distance is `enough`, or nearly certain that it is less than
 * `least`; else when the bound is within 2^-31 of the distance, or within 2^-36 if the bound is below `least`. */
template <int D>
HullGap find_gap(const ConvexHull& a, const ConvexHull& b, double enough, double least) noexcept;

/** Whether it is certain that two hulls are that far apart. */
template <int D>
bool are_far_apart(const ConvexHull& a, const ConvexHull& b, double distance) noexcept {
  return find_gap<D>(a, b, distance, distance).bound >= distance;
}

/** Whether a few directions in doubles show that two hulls do not meet. Where they are close to each other it mostly says no. */
template <int D>
bool are_surely_apart(const ConvexHull& a, const ConvexHull& b) noexcept;

/** What one direction shows of the distances of two hulls at both ends of their ways. The direction is the one that shows most at the
 * start. Neither number is more than the distance. That at the start is less by at most 2^-48 of the distance and 2^-69 of the size. */
struct GapAtEnds {
  double start = 0, end = 0;
};

/** Computed in double-doubles: some twenty times as slow as find_gap.
 * @param start the hulls. @param end the same points at the end. */
template <int D>
GapAtEnds find_gap_at_ends(const ConvexHull (&start)[2], const ConvexHull (&end)[2]) noexcept;

/** How far the first point of a hull can go to `to`, as a share of the way, while the hull with all that this point has
 * passed keeps that distance. Rounded; 0 if it is too near from the start, 1 if it can go all the way.
 * @param at what holds at that time, if it is not 1. */
template <int D>
double time_apart(const ConvexHull& a, const double* to, const ConvexHull& b, double distance, HullGap* at) noexcept;

/** Whether it is certain that hull `a`, and all that its first point has passed, are at least `distance` apart from hull `b` when this point has
 * gone the share `time` of its way to `to`. Its place on the way is a double-double. */
template <int D>
bool are_far_apart_until(const ConvexHull& a, const double* to, double time, const ConvexHull& b,
                         double distance) noexcept;

}  // namespace dsw
