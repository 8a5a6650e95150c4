#include "sweep/star.h"

#include <algorithm>

#include "environment/marking.h"
#include "flood/hop.h"
#include "flood/sequence.h"
#include "sweep/clearance.h"

namespace dsw {
namespace {

constexpr int kMostTurns = 4;  // then a cast costs no more

/** The vertex before its edges before its faces. */
uint64_t feature(const StarContact& c) noexcept {
  if (c.edge != kNone) return 1 + uint64_t{c.edge};
  return c.face != kNone ? (uint64_t{1} << 33) + c.face : 0;
}

}  // namespace

template <int D>
StarSweep<D>::StarSweep(const Environment<D>& env) : env_(env), probe_(env), flood_(env) {}

/** Whether what an edge sweeps lies in the cell that its ends are in, which need not be convex. From one end in its new place all of the
 * cell is seen, hence the edge lies in it; where the triangle counts, from both: so the moving end's path lies in the cell, and what joins
 * that to the fixed end. */
template <int D>
bool StarSweep<D>::is_seen(const Body<D>& body, const EdgeSweep& sweep) const {
  const bool from_target = sees_all(env_, sweep.arrival, sweep.to, counters);
  if (from_target == (body.level == SweepLevel::kEdges)) return from_target;
  return sees_all(env_, sweep.fixed, sweep.q, counters);
}

template <int D>
bool StarSweep<D>::is_seen(const FaceMotion& m, Cell cell) const {
  return sees_all(env_, cell, m.to, counters) && sees_all(env_, cell, m.q, counters) &&
         sees_all(env_, cell, m.r, counters);
}

template <int D>
typename StarSweep<D>::Settled StarSweep<D>::settle_by_what_is_kept(const Body<D>& body, const EdgeSweep& sweep,
                                                                    bool ask_balls) {
  // What is known must not carry an edge past the work limit that it meets without.
  if (max_cells != 0) return Settled::kNo;
  const Skipping& skipping = body.skipping;
  Settled settled = Settled::kNo;
  if (ask_balls && is_clear(body, sweep)) {
    settled = Settled::kClear;
  } else if (body.keeps_sequences()) {
    settled = follow_sequence(body, sweep);
  }
  counts.skipped += settled != Settled::kNo && (skipping.by_clearance || skipping.sequences) ? 1 : 0;
  return settled;
}

/** Whether the triangle lies in a ball that is free. */
template <int D>
bool StarSweep<D>::is_clear(const Body<D>& body, const EdgeSweep& sweep) const {
  const double* const p = body.position(sweep.v);
  return covers(env_, body.clearances[sweep.v], p, sweep.to, sweep.q) ||
         covers(env_, body.clearances[body.edges[sweep.e].other(sweep.v)], p, sweep.to, sweep.q);
}

/** The path of an end has passed a facet of `from`: the edge has one facet less to pass, or one more. */
template <int D>
bool StarSweep<D>::pass_on(EdgeSequence<D>& sequence, HalfFacet crossed, Cell from, bool first) const {
  // As the sequence names it: passed on the way from ends[0].
  const HalfFacet beyond = env_.map.opposite(crossed);
  const HalfFacet left = first ? crossed : beyond, met = first ? beyond : crossed;
  if (!sequence.facets.empty()) {
    const HalfFacet end{first ? sequence.facets.front() : sequence.facets.back()};
    // What is noted may be of another place, at EDGES: then it does not go on where the path has left its cell.
    if (env_.map.cell_of(first ? end : env_.map.opposite(end)) != from) return false;
    if (end == left) {
      sequence.remove(env_, first);
      return true;
    }
  }
  sequence.add(env_, met, first);
  return true;
}

/** Whether a triangle is free one side of which passes, in the old place, half of the facets round a pivot, and another, in the new place,
 * the others.
 * In space: before and after these the sides share facets, and what of the triangle lies there is in cells, as in one strip. Let Q be what
 * lies between. Its boundary is in the cells round the edge and goes once round the edge's line, so Q meets that line; with the edge's ends
 * on either side of the triangle's plane it does so in a point y of the edge. Q is convex: each of its points is between y and one of its
 * boundary. Both are in one cell, as all of these cells have the edge, so all between is in that cell.
 * In the plane the edge may have turned round several vertices, all asked here. All cells and facets at each are passable, as the sequence
 * before or after has them. So the triangle's sides lie in an open set, of what is passable, where they can be drawn together into a
 * point, over one vertex after the other; a point of the triangle outside of it would be one that they wind round. */
template <int D>
bool StarSweep<D>::turns_freely(const Body<D>& body, const EdgeSweep& sweep, const Pivot<D>& pivot) const {
  if constexpr (D == 3) {
    const double* const triangle[3] = {body.position(sweep.v), sweep.to, sweep.q};
    const uint32_t(&edge)[2] = pivot.vertices;
    const int a = orient<D>(triangle, env_.point(edge[0])), b = orient<D>(triangle, env_.point(edge[1]));
    return a * b < 0 && (env_.marked_edges == 0 || !env_.edge_marks.contains(edge[0], edge[1]));
  } else {
    return !vertex_marked(env_, pivot.vertices[0]);
  }
}

/** Whether the edge goes to the other side of a pivot, or of a few, and is free there with what it sweeps on its way; at EDGES the new
 * place is all that counts. */
template <int D>
bool StarSweep<D>::turns(const Body<D>& body, const EdgeSweep& sweep, bool first) {
  EdgeSequence<D>& sequence = body.sequences[sweep.e];
  const double *const from = first ? sweep.to : sweep.q, *const to = first ? sweep.q : sweep.to;
  const Cell start = first ? sweep.arrival : sweep.fixed, end = first ? sweep.fixed : sweep.arrival;
  const bool swept = body.level != SweepLevel::kEdges;
  Pivot<D> pivot;
  for (int rest = swept && D == 3 ? 1 : kMostTurns; rest != 0; --rest) {
    if (!turn(env_, sequence, from, to, pivot) || (swept && !turns_freely(body, sweep, pivot))) break;
    if (follows(env_, sequence, from, to, start, end)) return true;
  }
  return false;
}

/** Whether the edge keeps to the facets that it was last known to pass, but for those that its end passes itself, and for those round
 * a pivot to whose other side it goes: then it is free in its new place. If it kept to them before, too, the
 * triangle's sides share a strip of cells, or part at one pivot. A path of two facets may come from one cell beside the strip and go to
 * another: its facets cut off the triangle's corners in these, and what is left lies in the cell between them and in the strip. */
template <int D>
typename StarSweep<D>::Settled StarSweep<D>::follow_sequence(const Body<D>& body, const EdgeSweep& sweep) {
  EdgeSequence<D>& sequence = body.sequences[sweep.e];
  const BodyVertex<D>& from = body.vertices[sweep.v];
  const bool first = body.edges[sweep.e].ends[0] == sweep.v;
  const auto keeps = [&](const double* p, Cell cell) {
    return first ? follows(env_, sequence, p, sweep.q, cell, sweep.fixed)
                 : follows(env_, sequence, sweep.q, p, sweep.fixed, cell);
  };
  const auto passes_on = [&] {
    Cell cell = from.cell;
    for (uint32_t i = 0; i < sweep.crossed.count; ++i) {
      if (!pass_on(sequence, sweep.crossed.facets[i], cell, first)) return false;
      cell = env_.map.cell_of(env_.map.opposite(sweep.crossed.facets[i]));
    }
    return cell == sweep.arrival;
  };
  if (!sequence.known()) return Settled::kNo;
  if (from.cell != sweep.arrival && sweep.crossed.count == 0) return Settled::kNo;
  if (body.level != SweepLevel::kEdges && !keeps(from.position, from.cell)) return Settled::kNo;
  const bool stays = sweep.crossed.count == 0;
  if (stays && keeps(sweep.to, sweep.arrival)) return Settled::kStrip;
  before_ = sequence.facets;
  if (passes_on()) {
    if (!stays && keeps(sweep.to, sweep.arrival)) return Settled::kStrip;
    if (turns(body, sweep, first)) return Settled::kTurned;
  }
  sequence.assign(env_, before_);
  return Settled::kNo;
}

template <int D>
bool StarSweep<D>::keeps_sequence(const Body<D>& body, uint32_t e) const {
  const BodyVertex<D>&a = body.vertices[body.edges[e].ends[0]], &b = body.vertices[body.edges[e].ends[1]];
  return follows(env_, body.sequences[e], a.position, b.position, a.cell, b.cell);
}

/** Whether an edge meets nothing before its moving end meets a wall of the cell `front`: up to there it stays in that cell, or in
 * that and a second one and passes between them. Of a line through q the sides of a ridge change linearly on the way of its other end:
 * where it passes the facet at both ends of the way, it does so between. */
template <int D>
bool StarSweep<D>::stays_before_wall(const BodyVertex<D>& at, const double* to, Cell front,
                                     const BodyVertex<D>& fixed) const {
  if (at.cell != front) return false;
  if (front == fixed.cell) return env_.map.convex(front);
  return passes_between(env_, front, fixed.cell, at.position, fixed.position) &&
         passes_between(env_, front, fixed.cell, to, fixed.position);
}

/** Whether an edge is not known to be free in its new place; fills hit_edges_ with all, or with some if one is enough. */
template <int D>
bool StarSweep<D>::find_hit_edges(const Body<D>& body, uint32_t v, const double* to, Cell cell, bool one_is_enough) {
  hit_edges_.clear();
  packet_.clear();  // of casts that ran out of memory
  const auto run = [&] {
    packet_.run(env_, counters);
    for (uint32_t i = 0; i < packet_.count(); ++i) {
      const CastEnd end = packet_.result(i).end;
      if (!packet_.reached(i)) hit_edges_.push_back(packet_edges_[i]);
      limited_ = limited_ || end == CastEnd::kWorkLimit;
    }
    packet_.clear();
  };
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
    if (settles(body, {e, v, to, cell, fixed.position, fixed.cell, {}})) return true;
    packet_edges_[packet_.count()] = e;
    CastRequest& request = packet_.add(env_, cell, to, fixed.position);
    request.end = fixed.cell;
    request.max_cells = max_cells;
    if (packet_.full()) run();
    return !(one_is_enough && !hit_edges_.empty());
  });
  run();
  return !hit_edges_.empty();
}

