// The first touch of a moving pair by integers. The volume of its points is a polynomial of degree 3 in time, and areas are
// of degree 2. Private to this folder.
//
// Coefficients are sums of products of coordinates, not of their differences: where coordinates are of very different sizes,
// a difference has thousands of bits, but a product of three doubles has 159. Let a point be at s at the start and at e at the end. A
// determinant of n points is the sum of (1-t)^(n-i) t^i times all determinants that take i points at their ends.
#pragma once

#include "predicates/exact_touch.h"
#include "predicates/moving_pair_small.h"
#include "predicates/term_sum.h"

namespace dsw {

template <int D>
class ExactPair : public ExactTouch<D, ExactPair<D>> {
 public:
  ExactPair(IntegerPool& pool, const MovingPair<D>& pair);

  // See kept_side.
  int kept_side();

  // What ExactTouch asks for.
  Polynomial difference(int axis, int i, int j) const;
  const Polynomial& area(int view, int triangle);
  Polynomial volume();

 private:
  using Base = ExactTouch<D, ExactPair<D>>;

  void add_determinant(TermSum (&sums)[4], int a, int b, int c, bool negative) const;

  Polynomial new_area(int view, int triangle);

  bool is_small_;
  SmallPoints<D> small_;    // where coordinates are short; else:
  int width_;               // bits of a coordinate
  Term term_[2][D + 1][D];  // start and end, points, axes
  Polynomial area_[Base::kViews][Base::kTriangles];
  bool has_area_[Base::kViews][Base::kTriangles] = {};
};

}  // namespace dsw
