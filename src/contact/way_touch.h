#pragma once
// What is touched while all points move at once.

#include "corridor/candidates.h"
#include "predicates/moving_pair.h"
#include "proximity/partners.h"

namespace dsw {

/** A part that moves, and what it touches. */
template <int D>
struct WayTouch {
  MovingPair<D> pair;
  FirstTouch first;
  uint32_t trajectory;  // that moves
  Simplex part;         // its part
  bool comes_first;     // whether its points are the first of the pair
  // What it touches: the number of a body that moves, else kNone; and the body, or null for the environment.
  uint32_t other_trajectory = kNone;
  const Partner<D>* other = nullptr;
  Simplex other_part{};
  WallFeature wall{};
};

/** Adds a touch to what is touched first, all at the same exact time, unless it is later. Throws std::bad_alloc and
 * WorkOver. */
template <int D>
void add_first(const WayTouch<D>& touch, Array<WayTouch<D>>& first, PairWork* work) {
  if (!first.empty()) {
    const int order = compare_first_touches<D>(touch.pair, touch.first, first[0].pair, first[0].first, work);
    if (order > 0) return;
    if (order < 0) first.clear();
  }
  first.push_back(touch);
}

}  // namespace dsw
