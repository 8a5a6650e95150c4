// One cast from its start to its end; see cast.h. Included once for each instruction set, in a namespace of its own, after
// the headers it needs: nothing that another translation unit might share is compiled for a machine it may not run on.

// Each needs the one before.
// clang-format off
#include "motion/lanes.inl"
#include "motion/box.inl"
#include "motion/simplex.inl"
#include "motion/exit.inl"
// clang-format on

/** One bit of 64 for a cell. All visited cells' bits together say "never entered before" for certain; the opposite is only a
 * suspicion, which costs a comparison of times and nothing else. */
inline uint64_t visit_bit(Cell c) { return uint64_t{1} << ((c.unit * 0x9e3779b1u) >> 26); }

template <int D, class Tally>
CastResult walk(const Environment<D>& env, const CastRequest& request, Tally tally) noexcept {
  const Map<D>& map = env.map;
  ExitFinder<D, Tally> finder(env, request.from, request.to, tally);
  CastResult result;
  result.cell = request.start;
  Entry entry;
  uint64_t visited = visit_bit(request.start);
  uint32_t forecast = request.forecast;
  for (;;) {
    const Exit exit = finder.find(result.cell, entry, forecast);
    if (result.cells_visited == 1) result.first_facet = exit.facet;
    if (exit.facet == kStays) return result;
    const HalfFacet h = map.half_facet(result.cell, exit.facet), o = map.opposite(h);
    const Cell next = o.valid() ? map.cell_of(o) : Cell{};
    if (!o.valid() || (!request.through_walls && (map.facet_marked(h) || map.marked(next)))) {
      result.end = CastEnd::kHit;
      result.facet = h;
      result.simplex = exit.simplex;
      return result;
    }
    if (result.cells_visited == request.max_cells) {  // cells_visited is never 0, so 0 is no limit
      result.end = CastEnd::kWorkLimit;
      result.simplex = entry.simplex;
      return result;
    }
    if (request.crossing != nullptr) request.crossing(request.crossing_user, result.cell, exit.simplex, next);
    entry = {(visited & visit_bit(next)) != 0, result.cell, exit.simplex, o};
    visited |= visit_bit(next);
    forecast = kNoFacet;
    result.previous = result.cell;
    result.cell = next;
    ++result.cells_visited;
  }
}

template <int D>
CastResult walk_plain(const Environment<D>& env, const CastRequest& request) noexcept {
  return walk(env, request, CountNothing{});
}
template <int D>
CastResult walk_counted(const Environment<D>& env, const CastRequest& request, CastCounters* counters) noexcept {
  const CastResult result = walk(env, request, CountAll{counters});
  ++counters->casts;
  counters->cells_visited += result.cells_visited;
  return result;
}
template <int D>
bool contains(const Environment<D>& env, Cell cell, const double* centre, const double* point) noexcept {
  CountNothing nothing;
  return ExitFinder<D, CountNothing>(env, centre, point, nothing).contains(cell);
}
template <int D>
Walk<D> this_walk() noexcept {
  return {walk_plain<D>, walk_counted<D>, contains<D>};
}
