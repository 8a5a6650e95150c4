#pragma once
// Whether an edge, one end of which moves, is free: asked of its corridor, without a flood.

#include "corridor/first_ridge.h"
#include "corridor/touched_lines.h"
#include "walk/cast.h"

namespace dsw {

/** An edge, one end of which goes from p to `to`. The other end stays at q. */
struct MovingEdge {
  const double* p;
  Cell from;
  const double* to;
  Cell arrival;
  const double* q;
  Cell fixed;
  PathFacets crossed;   // on the path of p
  bool p_first;         // the edge, and its corridor, begins at p
  bool reached = true;  // false: the path of p meets a wall of `arrival`

  EdgeMotion motion() const noexcept { return {p, to, q}; }
};

/** Why an edge is known to be free, with the triangle that it sweeps. The triangle lies inside of one convex cell, of one
 * that is not convex, of a box or a ball that is free, of the corridor, or of the corridor and the other cells at one edge
 * that it turns round, in the plane at a few vertices. kStopped: nothing is met before the moving end meets a wall. kStopsAtRidge: it may not be free, but what it may meet is known. */
enum class Verdict : uint32_t { kUnknown, kInside, kSeen, kBoxed, kClear, kHolds, kTurned, kStopped, kStopsAtRidge };

/** What is used again from edge to edge. */
template <int D>
struct EdgeScratch {
  Array<uint32_t> before;    // facets of a corridor, to go back to
  CorridorWriter<D> writer;  // of a cast along an edge where it stands
  CastCounters* counters = nullptr;

  explicit EdgeScratch(const Memory* memory) : before(memory), writer(memory) {}
};

/** An edge and its corridor, on the way of an end. */
template <int D>
struct Follower {
  const Environment<D>& env;
  Corridor<D>& corridor;
  uint64_t call;  // the number of the call on the body
  const MovingEdge& edge;
  EdgeScratch<D>& scratch;
};

/** Whether the edge keeps to the facets that it was last known to pass, but for those that its end passes itself, and
 * for those round a pivot to whose other side it goes: then it is free in its new place. If it kept to them before,
 * too, the triangle's sides share a corridor, or part at one pivot. A path of two facets may come from one cell beside the
 * corridor and go to another: its facets cut off the triangle's corners in these, and what is left lies in the cell between
 * them and in the corridor. kUnknown, kHolds or kTurned. Throws std::bad_alloc.
 * @param swept whether the triangle counts, and not the new place alone: then a corridor that is not that of the edge's
 * place is noted again, by a cast. */
template <int D>
Verdict ask(const Follower<D>& f, bool swept);
/** Asks the same where triangles count, in space. If the edge leaves its facets, `ridge` is the first ridge that it meets
 * and cannot turn round, if that is known. Where the moving end stays in its cell, the edge may turn round several
 * ridges, one after the other. Throws std::bad_alloc.
 * @param arrives whether the edge will stand at the target: then the corridor becomes that of its new place. If not, the
 * corridor stays that of the start, and what is met counts up to the wall that the path meets.
 * @param touched lines that the edge has touched, of which walls may be known; null: none. */
template <int D>
Verdict ask_for_ridge(const Follower<D>& f, bool arrives, const TouchedLines* touched, FirstRidge* ridge);
/** Whether the edge meets nothing before an event, which is its own, or of the path or another edge of its moving end. The
 * edge keeps to its corridor until then, but for the facets that the path passes. If the path meets a wall, `arrival` is the
 * cell in front of the wall. Throws std::bad_alloc. */
template <int D>
bool is_free_before(const Follower<D>& f, const SweepEvent& event);

/** Whether the triangle lies in the cell that its corners are in, which need not be convex. From one end in its new
 * place all of the cell is seen, hence the edge lies in it; where the triangle counts, from both: so the moving end's
 * path lies in the cell, and what joins that to the fixed end. */
template <int D>
bool is_seen(const Environment<D>& env, bool swept, const MovingEdge& edge, CastCounters* counters);

/** Whether an edge meets nothing before its moving end meets a wall of the cell `arrival`: up to there it stays in that
 * cell, or in that and a second one and passes between them. Of a line through q the sides of a ridge change linearly
 * on the way of its other end: where it passes the facet at both ends of the way, it does so between. */
template <int D>
bool stays_before_wall(const Environment<D>& env, const MovingEdge& edge);

}  // namespace dsw