template <int D>
StarTry StarSweep<D>::try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
  const BodyVertex<D>& at = body.vertices[v];
  StarTry tried;
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return tried;
  }
  const CastResult path = cast(env_, at.position, to, at.cell, max_cells, counters);
  *cell = path.cell;
  limited_ = path.end == CastEnd::kWorkLimit;
  bool free = path.end == CastEnd::kReached;
  const auto answer = [&] {
    if (!free) tried.end = limited_ ? SweepEnd::kWorkLimit : SweepEnd::kContact;
    return tried;
  };
  if (!free || body.level == SweepLevel::kPoints) return answer();
  if (body.level == SweepLevel::kEdges) {
    free = !find_hit_edges(body, v, to, path.cell, true);
    if (!free) tried.edge = hit_edges_[0];
    return answer();
  }
  const PathFacets passed = path_facets(env_.map, at.cell, path);
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
    if (settles(body, {e, v, to, path.cell, fixed.position, fixed.cell, passed})) return true;
    free = is_triangle_free({at.position, to, fixed.position}, at.cell);
    if (!free) tried.edge = e;
    return free;
  });
  if constexpr (D == 3) {
    if (!free || body.level != SweepLevel::kFaces) return answer();
    for_each_face(body, v, [&](uint32_t f) {
      const BodyFace& face = body.faces[f];
      const BodyVertex<D>&q = body.vertices[face.after(v)], &r = body.vertices[face.before(v)];
      const FaceMotion m{at.position, to, q.position, r.position};
      if (stays_inside(m, at.cell, path.cell, q.cell, r.cell)) return true;
      free = is_tetrahedron_free(m, at.cell);
      if (!free) tried.face = f;
      return free;
    });
  }
  return answer();
}

