#include "corridor/ask.h"

#include "base/dimensions.h"
#include "corridor/hop.h"
#include "environment/marking.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

constexpr int kMostTurns = 4;  // then a cast costs no more

/** The arguments of ask. */
template <int D>
struct Asked {
  const Environment<D>& env;
  const MovingPart& edge;
  const Question& what;
  const KeptOfEdge<D>& kept;
  EdgeScratch<D>& scratch;
  FirstRidge* ridge;
};

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
  return touched != nullptr && touched->knows_fan(ridge.ridge, ridge.facet, env.change_version);
}

template <int D>
bool knows_path(const Asked<D>& q) noexcept {
  return q.edge.way.crossed.count != 0 || q.edge.way.from == q.edge.way.arrival;
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
bool turns_freely(const Asked<D>& q, const RidgeName& pivot) {
  if constexpr (D == 3) {
    const double* const triangle[3] = {q.edge.way.start, q.edge.way.end, q.edge.q};
    const uint32_t(&edge)[2] = pivot.vertices;
    const int a = orient<D>(triangle, q.env.point(edge[0])), b = orient<D>(triangle, q.env.point(edge[1]));
    return a * b < 0 && (q.env.marked_edges == 0 || !q.env.edge_marks.contains(edge[0], edge[1]));
  } else {
    return !vertex_marked(q.env, pivot.vertices[0]);
  }
}

/** Whether the edge goes to the other side of a pivot, or of a few, and is free there with what it sweeps on its way;
 * at EDGES the new place is all that counts. */
template <int D>
bool turns(const Asked<D>& q) {
  const bool first = q.edge.p_first;
  const double *const from = first ? q.edge.way.end : q.edge.q, *const to = first ? q.edge.q : q.edge.way.end;
  const Cell start = first ? q.edge.way.arrival : q.edge.q_cell, end = first ? q.edge.q_cell : q.edge.way.arrival;
  RidgeName pivot;
  for (int rest = q.what.swept && D == 3 ? 1 : kMostTurns; rest != 0; --rest) {
    if (!turn(q.env, *q.kept.corridor, from, to, pivot) || (q.what.swept && !turns_freely(q, pivot))) break;
    if (follows(q.env, *q.kept.corridor, from, to, start, end)) return true;
  }
  return false;
}

/** Whether the edge follows its corridor with the moving end at p. */
template <int D>
bool keeps(const Asked<D>& q, const double* p, Cell cell) {
  return q.edge.p_first ? follows(q.env, *q.kept.corridor, p, q.edge.q, cell, q.edge.q_cell)
                        : follows(q.env, *q.kept.corridor, q.edge.q, p, q.edge.q_cell, cell);
}

/** Whether that has been found before. */
template <int D>
bool has_kept(const Asked<D>& q, const double* p, Cell cell) {
  return q.edge.p_first ? q.kept.corridor->has_place(q.env.obstacle_version, p, q.edge.q, cell, q.edge.q_cell)
                        : q.kept.corridor->has_place(q.env.obstacle_version, q.edge.q, p, q.edge.q_cell, cell);
}

template <int D>
void note(const Asked<D>& q, const double* p, Cell cell) {
  if (q.edge.p_first) {
    q.kept.corridor->note_place(p, q.edge.q, cell, q.edge.q_cell);
  } else {
    q.kept.corridor->note_place(q.edge.q, p, q.edge.q_cell, cell);
  }
}

/** Whether the corridor is that of the edge where it stands; if it was not, perhaps by a cast. */
template <int D>
bool keeps_start(const Asked<D>& q) {
  const bool first = q.edge.p_first;
  const double *const from = first ? q.edge.way.start : q.edge.q, *const to = first ? q.edge.q : q.edge.way.start;
  const Cell start = first ? q.edge.way.from : q.edge.q_cell, end = first ? q.edge.q_cell : q.edge.way.from;
  if (follows(q.env, *q.kept.corridor, from, to, start, end)) return true;
  if (!q.scratch.writer.cast_segment(q.env, from, to, start, end, q.scratch.counters)) return false;
  q.kept.keep(q.env);
  q.scratch.writer.finish(*q.kept.corridor);
  return q.kept.corridor->known() && follows(q.env, *q.kept.corridor, from, to, start, end);
}

/** The corridor becomes what it is once the path of the moving end has been passed. False: that is not known. */
template <int D>
bool passes_on(const Asked<D>& q) {
  Cell cell = q.edge.way.from;
  for (uint32_t i = 0; i < q.edge.way.crossed.count; ++i) {
    if (!pass_on(q.env, *q.kept.corridor, q.edge.way.crossed.facets[i], cell, q.edge.p_first)) return false;
    cell = q.env.map.cell_of(q.env.map.opposite(q.edge.way.crossed.facets[i]));
  }
  return cell == q.edge.way.arrival;
}

template <int D>
void save(const Asked<D>& q) {
  q.kept.keep(q.env);
  q.scratch.before = q.kept.corridor->facets;
}

template <int D>
void restore(const Asked<D>& q) {
  if (q.kept.corridor->facets != q.scratch.before) q.kept.corridor->assign(q.env, q.scratch.before);
}

/** Looks for the first ridge that the edge meets. kUnknown and `goes_on`: the corridor may still tell that it is free. */
Verdict up_to_ridge(const Asked<3>& q, bool* goes_on) {
  FirstRidge* const ridge = q.ridge;
  const PointWay& way = q.edge.way;
  *goes_on = false;
  if (!keeps_start(q)) return Verdict::kUnknown;
  const size_t crossed = way.crossed.count, count = q.kept.corridor->facets.size();
  const bool stays = crossed == 0;
  if (stays && q.what.arrives && has_kept(q, way.end, way.arrival)) return Verdict::kHolds;
  if (!stays) save(q);
  const bool in_rows =
      (stays || passes_on(q)) && q.kept.corridor->in_rows && q.kept.corridor->portal.version == q.env.obstacle_version;
  // Only cells of facets in rows are known to be convex.
  const EdgeMotion m = q.edge.edge();
  const size_t added = (q.kept.corridor->facets.size() + crossed - count) / 2;  // the others have been removed
  bool knows = in_rows && q.env.map.convex(way.arrival) &&
               find_first_ridge(q.env, *q.kept.corridor, m, q.edge.p_first, added, ridge);
  bool turned = false;
  for (int turns = 0; stays && q.what.arrives && knows && ridge->facet.valid() && turns < kMostTurns; ++turns) {
    if (knows_walls(q.env, q.kept.touched, *ridge)) break;
    if (!turned) save(q);
    if (!turn_round(q.env, *q.kept.corridor, *ridge)) break;
    turned = true;
    knows = q.kept.corridor->in_rows && find_first_ridge(q.env, *q.kept.corridor, m, q.edge.p_first, 0, ridge);
  }
  const bool free = knows && !ridge->facet.valid();
  if (free && q.what.arrives) {
    note(q, way.end, way.arrival);
    return turned ? Verdict::kTurned : Verdict::kHolds;
  }
  if (!stays || turned) restore(q);
  if (free) return Verdict::kHolds;
  if (!knows) *ridge = {};
  *goes_on = !in_rows && q.what.arrives;
  return Verdict::kUnknown;
}

/** Whether the edge meets nothing before an event. */
template <int D>
Verdict until_event(const Asked<D>& q) {
  if (!keeps_start(q)) return Verdict::kUnknown;
  const auto passes = [&] {
    return passes_before(q.env, *q.kept.corridor, q.edge.edge(), q.edge.p_first, *q.what.before);
  };
  bool is_free;
  if (q.edge.way.crossed.count == 0) {
    is_free = passes();
  } else {
    save(q);
    // Only cells of facets in rows are known to be convex; the path may have gone on into another one.
    is_free = passes_on(q) && q.kept.corridor->in_rows && q.env.map.convex(q.edge.way.arrival) && passes();
    restore(q);
  }
  return is_free ? Verdict::kHolds : Verdict::kUnknown;
}

/** Whether all of the cell that the corners of the triangle are in is seen from an end of the edge in its new place; where
 * the triangle counts, from both: so the moving end's path lies in the cell, and what joins that to the fixed end. */
template <int D>
bool is_seen(const Asked<D>& q) {
  const bool from_target = sees_all(q.env, q.edge.way.arrival, q.edge.way.end, q.scratch.counters);
  if (from_target != q.what.swept) return from_target;
  return sees_all(q.env, q.edge.q_cell, q.edge.q, q.scratch.counters);
}

/** Whether an edge meets nothing before its moving end meets a wall of the cell where it arrives: up to there it stays in
 * that cell, or in that and a second one and passes between them. Of a line through q the sides of a ridge change linearly
 * on the way of its other end: where it passes the facet at both ends of the way, it does so between. */
template <int D>
bool stays_before_wall(const Environment<D>& env, const MovingPart& edge) {
  const Cell front = edge.way.arrival;
  if (edge.way.from != front) return false;
  if (front == edge.q_cell) return env.map.convex(front);
  return passes_between(env, front, edge.q_cell, edge.way.start, edge.q) &&
         passes_between(env, front, edge.q_cell, edge.way.end, edge.q);
}

}  // namespace

