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

template <int D>
bool knows_path(const Follower<D>& f) noexcept {
  return f.edge.crossed.count != 0 || f.edge.from == f.edge.arrival;
}

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
bool turns_freely(const Follower<D>& f, const Pivot<D>& pivot) {
  if constexpr (D == 3) {
    const double* const triangle[3] = {f.edge.p, f.edge.to, f.edge.q};
    const uint32_t(&edge)[2] = pivot.vertices;
    const int a = orient<D>(triangle, f.env.point(edge[0])), b = orient<D>(triangle, f.env.point(edge[1]));
    return a * b < 0 && (f.env.marked_edges == 0 || !f.env.edge_marks.contains(edge[0], edge[1]));
  } else {
    return !vertex_marked(f.env, pivot.vertices[0]);
  }
}

/** Whether the edge goes to the other side of a pivot, or of a few, and is free there with what it sweeps on its way;
 * at EDGES the new place is all that counts. */
template <int D>
bool turns(const Follower<D>& f, bool swept) {
  const bool first = f.edge.p_first;
  const double *const from = first ? f.edge.to : f.edge.q, *const to = first ? f.edge.q : f.edge.to;
  const Cell start = first ? f.edge.arrival : f.edge.fixed, end = first ? f.edge.fixed : f.edge.arrival;
  Pivot<D> pivot;
  for (int rest = swept && D == 3 ? 1 : kMostTurns; rest != 0; --rest) {
    if (!turn(f.env, f.corridor, from, to, pivot) || (swept && !turns_freely(f, pivot))) break;
    if (follows(f.env, f.corridor, from, to, start, end)) return true;
  }
  return false;
}

/** Whether the edge follows its corridor with the moving end at p. */
template <int D>
bool keeps(const Follower<D>& f, const double* p, Cell cell) {
  return f.edge.p_first ? follows(f.env, f.corridor, p, f.edge.q, cell, f.edge.fixed)
                        : follows(f.env, f.corridor, f.edge.q, p, f.edge.fixed, cell);
}

/** Whether that has been found before. */
template <int D>
bool has_kept(const Follower<D>& f, const double* p, Cell cell) {
  return f.edge.p_first ? f.corridor.has_place(f.env.obstacle_version, p, f.edge.q, cell, f.edge.fixed)
                        : f.corridor.has_place(f.env.obstacle_version, f.edge.q, p, f.edge.fixed, cell);
}

template <int D>
void note(const Follower<D>& f, const double* p, Cell cell) {
  if (f.edge.p_first) {
    f.corridor.note_place(p, f.edge.q, cell, f.edge.fixed);
  } else {
    f.corridor.note_place(f.edge.q, p, f.edge.fixed, cell);
  }
}

template <int D>
bool note_start(const Follower<D>& f) {
  const bool first = f.edge.p_first;
  const double *const p = f.edge.p, *const q = f.edge.q;
  const bool is_free =
      f.scratch.writer.cast_segment(f.env, first ? p : q, first ? q : p, first ? f.edge.from : f.edge.fixed,
                                    first ? f.edge.fixed : f.edge.from, f.scratch.counters);
  if (!is_free) return false;
  f.corridor.keep(f.call);
  f.scratch.writer.finish(f.corridor);
  return f.corridor.known();
}

/** Whether the corridor is that of the edge where it stands; if it was not, perhaps by a cast. */
template <int D>
bool keeps_start(const Follower<D>& f) {
  return keeps(f, f.edge.p, f.edge.from) || (note_start(f) && keeps(f, f.edge.p, f.edge.from));
}

/** The corridor becomes what it is once the path of the moving end has been passed. False: that is not known. */
template <int D>
bool passes_on(const Follower<D>& f) {
  Cell cell = f.edge.from;
  for (uint32_t i = 0; i < f.edge.crossed.count; ++i) {
    if (!pass_on(f.env, f.corridor, f.edge.crossed.facets[i], cell, f.edge.p_first)) return false;
    cell = f.env.map.cell_of(f.env.map.opposite(f.edge.crossed.facets[i]));
  }
  return cell == f.edge.arrival;
}

