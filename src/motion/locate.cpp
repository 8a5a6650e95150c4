#include "motion/locate.h"

namespace dsw {
namespace {

/** Whether the closed box of a cell's vertices, which holds the cell, holds the point. */
template <int D>
bool box_holds(const Environment<D>& env, Cell c, const double* point) noexcept {
  const uint32_t n = env.map.vertices_of(c);
  bool above[D] = {}, below[D] = {};
  for (uint32_t i = 0; i < n; ++i) {
    const double* p = env.point(c, i);
    for (int k = 0; k < D; ++k) {
      above[k] = above[k] || p[k] >= point[k];
      below[k] = below[k] || p[k] <= point[k];
    }
  }
  for (int k = 0; k < D; ++k) {
    if (!above[k] || !below[k]) return false;
  }
  return true;
}

template <int D>
bool holds(const Environment<D>& env, uint32_t index, const double* point) noexcept {
  const Cell c = env.map.cell(index);
  return box_holds(env, c, point) && admits(env, c) && contains(env, c, point);
}

}  // namespace

template <int D>
LocateResult locate(const Environment<D>& env, const double* point, Cell hint, CastCounters* counters) noexcept {
  double from[D];
  if (hint.valid()) centre(env, hint, from);
  // The centre of a sliver can round to a point outside of it, from where no walk may start.
  if (hint.valid() && admits(env, hint) && (env.map.form(hint) != Form::kSimplex || contains(env, hint, from))) {
    CastRequest request{from, point, hint};
    request.through_walls = true;
    const CastResult walked = cast(env, request, counters);
    if (walked.end == CastEnd::kReached) return {walked.cell};
  }
  if (!env.grid.empty()) {
    size_t bucket = 0;
    if (!find_bucket(env.grid, env.upper, point, &bucket)) return {};
    for (uint32_t i = env.grid.first[bucket]; i < env.grid.first[bucket + 1]; ++i) {
      if (holds(env, env.grid.cells[i], point)) return {env.map.cell(env.grid.cells[i])};
    }
    return {};
  }
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    if (holds(env, i, point)) return {env.map.cell(i)};
  }
  return {};
}

template LocateResult locate(const Environment<2>&, const double*, Cell, CastCounters*) noexcept;
template LocateResult locate(const Environment<3>&, const double*, Cell, CastCounters*) noexcept;

}  // namespace dsw
