// The first touch of a moving pair by integers. Private to this folder.
//
// Four points of a pair that touches lie in one plane: their volume, a polynomial of degree 3 in time, is 0. Project the
// points along an axis. If one of their four triangles has an area there, the projection of the plane is one-to-one. Then
// the signs of the areas, polynomials of degree 2, say whether the pair touches. If no triangle has an area along any
// axis, all points are on one line, and the coordinates decide: the pair is apart if it is apart on one axis. In the plane
// this begins one dimension lower, with the area of the three points.
//
// If the volume is always 0, the first touch is at time 0 or at a root of one of the areas, or of one of the differences of
// coordinates if all areas are always 0.
#pragma once

#include "predicates/moving_pair.h"
#include "predicates/polynomial.h"

namespace dsw {

template <int D>
class ExactPair {
 public:
  ExactPair(IntegerPool& pool, const MovingPair<D>& pair);

  // Whether the pair touches; first is then the first time.
  bool find_first(Root* first);

  // See kept_side.
  int kept_side();

 private:
  static constexpr int kViews = D == 3 ? 3 : 1;  // axes along which areas are seen
  static constexpr int kTriangles = D == 3 ? 4 : 1;

  Polynomial difference(int axis, int i, int j) const;  // coordinate of point j less that of point i
  const Polynomial& area(int view, int triangle);
  Polynomial volume();
  bool touches(const Root& time);
  bool touches_in_line(const Root& time) const;
  bool find_first_root(const Polynomial& p, Root* first);
  bool find_first_change(Root* first);
  void consider(const Polynomial& p, bool* found, Root* first);

  IntegerPool& pool_;
  PairKind kind_;
  Polynomial from_first_[D][D + 1];  // coordinates less those of point 0
  Polynomial area_[kViews][kTriangles];
  bool has_area_[kViews][kTriangles] = {};
};

}  // namespace dsw
