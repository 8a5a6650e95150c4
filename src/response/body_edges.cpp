// Edges of a body on its way, as if nobody met anything. What need not be cast is dropped a chunk at a time, the rest is cast side by
// side.

#include <algorithm>

#include "base/vec.h"
#include "response/body_move.h"
#include "sweep/clearance.h"

namespace dsw {

template <int D>
void BodyMove<D>::run_packet(const Body<D>& body) {
  packet_.run(env_, sweeps_.counters);
  for (uint32_t i = 0; i < packet_.count(); ++i) {
    if (packet_.reached(i)) continue;
    if (packet_vertices_[i] != kNone) {
      moving_[packet_vertices_[i]].doubtful = true;
    } else {
      for (const uint32_t v : body.edges[packet_edges_[i]].ends) moving_[v].doubtful = true;
    }
  }
}

/** Where vertex v is when it is the turn of that with `rank`, if nobody meets anything. */
template <int D>
const double* BodyMove<D>::place(const Body<D>& body, PointArray targets, uint32_t v, uint32_t rank) const {
  return moving_[v].rank < rank ? targets[v] : body.position(v);
}
template <int D>
Cell BodyMove<D>::cell_at(uint32_t v, uint32_t rank) const {
  return moving_[v].rank < rank ? moving_[v].arrival : moving_[v].from;
}

template <int D>
void BodyMove<D>::sweep_edges(Body<D>& body, PointArray targets, bool may_skip) {
  keeps_.assign(body.level == SweepLevel::kFaces ? body.edges.size() : 0, true);
  const bool asks_cells = body.skipping.by_environment && body.level == SweepLevel::kEdges && !body.keeps_sequences();
  const bool asks_boxes = body.level != SweepLevel::kEdges;
  const bool asks_balls = body.skipping.by_clearance && sweeps_.max_cells == 0;
  const bool only_places = body.level == SweepLevel::kEdges && !body.keeps_sequences();
  const bool skips_back = may_skip && body.skipping.back_edges;
  if (skips_back) find_inwards(body, targets);
  for (uint32_t next = 0; next < body.edges.size();) {
    uint32_t count = gather_edges(body, targets, next);
    if (asks_cells) count = drop_inside(body, targets, count);
    if (asks_balls) count = drop_clear(body, count);
    if (may_skip && body.skipping.by_similar_motion) count = drop_similar(body, targets, count);
    if (skips_back) count = drop_back(body, targets, count);
    for (uint32_t i = 0; i < count && only_places; ++i) cast_places(body, targets, chunk_[i], skips_back);
    for (uint32_t i = 0; i < count && !only_places; ++i) {
      const uint32_t e = chunk_[i], a = body.edges[e].ends[0], b = body.edges[e].ends[1];
      const bool boxed = asks_boxes && is_edge_boxed(body, targets, e);
      sweep_edge(body, targets, e, a, b, boxed);
      sweep_edge(body, targets, e, b, a, boxed);
    }
  }
  run_edges(body);
}

/** The next edges into chunk_; what is known of their ends is on its way when they are looked at. */
template <int D>
uint32_t BodyMove<D>::gather_edges(const Body<D>& body, PointArray targets, uint32_t& next) {
  uint32_t count = 0;
  for (; next < body.edges.size() && count < kChunk; ++next) {
    if (!body.has_edge(next)) continue;
    for (const uint32_t v : body.edges[next].ends) {
      __builtin_prefetch(&moving_[v]);
      __builtin_prefetch(&body.vertices[v]);
      __builtin_prefetch(targets[v]);
    }
    chunk_[count++] = next;
  }
  return count;
}

/** Of the first `count` edges of chunk_ drops those that do not move, and those without doubt for which drops(a, b, e) holds: these
 * are counted as skipped. Without a branch, which would be mispredicted for every other edge. */
template <int D>
template <class Drops>
uint32_t BodyMove<D>::drop(const Body<D>& body, uint32_t count, Drops drops) {
  uint32_t kept = 0, skipped = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t e = chunk_[i];
    const Moving &a = moving_[body.edges[e].ends[0]], &b = moving_[body.edges[e].ends[1]];
    const uint32_t moves = (a.rank != kNone ? 1u : 0u) + (b.rank != kNone ? 1u : 0u);
    const bool dropped = (moves != 0) & !a.doubtful & !b.doubtful && drops(a, b, e);
    chunk_[kept] = e;
    kept += (uint32_t{dropped} | uint32_t{moves == 0}) != 0 ? 0 : 1;
    skipped += dropped ? moves : 0;
  }
  sweeps_.counts.swept += skipped;
  sweeps_.counts.skipped += skipped;
  return kept;
}

