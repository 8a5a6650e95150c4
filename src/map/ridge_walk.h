#pragma once
// The way round a ridge from cell to cell: round an edge in space, in the plane round a vertex.

#include "map/map.h"

namespace dsw {

/** How a way round a ridge ends. */
enum class RidgeWalk { kAllRound, kStopped, kOutside, kTooLong };

/** From a facet at a ridge, into the cell that it belongs to, and on round the ridge.
 * @param leave leave(cell, entered) returns the other facet of the cell at the ridge, or an invalid one to stop.
 * @param most most cells. */
template <int D, class Leave>
RidgeWalk walk_round(const Map<D>& map, HalfFacet start, size_t most, Leave leave) {
  HalfFacet entered = start;
  for (size_t cells = 0; entered.valid(); ++cells) {
    if (cells == most) return RidgeWalk::kTooLong;
    const HalfFacet left = leave(map.cell_of(entered), entered);
    if (!left.valid()) return RidgeWalk::kStopped;
    entered = map.opposite(left);
    if (entered == start) return RidgeWalk::kAllRound;
  }
  return RidgeWalk::kOutside;
}

}  // namespace dsw
