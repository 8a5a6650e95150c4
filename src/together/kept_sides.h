#pragma once
// Whether a part of a body and a feature of the environment never meet, under the shift of the part.

#include "predicates/moving_pair.h"

namespace dsw {

/** The determinant of the points of a pair is affine in each of them. Its sign under the shift of the part, if it is the same
 * for all choices of start or end of each point; else 0. With a sign it is never 0, and the two never meet.
 * @param part_count how many of the points are the part's.
 * @param part_first whether these come first. */
template <int D>
int side_kept(const MovingPair<D>& pair, uint32_t part_count, bool part_first) noexcept;

template <int D>
bool keeps_sides(const MovingPair<D>& pair, uint32_t part_count, bool part_first) noexcept {
  return side_kept(pair, part_count, part_first) != 0;
}

}  // namespace dsw
