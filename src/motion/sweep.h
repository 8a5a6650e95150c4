#pragma once
// What a moving vertex p of a body sweeps on its way to p', in space and exact under the shift: with an edge p q the triangle
// p p' q [JCD10] 4.1, with a face p q r the tetrahedron p p' q r.

#include "map/cell_queue.h"
#include "motion/line_table.h"
#include "motion/sweep_contact.h"
#include "predicates/swept_triangle.h"

namespace dsw {

enum class SweepEnd : uint32_t { kFree, kContact, kWorkLimit };

struct SweepResult {
  SweepEnd end = SweepEnd::kFree;
  SweepContact contact;  // kContact: the first. kWorkLimit: nothing, even if contacts had been found: not all were
  uint32_t cells_visited = 0;
};

/** Floods from the cell of p over all cells that the swept triangle or tetrahedron meets without crossing anything impassable:
 * what is swept before the first contact is connected and holds p, so that the first contact is the earliest of what the
 * flood sees. Keeps its memory from sweep to sweep; one for each thread. */
template <int D>
class SweepFlood {
 public:
  explicit SweepFlood(const Environment<D>& env);

  /** `start` contains m.p, and the edge p q is free. Nothing is found where p, p', q are collinear: the path of p is the sweep
   * then. With `collect`, all() has every contact afterwards. Throws std::bad_alloc. O(cells met). */
  SweepResult sweep(const EdgeMotion& m, Cell start, uint32_t max_cells, bool collect = false);

  /** The cells met by the last sweep. */
  const CellQueue& cells() const { return cells_; }

  /** Every contact of the last sweep of an edge that collected, also of one that met the work limit: in the order of
   * comes_before, one for each line and for each triangle. Sorting throws nothing. */
  const Array<SweepContact>& all() const { return found_; }

  /** The first impassable vertex that a face meets; `start` contains m.p, and the face p q r is free. What enters through
   * the triangles p p' q and p p' r is left to the sweeps of these edges: where they find nothing earlier, this is the
   * face's first contact. Nothing is found where p, p', q, r lie in one plane. Throws std::bad_alloc. O(cells met, and
   * cells round the vertices inside of the tetrahedron). */
  SweepResult sweep(const FaceMotion& m, Cell start, uint32_t max_cells);

 private:
  struct Tetrahedron;
  static constexpr int kUnknown = 2 << 4;  // neither a sign nor bits of four faces
  /** A vertex of the cell that is looked at. */
  struct Corner {
    const double* at;
    uint32_t vertex;
    uint32_t beyond;  // sides of the box of what is swept
    int side;         // of the swept plane, or bits of the faces it lies beyond; kUnknown: nobody has asked
  };

  /** Vertices of a cell, and on which sides of the box of what is swept they lie. */
  template <class Swept>
  void read_vertices(Cell c, const Swept& swept) {
    const uint32_t* const w = map_.record(c);
    const Form form = form_of(w[0]);
    const uint32_t count = map_.vertices_of(c);
    corners_.resize(count);
    const uint32_t* const words = form == Form::kSimplex ? w : w + kUnitWords;
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t vertex = form == Form::kGeneral ? map_.vertex(c, i) : words[i] & kVertexMask;
      const double* const at = env_.point(vertex);
      corners_[i] = {at, vertex, swept.beyond_box(at), kUnknown};
    }
  }
  bool read_corners(Cell c);
  int side(Corner& corner) const;
  uint32_t outside(const Corner& a, const Corner& b);
  void look_at_facets(Cell c, const Shape& shape);
  void look_at_wires(Cell c, const Shape& shape);
  void look_at_obstacle(Cell c, const Shape& shape, uint32_t facet);
  bool facet_met(const Shape& shape, uint32_t facet);
  bool simplex_met(const uint16_t* local);
  void consider(const SweepContact& found);
  void sort_found();

  void look_at_inside_vertices(const Tetrahedron& t, Cell c);
  bool simplex_met(const Tetrahedron& t, const uint16_t* local);
  bool judge_vertex(Cell c, uint32_t vertex, HalfFacet& facet);

  const Environment<D>& env_;
  const Map<D>& map_;
  const SweptTriangle* triangle_ = nullptr;  // during a sweep of an edge
  bool collect_ = false;
  SweepResult result_;
  CellQueue cells_;            // met
  CellQueue around_;           // round the vertex that is judged
  LineTable lines_;            // where they pierce the swept plane; of a face: vertices that have been judged
  Array<Corner> corners_;      // of the cell that is looked at
  Array<SweepContact> found_;  // if they are collected
};

}  // namespace dsw
