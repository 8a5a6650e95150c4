#include "cutting/start.h"

#include "motion/locate.h"

namespace dsw {
namespace {

/** The point of the blade nearest to another one. */
void nearest_point(const Blade& blade, const double* from, double* out) {
  Vec best;
  double least = HUGE_VAL;
  for (uint32_t t = 0; t < blade.triangle_count(); ++t) {
    const double* corners[3];
    blade.corners(t, corners);
    const Vec way = to_triangle(from, corners);
    const double distance = length(way);
    if (!(distance < least)) continue;
    least = distance;
    best = way;
  }
  store(to_vec(from) + best, out);
}

}  // namespace

Cell find_start(const Environment<3>& env, const Blade& blade, Cell hint, uint32_t* visited) {
  if (!hint.valid()) {
    for (uint32_t i = 0; i < blade.point_count(); ++i) {
      const Cell found = locate(env, blade.points[i], {}, nullptr).cell;
      if (found.valid()) return found;
    }
    return {};
  }
  Crossings crossings(env, blade);
  if (crossings.is_met(hint)) return hint;
  double from[3], to[3];
  centre(env, hint, from);
  nearest_point(blade, from, to);
  if (!admits(env, hint) || !contains(env, hint, from) || !is_finite(to)) return {};
  CastRequest request{from, to, hint};
  request.through_walls = true;
  const CastResult walk = cast(env, request, nullptr);
  *visited += walk.cells_visited;
  if (crossings.is_met(walk.cell)) return walk.cell;
  // The way was rounded: it can end before the blade.
  for (uint32_t f = 0, facets = env.map.facets_of(walk.cell); f < facets; ++f) {
    const HalfFacet o = env.map.opposite(env.map.half_facet(walk.cell, f));
    if (o.valid() && crossings.is_met(env.map.cell_of(o))) return env.map.cell_of(o);
  }
  return {};
}

}  // namespace dsw
