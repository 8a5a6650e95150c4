#pragma once
// What the walls at one vertex of the environment sweep when it moves, against what lies there: the sweeps of a body
// turned round, and exact like them. Only the vertex moves, so that a part of a wall that has n other vertices sweeps a
// simplex of n + 2: in space a triangle sweeps a tetrahedron, an edge a triangle, the vertex a segment; in the plane a
// side sweeps a triangle, the vertex a segment.

#include "base/vec.h"
#include "contact/wall_hit.h"
#include "walls/occupants.h"

namespace dsw {

template <int D>
class WallSweep {
 public:
  explicit WallSweep(const Environment<D>& env);

  /** Finds the walls at a vertex, among the cells round it. Throws std::bad_alloc.
   * @param passable whether all of these cells, and their facets at the vertex, are known to be passable. Then there is one at least. */
  void start(uint32_t vertex, const Array<Cell>& star, bool passable);
  bool has_walls() const noexcept { return impassable_; }

  /** Whether a feature is touched when the vertex goes from `from` to `to`; fills *hit with the first touch. At EDGES a
   * marked edge, in the plane a marked vertex, is not met; in space vertices are met by faces alone. A thick body is met
   * by what comes too near to it. */
  bool meets(const Occupants<D>& all, const Feature& feature, const double* from, const double* to, WallHit* hit) const;

 private:
  void add_facet(HalfFacet h, const Shape& shape, Cell c, uint32_t facet);
  void add_lone_ridges(const Array<Cell>& star);
  void add_ridge(uint32_t other, HalfFacet facet, Cell cell);
  bool meets_point(const double* x, const double* from, const double* to, WallHit* hit) const;
  bool meets_edge(const Body<D>& body, uint32_t e, const double* from, const double* to, WallHit* hit) const;
  bool comes_near(const Body<D>& body, const Feature& feature, const double* from, const double* to,
                  WallHit* hit) const;
  bool meets_face(const Body<D>& body, uint32_t f, const double* from, const double* to, WallHit* hit) const;

  const Environment<D>& env_;
  uint32_t vertex_ = kNone;
  Cell front_;               // at the vertex, passable if there is one
  bool impassable_ = false;  // the vertex: by its mark, or by a ridge, as every wall has one at it
  // What is at the vertex, which comes first, each with a cell there that is passable if there is one.
  Array<WallFeature> simplices_{env_.memory};  // of facets: met by points
  Array<WallFeature> ridges_{env_.memory};     // of those, and marked edges; in the plane the vertex: met by edges
};

/** Normal of the plane in which the touched part of the wall and what it touches lie at the end of the vertex's way; of
 * any sense. `corners`: of the touched feature. Not of a thick body. */
template <int D>
Vec find_end_normal(const Environment<D>& env, const WallHit& hit, const double* const* corners, const double* to);
/** Where a hit is, and what is needed to push what is touched. */
template <int D>
void measure(const Environment<D>& env, const Occupants<D>& all, const double* from, const double* to, WallHit& hit);

}  // namespace dsw
