// Edges are dropped without branches on what is found of each, which would be mispredicted for every other edge.

#include "response/edge_sieve.h"

#include <algorithm>

#include "base/compiler.h"
#include "base/vec.h"
#include "sweep/clearance.h"

namespace dsw {

template <int D>
void EdgeSieve<D>::start(bool may_skip) {
  const Skipping& skipping = course_.motion.body->skipping;
  may_skip_ = may_skip;
  next_ = count_ = 0;
  if (skipping.by_clearance) measure_clearances();
  if (may_skip && skipping.back_edges) find_inwards();
}

/** For vertices whose edges had to be cast; and how much room all have now. */
template <int D>
void EdgeSieve<D>::measure_clearances() {
  Body<D>& body = *course_.motion.body;
  double longest = 0;
  for (const uint32_t v : course_.order) {
    if (course_.moves(v)) longest = std::max(longest, distance_squared<D>(course_.motion.targets[v], body.position(v)));
  }
  const double way = std::sqrt(longest);
  rooms_.assign(body.vertices.size(), 0);
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.has_vertex(v)) continue;
    Clearance<D>& ball = body.clearances[v];
    if (ball.wanted > 0) refresh_clearance(env_, body, v, std::sqrt(ball.wanted) + way);
    ball.wanted = 0;
    rooms_[v] = room_squared(env_, ball, body.position(v), way);
  }
}

/** Which vertices go towards the inside of a closed body: against the normals of all faces at them, where these were
 * when the move began. In doubles: what is left out by this is cast where it arrives. */
template <int D>
void EdgeSieve<D>::find_inwards() {
  const Body<D>& body = *course_.motion.body;
  for (const uint32_t v : course_.order) course_.vertices[v].inwards = course_.moves(v);
  for (uint32_t f = 0; f < body.faces.size(); ++f) {
    if (!body.has_face(f)) continue;
    const uint32_t(&corners)[3] = body.faces[f].corners;
    const double* const p = body.position(corners[0]);
    const Vec normal = difference<D>(body.position(corners[1]), p).cross(difference<D>(body.position(corners[2]), p));
    for (const uint32_t v : corners) {
      const Vec way = difference<D>(course_.place(v, kNone), body.position(v));
      course_.vertices[v].inwards &= dot(way, normal) < 0;
    }
  }
}

template <int D>
bool EdgeSieve<D>::next() {
  const Skipping& skipping = course_.motion.body->skipping;
  if (next_ >= course_.motion.body->edges.size()) return false;
  gather();
  if (skipping.by_environment && !course_.motion.body->keeps_corridors()) drop_inside();
  if (skipping.by_clearance && sweeps_.max_volumes == 0) drop_clear();
  if (may_skip_ && skipping.by_similar_motion) drop_similar();
  if (may_skip_ && skipping.back_edges) drop_back();
  return true;
}

/** What is known of the ends of the edges is on its way when they are looked at. */
template <int D>
void EdgeSieve<D>::gather() {
  const Body<D>& body = *course_.motion.body;
  for (count_ = 0; next_ < body.edges.size() && count_ < kChunk; ++next_) {
    if (!body.has_edge(next_)) continue;
    for (const uint32_t v : body.edges[next_].ends) {
      prefetch_line(&course_.vertices[v]);
      prefetch_line(&course_.motion.ways[v]);
      prefetch_line(&body.vertices[v]);
      prefetch_line(course_.motion.targets[v]);
    }
    if (body.keeps_corridors()) prefetch_line(&body.corridors[next_]);
    chunk_[count_++] = next_;
  }
}

/** Drops the edges that do not move, and those without doubt for which drops(a, b, e) holds, counted as skipped. */
template <int D>
template <class Drops>
void EdgeSieve<D>::drop(Drops drops) {
  const Vertex* const vertices = course_.vertices.data();
  const BodyEdge* const edges = course_.motion.body->edges.data();
  uint32_t kept = 0, skipped = 0;
  for (uint32_t i = 0; i < count_; ++i) {
    const uint32_t e = chunk_[i];
    const Vertex &a = vertices[edges[e].ends[0]], &b = vertices[edges[e].ends[1]];
    const uint32_t moves = (a.rank != kNone ? 1u : 0u) + (b.rank != kNone ? 1u : 0u);
    const bool dropped = (moves != 0) & !a.doubtful & !b.doubtful && drops(a, b, e);
    chunk_[kept] = e;
    kept += (uint32_t{dropped} | uint32_t{moves == 0}) != 0 ? 0 : 1;
    skipped += dropped ? moves : 0;
  }
  sweeps_.counts.swept += skipped;
  sweeps_.counts.skipped += skipped;
  count_ = kept;
}

