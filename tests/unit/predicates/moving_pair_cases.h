// Moving pairs that are hard: ties, near-ties, what lies in one plane or line, no extent, multiple and close zeros, and
// every scale that doubles have.
#pragma once

#include <array>
#include <string>

#include "cases.h"
#include "predicates/moving_pair.h"

namespace dsw {

template <int D>
struct MovingCase {
  PairKind kind;
  std::array<std::array<double, D>, D + 1> start, end;

  MovingPair<D> pair() const;
  // The coordinates exactly, as C++ reads them.
  std::string text() const;
};

enum class MovingFamily {
  kUniform,
  kLattice,
  kOnePlane,  // in space; in the plane one line
  kOneLine,
  kOneAxisPlane,
  kStanding,       // some points, or all
  kEqual,          // some points have one start, one end, or both
  kSingular,       // in one plane at all times, though the plane may turn; or without extent at all times
  kMultipleZeros,  // the volume is a product of linear functions, of which some have one zero
  kCloseZeros,     // the same with zeros within one double
  kZeroIsDouble,   // the same with a zero that is a double, and coordinates of many digits
  kTouchAtStart,
  kTouchAtEnd,
  kTouchBetween,  // at a time m/n, in the inside, on an edge or at a corner
  kNearMiss,      // one of the others, but one coordinate is the next double
  kRounded,       // one of the others, in coordinates that are rounded
  kHuge,          // one of the others, up to the largest double
  kTiny,          // one of the others, in multiples of the smallest
  kPerAxis,       // one of the others, each axis with a scale of its own
  kSpread,        // one of the others, each coordinate with a scale of its own
  kOffset,        // one of the others, far away
  kPointSet,      // a family of cases.h
  kCount
};
const char* name_of(MovingFamily family);

template <int D>
void draw(Random& random, MovingFamily family, PairKind kind, MovingCase<D>& drawn);

// Says the pair in other words: corners, ends, edges and axes in another order, axes reversed.
template <int D>
void rename(Random& random, MovingCase<D>& renamed);
// Moves one coordinate to a neighbouring double.
template <int D>
void nudge(Random& random, MovingCase<D>& nudged);
// Adds a multiple of one axis to another. The first time stays, unless sums are rounded.
template <int D>
void shear(Random& random, MovingCase<D>& sheared);

}  // namespace dsw
