// The first touch of a pair that turns by integers. Private to this folder.
//
// All lengths are multiples of one power of two, as a turn mixes the axes, and so are all components of the quaternions of a
// way. What decides are the polynomials of turning_terms.h.
#pragma once

#include "predicates/exact_touch.h"
#include "predicates/turning_terms.h"

namespace dsw {

struct PolynomialNumbers {
  using Q = Polynomial;
  using X = Polynomial;
  using Y = Polynomial;
  using C = Polynomial;
  using Value = Polynomial;
};

template <int D, bool kTwo>
class ExactTurningPair : public ExactTouch<D, ExactTurningPair<D, kTwo>> {
 public:
  // With an axis, the feature that turns, of which there is one then, is displaced along it by some length.
  ExactTurningPair(IntegerPool& pool, const TurningPair<D>& pair, int displaced_along = -1);

  PairKind kind() const noexcept { return terms_.kind; }
  Polynomial difference(int axis, int i, int j) const;
  const Polynomial& area(int view, int triangle);
  Polynomial volume();

 private:
  using Base = ExactTouch<D, ExactTurningPair<D, kTwo>>;
  template <class Numbers>
  using Terms = std::conditional_t<kTwo, turning::TwoTurns<D, Numbers>, turning::OneTurn<D, Numbers>>;

  turning::Pair<D, Terms<PolynomialNumbers>> terms_;
  Polynomial area_[Base::kViews][Base::kTriangles];
  bool has_area_[Base::kViews][Base::kTriangles] = {};
};

}  // namespace dsw
