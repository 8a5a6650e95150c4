#include "response/edge_pass.h"

#include <algorithm>

#include "base/compiler.h"
#include "base/search.h"

namespace dsw {

template <int D>
void EdgePass<D>::sweep(bool may_skip, bool may_guess) {
  may_guess_ = may_guess;
  const Body<D>& body = *course_.motion.body;
  const bool only_places = !sweeps_edges(body.level) && !body.keeps_corridors();
  const bool skips_back = D == 3 && may_skip && body.skipping.back_edges;  // no edge of the plane has faces
  const bool leaves_back = skips_back && body.skipping.leaves_back_edges;
  sieve_.start(may_skip);
  while (sieve_.next()) {
    if (only_places) {
      if (leaves_back) {
        pass_places<BackEdges::kLeft>();
      } else if (skips_back) {
        pass_places<BackEdges::kSkipped>();
      } else {
        pass_places<BackEdges::kCast>();
      }
    } else if (!body.keeps_corridors()) {
      for (const uint32_t e : sieve_) sweep_ways(e);
    } else {
      sweep_chunk();
    }
  }
  casts_.run_edges();
}

/** Tests the edges of a chunk in their new places. Those that are seen to be free, and whose ends both move and are not in
 * doubt, are only counted: at once, as long as nothing is cast, and no end is put in doubt otherwise. */
template <int D>
template <BackEdges Back>
void EdgePass<D>::pass_places() {
  const typename ShortEdges<D>::Seen seen = sieve_.find_short();
  const uint64_t plain = seen.first & seen.second & seen.sure;
  const uint32_t doubts = casts_.doubts(), count = sieve_.count();
  const auto cast = [&](uint32_t i) {
    cast_places<Back>(sieve_.begin()[i], (seen.first >> i & 1) != 0, (seen.second >> i & 1) != 0);
  };
  for (uint32_t i = 0; i < count;) {
    const bool may_count = plain != 0 && doubts == casts_.doubts();
    const uint32_t some = may_count ? std::min(count - i, casts_.room() / 2) : 0;
    if (some == 0) {
      cast(i++);
      continue;
    }
    const uint64_t part = (~uint64_t{0} >> (64 - some)) << i;
    count_plain<Back>(plain & part, seen.inwards);
    for (uint64_t rest = part & ~plain; rest != 0; rest &= rest - 1) cast(lowest_bit(rest));
    i += some;
  }
}

/** Counts the tests of edges of the chunk that are seen to be free. @param inwards the edges with an end that goes inwards: of the
 * others no test is left out, and the sieve has noted that they are tested. */
template <int D>
template <BackEdges Back>
void EdgePass<D>::count_plain(uint64_t which, uint64_t inwards) {
  if (which == 0) return;
  const uint32_t tests = 2 * bit_count(which);
  uint32_t left_tests = 0;
  sweeps_.counts.swept += tests;
  if (Back != BackEdges::kCast) {
    Body<D>& body = *course_.motion.body;
    for (which &= inwards; which != 0; which &= which - 1) {
      const uint32_t e = sieve_.begin()[lowest_bit(which)];
      const BodyEdge& edge = body.edges[e];
      const Left left =
          left_out<Back>(course_.vertices[edge.ends[0]], course_.vertices[edge.ends[1]], edge.faces[1] != kNone);
      left_tests += left.tests;
      if (Back == BackEdges::kLeft) body.untested[e] = left.last;
    }
  }
  sweeps_.counts.skipped += left_tests;
  casts_.add_seen_at_once(tests - left_tests);
}

/** Which tests of an edge are left out whose ends both move: with kSkipped that of the first end if it alone goes inwards, with
 * kLeft that of each end that does. */
template <int D>
template <BackEdges Back>
typename EdgePass<D>::Left EdgePass<D>::left_out(const Vertex& a, const Vertex& b, bool is_closed) {
  if (Back == BackEdges::kCast) return {};
  const bool turned = b.rank < a.rank;
  const uint8_t closed = is_closed ? 1 : 0, first = (turned ? b : a).inwards ? closed : 0,
                second = (turned ? a : b).inwards ? closed : 0;
  if (Back == BackEdges::kSkipped) return {static_cast<uint8_t>(first & ~second), 0};
  return {static_cast<uint8_t>(first + second), second};
}

/** Casts an edge in its new places, that of the end whose turn comes first and then that of the other one, but for tests
 * that are left out. What sweep_way does for both ends, at EDGES where no corridors are kept, without branches on which end is
 * the first. If the last test is left, the edge has not been tested where it arrives [JCD10] 6.2. */
template <int D>
template <BackEdges Back>
void EdgePass<D>::cast_places(uint32_t e, bool first_seen, bool second_seen) {
  Body<D>& body = *course_.motion.body;
  const PointArray targets = course_.motion.targets;
  const uint32_t(&ends)[2] = body.edges[e].ends;
  const uint32_t k = course_.vertices[ends[1]].rank < course_.vertices[ends[0]].rank ? 1 : 0;
  const uint32_t v = ends[k], w = ends[1 - k];
  Vertex &first = course_.vertices[v], &second = course_.vertices[w];
  if (first.rank == kNone) return;
  const VertexWay &first_way = course_.motion.ways[v], &second_way = course_.motion.ways[w];
  const bool both = second.rank != kNone, is_clear = course_.is_edge_clear(e), closed = body.edges[e].faces[1] != kNone;
  bool skips_first = first.inwards && closed, skips_second = second.inwards && closed;
  if (Back == BackEdges::kCast) skips_first = false;
  if (Back == BackEdges::kSkipped) skips_first = skips_first && both && !second.inwards;
  if (Back != BackEdges::kLeft) skips_second = false;
  const auto count = [&](bool skips) {
    ++sweeps_.counts.swept;
    sweeps_.counts.skipped += skips ? 1 : 0;
    return !skips && !is_clear;
  };
  if (!first.doubtful && count(skips_first))
    add_place(first_seen, e, v, {first_way.arrival, targets[v]}, {second_way.from, body.position(w)});
  if (Back == BackEdges::kLeft) body.untested[e] = (both ? skips_second : skips_first) ? 1 : 0;
  if (!both) return;
  if (!first_way.arrival.valid()) course_.put_in_doubt(w);
  if (!second.doubtful && count(skips_second))
    add_place(second_seen, e, w, {second_way.arrival, targets[w]}, {first_way.arrival, targets[v]});
}

/** Adds a place of an edge to those that are cast, if the edge is not seen to be free there. */
template <int D>
void EdgePass<D>::add_place(bool is_seen, uint32_t e, uint32_t v, const End& from, const End& to) {
  if (is_seen) {
    casts_.add_seen();
  } else {
    casts_.add_place(e, v, from, to);
  }
}

/** Finds the edges of a chunk whose ends stay in their cells: in one convex cell, or in two between which the edge is
 * known to pass facets all the way. What SimplexSweep::ask finds out of one move of one end, for both. */
template <int D>
void EdgePass<D>::ask_side_by_side() {
  const Body<D>& body = *course_.motion.body;
  const typename Course<D>::Vertex* const vertices = course_.vertices.data();
  const VertexWay* const ways = course_.motion.ways.data();
  inside_ = keeping_ = 0;
  uint64_t between = 0, at = 0;
  sieve_.prefetch_corridors();
  for (const uint32_t e : sieve_) {
    const uint32_t(&ends)[2] = body.edges[e].ends;
    const VertexWay &a = ways[ends[0]], &b = ways[ends[1]];
    const Portal<D>& portal = body.corridors[e].portal;
    const uint64_t stay = uint64_t{a.from == a.arrival} & uint64_t{b.from == b.arrival}, same = a.from == b.from;
    inside_ |= (stay & same & uint64_t{env_.map.convex(a.from)}) << at;
    const uint64_t moves = uint64_t{vertices[ends[0]].rank != kNone} | uint64_t{vertices[ends[1]].rank != kNone};
    between |= (moves & stay & ~same & uint64_t{portal.front == a.from} & uint64_t{portal.back == b.from}) << at;
    ++at;
  }
  if (sweeps_.max_volumes != 0) return;  // what is kept must not carry an edge past it
  for (uint64_t rest = between; rest != 0; rest &= rest - 1) {
    prefetch_way(env_, body.corridors[sieve_.begin()[lowest_bit(rest)]]);
  }
  for (; between != 0; between &= between - 1) {
    const uint32_t i = lowest_bit(between);
    keeping_ |= uint64_t{keeps_between(sieve_.begin()[i])} << i;
  }
}

/** Whether an edge keeps to the way between the cells of its ends, where they stay. */
template <int D>
bool EdgePass<D>::keeps_between(uint32_t e) const {
  const Body<D>& body = *course_.motion.body;
  Corridor<D>& corridor = body.corridors[e];
  const Portal<D>& portal = corridor.portal;
  const uint32_t(&ends)[2] = body.edges[e].ends;
  const VertexWay* const ways = course_.motion.ways.data();
  if (portal.version != env_.obstacle_version || !portal.leads(env_, ways[ends[0]].from, ways[ends[1]].from))
    return false;
  const bool turned = course_.vertices[ends[1]].rank < course_.vertices[ends[0]].rank;
  const uint32_t v = ends[turned ? 1 : 0], w = ends[turned ? 0 : 1];
  const EdgeWay way{body.position(v), course_.place(v, kNone), body.position(w), course_.place(w, kNone), !turned};
  if (portal.is_only()) return keeps_to_portal(env_, portal, way);
  if (corridor.in_rows) return keeps_to_rows(corridor, way, sweeps_edges(body.level));
  return keeps_to_facets(env_, corridor, way);
}

/** Edges in their order: what one of them meets lets others wait. */
template <int D>
void EdgePass<D>::sweep_chunk() {
  const Body<D>& body = *course_.motion.body;
  ask_side_by_side();
  const uint32_t inside_counts = body.skipping.by_environment ? 1 : 0,
                 keeping_counts = body.skipping.by_clearance || body.skipping.corridors ? 1 : 0;
  uint64_t bit = 1;
  for (const uint32_t e : sieve_) {
    const typename Course<D>::Vertex &a = course_.vertices[body.edges[e].ends[0]],
                                     &b = course_.vertices[body.edges[e].ends[1]];
    const bool inside = (inside_ & bit) != 0, decided = ((inside_ | keeping_) & bit) != 0;
    bit <<= 1;
    if ((uint32_t{!decided} | uint32_t{a.doubtful} | uint32_t{b.doubtful}) != 0) {
      sweep_ways(e);
      continue;
    }
    const uint32_t moves = (a.rank != kNone ? 1u : 0u) + (b.rank != kNone ? 1u : 0u);
    sweeps_.counts.swept += moves;
    sweeps_.counts.skipped += moves * (inside ? inside_counts : keeping_counts);
    if (inside && !body.corridors[e].facets.empty()) {
      Corridor<D>& corridor = body.corridors.own(e, env_.obstacle_version);
      corridor.keep(body.call);
      corridor.clear();
    }
  }
}

/** In the order of the turns of both ends: what the edge is found to pass is then that of its last place. */
template <int D>
void EdgePass<D>::sweep_ways(uint32_t e) {
  const uint32_t(&ends)[2] = course_.motion.body->edges[e].ends;
  const bool turned = course_.vertices[ends[1]].rank < course_.vertices[ends[0]].rank;
  const uint32_t a = ends[turned ? 1 : 0], b = ends[turned ? 0 : 1];
  const bool boxed = sweeps_edges(course_.motion.body->level) && ((D == 3 && course_.is_edge_clear(e)) || is_boxed(e));
  sweep_way(e, a, b, boxed);
  sweep_way(e, b, a, boxed);
}

/** @param boxed as is_boxed says. */
template <int D>
void EdgePass<D>::sweep_way(uint32_t e, uint32_t v, uint32_t other, bool boxed) {
  const Body<D>& body = *course_.motion.body;
  typename Course<D>::Vertex& moving = course_.vertices[v];
  if (moving.rank == kNone) return;
  const Cell fixed = course_.cell_at(other, moving.rank);
  // Where the other one will be is not known if there is something on its way.
  const bool other_meets = may_guess_ && course_.vertices[other].meets && course_.vertices[other].rank < moving.rank;
  moving.doubtful = moving.doubtful || other_meets || !fixed.valid();
  if (moving.doubtful) {
    if (!course_.keeps.empty()) course_.keeps[e] = false;
    return;
  }
  const VertexWay& way = course_.motion.ways[v];
  const PointWay path{body.position(v), course_.motion.targets[v], way.from, way.arrival, casts_.crossed(v)};
  const MovingPart sweep{{Simplex::kEdge, e},       v, path, course_.place(other, moving.rank), nullptr, fixed, Cell{},
                         body.edges[e].ends[0] == v};
  const Verdict verdict = boxed ? sweeps_.count_boxed(body) : sweeps_.ask(body, sweep, false);
  if (!course_.keeps.empty()) {
    const bool same = verdict == Verdict::kInside || (verdict == Verdict::kHolds && way.from == way.arrival);
    course_.keeps[e] = course_.keeps[e] && same;
  }
  if (verdict != Verdict::kUnknown) return;
  if (sweeps_edges(body.level)) {
    if (course_.is_edge_clear(e)) return;
    moving.doubtful = (may_guess_ && sweeps_.meets_touched_line(body, sweep)) || !sweeps_.is_free(body, sweep);
    moving.meets = moving.doubtful;
    return;  // its corridor is noted when it is asked for again
  }
  // A corridor is noted in the direction of the edge.
  const typename CourseCasts<D>::End moved{way.arrival, path.end}, still{fixed, sweep.q};
  const bool turned = body.keeps_corridors() && body.edges[e].ends[0] != v;
  casts_.add_edge(e, v, turned ? still : moved, turned ? moved : still);
}

/** Whether an edge and what both of its ends sweep lie in a box that is free. Not asked of edges that stay inside of
 * one cell, which is seen sooner, and of those known to cross more cells than a box may meet: they have their
 * corridors. */
template <int D>
bool EdgePass<D>::is_boxed(uint32_t e) {
  constexpr size_t kMostFacets = 3;
  const Body<D>& body = *course_.motion.body;
  const uint32_t v = body.edges[e].ends[0], w = body.edges[e].ends[1];
  const VertexWay &a = course_.motion.ways[v], &b = course_.motion.ways[w];
  if ((!course_.moves(v) && !course_.moves(w)) || !BoxProbe<D>::suits(env_, a.from)) return false;
  if (a.from == a.arrival && a.from == b.from && a.from == b.arrival && env_.map.convex(a.from)) return false;
  if (body.keeps_corridors() && body.corridors[e].facets.size() > kMostFacets) return false;
  Bounds<D> box(body.position(v));
  course_.include_way(v, box);
  course_.include_way(w, box);
  return sweeps_.is_boxed(box, a.from, b.from);
}

template <int D>
void FacePass<D>::sweep() {
  if (course_.all_clear) return;
  find_sides();
  for (uint32_t f = 0; f < course_.motion.body->faces.size(); ++f) {
    if (course_.motion.body->has_face(f) && !course_.is_face_clear(f) && !shares_corridor(f) && !is_boxed(f))
      sweep_face(f);
  }
}

template <int D>
void FacePass<D>::find_sides() {
  const Body<D>& body = *course_.motion.body;
  sides_.assign(3 * body.faces.size(), kNone);
  for (uint32_t e = 0; e < body.edges.size(); ++e) {
    for (const uint32_t f : body.edges[e].faces) {
      if (f == kNone) continue;
      const uint32_t(&corners)[3] = body.faces[f].corners, (&ends)[2] = body.edges[e].ends;
      uint32_t opposite = 0;
      while (corners[opposite] == ends[0] || corners[opposite] == ends[1]) ++opposite;
      sides_[3 * size_t{f} + opposite] = e;
    }
  }
}

/** What a face sweeps when its vertices move in their order. */
template <int D>
void FacePass<D>::sweep_face(uint32_t f) {
  const Body<D>& body = *course_.motion.body;
  for (const uint32_t v : body.faces[f].corners) {
    typename Course<D>::Vertex& moving = course_.vertices[v];
    if (moving.rank == kNone || moving.doubtful) continue;
    const uint32_t q = body.faces[f].after(v), r = body.faces[f].before(v), rank = moving.rank;
    const VertexWay& way = course_.motion.ways[v];
    const PointWay path{body.position(v), course_.motion.targets[v], way.from, way.arrival, {}};
    const MovingPart sweep{
        {Simplex::kFace, f},      v,    path, course_.place(q, rank), course_.place(r, rank), course_.cell_at(q, rank),
        course_.cell_at(r, rank), false};
    moving.doubtful = !sweeps_.passes(body, sweep);
  }
}

/** Whether a face and what it sweeps lie in a box that is free. */
template <int D>
bool FacePass<D>::is_boxed(uint32_t f) {
  const uint32_t(&corners)[3] = course_.motion.body->faces[f].corners;
  const auto from = [&](int k) { return course_.motion.ways[corners[k]].from; };
  const bool stays = dsw::none_of(corners, corners + 3, [&](uint32_t v) { return course_.moves(v); });
  if (stays || !BoxProbe<D>::suits(env_, from(0))) return false;
  Bounds<D> box(course_.motion.body->position(corners[0]));
  for (const uint32_t v : corners) course_.include_way(v, box);
  return sweeps_.is_boxed(box, from(0), from(1), from(2));
}

/** Whether an edge is known to keep to its corridor in its present place. */
template <int D>
bool FacePass<D>::keeps_at_rest(uint32_t e) const {
  const Body<D>& body = *course_.motion.body;
  const BodyVertex<D>&a = body.vertices[body.edges[e].ends[0]], &b = body.vertices[body.edges[e].ends[1]];
  return follows(env_, body.corridors[e], a.position, b.position, a.cell, b.cell);
}

/** Whether a face's edges keep to their corridors all through the move, and lie in one corridor. Then no edge of
 * the environment pierces the face, before, between or after, nor what its edges sweep: so no vertex is inside of the
 * tetrahedra. */
template <int D>
bool FacePass<D>::shares_corridor(uint32_t f) const {
  const Body<D>& body = *course_.motion.body;
  if (!body.keeps_corridors()) return false;
  CorridorView views[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t e = sides_[3 * size_t{f} + k];
    const uint32_t(&ends)[2] = body.edges[e].ends;
    const bool moves = course_.moves(ends[0]) || course_.moves(ends[1]);
    if (moves ? !course_.keeps[e] : !keeps_at_rest(e)) return false;
    const Array<uint32_t>& facets = body.corridors[e].facets;
    views[k] = {facets.data(), facets.size(), ends[0] != body.faces[f].corners[(k + 1) % 3]};
  }
  return share_corridor(env_.map, views[2], views[0], views[1]);
}

template class EdgePass<2>;
template class EdgePass<3>;
template class FacePass<3>;  // nothing of the plane has faces

}  // namespace dsw
