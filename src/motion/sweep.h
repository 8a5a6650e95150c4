#pragma once
// One edge swept over a triangle: its end p moves to p', its end q stays [JCD10] 4.1. In space; exact under the shift.

#include "environment/environment.h"
#include "predicates/sweep_events.h"

namespace dsw {

/** What an edge meets first. */
struct SweepContact {
  SweepEvent event;
  Cell front;                // the cell from which it is met
  HalfFacet facet;           // impassable, seen from `front`; invalid for a wire
  bool faces_start = false;  // p lies on this side of the plane
  uint32_t simplex = 0;      // of `front`, in `facet`
  uint32_t dart = kNoFacet;  // of `front`, along the obstacle's edge; kNoFacet for a vertex event and on a diagonal
};

enum class SweepEnd : uint32_t { kFree, kContact, kWorkLimit };

struct SweepResult {
  SweepEnd end = SweepEnd::kFree;
  SweepContact contact;
  uint32_t cells_visited = 0;
};

/** Floods from the cell of p over all cells that the swept triangle meets without crossing anything impassable: what is swept
 * before the first contact is connected and holds p, so that the first contact is the earliest of what the flood sees. Keeps
 * its memory from sweep to sweep; one for each thread. */
class SweepFlood {
 public:
  explicit SweepFlood(const Environment<3>& env);

  /** `start` contains m.p, and the edge p q is free. Nothing is found where p, p', q are collinear: the path of p is the sweep
   * then. Throws std::bad_alloc. O(cells met). */
  SweepResult sweep(const EdgeMotion& m, Cell start, uint32_t max_cells);

 private:
  size_t slot_of(Cell c) const;
  void enter(Cell c);
  void forget_all();
  bool look_at_vertices(Cell c);
  void look_at_facets(Cell c);
  void look_at_wires(Cell c);
  void look_at_obstacle(Cell c, const Shape& shape, uint32_t facet);
  bool facet_met(Cell c, const Shape& shape, uint32_t facet) const;
  bool edge_pierces(const double* a, const double* b) const;
  void consider(const SweepContact& found);

  const Environment<3>& env_;
  const Map<3>& map_;
  EdgeMotion m_{};
  SweepResult result_;
  Array<Cell> cells_;      // met, in the order of discovery
  Array<uint32_t> slots_;  // their units by hash, linear probing; kNoCell is empty
  Array<int8_t> sides_;    // of the swept plane: vertices of the cell that is looked at
};

}  // namespace dsw
