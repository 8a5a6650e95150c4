#include "sweep/simplex_sweep.h"

#include "predicates/inside_tetrahedron.h"
#include "sweep/clearance.h"

namespace dsw {
namespace {

/** Whether a point is seen to lie in a tetrahedron. */
bool is_seen_inside(const Environment<3>& env, Cell cell, const double* point) noexcept {
  const uint32_t* const w = env.map.record(cell);
  if (form_of(w[0]) != Form::kSimplex) return false;
  const double* corners[4];
  for (int i = 0; i < 4; ++i) corners[i] = env.point(w[i] & kVertexMask);
  return is_inside_tetrahedron(corners, point);
}
bool is_seen_inside(const Environment<2>&, Cell, const double*) noexcept { return false; }

/** Whether what an edge sweeps lies in a ball that is free. */
template <int D>
bool is_clear(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep) {
  const MovingEdge& edge = sweep.edge;
  return covers(env, body.clearances[sweep.v], edge.p, edge.to, edge.q) ||
         covers(env, body.clearances[body.edges[sweep.e].other(sweep.v)], edge.p, edge.to, edge.q);
}

}  // namespace

/** Most paths stay in a tetrahedron, which takes no cast to see. */
template <int D>
CastResult SimplexSweep<D>::cast_path(const Body<D>& body, uint32_t v, const double* to) {
  const BodyVertex<D>& at = body.vertices[v];
  CastResult path;
  path.cell = at.cell;
  limited_ = false;
  if (is_seen_inside(env_, at.cell, to)) return path;
  path = cast(env_, at.position, to, at.cell, max_volumes, counters);
  limited_ = path.end == CastEnd::kWorkLimit;
  return path;
}

template <int D>
Verdict SimplexSweep<D>::ask_what_is_kept(const Body<D>& body, const EdgeSweep& sweep, bool ask_balls,
                                          FirstRidge* ridge) {
  // What is known must not carry an edge past the work limit that it meets without.
  if (max_volumes != 0) return Verdict::kUnknown;
  const Skipping& skipping = body.skipping;
  Verdict verdict = Verdict::kUnknown;
  if (ask_balls && is_clear(env_, body, sweep)) {
    verdict = Verdict::kClear;
  } else if (body.keeps_corridors()) {
    const Follower<D> f = follower(body, sweep);
    verdict = ridge != nullptr ? ask_for_ridge(f, true, lines_of(body, sweep.e, sweep.v), ridge)
                               : dsw::ask(f, sweeps_edges(body.level));
  }
  counts.skipped += verdict != Verdict::kUnknown && (skipping.by_clearance || skipping.corridors) ? 1 : 0;
  return verdict;
}

/** Whether what the face sweeps lies inside of one cell. */
template <int D>
Verdict SimplexSweep<D>::ask(const Body<D>& body, const FaceSweep& sweep) const {
  const Cell cell = sweep.arrival;
  const bool inside =
      sweep.reached && body.vertices[sweep.v].cell == cell && sweep.q_cell == cell && sweep.r_cell == cell;
  if (!inside) return Verdict::kUnknown;
  if (env_.map.convex(cell)) return Verdict::kInside;
  const auto sees = [&](const double* point) { return sees_all(env_, cell, point, counters); };
  return sees(sweep.to) && sees(sweep.q) && sees(sweep.r) ? Verdict::kSeen : Verdict::kUnknown;
}

/** For an edge: what is met after `end` is not needed. With a work limit, which is that of all cells, it may be
 * found. */
template <int D>
SweepResult SimplexSweep<D>::flood_until(const EdgeMotion& m, Cell start, double end) {
  if constexpr (D == 3) {
    if (max_volumes == 0) return count(flood_.sweep_until(m, start, end));
  }
  return flood(m, start);
}

template <int D>
bool SimplexSweep<D>::is_free(const Body<D>& body, const EdgeSweep& sweep) {
  if (sweeps_edges(body.level)) return is_triangle_free(motion(body, sweep), body.vertices[sweep.v].cell);
  const MovingEdge& edge = sweep.edge;
  if (edge.arrival == edge.fixed && env_.map.convex(edge.arrival)) {  // counted, not cast
    if (counters != nullptr) counters->add({1, 1});
    return true;
  }
  CastRequest request;
  request.from = edge.to;
  request.to = edge.q;
  request.start = edge.arrival;
  request.end = edge.fixed;
  request.max_volumes = max_volumes;
  const CastResult place = cast(env_, request, counters);
  limited_ = limited_ || place.end == CastEnd::kWorkLimit;
  return place.end == CastEnd::kReached && place.cell == edge.fixed;
}

template <int D>
bool SimplexSweep<D>::is_free(const Body<D>& body, const FaceSweep& sweep) {
  return is_tetrahedron_free(motion(body, sweep), body.vertices[sweep.v].cell);
}

template <int D>
bool SimplexSweep<D>::find_first(const Body<D>& body, const EdgeSweep& sweep, const SweepEvent* before,
                                 SweepContact* found) {
  FirstRidge ridge;
  const bool swept = sweep.edge.reached && sweeps_edges(body.level);
  if (ask(body, sweep, true, swept ? &ridge : nullptr) != Verdict::kUnknown) return false;
  // At EDGES what is in its way counts only if the edge is not free in its new place.
  if (!swept && sweep.edge.reached && is_free(body, sweep)) return false;
  const bool follows = max_volumes == 0 && body.keeps_corridors();
  if (!swept && follows) {
    const TouchedLines* const touched = lines_of(body, sweep.e, sweep.v);
    if (ask_for_ridge(follower(body, sweep), false, touched, &ridge) != Verdict::kUnknown) return false;
  }
  const EdgeMotion m = motion(body, sweep);
  if (ridge.facet.valid()) {
    if (before != nullptr && compare_events<D>(m.p, m.to, *before, ridge.event).sign < 0) return false;
    if (meets_first(env_, body, sweep, ridge, found)) return true;
  }
  const Cell start = body.vertices[sweep.v].cell;
  if (is_boxed(bounds<D>(m.p, m.to, m.q), start)) return false;
  if (before != nullptr && follows && is_free_before(follower(body, sweep), *before)) return false;
  const SweepResult met = flood_until(m, start, before != nullptr ? time_after<D>(m.p, m.to, *before) : 1);
  if (met.end != SweepEnd::kContact) return false;
  keep_touched_line(env_, body, sweep.e, sweep.v, met.contact);
  *found = met.contact;
  return true;
}

template <int D>
bool SimplexSweep<D>::find_first(const Body<D>& body, const FaceSweep& sweep, const SweepEvent*, SweepContact* found) {
  if constexpr (D == 3) {
    const FaceMotion m = motion(body, sweep);
    const Cell start = body.vertices[sweep.v].cell;
    if (ask(body, sweep) != Verdict::kUnknown || is_boxed(bounds<D>(m.p, m.to, m.q, m.r), start)) return false;
    const SweepResult met = flood(m, start);
    if (met.end == SweepEnd::kContact) *found = met.contact;
    return met.end == SweepEnd::kContact;
  }
  return false;
}

template class SimplexSweep<2>;
template class SimplexSweep<3>;

}  // namespace dsw
