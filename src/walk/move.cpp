#include "walk/move.h"

#include <algorithm>

#include "base/dimensions.h"
#include "predicates/plane_hit.h"
#include "walk/retreat.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** To a position that the cast reaches from the start, which is always free. */
template <int D>
void pull_back(const Environment<D>& env, const CastRequest& request, MoveResult<D>& result,
               CastCounters* counters) noexcept {
  CastRequest trial = request;
  trial.crossing = nullptr;
  trial.max_volumes = 0;
  const auto is_free = [&](const double* candidate) {
    trial.to = candidate;
    const CastResult free = cast(env, trial, counters);
    ++result.candidates;
    if (free.end == CastEnd::kReached) result.cell = free.cell;
    return free.end == CastEnd::kReached;
  };
  double target[D], time = result.time;
  std::copy(request.to, request.to + D, target);
  if (!result.work_limited) shorten<D>(request.from, target, &time, is_free);
  if (!retreat<D>(request.from, target, time, result.position, is_free)) result.cell = request.start;
}

}  // namespace

template <int D>
MoveResult<D> finish_move(const Environment<D>& env, const CastRequest& request, const CastResult& flight,
                          bool with_normal, CastCounters* counters) noexcept {
  MoveResult<D> result;
  result.cast = flight;
  result.cell = result.cast.cell;
  if (result.cast.end == CastEnd::kReached) {
    std::copy(request.to, request.to + D, result.position);
    return result;
  }
  if (result.cast.end == CastEnd::kHit) {
    const double* points[D];
    boundary_points(env, result.cast.cell, result.cast.simplex, points);
    if (with_normal) {
      const PlaneHit<D> hit = plane_hit<D>(request.from, request.to, points);
      result.time = hit.time;
      std::copy(hit.normal, hit.normal + D, result.normal);
    } else {
      result.time = crossing_time<D>(request.from, request.to, points);
    }
  } else {
    result.work_limited = true;
    const CastResult& stopped = result.cast;
    result.time =
        stopped.previous.valid() ? crossing_time(env, stopped.previous, stopped.simplex, request.from, request.to) : 0;
  }
  pull_back(env, request, result, counters);
  return result;
}

DSW_INSTANTIATE(finish_move);

}  // namespace dsw
