// The first touch of a moving pair by machine integers, where the coordinates of an axis span at most 60 bits from the lowest set
// bit to the highest. Private to this folder.
#pragma once

#include "predicates/moving_pair.h"
#include "predicates/polynomial.h"

namespace dsw {

constexpr int kMostSmallSpan = 60;

// Whether the answer is known: *first is it then. Else ExactPair must tell.
template <int D>
bool small_first_touch(const MovingPair<D>& pair, FirstTouch* first) noexcept;

// The polynomials of such a pair, which ExactTouch explains, with integers of any length as coefficients.
template <int D>
class SmallPoints {
 public:
  SmallPoints() = default;
  // `low` is that of integers::Span.
  SmallPoints(const MovingPair<D>& pair, const int (&low)[D]) noexcept : pair_(pair) {
    for (int k = 0; k < D; ++k) low_[k] = low[k];
  }

  Polynomial difference(IntegerPool& pool, int axis, int i, int j) const;
  Polynomial area(IntegerPool& pool, int view, int triangle) const;
  Polynomial volume(IntegerPool& pool) const;

 private:
  MovingPair<D> pair_;
  int low_[D];
};

}  // namespace dsw