template <int D>
bool BodyMove<D>::sees_all_of_cell(PointArray targets, uint32_t v) {
  Moving& moving = moving_[v];
  if (moving.sight == Sight::kUnknown) {
    moving.sight = sees_all(env_, moving.arrival, targets[v], sweeps_.counters) ? Sight::kWhole : Sight::kPart;
  }
  return moving.sight == Sight::kWhole;
}

/** Edges that do not leave a cell [JCD10] 6.1. If it is not convex: it is seen whole from the first target that an end goes to, from there
 * on an end of the edge. */
template <int D>
uint32_t BodyMove<D>::drop_inside(const Body<D>& body, PointArray targets, uint32_t count) {
  return drop(body, count, [&](const Moving& a, const Moving& b, uint32_t e) {
    const uint32_t inside = uint32_t{a.from == a.arrival} & uint32_t{b.from == b.arrival} & uint32_t{a.from == b.from};
    const uint32_t settled = inside & uint32_t{env_.map.convex(a.from)};
    if (__builtin_expect(inside == settled, 1)) return settled != 0;
    return sees_all_of_cell(targets, body.edges[e].ends[a.rank < b.rank ? 0 : 1]);
  });
}

/** Edges that do not leave the ball of an end. */
template <int D>
uint32_t BodyMove<D>::drop_clear(Body<D>& body, uint32_t count) {
  const uint32_t before = sweeps_.counts.skipped;
  const uint32_t kept = drop(body, count, [&](const Moving&, const Moving&, uint32_t e) {
    const uint32_t a = body.edges[e].ends[0], b = body.edges[e].ends[1];
    const bool clear = distance_squared<D>(body.position(a), body.position(b)) < std::max(rooms_[a], rooms_[b]);
    if (!keeps_.empty() && clear) keeps_[e] = false;
    return clear;
  });
  for (uint32_t i = 0; i < kept; ++i) {
    const uint32_t a = body.edges[chunk_[i]].ends[0], b = body.edges[chunk_[i]].ends[1];
    const double square = distance_squared<D>(body.position(a), body.position(b));
    for (const uint32_t v : {a, b}) body.clearances[v].wanted = std::max(body.clearances[v].wanted, square);
  }
  earn_credit(body, sweeps_.counts.skipped - before, 2 * kept);
  return kept;
}

/** All places of a vertex on its way, as far as nothing is met. */
template <int D>
void BodyMove<D>::include_way(const Body<D>& body, PointArray targets, uint32_t v, Bounds<D>& box) const {
  box.include(body.position(v));
  if (moving_[v].rank != kNone) box.include(targets[v]);
}

/** Whether an edge and what both of its ends sweep lie in a box that is free. Not asked of edges that stay inside of one cell, which is
 * seen sooner, and of those known to cross more cells than a box may meet: they have their sequences. */
template <int D>
bool BodyMove<D>::is_edge_boxed(const Body<D>& body, PointArray targets, uint32_t e) {
  constexpr size_t kMostFacets = 3;
  const uint32_t v = body.edges[e].ends[0], w = body.edges[e].ends[1];
  const Moving &a = moving_[v], &b = moving_[w];
  if ((a.rank == kNone && b.rank == kNone) || !BoxProbe<D>::suits(env_, a.from)) return false;
  if (a.from == a.arrival && a.from == b.from && a.from == b.arrival && env_.map.convex(a.from)) return false;
  if (body.sequences[e].facets.size() > kMostFacets) return false;
  Bounds<D> box(body.position(v));
  include_way(body, targets, v, box);
  include_way(body, targets, w, box);
  return sweeps_.is_boxed(box, a.from, b.from);
}

