#pragma once
// The question: is an edge free, one end of which moves? It is answered without a flood, or not at all.

#include "corridor/clearance.h"
#include "corridor/corridors.h"
#include "corridor/first_ridge.h"
#include "corridor/touched_lines.h"
#include "walk/cast.h"

namespace dsw {

/** Why an edge is known to be free, with the triangle that it sweeps. The triangle lies inside of one convex cell, of one
 * that is not convex, of a box or a ball that is free, of the corridor, or of the corridor and the other cells at one edge
 * that it turns round, in the plane at a few vertices. kStopped: nothing is met before the moving end meets a wall.
 * kStopsAtRidge: it may not be free, but what it may meet is known. */
enum class Verdict : uint32_t { kUnknown, kInside, kSeen, kBoxed, kClear, kHolds, kTurned, kStopped, kStopsAtRidge };

/** What is used again from edge to edge. */
template <int D>
struct EdgeScratch {
  Array<uint32_t> before;    // facets of a corridor, to go back to
  CorridorWriter<D> writer;  // of a cast along an edge where it stands
  CastCounters* counters = nullptr;

  explicit EdgeScratch(const Memory* memory) : before(memory), writer(memory) {}
};

/** What is asked of an edge. */
struct Question {
  /** Whether the triangle counts, and not the edge's new place alone. Then a corridor that is not that of the edge's place
   * is noted again, by a cast. */
  bool swept;
  /** Whether the edge will stand at the target: then the corridor becomes that of its new place, and what may make it so is
   * asked first. If not, the corridor stays that of the start, and what is met counts up to the wall that the path meets. */
  bool arrives = true;
  bool asks_cells = false;             // whether one cell may hold the triangle
  bool is_limited = false;             // what is kept must not carry an edge past a work limit
  const SweepEvent* before = nullptr;  // only what is met before it counts; it is of the edge's moving end
};

/** What is kept of an edge, which may help. An answer brings the corridor up to date. */
template <int D>
struct KeptOfEdge {
  Corridors<D>* of_edges = nullptr;
  uint32_t edge = 0;
  mutable Corridor<D>* corridor = nullptr;  // null: none is kept
  uint64_t call = 0;                        // the number of the call on the body, to which the corridor can go back
  const Clearance<D>* balls[2] = {};        // of the ends; null: they are not asked
  const TouchedLines* touched = nullptr;    // lines that the edge has touched, of which walls may be known

  /** Before the corridor is changed in a call on the body. Throws std::bad_alloc. */
  void keep(const Environment<D>& env) const {
    corridor = &of_edges->own(edge, env.obstacle_version);
    corridor->keep(call);
  }
};

/** Answers. The tests go from cheap to dear:
 * - A path that is blocked in its cell, with the edge in that and the next cell: nothing is met before the wall.
 * - One cell: it is exactly convex, or all of it is seen from the ends of the edge in its new place.
 * - The ball of one end holds the triangle.
 * - The corridor: the edge keeps to the facets that it was last known to pass, but for those that its end passes itself,
 *   and for those round a pivot to whose other side it goes. Then it is free in its new place. If it kept to them before,
 *   too, the triangle's sides share a corridor, or part at one pivot. A path of two facets may come from one cell beside
 *   the corridor and go to another: its facets cut off the triangle's corners in these, and what is left lies in the cell
 *   between them and in the corridor.
 * - With `ridge`, in space: the first ridge that the edge meets and cannot turn round. Where the moving end stays in its
 *   cell, the edge may turn round several ridges, one after the other.
 * - With `before`: the edge keeps to its corridor until then, but for the facets that the path passes.
 * Throws std::bad_alloc.
 * @param ridge null, or becomes what is met first, if the answer is kUnknown and that is known. */
template <int D>
Verdict ask(const Environment<D>& env, const MovingPart& edge, const Question& what, const KeptOfEdge<D>& kept,
            EdgeScratch<D>& scratch, FirstRidge* ridge = nullptr);

}  // namespace dsw
