// First times of pairs that move or turn over GMP, exactly. Slow, and right by looking at it: it asks at each time that may be the
// first whether the features have a point in common, by dot and cross products of all coordinates.
#pragma once

#include "predicates/moving_pair.h"
#include "predicates/turning_pair.h"

namespace dsw {

// What first_touch must return. A pair is a MovingPair or a TurningPair.
template <class Pair>
FirstTouch true_first_touch(const Pair& pair);

// When a pair of which one feature has a way first touches if this feature is displaced a little: along x by 2^-300, and along each later
// axis by much less. So features touch at time 0 only if they do so on both sides of their plane, and what leaves does not touch.
template <int D>
FirstTouch true_first_entry(const TurningPair<D>& pair);

// Sign of a's first time minus b's. Both touch.
template <class Pair>
int true_compare(const Pair& a, const Pair& b);

// What kept_side must return.
template <int D>
int true_kept_side(const MovingPair<D>& points);

}  // namespace dsw
