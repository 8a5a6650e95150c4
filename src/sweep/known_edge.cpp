#include "sweep/known_edge.h"

#include "base/dimensions.h"
#include "corridor/corridor.h"
#include "corridor/hop.h"
#include "environment/marking.h"
#include "predicates/filtered.h"
#include "sweep/clearance.h"
#include "sweep/touched_line.h"

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
bool turns_freely(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep, const Pivot<D>& pivot) {
  if constexpr (D == 3) {
    const double* const triangle[3] = {body.position(sweep.v), sweep.to, sweep.q};
    const uint32_t(&edge)[2] = pivot.vertices;
    const int a = orient<D>(triangle, env.point(edge[0])), b = orient<D>(triangle, env.point(edge[1]));
    return a * b < 0 && (env.marked_edges == 0 || !env.edge_marks.contains(edge[0], edge[1]));
  } else {
    return !vertex_marked(env, pivot.vertices[0]);
  }
}

/** Whether the edge goes to the other side of a pivot, or of a few, and is free there with what it sweeps on its way;
 * at EDGES the new place is all that counts. */
template <int D>
bool turns(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep, bool first) {
  Corridor<D>& corridor = body.corridors[sweep.e];
  const double *const from = first ? sweep.to : sweep.q, *const to = first ? sweep.q : sweep.to;
  const Cell start = first ? sweep.arrival : sweep.fixed, end = first ? sweep.fixed : sweep.arrival;
  const bool swept = sweeps_edges(body.level);
  Pivot<D> pivot;
  for (int rest = swept && D == 3 ? 1 : kMostTurns; rest != 0; --rest) {
    if (!turn(env, corridor, from, to, pivot) || (swept && !turns_freely(env, body, sweep, pivot))) break;
    if (follows(env, corridor, from, to, start, end)) return true;
  }
  return false;
}

/** Whether the facets that the path of the moving end passes are known. */
template <int D>
bool knows_path(const Body<D>& body, const EdgeSweep& sweep) {
  return sweep.crossed.count != 0 || body.vertices[sweep.v].cell == sweep.arrival;
}

/** An edge and its corridor, on its way. */
template <int D>
struct Follower {
  const Environment<D>& env;
  const EdgeSweep& sweep;
  EdgeScratch<D>& scratch;
  Corridor<D>& corridor;
  const BodyVertex<D>& from;
  const uint64_t call;
  const bool first;  // the corridor begins at the moving end

  Follower(const Environment<D>& environment, const Body<D>& body, const EdgeSweep& edge, EdgeScratch<D>& used)
      : env(environment),
        sweep(edge),
        scratch(used),
        corridor(body.corridors[edge.e]),
        from(body.vertices[edge.v]),
        call(body.call),
        first(body.edges[edge.e].ends[0] == edge.v) {}

  /** With the moving end at p. */
  bool keeps(const double* p, Cell cell) const {
    return first ? follows(env, corridor, p, sweep.q, cell, sweep.fixed)
                 : follows(env, corridor, sweep.q, p, sweep.fixed, cell);
  }
  /** Whether that has been found before. */
  bool has_kept(const double* p, Cell cell) const {
    return first ? corridor.has_place(env.obstacle_version, p, sweep.q, cell, sweep.fixed)
                 : corridor.has_place(env.obstacle_version, sweep.q, p, sweep.fixed, cell);
  }
  void note(const double* p, Cell cell) const {
    if (first) {
      corridor.note_place(p, sweep.q, cell, sweep.fixed);
    } else {
      corridor.note_place(sweep.q, p, sweep.fixed, cell);
    }
  }
  /** Whether the corridor is that of the edge where it stands; if it was not, perhaps by a cast. */
  bool keeps_start() const {
    return keeps(from.position, from.cell) || (note_start() && keeps(from.position, from.cell));
  }

  bool note_start() const {
    const double *const p = from.position, *const q = sweep.q;
    const bool is_free = scratch.writer.cast_segment(env, first ? p : q, first ? q : p, first ? from.cell : sweep.fixed,
                                                     first ? sweep.fixed : from.cell, scratch.counters);
    if (!is_free) return false;
    corridor.keep(call);
    scratch.writer.finish(corridor);
    return corridor.known();
  }
  /** What the corridor is once the path of the moving end has been passed. */
  bool passes_on() const {
    Cell cell = from.cell;
    for (uint32_t i = 0; i < sweep.crossed.count; ++i) {
      if (!pass_on(env, corridor, sweep.crossed.facets[i], cell, first)) return false;
      cell = env.map.cell_of(env.map.opposite(sweep.crossed.facets[i]));
    }
    return cell == sweep.arrival;
  }
  void save() const {
    corridor.keep(call);
    scratch.before = corridor.facets;
  }
  void restore() const {
    if (corridor.facets != scratch.before) corridor.assign(env, scratch.before);
  }
};

}  // namespace

template <int D>
bool is_seen(const Environment<D>& env, SweepLevel level, const EdgeSweep& sweep, CastCounters* counters) {
  const bool from_target = sees_all(env, sweep.arrival, sweep.to, counters);
  if (from_target != sweeps_edges(level)) return from_target;
  return sees_all(env, sweep.fixed, sweep.q, counters);
}

