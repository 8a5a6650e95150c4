#pragma once
// One facet of a polyhedron, split along segments between points that lie in it.

#include "conform/facet_pairs.h"

namespace dsw {

/** Where something lies of a loop. */
enum class LoopPlace { kOutside, kCorner, kInside };

class FacetSplit {
 public:
  /** `loop` has all points that lie on its edges; it stays where it is while this lives. */
  FacetSplit(const Environment<3>& env, VertexRange loop, LoopView view)
      : env_(env), loop_(loop), view_(view), segments_(env.memory) {}

  /** What a segment is to the loop. It must not have a corner of the loop inside of it. */
  enum class Relation { kApart, kSide, kInside, kCrosses };
  Relation relate(uint32_t u, uint32_t v) const;
  LoopPlace place(uint32_t vertex) const;

  /** Splits the facet along a segment inside of it. */
  void add(uint32_t u, uint32_t v) { segments_.push_back(pair_of(u, v)); }
  bool has_segments() const { return !segments_.empty(); }

  /** Appends the loops that the segments make of the facet, oriented as it. Where a loop would go through a point twice, its
   * triangles, positive seen from `apex`. False: there is no such way. O(k^2) for k segments; O(k^3) where parts of the
   * facet have holes. Throws std::bad_alloc. */
  bool run(const double* apex, Loops& out);

 private:
  struct Segment {
    uint32_t from, to;
    bool operator<(const Segment& o) const { return from != o.from ? from < o.from : to < o.to; }
    bool operator==(const Segment& o) const { return from == o.from && to == o.to; }
  };
  static Segment pair_of(uint32_t u, uint32_t v) { return u < v ? Segment{u, v} : Segment{v, u}; }

  int turn(uint32_t a, uint32_t b, uint32_t c) const;
  bool is_in_wedge(uint32_t corner, uint32_t v) const;
  bool crosses(uint32_t u, uint32_t v, uint32_t a, uint32_t b) const;
  bool is_between(uint32_t u, uint32_t w, uint32_t v) const;
  bool is_free(uint32_t u, uint32_t v, const Array<uint32_t>& vertices) const;
  bool join_holes();
  uint32_t next(const Array<Segment>& halves, uint32_t half) const;
  bool add_loop(const Array<uint32_t>& loop, const double* apex, Loops& out) const;

  const Environment<3>& env_;
  VertexRange loop_;
  LoopView view_;
  Array<Segment> segments_;
};

}  // namespace dsw
