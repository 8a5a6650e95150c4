// The first touch of a moving pair by integers. The volume of its points is a polynomial of degree 3 in time, and areas are
// of degree 2. Private to this folder.
#pragma once

#include "predicates/exact_touch.h"

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
  Polynomial from_first_[D][D + 1];  // coordinates less those of point 0
  Polynomial area_[Base::kViews][Base::kTriangles];
  bool has_area_[Base::kViews][Base::kTriangles] = {};
};

}  // namespace dsw
