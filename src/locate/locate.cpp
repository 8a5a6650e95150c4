#include "locate/locate.h"

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
bool holds(const Environment<D>& env, Cell c, const double* point) noexcept {
  return c.valid() && box_holds(env, c, point) && admits(env, c) && contains(env, c, point);
}

/** The cell of a point, if a walk from a cell finds it. */
template <int D>
Cell walk(const Environment<D>& env, const double* point, Cell from, CastCounters* counters) noexcept {
  if (!admits(env, from)) return {};
  double start[D];
  centre(env, from, start);
  // The centre of a sliver can round to a point outside of it, from where no walk may start.
  if (env.map.form(from) == Form::kSimplex && !contains(env, from, start)) return {};
  CastRequest request{start, point, from};
  request.through_walls = true;
  const CastResult walked = cast(env, request, counters);
  return walked.end == CastEnd::kReached ? walked.cell : Cell{};
}

/** The cell of a point by the grid. Where cells have changed since it was built it proves nothing: a cell listed near the point is then
 * as good a start for a walk as any. */
template <int D>
Cell find_in_grid(const Environment<D>& env, const double* point, CastCounters* counters) noexcept {
  size_t bucket = 0;
  if (!find_bucket(env.grid, env.upper, point, &bucket)) return {};
  Cell near;
  for (uint32_t i = env.grid.first[bucket]; i < env.grid.first[bucket + 1]; ++i) {
    const Cell c = env.map.cell(env.grid.cells[i]);
    if (holds(env, c, point)) return c;
    if (c.valid()) near = c;
  }
  return env.map.has_changed() && near.valid() ? walk(env, point, near, counters) : Cell{};
}

}  // namespace

template <int D>
LocateResult locate(const Environment<D>& env, const double* point, Cell hint, CastCounters* counters) noexcept {
  Cell found;
  if (hint.valid()) found = walk(env, point, hint, counters);
  if (!found.valid() && !env.grid.empty()) {
    found = find_in_grid(env, point, counters);
    if (!env.map.has_changed()) return {found};
  }
  for (uint32_t i = 0, count = env.map.index_count(); !found.valid() && i < count; ++i) {
    if (holds(env, env.map.cell(i), point)) found = env.map.cell(i);
  }
  return {found};
}

template LocateResult locate(const Environment<2>&, const double*, Cell, CastCounters*) noexcept;
template LocateResult locate(const Environment<3>&, const double*, Cell, CastCounters*) noexcept;

}  // namespace dsw
