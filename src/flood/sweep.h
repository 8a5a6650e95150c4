#pragma once
// What a moving vertex p of a body sweeps on its way to p', exact under the shift: with an edge p q the triangle p p' q
// [JCD10] 4.1, with a face p q r the tetrahedron p p' q r. In the plane there are no faces, and an edge sweeps a solid.

#include "flood/solid_sweep.h"
#include "predicates/swept_triangle.h"

namespace dsw {

template <int D>
class SweepFlood;

template <>
class SweepFlood<2> : public SolidSweep<2> {
  using SolidSweep<2>::SolidSweep;
};

/** As SolidSweep, also for the triangle that an edge sweeps in space. */
template <>
class SweepFlood<3> : public SolidSweep<3> {
 public:
  using SolidSweep<3>::SolidSweep;
  using SolidSweep<3>::sweep;

  /** `start` contains m.p, and the edge p q is free. Nothing is found where p, p', q are collinear: the path of p is
   * the sweep then. With `collect`, all() has every contact afterwards. Throws std::bad_alloc. O(cells met). */
  SweepResult sweep(const EdgeMotion& m, Cell start, uint32_t max_volumes, bool collect = false);

 private:
  bool read_corners(Cell c);
  int side(Corner& corner) const;
  uint32_t outside(const Corner& a, const Corner& b);
  void look_at_facets(Cell c, const Shape& shape);
  void look_at_marked_edges(Cell c, const Shape& shape);
  void look_at_obstacle(Cell c, const Shape& shape, uint32_t facet);
  bool facet_met(const Shape& shape, uint32_t facet);
  bool simplex_met(const uint16_t* local);
  void consider(const SweepContact& found);
  void sort_found();

  const SweptTriangle* triangle_ = nullptr;  // during a sweep of an edge
  bool collect_ = false;
};

}  // namespace dsw
