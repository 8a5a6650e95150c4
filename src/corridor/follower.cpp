#include "corridor/follower.h"

#include "base/dimensions.h"
#include "corridor/hop.h"
#include "environment/marking.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

constexpr int kMostTurns = 4;  // then a cast costs no more

/** The path of an end has passed a facet of `from`. What is noted may be of another place, at EDGES: then it does not go
 * on where the path has left its cell, and nothing is done. */
template <int D>
bool pass_on(const Environment<D>& env, Corridor<D>& corridor, HalfFacet crossed, Cell from, bool first) {
  if (!corridor.facets.empty()) {
    const HalfFacet end{first ? corridor.facets.front() : corridor.facets.back()};
    if (env.map.cell_of(first ? end : env.map.opposite(end)) != from) return false;
  }
  corridor.pass(env, crossed, first);
  return true;
}

/** Whether walls are known to end the passable cells round a ridge. */
bool knows_walls(const Environment<3>& env, const TouchedLines* touched, const FirstRidge& ridge) noexcept {
  const TouchedLine line{{ridge.vertices[0], ridge.vertices[1]}};
  return touched != nullptr && touched->knows_fan(line, ridge.facet, env.change_version);
}

}  // namespace

/** Whether a triangle is free one side of which passes, in the old place, half of the facets round a pivot, and
 * another, in the new place, the others. In space: before and after these the sides share facets, and what of the
 * triangle lies there is in cells, as in one corridor. Let Q be what lies between. Its boundary is in the cells round the
 * edge and goes once round the edge's line, so Q meets that line; with the edge's ends on either side of the triangle's
 * plane it does so in a point y of the edge. Q is convex: each of its points is between y and one of its boundary. Both
 * are in one cell, as all of these cells have the edge, so all between is in that cell. In the plane the edge may have
 * turned round several vertices, all asked here. All cells and facets at each are passable, as the corridor before or
 * after has them. So the triangle's sides lie in an open set, of what is passable, where they can be drawn together
 * into a point, over one vertex after the other; a point of the triangle outside of it would be one that they wind
 * round. */
template <int D>
bool Follower<D>::turns_freely(const Pivot<D>& pivot) const {
  if constexpr (D == 3) {
    const double* const triangle[3] = {edge_.p, edge_.to, edge_.q};
    const uint32_t(&edge)[2] = pivot.vertices;
    const int a = orient<D>(triangle, env_.point(edge[0])), b = orient<D>(triangle, env_.point(edge[1]));
    return a * b < 0 && (env_.marked_edges == 0 || !env_.edge_marks.contains(edge[0], edge[1]));
  } else {
    return !vertex_marked(env_, pivot.vertices[0]);
  }
}

/** Whether the edge goes to the other side of a pivot, or of a few, and is free there with what it sweeps on its way;
 * at EDGES the new place is all that counts. */
template <int D>
bool Follower<D>::turns(bool swept) const {
  const bool first = edge_.p_first;
  const double *const from = first ? edge_.to : edge_.q, *const to = first ? edge_.q : edge_.to;
  const Cell start = first ? edge_.arrival : edge_.fixed, end = first ? edge_.fixed : edge_.arrival;
  Pivot<D> pivot;
  for (int rest = swept && D == 3 ? 1 : kMostTurns; rest != 0; --rest) {
    if (!turn(env_, corridor_, from, to, pivot) || (swept && !turns_freely(pivot))) break;
    if (follows(env_, corridor_, from, to, start, end)) return true;
  }
  return false;
}

/** Whether the edge follows its corridor with the moving end at p. */
template <int D>
bool Follower<D>::keeps(const double* p, Cell cell) const {
  return edge_.p_first ? follows(env_, corridor_, p, edge_.q, cell, edge_.fixed)
                       : follows(env_, corridor_, edge_.q, p, edge_.fixed, cell);
}

/** Whether that has been found before. */
template <int D>
bool Follower<D>::has_kept(const double* p, Cell cell) const {
  return edge_.p_first ? corridor_.has_place(env_.obstacle_version, p, edge_.q, cell, edge_.fixed)
                       : corridor_.has_place(env_.obstacle_version, edge_.q, p, edge_.fixed, cell);
}

template <int D>
void Follower<D>::note(const double* p, Cell cell) const {
  if (edge_.p_first) {
    corridor_.note_place(p, edge_.q, cell, edge_.fixed);
  } else {
    corridor_.note_place(edge_.q, p, edge_.fixed, cell);
  }
}

/** Whether the corridor is that of the edge where it stands; if it was not, perhaps by a cast. */
template <int D>
bool Follower<D>::keeps_start() const {
  return keeps(edge_.p, edge_.from) || (note_start() && keeps(edge_.p, edge_.from));
}

template <int D>
bool Follower<D>::note_start() const {
  const bool first = edge_.p_first;
  const double *const p = edge_.p, *const q = edge_.q;
  const bool is_free =
      scratch_.writer.cast_segment(env_, first ? p : q, first ? q : p, first ? edge_.from : edge_.fixed,
                                   first ? edge_.fixed : edge_.from, scratch_.counters);
  if (!is_free) return false;
  corridor_.keep(call_);
  scratch_.writer.finish(corridor_);
  return corridor_.known();
}

