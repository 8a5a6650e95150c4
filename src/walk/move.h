#pragma once
// A particle's move: a cast, and at a contact the search for a position that is verified free.

#include "base/position.h"
#include "walk/cast.h"

namespace dsw {

template <int D>
struct MoveResult {
  CastResult cast;          // of the flight to the target
  double time = 1;          // 1; at a contact floor of the exact time; at a work limit not later than the last crossing
  double position[D] = {};  // verified: the segment from `from` to it meets nothing impassable
  double normal[D] = {};    // at a contact, if asked for: unit, out of the obstacle
  Cell cell;                // contains `position` under the shift
  uint32_t candidates = 0;  // positions tried
  bool work_limited = false;
};

/** The move of a point, of which `flight` was the cast; `request.from` lies in `request.start`. The cell and position
 * of the result are always valid; in the worst case they are those of the start. */
template <int D>
MoveResult<D> finish_move(const Environment<D>& env, const CastRequest& request, const CastResult& flight,
                          bool with_normal, CastCounters* counters) noexcept;

}  // namespace dsw