template <int D>
bool StarSweep<D>::find_obstacle(const Body<D>& body, uint32_t v, const double* to, const StarTry& tried,
                                 CastResult* hit, StarContact* inside) {
  const BodyVertex<D>& at = body.vertices[v];
  *inside = {{}, tried.edge, tried.face};
  const CastResult path = cast(env_, at.position, to, at.cell, 0, counters);
  if constexpr (D == 3) {
    if (tried.face != kNone) {
      const BodyFace& face = body.faces[tried.face];
      const FaceMotion m{at.position, to, body.position(face.after(v)), body.position(face.before(v))};
      inside->contact = flood(m, at.cell).contact;
      return false;
    }
  }
  *hit = path;
  if (tried.edge == kNone) return true;
  const double* const q = body.position(body.edges[tried.edge].other(v));
  *hit = cast(env_, to, q, path.cell, 0, counters);
  if (hit->end == CastEnd::kHit) return true;
  inside->contact = flood(EdgeMotion{at.position, to, q}, at.cell).contact;
  return false;
}

template <int D>
SweepEnd StarSweep<D>::find_first(const Body<D>& body, uint32_t v, const double* to, StarContact* first, Cell* cell) {
  const BodyVertex<D>& at = body.vertices[v];
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return SweepEnd::kFree;
  }
  const CastResult path = cast(env_, at.position, to, at.cell, max_cells, counters);
  *cell = path.cell;
  limited_ = path.end == CastEnd::kWorkLimit;
  if (limited_) return SweepEnd::kWorkLimit;
  bool any = false;
  const auto answer = [&] { return limited_ ? SweepEnd::kWorkLimit : any ? SweepEnd::kContact : SweepEnd::kFree; };
  if (path.end == CastEnd::kHit) consider(at.position, to, {path_contact(env_, path), kNone, kNone}, first, &any);
  if (body.level == SweepLevel::kPoints) return answer();

  const auto sweep_edge = [&](uint32_t e) {
    const EdgeMotion m{at.position, to, body.position(body.edges[e].other(v))};
    if (is_boxed(bounds<D>(m.p, m.to, m.q), at.cell)) return true;
    const SweepResult swept = flood(m, at.cell);
    if (swept.end == SweepEnd::kContact) consider(m.p, to, {swept.contact, e, kNone}, first, &any);
    return true;
  };
  if (body.level == SweepLevel::kEdges && !any) {
    if (find_hit_edges(body, v, to, path.cell, false)) std::for_each(hit_edges_.begin(), hit_edges_.end(), sweep_edge);
    return answer();
  }
  const bool reached = !any;
  const PathFacets passed = path_facets(env_.map, at.cell, path);
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
    const bool settled = reached ? settles(body, {e, v, to, path.cell, fixed.position, fixed.cell, passed})
                                 : stays_before_wall(at, to, path.cell, fixed);
    return settled ? true : sweep_edge(e);
  });
  if constexpr (D == 3) {
    if (body.level != SweepLevel::kFaces) return answer();
    for_each_face(body, v, [&](uint32_t f) {
      const BodyFace& face = body.faces[f];
      const FaceMotion m{at.position, to, body.position(face.after(v)), body.position(face.before(v))};
      if (is_boxed(bounds<D>(m.p, m.to, m.q, m.r), at.cell)) return true;
      const SweepResult swept = flood(m, at.cell);
      if (swept.end == SweepEnd::kContact) consider(m.p, to, {swept.contact, kNone, f}, first, &any);
      return true;
    });
  }
  return answer();
}

