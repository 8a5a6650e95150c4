// First times of moving pairs over GMP, exactly. Slow, and right by looking at it: it asks at each time that may be the
// first whether the features have a point in common, by dot and cross products of all coordinates.
#pragma once

#include "predicates/moving_pair.h"

namespace dsw {

// What first_touch must return.
template <int D>
FirstTouch true_first_touch(const MovingPair<D>& pair);

// Sign of a's first time minus b's. Both touch.
template <int D>
int true_compare(const MovingPair<D>& a, const MovingPair<D>& b);

// What kept_side must return.
template <int D>
int true_kept_side(const MovingPair<D>& points);

}  // namespace dsw
