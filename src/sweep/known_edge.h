#pragma once
// What is known of an edge that an end of it sweeps, without a look at the triangle.

#include "body/body.h"
#include "corridor/first_ridge.h"
#include "walk/cast.h"

namespace dsw {

/** The sweep of edge e when its end v goes to `to`, in `arrival`, and the other end is at q, in `fixed`. */
struct EdgeSweep {
  uint32_t e, v;
  const double* to;
  Cell arrival;
  const double* q;
  Cell fixed;
  PathFacets crossed;   // on the path of v
  bool reached = true;  // false: the path of v meets a wall of `arrival`
};

/** What is known: nothing, or that nothing is met because the triangle lies inside of one convex cell, of one that is
 * not convex, of a box or a ball that is free, of the corridor that the edge is known to cross, or of these and
 * the others at one edge that it turns round, in the plane at a few vertices. kStopped: nothing is met before the
 * moving end meets a wall. */
enum class Verdict : uint32_t { kUnknown, kInside, kSeen, kBoxed, kClear, kHolds, kTurned, kStopped };

/** Whether the triangle lies in the cell that its corners are in, which need not be convex. From one end in its new
 * place all of the cell is seen, hence the edge lies in it; where the triangle counts, from both: so the moving end's
 * path lies in the cell, and what joins that to the fixed end. */
template <int D>
bool is_seen(const Environment<D>& env, SweepLevel level, const EdgeSweep& sweep, CastCounters* counters);

/** Whether the triangle lies in a ball that is free. */
template <int D>
bool is_clear(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep);

/** What is used again from edge to edge. */
template <int D>
struct EdgeScratch {
  Array<uint32_t> before;    // facets of a corridor, to go back to
  CorridorWriter<D> writer;  // of a cast along an edge where it stands
  CastCounters* counters = nullptr;

  explicit EdgeScratch(const Memory* memory) : before(memory), writer(memory) {}
};

/** Whether the edge keeps to the facets that it was last known to pass, but for those that its end passes itself, and
 * for those round a pivot to whose other side it goes: then it is free in its new place. If it kept to them before,
 * too, the triangle's sides share a corridor, or part at one pivot. A path of two facets may come from one cell
 * beside the corridor and go to another: its facets cut off the triangle's corners in these, and what is left lies in the
 * cell between them and in the corridor. kUnknown, kHolds or kTurned. Where triangles count, a corridor that is not that of
 * the edge's place is noted again, by a cast. Throws std::bad_alloc. */
template <int D>
Verdict follow_corridor(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep,
                        EdgeScratch<D>& scratch);

/** In space, where triangles count: as follow_corridor. If the edge leaves its facets, `ridge` is the first ridge that
 * it meets and cannot turn round, if that is known. Where the moving end stays in its cell, the edge may turn round
 * several ridges, one after the other.
 * @param arrives whether the edge will stand at the target: then the corridor becomes that of its new place. If not,
 * the corridor stays that of the start, and what is met counts up to the wall that the path meets. */
Verdict follow_to_ridge(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep, bool arrives,
                        EdgeScratch<3>& scratch, FirstRidge* ridge);
inline Verdict follow_to_ridge(const Environment<2>& env, const Body<2>& body, const EdgeSweep& sweep, bool arrives,
                               EdgeScratch<2>& scratch, FirstRidge*) {
  return arrives ? follow_corridor(env, body, sweep, scratch) : Verdict::kUnknown;
}

/** Whether the edge meets nothing before an event, which is its own, or of the path or another edge of its moving end.
 * The edge keeps to its corridor until then, but for the facets that the path passes. If the path meets a wall,
 * `arrival` is the cell in front of the wall. False at EDGES without corridors. Throws std::bad_alloc. */
template <int D>
bool is_free_before(const Environment<D>& env, const Body<D>& body, const EdgeSweep& sweep, const SweepEvent& event,
                    EdgeScratch<D>& scratch);

/** Whether an edge is known to keep to its corridor in its present place. */
template <int D>
bool keeps_corridor(const Environment<D>& env, const Body<D>& body, uint32_t e);

/** Whether an edge meets nothing before its moving end meets a wall of the cell `front`: up to there it stays in that
 * cell, or in that and a second one and passes between them. Of a line through q the sides of a ridge change linearly
 * on the way of its other end: where it passes the facet at both ends of the way, it does so between. */
template <int D>
bool stays_before_wall(const Environment<D>& env, const BodyVertex<D>& at, const double* to, Cell front,
                       const BodyVertex<D>& fixed);

}  // namespace dsw