/** Drops the edges for which skips(a, b, e) holds, and casts them where they arrive. If such a cast fails, both ends are in doubt. */
template <int D>
template <class Skips>
uint32_t BodyMove<D>::drop_and_cast(Body<D>& body, PointArray targets, uint32_t count, Skips skips) {
  uint32_t dropped = 0, skipped[kChunk];
  const uint32_t kept = drop(body, count, [&](const Moving& a, const Moving& b, uint32_t e) {
    const bool skip = skips(a, b, e);
    skipped[dropped] = e;
    dropped += skip ? 1 : 0;
    return skip;
  });
  for (uint32_t i = 0; i < dropped; ++i) {
    const uint32_t e = skipped[i], a = body.edges[e].ends[0], b = body.edges[e].ends[1];
    cast_edge(body, e, kNone, {moving_[a].arrival, place(body, targets, a, kNone)},
              {moving_[b].arrival, place(body, targets, b, kNone)});
  }
  return kept;
}

/** Edges whose ends go less than their length, and nearly alike. */
template <int D>
uint32_t BodyMove<D>::drop_similar(Body<D>& body, PointArray targets, uint32_t count) {
  const double share = body.skipping.motion_share * body.skipping.motion_share;
  return drop_and_cast(body, targets, count, [&](const Moving& a, const Moving& b, uint32_t e) {
    const uint32_t v = body.edges[e].ends[0], w = body.edges[e].ends[1];
    const double *const p = body.position(v), *const q = body.position(w);
    const Vec way_p = difference<D>(a.rank != kNone ? targets[v] : p, p);
    const Vec way_q = difference<D>(b.rank != kNone ? targets[w] : q, q), change = way_p - way_q;
    const double length = distance_squared<D>(p, q), way = std::max(dot(way_p, way_p), dot(way_q, way_q));
    return (way < length) & (dot(change, change) < share * length);
  });
}

/** Which vertices go towards the inside of a closed body: against the normals of all faces at them, where these were when the move began.
 * In doubles: what is left out by this is cast where it arrives. */
template <int D>
void BodyMove<D>::find_inwards(const Body<D>& body, PointArray targets) {
  for (const uint32_t v : order_) moving_[v].inwards = moving_[v].rank != kNone;
  for (uint32_t f = 0; f < body.faces.size(); ++f) {
    if (!body.has_face(f)) continue;
    const uint32_t(&corners)[3] = body.faces[f].corners;
    const double* const p = body.position(corners[0]);
    const Vec normal = difference<D>(body.position(corners[1]), p).cross(difference<D>(body.position(corners[2]), p));
    for (const uint32_t v : corners) {
      Moving& moving = moving_[v];
      const double* const to = moving.rank != kNone ? targets[v] : body.position(v);
      moving.inwards &= dot(difference<D>(to, body.position(v)), normal) < 0;  // without a branch: half of them
    }
  }
}

/** Edges both ends of which go towards the inside [JCD10] 6.2. */
template <int D>
uint32_t BodyMove<D>::drop_back(Body<D>& body, PointArray targets, uint32_t count) {
  return drop_and_cast(body, targets, count, [&](const Moving& a, const Moving& b, uint32_t e) {
    return (uint32_t{a.inwards} & uint32_t{b.inwards} & (body.edges[e].faces[1] != kNone ? 1u : 0u)) != 0;
  });
}

/** Casts an edge in its new places, that of the end whose turn comes first and then that of the other one. A first end that goes
 * towards the inside needs no cast where the other one has its own.
 * What sweep_edge does for both ends, at EDGES where no sequences are kept, without branches on which end is the first. */
template <int D>
void BodyMove<D>::cast_places(Body<D>& body, PointArray targets, uint32_t e, bool skips_back) {
  const uint32_t(&ends)[2] = body.edges[e].ends;
  const uint32_t k = moving_[ends[1]].rank < moving_[ends[0]].rank ? 1 : 0, v = ends[k], w = ends[1 - k];
  Moving &first = moving_[v], &second = moving_[w];
  const bool both = second.rank != kNone;
  if (first.rank == kNone) return;
  if (!first.doubtful) {
    const bool skips = skips_back && both && first.inwards && !second.inwards && body.edges[e].faces[1] != kNone;
    ++sweeps_.counts.swept;
    sweeps_.counts.skipped += skips ? 1 : 0;
    if (!skips) cast_edge(body, e, v, {first.arrival, targets[v]}, {second.from, body.position(w)});
  }
  if (!both) return;
  second.doubtful = second.doubtful || !first.arrival.valid();
  if (second.doubtful) return;
  ++sweeps_.counts.swept;
  cast_edge(body, e, w, {second.arrival, targets[w]}, {first.arrival, targets[v]});
}

