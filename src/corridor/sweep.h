#pragma once
// What a moving vertex p of a body sweeps on its way to p', exact under the shift: with an edge p q the triangle p p' q
// [JCD10] 4.1, with a face p q r the tetrahedron p p' q r. In the plane there are no faces, and an edge sweeps a solid.

#include "corridor/solid_sweep.h"
#include "predicates/cell_signs.h"
#include "predicates/swept_triangle.h"

namespace dsw {

template <int D>
class SweepFlood;

template <>
class SweepFlood<2> : public SolidSweep<2> {
  using SolidSweep<2>::SolidSweep;
};

/** A SolidSweep that also floods the triangle that an edge sweeps in space. */
template <>
class SweepFlood<3> : public SolidSweep<3> {
 public:
  using SolidSweep<3>::SolidSweep;
  using SolidSweep<3>::sweep;

  /** `start` contains m.p, and the edge p q is free. Where several parts of the environment touch each other in an edge
   * alone, the contact with that edge names a wall of the part from which p q comes. Nothing is found where p, p', q
   * are collinear: the path of p is the sweep then. With `collect`, all() has every contact afterwards. Throws
   * std::bad_alloc. O(cells met). */
  SweepResult sweep(const EdgeMotion& m, Cell start, uint32_t max_volumes, bool collect = false);
  /** Sweeps as sweep() does, but only a contact before `end`, a time in [0,1], is certain to be found. O(cells met
   * before the first contact, and a few more). */
  SweepResult sweep_until(const EdgeMotion& m, Cell start, double end);

 private:
  void flood_triangle(SweptTriangle& triangle, Cell start, uint32_t max_volumes);
  bool read_corners(Cell c);
  bool read_signs(Cell c, Form form);
  int side(Corner& corner) const;
  uint32_t outside(const Corner& a, const Corner& b);
  void look_at_facets(Cell c, const Shape& shape);
  void look_at_marked_edges(Cell c, const Shape& shape);
  void look_at_obstacle(Cell c, const Shape& shape, uint32_t facet);
  bool facet_met(const Shape& shape, uint32_t facet);
  bool flat_facet_met(const Shape& shape, uint32_t facet) const;
  bool simplex_met(const uint16_t* local);
  bool passes_plane(const uint16_t* local) const;
  void consider(const SweepContact& found);
  bool comes_from(const SweepContact& wall) const;
  uint32_t other_at_line(Cell c, const double* const* triangle, const double* const* line) const;
  template <class Visit>
  void for_each_cell_round(const SweepContact& wall, Visit visit) const;
  void decide_ties();
  bool is_one_fan(const SweepContact& contact) const;
  void sort_found();

  SweptTriangle* triangle_ = nullptr;  // during a sweep of an edge
  bool is_signed_ = false;             // the cell that is looked at is a tetrahedron or a pyramid; its signs are known:
  CellSigns signs_;
  bool is_flat_ = false;  // and it is convex with flat facets
  bool collect_ = false;
  bool ends_ = false;                      // at the first contact
  Array<SweepContact> tied_{env_.memory};  // walls at the line of the first contact
};

}  // namespace dsw
