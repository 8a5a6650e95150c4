// Edges are dropped without branches on what is found of each, which would be mispredicted for every other edge.

#include "response/edge_sieve.h"

#include <algorithm>

#include "base/compiler.h"
#include "base/vec.h"
#include "response/inwards.h"
#include "sweep/clearance.h"

namespace dsw {

/** Gives those of some edges that have two faces. */
template <int D>
uint64_t EdgeSieve<D>::closed(const BodyEdge* edges, uint64_t which) const {
  if (is_closed_) return which;
  uint64_t bits = 0;
  for (; which != 0; which &= which - 1) {
    const uint32_t i = lowest_bit(which);
    bits |= uint64_t{edges[i].faces[1] != kNone ? 1u : 0u} << i;
  }
  return bits;
}

template <int D>
void EdgeSieve<D>::start(bool may_skip) {
  const Skipping& skipping = course_.motion.body->skipping;
  may_skip_ = may_skip;
  next_ = count_ = over_ = 0;
  const size_t edges = course_.motion.body->edge_slots.alive_count(),
               faces = course_.motion.body->face_slots.alive_count();
  may_be_free_ = edges != course_.motion.body->edges.size();
  is_closed_ = 3 * faces == 2 * edges;  // a face has three edges, and an edge at most two faces
  if (skipping.by_clearance) measure_clearances();
  if (may_skip && skipping.back_edges) find_inwards();
  const bool only_places = !sweeps_edges(course_.motion.body->level) && !course_.motion.body->keeps_corridors();
  const bool casts_back = skipping.back_edges && !skipping.leaves_back_edges;
  fills_ = !skipping.by_clearance && !(may_skip && (skipping.by_similar_motion || casts_back));
  sifts_ = only_places && (skipping.by_environment || (may_skip && skipping.back_edges));
  // What is counted of casts is counted where they are made.
  sees_ = only_places && sweeps_.counters == nullptr && !course_.all_clear && course_.clear_edges.empty() &&
          (sweeps_.max_volumes == 0 || sweeps_.max_volumes >= ShortEdges<D>::kMostCells);
  if (sees() || sifts_) short_.start(sees());
  course_.turn_words = sees() ? short_.words_now() : nullptr;
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

/** Which vertices go towards the inside of a closed body. In doubles: what is left out by this is cast where it arrives, or
 * listed. */
template <int D>
void EdgeSieve<D>::find_inwards() {
  const Body<D>& body = *course_.motion.body;
  if constexpr (D == 3) {
    ways_.resize(4 * body.vertices.size());
    const MovingSurface surface{body.faces.data(), body.faces.size(), body.vertices.data(), body.vertices.size(),
                                course_.motion.targets};
    kFindInwards(surface, ways_.data(), course_.vertices.data());
  } else {
    for (Vertex& vertex : course_.vertices) vertex.inwards = vertex.rank != kNone;
  }
}

template <int D>
bool EdgeSieve<D>::next() {
  const Skipping& skipping = course_.motion.body->skipping;
  if (next_ >= course_.motion.body->edges.size() && over_ == 0) return false;
  if (sifts_) {
    sift();
  } else {
    gather();
  }
  if (skipping.by_environment && !course_.motion.body->keeps_corridors() && (!sifts_ || short_.has_others()))
    drop_inside();
  if (skipping.by_clearance && sweeps_.max_volumes == 0) drop_clear();
  if (may_skip_ && skipping.by_similar_motion) drop_similar();
  if (may_skip_ && skipping.back_edges && !sifts_) drop_back();
  return true;
}

/** Gathers a chunk without the edges that stay in one convex cell [JCD10] 6.1, which need no cast, and without those that
 * go towards the inside 6.2: these are cast where they arrive, or left. At EDGES, where no corridors are kept. What is kept of the
 * last block beyond a full chunk is left for the next one. */
template <int D>
void EdgeSieve<D>::sift() {
  const Body<D>& body = *course_.motion.body;
  const bool skips_back = may_skip_ && body.skipping.back_edges, leaves = skips_back && body.skipping.leaves_back_edges;
  const uint32_t size = static_cast<uint32_t>(body.edges.size());
  std::copy_n(chunk_ + kChunk, over_, chunk_);
  uint32_t kept = over_;
  while (next_ < size && kept < kChunk) {
    const uint32_t first = next_;
    next_ = std::min(first + kChunk, size);
    const Sifted block = sift_block(first, next_ - first, skips_back);
    for (uint64_t rest = block.kept; rest != 0; rest &= rest - 1) chunk_[kept++] = first + lowest_bit(rest);
    count_sifted(first, block, leaves);
    if (skips_back && !leaves) cast_where_they_arrive(first, block.back);
    if (!fills_) break;
  }
  count_ = std::min(kept, kChunk);
  over_ = kept - count_;
}

/** What becomes of so many edges, at most a chunk: bits alone, as nothing is stored then. Edges with an end that does not move,
 * or is in doubt, are few: they are looked at apart. */
template <int D>
typename EdgeSieve<D>::Sifted EdgeSieve<D>::sift_block(uint32_t first, uint32_t count, bool skips_back) const {
  const BodyEdge* const edges = course_.motion.body->edges.data() + first;
  const EdgeBits bits = kReadTurnWords(edges, nullptr, count, may_be_free_, short_.words());
  Sifted sifted;
  sifted.inside = bits.shared & ~bits.odd;
  if (skips_back) {
    sifted.back = closed(edges, bits.inwards & ~bits.shared & ~bits.odd);
    if (!course_.motion.body->skipping.by_environment) sifted.inwards = closed(edges, sifted.inside & bits.either);
  }
  sifted.kept = bits.used & ~(sifted.inside | sifted.back | bits.odd);
  for (uint64_t odd = bits.odd; odd != 0; odd &= odd - 1) {
    sift_odd(edges[lowest_bit(odd)], uint64_t{1} << lowest_bit(odd), skips_back, sifted);
  }
  return sifted;
}

/** What becomes of an edge one of whose ends does not move or is in doubt. */
template <int D>
void EdgeSieve<D>::sift_odd(const BodyEdge& edge, uint64_t bit, bool skips_back, Sifted& sifted) const {
  const uint32_t a = short_.words()[edge.ends[0]], b = short_.words()[edge.ends[1]], both = a & b;
  if (((a | b) & TurnWord::kMoves) == 0) return;
  const bool closed = skips_back && edge.faces[1] != kNone, sure = (both & TurnWord::kSure) != 0;
  const bool inside = sure && TurnWord::share_cell(a, b) != 0;
  const bool back = sure && !inside && closed && (both & TurnWord::kInwards) != 0;
  if (inside) sifted.inside |= bit;
  if (back) sifted.back |= bit;
  if (!inside && !back) sifted.kept |= bit;
  if ((inside || back) && ((a ^ b) & TurnWord::kMoves) != 0) sifted.one_stays |= bit;
  if (inside && closed && ((a | b) & TurnWord::kInwards) != 0) sifted.inwards |= bit;
}

/** Counts the tests of the edges that are dropped, and notes which of them are not tested. */
template <int D>
void EdgeSieve<D>::count_sifted(uint32_t first, const Sifted& block, bool leaves) {
  Body<D>& body = *course_.motion.body;
  const uint32_t one_stays = block.one_stays != 0 ? bit_count(block.one_stays) : 0;
  const uint32_t dropped = 2 * bit_count(block.inside | block.back) - one_stays;
  sweeps_.counts.swept += dropped;
  if (leaves) {
    uint8_t* const untested = body.untested.data() + first;
    // What is kept counts as tested, unless its last test is left later.
    const uint64_t moving = block.inside | block.back | block.kept;
    if ((moving & (moving + 1)) == 0) {
      std::fill_n(untested, moving + 1 != 0 ? lowest_bit(moving + 1) : 64, uint8_t{0});
    } else {
      for (uint64_t rest = block.inside | block.kept; rest != 0; rest &= rest - 1) untested[lowest_bit(rest)] = 0;
    }
    for (uint64_t rest = block.back; rest != 0; rest &= rest - 1) untested[lowest_bit(rest)] = 1;
  }
  if (body.skipping.by_environment) {
    sweeps_.counts.skipped += dropped;
    return;
  }
  uint32_t skipped = 2 * bit_count(block.back);
  for (uint64_t rest = block.inwards; rest != 0; rest &= rest - 1) skipped += skip_inside(first + lowest_bit(rest));
  sweeps_.counts.skipped += skipped;
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

/** What is known of the ends of the edges is on its way when they are looked at, but for ShortEdges, which reads less. */
template <int D>
void EdgeSieve<D>::gather() {
  const Body<D>& body = *course_.motion.body;
  const uint32_t size = static_cast<uint32_t>(body.edges.size());
  if (sees() && !may_be_free_) {
    count_ = std::min(kChunk, size - next_);
    for (uint32_t i = 0; i < kChunk; ++i) chunk_[i] = next_ + i;  // a fixed count is written in lanes
    next_ += count_;
    return;
  }
  for (count_ = 0; next_ < size && count_ < kChunk; ++next_) {
    chunk_[count_] = next_;
    const BodyEdge& edge = body.edges[next_];
    count_ += edge.ends[0] != kNone ? 1 : 0;
    if (sees() || edge.ends[0] == kNone) continue;
    for (const uint32_t v : edge.ends) {
      prefetch_line(&course_.vertices[v]);
      prefetch_line(&course_.motion.ways[v]);
      prefetch_line(&body.vertices[v]);
      prefetch_line(course_.motion.targets[v]);
    }
    if (body.keeps_corridors()) prefetch_line(&body.corridors[next_]);
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
  cast_where_they_arrive(skipped, dropped);
}

/** Casts some edges of those from `first` on where their ends arrive. */
template <int D>
void EdgeSieve<D>::cast_where_they_arrive(uint32_t first, uint64_t which) {
  uint32_t count = 0, edges[kChunk];
  for (; which != 0; which &= which - 1) edges[count++] = first + lowest_bit(which);
  cast_where_they_arrive(edges, count);
}

/** Casts edges, at most a chunk, where their ends arrive. */
template <int D>
void EdgeSieve<D>::cast_where_they_arrive(const uint32_t* edges, uint32_t count) {
  const uint64_t seen = sees() ? short_.find_arrivals(edges, count) : 0;
  for (uint32_t i = 0; i < count; ++i) {
    if ((seen >> i & 1) != 0) {
      casts_.add_seen();
      continue;
    }
    const uint32_t a = course_.motion.body->edges[edges[i]].ends[0], b = course_.motion.body->edges[edges[i]].ends[1];
    const typename CourseCasts<D>::End from{course_.motion.ways[a].arrival, course_.place(a, kNone)},
        to{course_.motion.ways[b].arrival, course_.place(b, kNone)};
    if (course_.motion.body->keeps_corridors()) {
      casts_.add_edge(edges[i], kNone, from, to);
    } else {
      casts_.add_place(edges[i], kNone, from, to);
    }
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
