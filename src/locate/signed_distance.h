#pragma once
// How far points are from the outer boundary of an environment, and on which side of it they are.

#include "locate/boundary_tree.h"
#include "locate/distances.h"

namespace dsw {

template <int D>
struct SignedDistance {
  double distance = HUGE_VAL;  // rounded; negative inside of the environment
  Vec way;                     // to the nearest place of the boundary, times the scale
  double scale = 1;
  Vec normal;       // unit, from there towards the point; zero on the boundary
  HalfFacet facet;  // there
};

/** The sign is exact: that of the point's place under the shift, where the point does not lie on the boundary. O(log n) expected
 * with a tree: the one that is given, or else that of obstacles, if there is one; O(n) without, and for points far beyond the
 * environment. Answers do not depend on that. */
template <int D>
SignedDistance<D> find_signed_distance(const Environment<D>& env, const double* point,
                                       const BoundaryTree<D>* boundary) noexcept;

}  // namespace dsw
