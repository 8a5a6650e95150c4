#pragma once
// Two hulls side by side, for the search in doubles and the one in double-doubles. Private to this folder.

#include <limits>

#include "predicates/hull_gap.h"

namespace dsw {

/** The difference of a point of each hull. */
struct HullCorner {
  Vec at;
  uint32_t a, b;
};

/** A direction, and how far it shows the hulls to be apart. */
struct HullDirection {
  double bound = 0;
  Vec direction = Vec::Zero();
};

/** Two hulls as differences from a point of the second, in a power of two as unit: coordinates are at most 1. Each is
 * rounded once, a place with a rest twice. */
template <int D>
class HullPair {
 public:
  /** @param rest null, or where the last point of the first hull lies beside its rounded place.
   * @param within points of the first hull that are farther are drawn nearer, straight to the first point of the second one. A direction
   * that shows the drawn hulls apart shows as much of the hulls themselves: what comes back moves away from that point. */
  HullPair(const ConvexHull& a, const ConvexHull& b, const double* rest = nullptr,
           double within = std::numeric_limits<double>::infinity()) noexcept;

  bool is_finite() const noexcept { return is_finite_; }
  double unit() const noexcept { return unit_; }
  const ConvexHull& hull_a() const noexcept { return hull_a_; }
  const ConvexHull& hull_b() const noexcept { return hull_b_; }
  const double* rest() const noexcept { return rest_; }
  HullCorner corner(uint32_t i, uint32_t k) const noexcept { return {a_[i] - b_[k], i, k}; }
  /** Magnitudes: of the largest coordinates of both. */
  const Vec& most() const noexcept { return most_; }
  /** The corner that lies least far in a direction. */
  HullCorner support(const Vec& direction) const noexcept;
  /** A lower bound of how far the first hull lies beyond the second in a direction, in units. */
  double bound_in(const Vec& direction) const noexcept;

 private:
  ConvexHull hull_a_, hull_b_;
  const double* rest_;
  bool is_finite_ = false;
  double unit_ = 1;
  Vec a_[ConvexHull::kMost], b_[ConvexHull::kMost];
  Vec most_ = Vec::Zero();
};

/** Finds the direction in which the hulls are farthest apart. It tries all that can be: normals of faces, common
 * normals of edges, ways from vertices across edges and to vertices. All is computed in double-doubles, so a bound
 * loses 2^-49 of itself and some 2^-70 of the size. Some twenty times as slow as a search. */
template <int D>
HullDirection look_everywhere(const HullPair<D>& pair) noexcept;

/** Looks everywhere, and tells what the best direction shows of the hulls at another time: there with as many digits.
 * @param end of the same points. */
template <int D>
GapAtEnds look_at_ends(const HullPair<D>& start, const HullPair<D>& end) noexcept;

/** The weights of the points that are nearest to each other, found with the same digits. */
template <int D>
void find_points(const HullPair<D>& pair, HullGap& gap) noexcept;

}  // namespace dsw
