#pragma once
// Points of the outer boundary that lie on edges of it and are no ends of these.

#include "base/key_table.h"
#include "environment/outer_facets.h"

namespace dsw {

template <int D>
class HangingPoints {
 public:
  /** Looks for corners of outer facets that lie on edges of outer facets: exactly, or within `room`. Expected O(n log n) for
   * edges of like length. Throws std::bad_alloc. */
  HangingPoints(const Environment<D>& env, const OuterFacets<D>& outer, double room);

  bool empty() const { return points_.empty(); }
  /** Whether a cell has two vertices or more that are ends of edges with points. */
  bool may_have_ends(Cell c) const {
    uint32_t count = 0;
    env_.map.for_each_vertex(c, [&](uint32_t v) { count += may_have(v) ? 1u : 0u; });
    return count >= 2;
  }
  /** Appends u, and then the points that lie between u and v, in this order. */
  void append(uint32_t u, uint32_t v, Array<uint32_t>& loop) const;

 private:
  struct Point {
    uint32_t edge, vertex;
    double along;  // the coordinate along which the edge is longest
  };

  bool may_have(uint32_t vertex) const { return (ends_[vertex / 64] >> vertex % 64 & 1) != 0; }

  const Environment<D>& env_;
  KeyTable edges_;         // that have points
  Array<uint32_t> first_;  // of each edge in points_; and where the last one ends
  Array<Point> points_;    // from the end of the lower index to the other one
  Array<uint64_t> ends_;   // bits: vertices that are ends of such edges
};

}  // namespace dsw
