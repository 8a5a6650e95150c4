#include "sweep/simplex_sweep.h"

#include "walk/short_way.h"

namespace dsw {

/** Most paths end in their tetrahedron or at its wall, which takes no cast to see; with counters, a hit is a cast that counts. */
template <int D>
CastResult SimplexSweep<D>::cast_path(const Body<D>& body, uint32_t v, const double* to) {
  const BodyVertex<D>& at = body.vertices[v];
  CastResult path;
  limited_ = false;
  if (ends_at_once(env_, at.cell, to, &path) && (path.end == CastEnd::kReached || counters == nullptr)) return path;
  path = cast(env_, at.position, to, at.cell, max_volumes, counters);
  limited_ = path.end == CastEnd::kWorkLimit;
  return path;
}

template <int D>
Verdict SimplexSweep<D>::ask_edge(const Body<D>& body, const MovingPart& edge, bool ask_balls, FirstRidge* ridge) {
  const Skipping& skipping = body.skipping;
  Question what = question(body);
  KeptOfEdge<D> kept = kept_of(body, edge);
  what.asks_cells = skipping.by_environment || kept.corridor != nullptr;
  if (ask_balls && skipping.by_clearance) {
    kept.balls[0] = &body.clearances[edge.vertex];
    kept.balls[1] = &body.clearances[body.edges[edge.part.index].other(edge.vertex)];
  }
  if (ridge != nullptr) kept.touched = lines_of(body, edge.part.index, edge.vertex);
  const Verdict verdict = dsw::ask(env_, edge, what, kept, scratch_, ridge);
  if (!edge.reached) return verdict;
  const bool is_of_cell = verdict == Verdict::kInside || verdict == Verdict::kSeen;
  const bool counts_it = is_of_cell ? skipping.by_environment : skipping.by_clearance || skipping.corridors;
  ++counts.swept;
  counts.skipped += verdict != Verdict::kUnknown && counts_it ? 1 : 0;
  return verdict;
}

/** Whether what the face sweeps lies inside of one cell. */
template <int D>
Verdict SimplexSweep<D>::ask_face(const MovingPart& face) const {
  const Cell cell = face.way.arrival;
  const bool inside = face.reached && face.way.from == cell && face.q_cell == cell && face.r_cell == cell;
  if (!inside) return Verdict::kUnknown;
  if (env_.map.convex(cell)) return Verdict::kInside;
  const auto sees = [&](const double* point) { return sees_all(env_, cell, point, counters); };
  return sees(face.way.end) && sees(face.q) && sees(face.r) ? Verdict::kSeen : Verdict::kUnknown;
}

template <int D>
SweepResult SimplexSweep<D>::flood(const MovingPart& sweep) {
  if constexpr (D == 3) {
    if (sweep.part.kind == Simplex::kFace) return flood(sweep.face(), sweep.way.from);
  }
  return flood(sweep.edge(), sweep.way.from);
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
bool SimplexSweep<D>::is_free(const Body<D>& body, const MovingPart& sweep) {
  const PointWay& way = sweep.way;
  if (sweep.part.kind == Simplex::kFace) return is_tetrahedron_free(sweep.face(), way.from);
  if (sweeps_edges(body.level)) return is_triangle_free(sweep.edge(), way.from);
  if (way.arrival == sweep.q_cell && env_.map.convex(way.arrival)) {  // counted, not cast
    if (counters != nullptr) counters->add({1, 1});
    return true;
  }
  CastRequest request;
  request.from = way.end;
  request.to = sweep.q;
  request.start = way.arrival;
  request.end = sweep.q_cell;
  request.max_volumes = max_volumes;
  const CastResult place = cast(env_, request, counters);
  limited_ = limited_ || place.end == CastEnd::kWorkLimit;
  return place.end == CastEnd::kReached && place.cell == sweep.q_cell;
}

template <int D>
bool SimplexSweep<D>::find_first(const Body<D>& body, const MovingPart& sweep, const SweepEvent* before,
                                 SweepContact* found) {
  if (sweep.part.kind == Simplex::kFace) return find_first_of_face(sweep, found);
  FirstRidge ridge;
  const bool swept = sweep.reached && sweeps_edges(body.level);
  if (ask_edge(body, sweep, true, swept ? &ridge : nullptr) != Verdict::kUnknown) return false;
  // At EDGES what is in its way counts only if the edge is not free in its new place.
  if (!swept && sweep.reached && is_free(body, sweep)) return false;
  // From here on what counts is what is met first.
  Question what = question(body);
  KeptOfEdge<D> kept = kept_of(body, sweep);
  what.arrives = false;
  if (!swept) {
    kept.touched = lines_of(body, sweep.part.index, sweep.vertex);
    if (dsw::ask(env_, sweep, what, kept, scratch_, &ridge) != Verdict::kUnknown) return false;
  }
  const EdgeMotion m = sweep.edge();
  if (ridge.facet.valid()) {
    if (before != nullptr && compare_events<D>(m.p, m.to, *before, ridge.event).sign < 0) return false;
    if (meets_first(env_, body, sweep, ridge, found)) return true;
  }
  if (is_boxed(bounds<D>(m.p, m.to, m.q), sweep.way.from)) return false;
  what.before = before;
  if (before != nullptr && dsw::ask(env_, sweep, what, kept, scratch_) != Verdict::kUnknown) return false;
  const SweepResult met = flood_until(m, sweep.way.from, before != nullptr ? time_after<D>(m.p, m.to, *before) : 1);
  if (met.end != SweepEnd::kContact) return false;
  keep_touched_line(env_, body, sweep.part.index, sweep.vertex, met.contact);
  *found = met.contact;
  return true;
}

template <int D>
bool SimplexSweep<D>::find_first_of_face(const MovingPart& face, SweepContact* found) {
  if constexpr (D == 3) {
    const FaceMotion m = face.face();
    if (ask_face(face) != Verdict::kUnknown || is_boxed(bounds<D>(m.p, m.to, m.q, m.r), face.way.from)) return false;
    const SweepResult met = flood(m, face.way.from);
    if (met.end == SweepEnd::kContact) *found = met.contact;
    return met.end == SweepEnd::kContact;
  }
  return false;
}

template class SimplexSweep<2>;
template class SimplexSweep<3>;

}  // namespace dsw
