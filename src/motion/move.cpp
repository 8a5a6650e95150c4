#include "motion/move.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/standard_facets.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

/** First step back from a contact: one unit in the last place of the largest coordinate, as a fraction of the move. */
template <int D>
double first_step(const double* p, const double* q) noexcept {
  double largest = 0, length = 0;
  for (int k = 0; k < D; ++k) {
    largest = std::max(largest, std::max(std::fabs(p[k]), std::fabs(q[k])));
    length = std::max(length, std::fabs(q[k] - p[k]));
  }
  const double ulp = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  const double step = std::isfinite(ulp) ? ulp / length : std::numeric_limits<double>::epsilon();
  return std::min(std::max(step, std::numeric_limits<double>::epsilon() / 2), 1.0);
}

/** Candidates recede from `time` by doubling steps; the first from which nothing impassable is met on the way is taken,
 * and after 60 of them the start, which is always free. */
template <int D>
void pull_back(const Environment<D>& env, const CastRequest& request, MoveResult<D>& result,
               CastCounters* counters) noexcept {
  CastRequest trial = request;
  trial.crossing = nullptr;
  trial.max_cells = 0;
  trial.to = result.position;
  double step = first_step<D>(request.from, request.to);
  double last[D];
  for (int tries = 0; tries < 60; ++tries, step *= 2) {
    const double t = result.time - step;
    if (!(t > 0)) break;
    point_at<D>(request.from, request.to, t, result.position);
    if (tries != 0 && std::equal(last, last + D, result.position)) continue;
    std::copy(result.position, result.position + D, last);
    ++result.candidates;
    const CastResult free = cast(env, trial, counters);
    if (free.end == CastEnd::kReached) {
      result.cell = free.cell;
      return;
    }
  }
  std::copy(request.from, request.from + D, result.position);
  result.cell = request.start;
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

template MoveResult<2> finish_move(const Environment<2>&, const CastRequest&, const CastResult&, bool,
                                   CastCounters*) noexcept;
template MoveResult<3> finish_move(const Environment<3>&, const CastRequest&, const CastResult&, bool,
                                   CastCounters*) noexcept;

}  // namespace dsw
