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
  const bool only_places = !sweeps_edges(course_.motion.body->level) && !course_.motion.body->keeps_corridors();
  sifts_ = only_places && (skipping.by_environment || (may_skip && skipping.back_edges));
  if (sifts_) note_vertices();
}

/** What sift asks of the ends of edges, in few bytes. */
template <int D>
void EdgeSieve<D>::note_vertices() {
  const Array<VertexWay>& ways = course_.motion.ways;
  stays_.resize(ways.size());
  states_.resize(ways.size());
  others_ = false;
  for (size_t v = 0; v < ways.size(); ++v) {
    const Vertex& turn = course_.vertices[v];
    const Cell from = ways[v].from;
    const bool stays = from == ways[v].arrival, convex = stays && from.valid() && env_.map.convex(from);
    stays_[v] = convex ? from.unit : kNone;
    states_[v] = static_cast<uint8_t>((turn.rank != kNone ? kMoves : 0) | (turn.doubtful ? 0 : kSure) |
                                      (turn.inwards ? kInwards : 0));
    others_ = others_ || (stays && !convex);
  }
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
 * when the move began. In doubles: what is left out by this is cast where it arrives, or listed. A face none of whose
 * corners can go inwards any more is not looked at. */
template <int D>
void EdgeSieve<D>::find_inwards() {
  const Body<D>& body = *course_.motion.body;
  Vertex* const vertices = course_.vertices.data();
  const PointArray targets = course_.motion.targets;
  for (const uint32_t v : course_.order) vertices[v].inwards = course_.moves(v);
  for (const BodyFace& face : body.faces) {
    const uint32_t a = face.corners[0], b = face.corners[1], c = face.corners[2];
    if (a == kNone || !(vertices[a].inwards || vertices[b].inwards || vertices[c].inwards)) continue;
    const double *const p = body.position(a), *const q = body.position(b), *const r = body.position(c);
    const Vec normal = difference<D>(q, p).cross(difference<D>(r, p));
    // One that does not go inwards may stay, and then its target is not read.
    if (vertices[a].inwards) vertices[a].inwards = dot(difference<D>(targets[a], p), normal) < 0;
    if (vertices[b].inwards) vertices[b].inwards = dot(difference<D>(targets[b], q), normal) < 0;
    if (vertices[c].inwards) vertices[c].inwards = dot(difference<D>(targets[c], r), normal) < 0;
  }
}

template <int D>
bool EdgeSieve<D>::next() {
  const Skipping& skipping = course_.motion.body->skipping;
  if (next_ >= course_.motion.body->edges.size()) return false;
  if (sifts_) {
    sift();
  } else {
    gather();
  }
  if (skipping.by_environment && !course_.motion.body->keeps_corridors() && (!sifts_ || others_)) drop_inside();
  if (skipping.by_clearance && sweeps_.max_volumes == 0) drop_clear();
  if (may_skip_ && skipping.by_similar_motion) drop_similar();
  if (may_skip_ && skipping.back_edges && !sifts_) drop_back();
  return true;
}

/** Gathers a chunk without the edges that stay in one convex cell [JCD10] 6.1, which need no cast, and without those that
 * go towards the inside 6.2: these are cast where they arrive, or left. At EDGES, where no corridors are kept. */
template <int D>
void EdgeSieve<D>::sift() {
  Body<D>& body = *course_.motion.body;
  const bool skips_back = may_skip_ && body.skipping.back_edges, knows_cells = body.skipping.by_environment;
  uint8_t* const untested = skips_back && body.skipping.leaves_back_edges ? body.untested.data() : nullptr;
  const uint8_t* const states = states_.data();
  const uint32_t* const stays = stays_.data();
  const uint32_t goes_back = skips_back ? 1 : 0;
  uint32_t kept = 0, back_count = 0, back_edges[kChunk], dropped = 0, skipped = 0;
  const uint32_t end = next_ + std::min<uint32_t>(kChunk, static_cast<uint32_t>(body.edges.size()) - next_);
  for (uint32_t e = next_; e < end; ++e) {
    const BodyEdge& edge = body.edges[e];
    if (edge.ends[0] == kNone) continue;
    const uint32_t a = states[edge.ends[0]], b = states[edge.ends[1]], both = a & b;
    const uint32_t cell = stays[edge.ends[0]], moves = (a | b) & kMoves, sure = moves & (both / kSure);
    const uint32_t inside = sure & (cell == stays[edge.ends[1]] ? 1u : 0u) & (cell != kNone ? 1u : 0u);
    const uint32_t closed = edge.faces[1] != kNone ? goes_back : 0;
    const uint32_t back = sure & (inside ^ 1) & (both / kInwards) & closed;
    chunk_[kept] = e;
    kept += moves & ((inside | back) ^ 1);
    back_edges[back_count] = e;
    back_count += back;
    dropped += (inside | back) * ((a & kMoves) + (b & kMoves));
    if (untested != nullptr) untested[e] = static_cast<uint8_t>((untested[e] & (inside ^ 1)) | back);
    if (!knows_cells && (inside & closed) != 0 && ((a | b) & kInwards) != 0) skipped += skip_inside(e);
  }
  next_ = end;
  count_ = kept;
  sweeps_.counts.swept += dropped;
  sweeps_.counts.skipped += knows_cells ? dropped : 2 * back_count + skipped;
  if (untested != nullptr) return;
  for (uint32_t i = 0; i < back_count; ++i) cast_where_it_arrives(back_edges[i]);
}

/** How many tests 6.2 alone leaves out of an edge that stays in one cell, and whether this edge is listed: as if nothing was
 * known of cells. */
template <int D>
uint32_t EdgeSieve<D>::skip_inside(uint32_t e) {
  Body<D>& body = *course_.motion.body;
  const uint32_t(&ends)[2] = body.edges[e].ends;
  const uint32_t k = course_.vertices[ends[1]].rank < course_.vertices[ends[0]].rank ? 1 : 0;
  const Vertex &first = course_.vertices[ends[k]], &second = course_.vertices[ends[1 - k]];
  const uint32_t first_in = first.inwards ? 1 : 0, second_in = second.inwards ? 1 : 0;
  const bool both = second.rank != kNone;
  if (!body.skipping.leaves_back_edges) return both ? first_in * (1 + second_in) : 0;
  body.untested[e] = static_cast<uint8_t>(both ? second_in : first_in);
  return first_in + second_in;
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
  for (uint32_t i = 0; i < dropped; ++i) cast_where_it_arrives(skipped[i]);
}

template <int D>
void EdgeSieve<D>::cast_where_it_arrives(uint32_t e) {
  const uint32_t a = course_.motion.body->edges[e].ends[0], b = course_.motion.body->edges[e].ends[1];
  const typename CourseCasts<D>::End from{course_.motion.ways[a].arrival, course_.place(a, kNone)},
      to{course_.motion.ways[b].arrival, course_.place(b, kNone)};
  if (course_.motion.body->keeps_corridors()) {
    casts_.add_edge(e, kNone, from, to);
  } else {
    casts_.add_place(e, kNone, from, to);
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
  const bool leaves = may_skip_ && course_.motion.body->skipping.leaves_back_edges;
  uint8_t* const untested = course_.motion.body->untested.data();
  drop([&](const Vertex& turn_a, const Vertex& turn_b, uint32_t e) {
    const uint32_t(&ends)[2] = course_.motion.body->edges[e].ends;
    const VertexWay &a = ways[ends[0]], &b = ways[ends[1]];
    const uint32_t inside = uint32_t{a.from == a.arrival} & uint32_t{b.from == b.arrival} & uint32_t{a.from == b.from};
    const uint32_t decided = inside & uint32_t{env_.map.convex(a.from)};
    if (leaves) untested[e] &= decided != 0 ? 0 : 1;
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

/** Edges both ends of which go towards the inside [JCD10] 6.2. They are cast where they arrive, or left. */
template <int D>
void EdgeSieve<D>::drop_back() {
  Body<D>& body = *course_.motion.body;
  const auto goes_back = [&](const Vertex& a, const Vertex& b, uint32_t e) {
    return (uint32_t{a.inwards} & uint32_t{b.inwards} & (body.edges[e].faces[1] != kNone ? 1u : 0u)) != 0;
  };
  if (!body.skipping.leaves_back_edges) return drop_and_cast(goes_back);
  drop([&](const Vertex& a, const Vertex& b, uint32_t e) {
    const bool left = goes_back(a, b, e);
    body.untested[e] |= left ? 1 : 0;
    return left;
  });
}

template class EdgeSieve<2>;
template class EdgeSieve<3>;

}  // namespace dsw