/** The corridor becomes what it is once the path of the moving end has been passed. False: that is not known. */
template <int D>
bool Follower<D>::passes_on() const {
  Cell cell = edge_.from;
  for (uint32_t i = 0; i < edge_.crossed.count; ++i) {
    if (!pass_on(env_, corridor_, edge_.crossed.facets[i], cell, edge_.p_first)) return false;
    cell = env_.map.cell_of(env_.map.opposite(edge_.crossed.facets[i]));
  }
  return cell == edge_.arrival;
}

template <int D>
void Follower<D>::save() const {
  corridor_.keep(call_);
  scratch_.before = corridor_.facets;
}

template <int D>
void Follower<D>::restore() const {
  if (corridor_.facets != scratch_.before) corridor_.assign(env_, scratch_.before);
}

template <int D>
Verdict Follower<D>::ask(bool swept) {
  if (!knows_path()) return Verdict::kUnknown;
  if (!(swept ? keeps_start() : corridor_.known())) return Verdict::kUnknown;
  const bool stays = edge_.crossed.count == 0;
  if (stays && keeps(edge_.to, edge_.arrival)) return Verdict::kHolds;
  save();
  if (passes_on()) {
    if (!stays && keeps(edge_.to, edge_.arrival)) return Verdict::kHolds;
    if (turns(swept)) return Verdict::kTurned;
  }
  restore();
  return Verdict::kUnknown;
}

template <int D>
Verdict Follower<D>::ask_for_ridge(bool arrives, const TouchedLines* touched, FirstRidge* ridge) {
  if constexpr (D == 2) return arrives ? ask(true) : Verdict::kUnknown;
  if constexpr (D == 3) {
    *ridge = {};
    if (!knows_path() || !keeps_start()) return Verdict::kUnknown;
    const size_t crossed = edge_.crossed.count, count = corridor_.facets.size();
    const bool stays = crossed == 0;
    if (stays && arrives && has_kept(edge_.to, edge_.arrival)) return Verdict::kHolds;
    if (!stays) save();
    const bool in_rows =
        (stays || passes_on()) && corridor_.in_rows && corridor_.portal.version == env_.obstacle_version;
    // Only cells of facets in rows are known to be convex.
    const EdgeMotion m = edge_.motion();
    const size_t added = (corridor_.facets.size() + crossed - count) / 2;  // the others have been removed
    bool knows =
        in_rows && env_.map.convex(edge_.arrival) && find_first_ridge(env_, corridor_, m, edge_.p_first, added, ridge);
    bool turned = false;
    for (int turns = 0; stays && arrives && knows && ridge->facet.valid() && turns < kMostTurns; ++turns) {
      if (knows_walls(env_, touched, *ridge)) break;
      if (!turned) save();
      if (!turn_round(env_, corridor_, *ridge)) break;
      turned = true;
      knows = corridor_.in_rows && find_first_ridge(env_, corridor_, m, edge_.p_first, 0, ridge);
    }
    const bool free = knows && !ridge->facet.valid();
    if (free && arrives) {
      note(edge_.to, edge_.arrival);
      return turned ? Verdict::kTurned : Verdict::kHolds;
    }
    if (!stays || turned) restore();
    if (free) return Verdict::kHolds;
    if (!knows) *ridge = {};
    return !in_rows && arrives ? ask(true) : Verdict::kUnknown;
  }
}

template <int D>
bool Follower<D>::is_free_before(const SweepEvent& event) {
  if (!knows_path() || !keeps_start()) return false;
  const auto passes = [&] { return passes_before(env_, corridor_, edge_.motion(), edge_.p_first, event); };
  if (edge_.crossed.count == 0) return passes();
  save();
  // Only cells of facets in rows are known to be convex; the path may have gone on into another one.
  const bool is_free = passes_on() && corridor_.in_rows && env_.map.convex(edge_.arrival) && passes();
  restore();
  return is_free;
}

template <int D>
bool is_seen(const Environment<D>& env, bool swept, const MovingEdge& edge, CastCounters* counters) {
  const bool from_target = sees_all(env, edge.arrival, edge.to, counters);
  if (from_target != swept) return from_target;
  return sees_all(env, edge.fixed, edge.q, counters);
}

template <int D>
bool stays_before_wall(const Environment<D>& env, const MovingEdge& edge) {
  const Cell front = edge.arrival;
  if (edge.from != front) return false;
  if (front == edge.fixed) return env.map.convex(front);
  return passes_between(env, front, edge.fixed, edge.p, edge.q) &&
         passes_between(env, front, edge.fixed, edge.to, edge.q);
}

template class Follower<2>;
template class Follower<3>;
DSW_INSTANTIATE(is_seen);
DSW_INSTANTIATE(stays_before_wall);

}  // namespace dsw