template <int D>
bool is_clear(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep) {
  const double* const p = body.position(sweep.v);
  return covers(env, body.clearances[sweep.v], p, sweep.to, sweep.q) ||
         covers(env, body.clearances[body.edges[sweep.e].other(sweep.v)], p, sweep.to, sweep.q);
}

template <int D>
Verdict follow_corridor(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep,
                        EdgeScratch<D>& scratch) {
  if (!knows_path(body, sweep)) return Verdict::kUnknown;
  Follower<D> edge(env, body, sweep, scratch);
  if (!(sweeps_edges(body.level) ? edge.keeps_start() : edge.corridor.known())) return Verdict::kUnknown;
  const bool stays = sweep.crossed.count == 0;
  if (stays && edge.keeps(sweep.to, sweep.arrival)) return Verdict::kHolds;
  edge.save();
  if (edge.passes_on()) {
    if (!stays && edge.keeps(sweep.to, sweep.arrival)) return Verdict::kHolds;
    if (turns(env, body, sweep, edge.first)) return Verdict::kTurned;
  }
  edge.restore();
  return Verdict::kUnknown;
}

Verdict follow_to_ridge(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep, bool arrives,
                        EdgeScratch<3>& scratch, FirstRidge* ridge) {
  *ridge = {};
  if (!knows_path(body, sweep)) return Verdict::kUnknown;
  Follower<3> edge(env, body, sweep, scratch);
  if (!edge.keeps_start()) return Verdict::kUnknown;
  const Corridor<3>& corridor = edge.corridor;
  const size_t crossed = sweep.crossed.count, count = corridor.facets.size();
  const bool stays = crossed == 0;
  if (stays && arrives && edge.has_kept(sweep.to, sweep.arrival)) return Verdict::kHolds;
  if (!stays) edge.save();
  const bool in_rows =
      (stays || edge.passes_on()) && corridor.in_rows && corridor.portal.version == env.obstacle_version;
  // Only cells of facets in rows are known to be convex.
  const EdgeMotion m{body.position(sweep.v), sweep.to, sweep.q};
  const size_t added = (corridor.facets.size() + crossed - count) / 2;  // the others have been removed
  bool knows = in_rows && env.map.convex(sweep.arrival) && find_first_ridge(env, corridor, m, edge.first, added, ridge);
  bool turned = false;
  for (int turns = 0; stays && arrives && knows && ridge->facet.valid() && turns < kMostTurns; ++turns) {
    if (knows_walls(env, body, sweep, *ridge)) break;
    if (!turned) edge.save();
    if (!turn_round(env, edge.corridor, *ridge)) break;
    turned = true;
    knows = corridor.in_rows && find_first_ridge(env, corridor, m, edge.first, 0, ridge);
  }
  const bool free = knows && !ridge->facet.valid();
  if (free && arrives) {
    edge.note(sweep.to, sweep.arrival);
    return turned ? Verdict::kTurned : Verdict::kHolds;
  }
  if (!stays || turned) edge.restore();
  if (free) return Verdict::kHolds;
  if (!knows) *ridge = {};
  return !in_rows && arrives ? follow_corridor(env, body, sweep, scratch) : Verdict::kUnknown;
}

template <int D>
bool is_free_before(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep, const SweepEvent& event,
                    EdgeScratch<D>& scratch) {
  if (!body.keeps_corridors() || !knows_path(body, sweep)) return false;
  Follower<D> edge(env, body, sweep, scratch);
  if (!edge.keeps_start()) return false;
  const EdgeMotion m{body.position(sweep.v), sweep.to, sweep.q};
  const auto passes = [&] { return passes_before(env, edge.corridor, m, edge.first, event); };
  if (sweep.crossed.count == 0) return passes();
  edge.save();
  // Only cells of facets in rows are known to be convex; the path may have gone on into another one.
  const bool is_free = edge.passes_on() && edge.corridor.in_rows && env.map.convex(sweep.arrival) && passes();
  edge.restore();
  return is_free;
}

template <int D>
bool keeps_corridor(const Environment<D>& env, const Body<D>& body, uint32_t e) {
  const BodyVertex<D>&a = body.vertices[body.edges[e].ends[0]], &b = body.vertices[body.edges[e].ends[1]];
  return follows(env, body.corridors[e], a.position, b.position, a.cell, b.cell);
}

template <int D>
bool stays_before_wall(const Environment<D>& env, const BodyVertex<D>& at, const double* to, Cell front,
                       const BodyVertex<D>& fixed) {
  if (at.cell != front) return false;
  if (front == fixed.cell) return env.map.convex(front);
  return passes_between(env, front, fixed.cell, at.position, fixed.position) &&
         passes_between(env, front, fixed.cell, to, fixed.position);
}

DSW_INSTANTIATE(is_seen);
DSW_INSTANTIATE(is_clear);
DSW_INSTANTIATE(follow_corridor);
DSW_INSTANTIATE(is_free_before);
DSW_INSTANTIATE(keeps_corridor);
DSW_INSTANTIATE(stays_before_wall);

}  // namespace dsw
