// Pairs that turn and are hard: those of moving_pair_cases.h with ways that share centres, places and turns with them.
#pragma once

#include <array>
#include <string>

#include "moving_pair_cases.h"
#include "predicates/turning_pair.h"

namespace dsw {

enum class TurningFamily {
  kRandom,         // everything drawn evenly
  kHinged,         // as they often are: turns of any angle about a point, and places that are near
  kStructured,     // small integers, and turns of 60, 90, 120 and 180 degrees
  kFlat,           // the same, turned in one plane: much touches all the time
  kPlanted,        // touches at the start, half way or at the end, but for rounding
  kGrazing,        // a point of a circle at a plane or an edge that touches the circle, but for rounding
  kTogether,       // both on one way, or on ways that differ in one number
  kOfMovingPairs,  // points of a family of moving_pair_cases.h
  kCount
};
const char* name_of(TurningFamily family);

template <int D>
struct TurningCase {
  MovingCase<D> points;
  std::array<TurningWay, 2> ways;
  std::array<bool, 2> turns;

  TurningPair<D> pair() const;
  std::string text() const;
};

// Which features turn: 1, 2, or 3 for both.
template <int D>
TurningCase<D> draw_turning(Random& random, TurningFamily family, PairKind kind, int turning);

// Moves one number to a neighbouring double.
template <int D>
void nudge(Random& random, TurningCase<D>& nudged);

}  // namespace dsw
