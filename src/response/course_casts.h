#pragma once
// Casts of a body on its course, side by side.

#include "response/course.h"
#include "sweep/simplex_sweep.h"

namespace dsw {

/** Casts paths and edges in packets. Where a cast is not free, the vertices that rely on it are in doubt. */
template <int D>
class CourseCasts {
 public:
  struct End {
    Cell cell;
    const double* position;
  };

  CourseCasts(const Environment<D>& env, const SimplexSweep<D>& sweeps, Course<D>& course)
      : env_(env), sweeps_(sweeps), course_(course) {}

  /** For a course that has just started. Throws std::bad_alloc, as add_edge and run_edges do. */
  void start();
  /** Casts the paths of all vertices that move, which tells where they arrive. */
  void cast_paths();
  /** The facets on the path of a vertex; none unless corridors are kept. */
  PathFacets crossed(uint32_t v) const { return course_.motion.crossed_by(v); }

  /** To see whether edge e is free in a new place, and which cells it crosses there.
   * @param v whose way is in doubt if it is not; kNone: that of both ends. */
  void add_edge(uint32_t e, uint32_t v, const End& from, const End& to);
  /** Adds the new place of edge e if no corridors are kept: only whether the edge is free there is asked. */
  void add_place(uint32_t e, uint32_t v, const End& from, const End& to) {
    vertices_[packet_.count()] = v;
    edges_[packet_.count()] = e;
    packet_.add_between(env_, from.cell, from.position, to.cell, to.position, sweeps_.max_volumes);
    if (packet_.full()) run_edges();
  }
  /** Counts a place of an edge that is seen to be free: which edges are cast together does not depend on that. */
  void add_seen() {
    packet_.add_seen(1);
    if (packet_.full()) run_edges();
  }
  /** Or so many, fewer than there is room for. */
  void add_seen_at_once(uint32_t places) { packet_.add_seen(places); }
  /** How many places may be added before edges are cast. */
  uint32_t room() const { return packet_.room() - 1; }
  /** How often a cast has put vertices in doubt. */
  uint32_t doubts() const { return doubts_; }
  /** Casts the edges that have been added. */
  void run_edges();
  /** Whether these edges of a vertex are free where they are. */
  bool are_free(uint32_t v, const Array<uint32_t>& edges);
  /** Finds out which edges of a vertex are free where they are, for a body that keeps a list of edges that may not be.
   * @param asked all but those that are known to be free. */
  void test_star(uint32_t v, const Array<uint32_t>& asked);

 private:
  void run();
  template <class Visit>
  bool visit_blocked(uint32_t v, const Array<uint32_t>& edges, Visit visit);

  const Environment<D>& env_;
  const SimplexSweep<D>& sweeps_;
  Course<D>& course_;
  Packet<D> packet_;
  uint32_t doubts_ = 0;
  uint32_t vertices_[kPacket] = {};  // kNone: of both ends of the edge
  uint32_t edges_[kPacket] = {};
  Array<CorridorWriter<D>> writers_{env_.memory};  // of the packet, if corridors are kept
};

}  // namespace dsw