/** @param boxed as is_edge_boxed says. */
template <int D>
void BodyMove<D>::sweep_edge(Body<D>& body, PointArray targets, uint32_t e, uint32_t v, uint32_t other, bool boxed) {
  Moving& moving = moving_[v];
  if (moving.rank == kNone) return;
  const Cell fixed = cell_at(other, moving.rank);
  // Where the other one will be is not known if there is something on its way.
  moving.doubtful = moving.doubtful || !fixed.valid();
  if (moving.doubtful) {
    if (!keeps_.empty()) keeps_[e] = false;
    return;
  }
  const typename StarSweep<D>::EdgeSweep sweep{e,
                                               v,
                                               targets[v],
                                               moving.arrival,
                                               place(body, targets, other, moving.rank),
                                               fixed,
                                               body.keeps_sequences() ? crossed_[v] : PathFacets{}};
  const typename StarSweep<D>::Settled settled =
      boxed ? sweeps_.settle_boxed(body) : sweeps_.settle(body, sweep, false);
  if (!keeps_.empty()) {
    const bool same = settled == StarSweep<D>::Settled::kInside ||
                      (settled == StarSweep<D>::Settled::kStrip && body.vertices[v].cell == moving.arrival);
    keeps_[e] = keeps_[e] && same;
  }
  if (settled != StarSweep<D>::Settled::kNo) return;
  if (body.level != SweepLevel::kEdges) {
    const BodyVertex<D>& from = body.vertices[v];
    moving.doubtful = !sweeps_.is_triangle_free({from.position, sweep.to, sweep.q}, from.cell);
    if (moving.doubtful) return;
  }
  // A sequence is noted in the direction of the edge.
  const EdgeEnd moved{sweep.arrival, sweep.to}, still{sweep.fixed, sweep.q};
  const bool turned = body.keeps_sequences() && body.edges[e].ends[0] != v;
  cast_edge(body, e, v, turned ? still : moved, turned ? moved : still);
}

/** To see whether an edge is free in its new place, and which cells it crosses there.
 * @param v whose way is in doubt if it is not; kNone: that of both ends. */
template <int D>
void BodyMove<D>::cast_edge(Body<D>& body, uint32_t e, uint32_t v, const EdgeEnd& from, const EdgeEnd& to) {
  const uint32_t at = packet_.count();
  packet_vertices_[at] = v;
  packet_edges_[at] = e;
  CastRequest& request = packet_.add(env_, from.cell, from.position, to.position);
  request.end = to.cell;
  request.max_cells = sweeps_.max_cells;
  if (body.keeps_sequences()) {
    if (writers_.size() == at) writers_.emplace_back(env_.memory);
    writers_[at].attach(env_, request);
  }
  if (packet_.full()) run_edges(body);
}

template <int D>
void BodyMove<D>::run_edges(Body<D>& body) {
  run_packet(body);
  if (body.keeps_sequences()) {
    for (uint32_t i = 0; i < packet_.count(); ++i) {
      if (packet_.reached(i)) writers_[i].finish(body.sequences[packet_edges_[i]]);
    }
  }
  packet_.clear();
}

// What body_move.cpp calls.
template void BodyMove<2>::run_packet(const Body<2>&);
template void BodyMove<3>::run_packet(const Body<3>&);
template const double* BodyMove<2>::place(const Body<2>&, PointArray, uint32_t, uint32_t) const;
template const double* BodyMove<3>::place(const Body<3>&, PointArray, uint32_t, uint32_t) const;
template Cell BodyMove<2>::cell_at(uint32_t, uint32_t) const;
template Cell BodyMove<3>::cell_at(uint32_t, uint32_t) const;
template void BodyMove<2>::sweep_edges(Body<2>&, PointArray, bool);
template void BodyMove<3>::sweep_edges(Body<3>&, PointArray, bool);
template void BodyMove<2>::include_way(const Body<2>&, PointArray, uint32_t, Bounds<2>&) const;
template void BodyMove<3>::include_way(const Body<3>&, PointArray, uint32_t, Bounds<3>&) const;

}  // namespace dsw