template <int D>
Verdict ask(const Environment<D>& env, const MovingPart& edge, const Question& what, const KeptOfEdge<D>& kept,
            EdgeScratch<D>& scratch, FirstRidge* ridge) {
  const Asked<D> q{env, edge, what, kept, scratch, ridge};
  const PointWay& way = edge.way;
  const auto is_in = [&](const Clearance<D>* ball) { return ball->covers(env, way.start, way.end, edge.q); };
  if (what.arrives && !edge.reached) return stays_before_wall(env, edge) ? Verdict::kStopped : Verdict::kUnknown;
  if (what.asks_cells && way.from == way.arrival && way.from == edge.q_cell) {
    const bool convex = env.map.convex(way.from);
    if (convex || is_seen(q)) {
      if (kept.corridor != nullptr && !kept.of_edges->is_plain(kept.edge)) {
        kept.keep(env);
        kept.corridor->clear();
      }
      return convex ? Verdict::kInside : Verdict::kSeen;
    }
  }
  if (what.is_limited) return Verdict::kUnknown;
  if (kept.balls[0] != nullptr && (is_in(kept.balls[0]) || is_in(kept.balls[1]))) return Verdict::kClear;
  if (kept.corridor == nullptr || !knows_path(q)) return Verdict::kUnknown;
  if (what.before != nullptr) return until_event(q);
  if constexpr (D == 3) {
    bool goes_on = true;
    const Verdict verdict = ridge != nullptr ? up_to_ridge(q, &goes_on) : Verdict::kUnknown;
    if (!goes_on || verdict != Verdict::kUnknown) return verdict;
  }
  if (!what.arrives || !(what.swept ? keeps_start(q) : kept.corridor->known())) return Verdict::kUnknown;
  const bool stays = way.crossed.count == 0;
  if (stays && keeps(q, way.end, way.arrival)) return Verdict::kHolds;
  save(q);
  if (passes_on(q)) {
    if (!stays && keeps(q, way.end, way.arrival)) return Verdict::kHolds;
    if (turns(q)) return Verdict::kTurned;
  }
  restore(q);
  return Verdict::kUnknown;
}

DSW_INSTANTIATE(ask);

}  // namespace dsw