template <int D>
void StarSweep<D>::find_all(const Body<D>& body, uint32_t v, const double* to, const StarContact& first,
                            Array<StarContact>& all) {
  const BodyVertex<D>& at = body.vertices[v];
  all.clear();
  const CastResult path = cast(env_, at.position, to, at.cell, max_cells, counters);
  if (path.end == CastEnd::kHit) all.push_back({path_contact(env_, path), kNone, kNone});
  if (body.level == SweepLevel::kPoints) return;
  const auto collect = [&](uint32_t e) {
    flood(EdgeMotion{at.position, to, body.position(body.edges[e].other(v))}, at.cell, true);
    for (const SweepContact& each : flood_.all()) {
      // The diagonal of a flat face is nothing to be met, but where the shift meets it first.
      const bool flat = kind_of(each) == ContactKind::kPlane && env_.map.convex(each.front) &&
                        !(e == first.edge && same_event(each, first.contact));
      if (each.event.kind != EventKind::kVertex && !flat) all.push_back({each, e, kNone});
    }
    return true;
  };
  if (body.level == SweepLevel::kEdges && path.end == CastEnd::kReached) {
    find_hit_edges(body, v, to, path.cell, false);
    std::for_each(hit_edges_.begin(), hit_edges_.end(), collect);
  } else {
    for_each_edge(body, v, collect);
  }
  if (first.face != kNone) all.push_back(first);
  std::sort(all.begin(), all.end(), [&](const StarContact& a, const StarContact& b) {
    if (comes_before(env_.map, at.position, to, a.contact, b.contact)) return true;
    return !comes_before(env_.map, at.position, to, b.contact, a.contact) && feature(a) < feature(b);
  });
}

/** Keeps the earlier one; of equal ones the vertex, then the lowest edge, then the lowest face. */
template <int D>
void StarSweep<D>::consider(const double* p, const double* to, const StarContact& found, StarContact* first,
                            bool* any) const {
  StarContact next = found;
  if (next.contact.event.kind == EventKind::kVertex) next.edge = next.face = kNone;
  const bool later =
      *any && (comes_before(env_.map, p, to, first->contact, next.contact) ||
               (!comes_before(env_.map, p, to, next.contact, first->contact) && feature(*first) <= feature(next)));
  if (later) return;
  *first = next;
  *any = true;
}

template class StarSweep<2>;
template class StarSweep<3>;

}  // namespace dsw
