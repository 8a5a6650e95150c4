// On which side a line through two points passes a ridge is affine in each of the points. So if the lines through all
// choices of start or end of both ends pass all facets of a corridor, the edge's line passes them at all times. It then
// crosses the cells between these facets one after the other, each from facet to facet. The ends are in cells of the
// corridor at all times, so the edge is, too.
//
// If a path is blocked, this holds until its end passes the wall. What comes after that is of no use.
//
// An end that goes to the next cell of the corridor leaves it shorter. One that goes elsewhere makes it longer. The lines
// are compared with the longer corridor. If the edge may leave it, `ridge_rings.h` finds what the edge may touch.

#include "corridor/moving_corridors.h"

#include "base/dimensions.h"
#include "walk/standard_facets.h"

namespace dsw {

/** Writes the facets that a vertex passes on its way to a place. If the path is blocked, there may be more of them. False:
 * a cell at an end of the path is not known to be convex. */
template <int D>
bool MovingCorridors<D>::find_path(const PointWay& end, const double* place, Array<uint32_t>& path) {
  const Map<D>& map = env_.map;
  const Cell from = end.from, to = end.arrival;
  const auto suits = [&](Cell c) { return map.convex(c) && !is_closed(env_, c); };
  path.clear();
  if (!suits(from)) return false;
  if (from == to) return true;
  const PathFacets& crossed = end.crossed;
  if (crossed.is_known) {
    for (uint32_t i = 0; i < crossed.count; ++i) path.push_back(crossed.facets[i].word);
  } else {
    if (!cast_path(end.start, place, from, to)) return false;
    path = writer_.passed();
  }
  return path.empty() || suits(map.cell_of(map.opposite({path.back()})));
}

/** Casts a segment, and notes the facets that it passes. True: the segment is free, and it ends in `end`, if that is
 * valid. */
template <int D>
bool MovingCorridors<D>::cast_path(const double* from, const double* to, Cell start, Cell end) {
  do {
    if (!writer_.cast_segment(env_, from, to, start, end, counters)) return false;
  } while (!writer_.had_room());
  return true;
}

/** Whether a corridor leads from the cell of one end to that of the other. */
template <int D>
bool MovingCorridors<D>::is_of(const Corridor<D>& corridor, const PointWay& a, const PointWay& b) const {
  if (!corridor.known()) return false;
  if (corridor.facets.empty()) return a.from == b.from;
  return corridor.portal.version == env_.obstacle_version && corridor.portal.front == a.from &&
         corridor.portal.back == b.from;
}

/** Notes the corridor of the edge where it starts. */
template <int D>
bool MovingCorridors<D>::note_start(Corridor<D>& corridor, uint64_t call, const PointWay& a, const PointWay& b) {
  if (!cast_path(a.start, b.start, a.from, b.from)) return false;
  corridor.keep(call);
  writer_.finish(corridor);
  return true;
}

template <int D>
Verdict MovingCorridors<D>::ask(Corridor<D>& corridor, uint64_t call, const PointWay (&ends)[2],
                                const double* const (&places)[2], bool are_ends, bool is_kept) {
  for (uint32_t k = 0; k < 2; ++k) {
    if (!find_path(ends[k], places[k], paths_[k])) return Verdict::kUnknown;
  }
  const PointWay &a = ends[0], &b = ends[1];
  bool is_known = is_of(corridor, a, b);
  if (is_known) corridor.portal.version = env_.obstacle_version;  // one without facets is of all versions
  if (is_known && are_ends && stays(corridor, call, a, b)) return Verdict::kHolds;
  // What is found does not depend on what was noted before.
  is_known = is_known && follows(env_, corridor, a.start, b.start, a.from, b.from);
  if (!is_known) {
    if (!note_start(corridor, call, a, b)) return Verdict::kUnknown;
    if (are_ends && stays(corridor, call, a, b)) return Verdict::kHolds;
  }
  if (!rings_.find(corridor, EdgeWay::of_both(a.start, places[0], b.start, places[1]), paths_))
    return Verdict::kUnknown;
  const CandidateView<D> found = features();
  if (found.first != found.last) return Verdict::kStopsAtRidge;
  if (are_ends && is_kept) go_on(corridor, call, ends);
  return Verdict::kHolds;
}

/** Whether the edge keeps to its corridor, or to one more facet at either end. The corridor becomes that of the end. If the
 * edge may leave it, it stays that of the start. */
template <int D>
bool MovingCorridors<D>::stays(Corridor<D>& corridor, uint64_t call, const PointWay& a, const PointWay& b) {
  if (paths_[0].size() > 1 || paths_[1].size() > 1) return false;
  if (!paths_[0].empty() || !paths_[1].empty()) corridor.keep(call);
  const auto extend = [&](const Array<uint32_t>& path, bool first) {
    return !path.empty() && !corridor.has_at(env_, {path[0]}, first) && corridor.pass(env_, {path[0]}, first);
  };
  const bool is_longer_at_a = extend(paths_[0], true), is_longer_at_b = extend(paths_[1], false);
  const bool stays = !corridor.facets.empty() && passes_all(corridor, a, b);
  // Both ends do not go through the only facet: no line would pass that at the end.
  if (stays ? !paths_[0].empty() && !is_longer_at_a : is_longer_at_a) corridor.remove(env_, true);
  if (stays ? !paths_[1].empty() && !is_longer_at_b : is_longer_at_b) corridor.remove(env_, false);
  return stays;
}

template <int D>
bool MovingCorridors<D>::passes_all(Corridor<D>& corridor, const PointWay& a, const PointWay& b) const {
  const EdgeWay way = EdgeWay::of_both(a.start, a.end, b.start, b.end);
  if (corridor.portal.is_only()) return keeps_to_portal(env_, corridor.portal, way);
  if (keeps_to_facets(env_, corridor, way)) return true;
  const Cell front = corridor.portal.front, back = corridor.portal.back;
  const auto passes = [&](const double* from, const double* to) {
    return follows(env_, corridor, from, to, front, back);
  };
  return passes(a.start, b.start) && passes(a.end, b.start) && passes(a.start, b.end) && passes(a.end, b.end);
}

template <int D>
void MovingCorridors<D>::go_on(Corridor<D>& corridor, uint64_t call, const PointWay (&ends)[2]) {
  const PointWay &a = ends[0], &b = ends[1];
  if (!a.arrival.valid() || !b.arrival.valid()) return;
  corridor.keep(call);
  for (const uint32_t passed : paths_[0]) corridor.pass(env_, {passed}, true);
  for (const uint32_t passed : paths_[1]) corridor.pass(env_, {passed}, false);
  constexpr int kMostTurnsRound = 16;
  RidgeName pivot;
  for (int k = 0; k < kMostTurnsRound && !follows(env_, corridor, a.end, b.end, a.arrival, b.arrival); ++k) {
    if (!turn(env_, corridor, a.end, b.end, pivot)) return;
  }
}

template <int D>
bool MovingCorridors<D>::keeps_to_facet([[maybe_unused]] const PointWay (&ends)[2]) const noexcept {
  if constexpr (D == 3) {
    const Map<3>& map = env_.map;
    const PointWay &a = ends[0], &b = ends[1];
    const bool a_leaves = a.from != a.arrival, b_leaves = b.from != b.arrival;
    if (a_leaves && b_leaves) return false;
    const bool are_apart = a.from != b.from;
    const Cell first = are_apart || b_leaves ? a.from : a.arrival, last = are_apart || a_leaves ? b.from : b.arrival;
    if (!first.valid() || !last.valid() || first == last) return false;
    const auto passes_it_alone = [&](const PointWay& end, Cell to) {
      return end.arrival == to && end.crossed.is_known && end.crossed.count == 1;
    };
    if (a_leaves && !passes_it_alone(a, are_apart ? last : first)) return false;
    if (b_leaves && !passes_it_alone(b, are_apart ? first : last)) return false;
    const auto suits = [&](Cell c) { return map.convex(c) && !is_closed(env_, c); };
    if (!suits(first) || !suits(last) || !has_standard_facets(map.form(first))) return false;
    const HalfFacet facet = find_only_facet(env_, first, last);
    if (!facet.valid()) return false;
    Portal<3> portal;
    standard_corners(map.record(first), map.local_of(facet, first), portal.corners);
    return keeps_to_portal(env_, portal, EdgeWay::of_both(a.start, a.end, b.start, b.end));
  }
  return false;
}

template <int D>
HalfFacet find_only_facet(const Environment<D>& env, Cell from, Cell to) noexcept {
  const Map<D>& map = env.map;
  HalfFacet found;
  for (uint32_t f = 0, count = map.facets_of(from); f < count; ++f) {
    const HalfFacet facet = map.half_facet(from, f), beyond = map.opposite(facet);
    if (!beyond.valid() || map.cell_of(beyond) != to) continue;
    if (found.valid()) return {};
    found = facet;
  }
  return found.valid() && !is_impassable(env, found) ? found : HalfFacet{};
}

DSW_INSTANTIATE(find_only_facet);
template class MovingCorridors<2>;
template class MovingCorridors<3>;

}  // namespace dsw