template <int D>
void save(const Follower<D>& f) {
  f.corridor.keep(f.call);
  f.scratch.before = f.corridor.facets;
}

template <int D>
void restore(const Follower<D>& f) {
  if (f.corridor.facets != f.scratch.before) f.corridor.assign(f.env, f.scratch.before);
}

}  // namespace

template <int D>
Verdict ask(const Follower<D>& f, bool swept) {
  if (!knows_path(f)) return Verdict::kUnknown;
  if (!(swept ? keeps_start(f) : f.corridor.known())) return Verdict::kUnknown;
  const bool stays = f.edge.crossed.count == 0;
  if (stays && keeps(f, f.edge.to, f.edge.arrival)) return Verdict::kHolds;
  save(f);
  if (passes_on(f)) {
    if (!stays && keeps(f, f.edge.to, f.edge.arrival)) return Verdict::kHolds;
    if (turns(f, swept)) return Verdict::kTurned;
  }
  restore(f);
  return Verdict::kUnknown;
}

template <int D>
Verdict ask_for_ridge(const Follower<D>& f, bool arrives, const TouchedLines* touched, FirstRidge* ridge) {
  if constexpr (D == 2) return arrives ? ask(f, true) : Verdict::kUnknown;
  if constexpr (D == 3) {
    *ridge = {};
    if (!knows_path(f) || !keeps_start(f)) return Verdict::kUnknown;
    const size_t crossed = f.edge.crossed.count, count = f.corridor.facets.size();
    const bool stays = crossed == 0;
    if (stays && arrives && has_kept(f, f.edge.to, f.edge.arrival)) return Verdict::kHolds;
    if (!stays) save(f);
    const bool in_rows =
        (stays || passes_on(f)) && f.corridor.in_rows && f.corridor.portal.version == f.env.obstacle_version;
    // Only cells of facets in rows are known to be convex.
    const EdgeMotion m = f.edge.motion();
    const size_t added = (f.corridor.facets.size() + crossed - count) / 2;  // the others have been removed
    bool knows = in_rows && f.env.map.convex(f.edge.arrival) &&
                 find_first_ridge(f.env, f.corridor, m, f.edge.p_first, added, ridge);
    bool turned = false;
    for (int count_turns = 0; stays && arrives && knows && ridge->facet.valid() && count_turns < kMostTurns;
         ++count_turns) {
      if (knows_walls(f.env, touched, *ridge)) break;
      if (!turned) save(f);
      if (!turn_round(f.env, f.corridor, *ridge)) break;
      turned = true;
      knows = f.corridor.in_rows && find_first_ridge(f.env, f.corridor, m, f.edge.p_first, 0, ridge);
    }
    const bool free = knows && !ridge->facet.valid();
    if (free && arrives) {
      note(f, f.edge.to, f.edge.arrival);
      return turned ? Verdict::kTurned : Verdict::kHolds;
    }
    if (!stays || turned) restore(f);
    if (free) return Verdict::kHolds;
    if (!knows) *ridge = {};
    return !in_rows && arrives ? ask(f, true) : Verdict::kUnknown;
  }
}

template <int D>
bool is_free_before(const Follower<D>& f, const SweepEvent& event) {
  if (!knows_path(f) || !keeps_start(f)) return false;
  const auto passes = [&] { return passes_before(f.env, f.corridor, f.edge.motion(), f.edge.p_first, event); };
  if (f.edge.crossed.count == 0) return passes();
  save(f);
  // Only cells of facets in rows are known to be convex; the path may have gone on into another one.
  const bool is_free = passes_on(f) && f.corridor.in_rows && f.env.map.convex(f.edge.arrival) && passes();
  restore(f);
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

DSW_INSTANTIATE(ask);
DSW_INSTANTIATE(ask_for_ridge);
DSW_INSTANTIATE(is_free_before);
DSW_INSTANTIATE(is_seen);
DSW_INSTANTIATE(stays_before_wall);

}  // namespace dsw