/** Drops the edges for which skips(a, b, e) holds, and casts them where they arrive: for both ends. */
template <int D>
template <class Skips>
void EdgeSieve<D>::drop_and_cast(Skips skips) {
  uint32_t dropped = 0, skipped[kChunk];
  drop([&](const Vertex& a, const Vertex& b, uint32_t e) {
    const bool skip = skips(a, b, e);
    skipped[dropped] = e;
    dropped += skip ? 1 : 0;
    return skip;
  });
  for (uint32_t i = 0; i < dropped; ++i) {
    const uint32_t e = skipped[i], a = course_.motion.body->edges[e].ends[0], b = course_.motion.body->edges[e].ends[1];
    casts_.add_edge(e, kNone, {course_.motion.ways[a].arrival, course_.place(a, kNone)},
                    {course_.motion.ways[b].arrival, course_.place(b, kNone)});
  }
}

template <int D>
bool EdgeSieve<D>::sees_all_of_cell(uint32_t v) {
  using Sight = typename Course<D>::Sight;
  Vertex& at = course_.vertices[v];
  if (at.sight == Sight::kUnknown) {
    at.sight = sees_all(env_, course_.motion.ways[v].arrival, course_.motion.targets[v], sweeps_.counters)
                   ? Sight::kWhole
                   : Sight::kPart;
  }
  return at.sight == Sight::kWhole;
}

/** Edges that do not leave a cell [JCD10] 6.1. If it is not convex: it is seen whole from the first target that an end
 * goes to, from there on an end of the edge. */
template <int D>
void EdgeSieve<D>::drop_inside() {
  const VertexWay* const ways = course_.motion.ways.data();
  drop([&](const Vertex& turn_a, const Vertex& turn_b, uint32_t e) {
    const uint32_t(&ends)[2] = course_.motion.body->edges[e].ends;
    const VertexWay &a = ways[ends[0]], &b = ways[ends[1]];
    const uint32_t inside = uint32_t{a.from == a.arrival} & uint32_t{b.from == b.arrival} & uint32_t{a.from == b.from};
    const uint32_t decided = inside & uint32_t{env_.map.convex(a.from)};
    if (DSW_LIKELY(inside == decided)) return decided != 0;
    return sees_all_of_cell(ends[turn_a.rank < turn_b.rank ? 0 : 1]);
  });
}

/** Edges that do not leave the ball of an end. */
template <int D>
void EdgeSieve<D>::drop_clear() {
  Body<D>& body = *course_.motion.body;
  const uint32_t before = sweeps_.counts.skipped;
  drop([&](const Vertex&, const Vertex&, uint32_t e) {
    const uint32_t a = body.edges[e].ends[0], b = body.edges[e].ends[1];
    const bool clear = distance_squared<D>(body.position(a), body.position(b)) < std::max(rooms_[a], rooms_[b]);
    if (!course_.keeps.empty() && clear) course_.keeps[e] = false;
    return clear;
  });
  for (const uint32_t e : *this) {
    const uint32_t a = body.edges[e].ends[0], b = body.edges[e].ends[1];
    const double square = distance_squared<D>(body.position(a), body.position(b));
    for (const uint32_t v : {a, b}) body.clearances[v].wanted = std::max(body.clearances[v].wanted, square);
  }
  earn_credit(body, sweeps_.counts.skipped - before, 2 * count_);
}

/** Edges whose ends go less than their length, and nearly alike. */
template <int D>
void EdgeSieve<D>::drop_similar() {
  const Body<D>& body = *course_.motion.body;
  const double share = body.skipping.motion_share * body.skipping.motion_share;
  drop_and_cast([&](const Vertex&, const Vertex&, uint32_t e) {
    const uint32_t v = body.edges[e].ends[0], w = body.edges[e].ends[1];
    const double *const p = body.position(v), *const q = body.position(w);
    const Vec way_p = difference<D>(course_.place(v, kNone), p), way_q = difference<D>(course_.place(w, kNone), q);
    const Vec change = way_p - way_q;
    const double length = distance_squared<D>(p, q), way = std::max(dot(way_p, way_p), dot(way_q, way_q));
    return (way < length) & (dot(change, change) < share * length);
  });
}

/** Edges both ends of which go towards the inside [JCD10] 6.2. */
template <int D>
void EdgeSieve<D>::drop_back() {
  drop_and_cast([&](const Vertex& a, const Vertex& b, uint32_t e) {
    return (uint32_t{a.inwards} & uint32_t{b.inwards} & (course_.motion.body->edges[e].faces[1] != kNone ? 1u : 0u)) !=
           0;
  });
}

template class EdgeSieve<2>;
template class EdgeSieve<3>;

}  // namespace dsw
