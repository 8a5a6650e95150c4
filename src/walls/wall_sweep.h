#pragma once
// What the walls at one vertex of the environment sweep when it moves, against what lies there: the sweeps of a body turned round,
// and exact like them. Only the vertex moves, so a wall triangle sweeps a tetrahedron, a wall's edge a triangle, the vertex a segment.

#include "walls/occupants.h"

namespace dsw {

/** The first touch of a feature by the walls at a moving vertex. */
struct WallHit {
  double time = 0;  // fraction of the vertex's way, rounded down
  Feature feature;
  HalfFacet wall;                 // impassable; invalid for a wire and a marked vertex
  uint32_t q = kNone, r = kNone;  // with the vertex the wall's triangle or edge that touches; kNone beyond that

  bool operator<(const WallHit& o) const { return time != o.time ? time < o.time : feature < o.feature; }
};

template <int D>
class WallSweep {
 public:
  explicit WallSweep(const Environment<D>& env);

  /** Finds the walls at a vertex, among the cells round it. Throws std::bad_alloc. */
  void start(uint32_t vertex, const Array<Cell>& star);
  bool has_walls() const noexcept { return !triangles_.empty() || !edges_.empty() || marked_; }

  /** Whether a feature is touched when the vertex goes from `from` to `to`; fills *hit with the first touch. At EDGES wires and marked
   * vertices are not met, below FACES vertices are not. */
  bool meets(const Occupants<D>& all, const Feature& feature, const double* from, const double* to, WallHit* hit) const;

 private:
  struct Triangle {
    uint32_t q, r;
    HalfFacet facet;
  };
  struct Edge {
    uint32_t q;
    HalfFacet facet;  // invalid: a wire
  };

  void add_facet(HalfFacet h, const Shape& shape, Cell c, uint32_t facet);
  void add_edge(uint32_t q, HalfFacet facet);
  bool meets_point(const double* x, const double* from, const double* to, WallHit* hit) const;
  bool meets_edge(const Body<D>& body, uint32_t e, const double* from, const double* to, WallHit* hit) const;
  bool meets_face(const Body<D>& body, uint32_t f, const double* from, const double* to, WallHit* hit) const;

  const Environment<D>& env_;
  uint32_t vertex_ = kNone;
  bool marked_ = false;  // the vertex is impassable: by its mark, or by an edge, as every wall has two at it
  Array<Triangle> triangles_;
  Array<Edge> edges_;
};

/** Where and how a hit touches. */
struct WallTouch {
  double point[3], normal[3];  // the normal: unit, out of the wall, in the sense of its motion
  double along = 0;            // of a touched edge, from its first end
};
template <int D>
WallTouch describe_touch(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, const double* from,
                         const double* to);

}  // namespace dsw
