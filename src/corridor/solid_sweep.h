#pragma once
// What a moving vertex p of a body sweeps on its way to p', where that has the dimension of the space: with a face p q
// r the tetrahedron p p' q r, in the plane with an edge p q the triangle p p' q [JCD10] 4.1. Exact under the shift.

#include "corridor/line_table.h"
#include "corridor/sweep_contact.h"
#include "map/cell_queue.h"

namespace dsw {

enum class SweepEnd : uint32_t { kFree, kContact, kWorkLimit };

struct SweepResult {
  SweepEnd end = SweepEnd::kFree;
  SweepContact contact;  // kContact: the first. kWorkLimit: nothing, even if contacts had been found: not all were
  uint32_t volumes_visited = 0;
};

/** Floods from the cell of p over all cells that what is swept meets without crossing anything impassable: what is
 * swept before the first contact is connected and holds p, so that the first contact is the earliest of what the flood
 * sees. Keeps its memory from sweep to sweep; one for each thread. */
template <int D>
class SolidSweep {
 public:
  explicit SolidSweep(const Environment<D>& env);

  /** The first impassable vertex that a face meets, in the plane an edge; `start` contains m.p, and the face is free
   * where it stands. What enters through the triangles p p' q and p p' r is left to the sweeps of these edges, in the
   * plane what enters through p p' to the path of p: where they find nothing earlier, this is the first contact.
   * Nothing is found where p, p', q, r lie in one plane, or p, p', q in one line. With `collect`, all() has every
   * contact afterwards. Throws std::bad_alloc. O(cells met, and cells round the vertices inside). */
  SweepResult sweep(const SolidMotion<D>& m, Cell start, uint32_t max_volumes, bool collect = false);

  /** The cells met by the last sweep. */
  const CellQueue& cells() const { return cells_; }

  /** Every contact of the last sweep that collected, also of one that met the work limit: in the order of comes_before,
   * one for each vertex and for each line and triangle. Sorting throws nothing. */
  const Array<SweepContact>& all() const { return found_; }

 protected:
  struct Solid;
  static constexpr int kUnknown = 2 << 4;  // neither a sign nor bits of four sides
  /** A vertex of the cell that is looked at. */
  struct Corner {
    const double* at;
    uint32_t vertex;
    uint32_t beyond;  // sides of the box of what is swept
    int side;         // of the swept plane, or bits of the sides it lies beyond; kUnknown: nobody has asked
  };

  /** Vertices of a cell, and on which sides of the box of what is swept they lie. */
  template <class Swept>
  void read_vertices(Cell c, const Swept& swept) {
    const uint32_t* const w = map_.record(c);
    const Form form = form_of(w[0]);
    const uint32_t count = map_.vertices_of(c);
    corners_.resize(count);
    const uint32_t* const words = form == Form::kSimplex ? w : w + kUnitWords<D>;
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t vertex = form == Form::kGeneral ? map_.vertex(c, i) : words[i] & kVertexMask;
      const double* const at = env_.point(vertex);
      corners_[i] = {at, vertex, swept.beyond_box(at), kUnknown};
    }
  }
  /** Calls look(cell) for each cell that is met, up to the work limit; look inserts more into cells_. */
  template <class Look>
  void flood(Cell start, uint32_t max_volumes, Look look) {
    cells_.insert(start);
    for (size_t i = 0; i < cells_.size(); ++i) {
      if (max_volumes != 0 && i == max_volumes) {
        result_.end = SweepEnd::kWorkLimit;
        result_.contact = {};
        return;
      }
      ++result_.volumes_visited;
      look(cells_[i]);
    }
  }
  /** Forgets the last sweep. */
  void clear();

  const Environment<D>& env_;
  const Map<D>& map_;
  SweepResult result_;
  CellQueue cells_{env_.memory};        // met
  LineTable lines_{env_.memory};        // where they pierce the swept plane; of a solid: vertices that have been tested
  Array<Corner> corners_{env_.memory};  // of the cell that is looked at
  Array<SweepContact> found_{env_.memory};  // if they are collected

 private:
  void enter_neighbours(const Solid& solid, Cell c);
  bool simplex_met(const Solid& solid, const uint16_t* local);
  void look_at_inside_vertices(const Solid& solid, Cell c);
  void test_corner(const Solid& solid, Cell c, const Corner& corner);
  bool test_vertex(Cell c, uint32_t vertex, HalfFacet& facet);

  bool collect_ = false;
  CellQueue around_{env_.memory};  // round the vertex that is tested
};

}  // namespace dsw
