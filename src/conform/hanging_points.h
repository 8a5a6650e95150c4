#pragma once
// Points that lie on edges and are no ends of these.

#include "base/key_table.h"
#include "environment/outer_facets.h"

namespace dsw {

/** Whether a point lies between the ends of an edge and is not farther from it than `room`. 0: exactly on it. */
template <int D>
bool lies_on_edge(const double* a, const double* b, const double* p, double room) noexcept;

template <int D>
class HangingPoints {
 public:
  explicit HangingPoints(const Environment<D>& env)
      : env_(env),
        edges_(env.memory),
        first_(env.memory),
        points_(env.memory),
        ends_((size_t{env.map.vertex_count} + 63) / 64, 0, env.memory) {}

  /** Adds a vertex that lies on an edge, if it is not known. O(points on the edge). Throws std::bad_alloc. */
  void add(uint32_t u, uint32_t v, uint32_t vertex);

  uint32_t count() const { return static_cast<uint32_t>(points_.size()); }
  /** Whether a cell has two vertices or more that are ends of edges with points. */
  bool may_have_ends(Cell c) const {
    uint32_t count = 0;
    env_.map.for_each_vertex(c, [&](uint32_t v) { count += may_have(v) ? 1u : 0u; });
    return count >= 2;
  }
  /** Bits: vertices that make flat triangles with two points of one edge: its ends, and its points if there are several. */
  Array<uint64_t> poor_fans() const;
  /** Appends u, and then the points that lie between u and v, in this order. */
  void append(uint32_t u, uint32_t v, Array<uint32_t>& loop) const {
    loop.push_back(u);
    if (may_have(u) && may_have(v)) append_points(u, v, loop);
  }

 private:
  static constexpr uint32_t kEnd = 0xffffffffu;
  struct Point {
    uint32_t vertex, next;  // next: towards the end of the higher index
    double along;           // ascends that way
  };

  bool may_have(uint32_t vertex) const { return (ends_[vertex / 64] >> vertex % 64 & 1) != 0; }
  void append_points(uint32_t u, uint32_t v, Array<uint32_t>& loop) const;

  const Environment<D>& env_;
  KeyTable edges_;         // that have points
  Array<uint32_t> first_;  // in points_, of each edge
  Array<Point> points_;
  Array<uint64_t> ends_;  // bits: vertices that are ends of such edges
};

/** Corners of sides of the outer boundary that lie on sides of it: exactly, or within `room`. Expected O(n log n) for sides of
 * like length. Throws std::bad_alloc. */
void find_hanging_points(const Environment<2>& env, const OuterFacets<2>& outer, double room, HangingPoints<2>& found);

}  // namespace dsw
