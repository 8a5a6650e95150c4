#pragma once
// What a segment meets between its ends, exactly and without the shift: walls are closed, and what touches an end alone
// does not count. Line of sight between points of a surface needs it.

#include "base/key_table.h"
#include "environment/environment.h"

namespace dsw {

enum class OpenEnd { kFree, kMet, kWorkLimit, kOutside, kImpassable };

struct OpenSegmentResult {
  OpenEnd end = OpenEnd::kFree;
  double time = 0;       // kMet: the largest double not later than the first touch
  HalfFacet facet;       // kMet: the impassable facet, from a passable cell. Of equals the lowest canonical one
  uint32_t simplex = 0;  // the first of its simplices that is met then, in the numbering of the cell
  uint32_t volumes_visited = 0;
};

/** Asks one segment after the other. */
template <int D>
class OpenSegments {
 public:
  explicit OpenSegments(const Environment<D>& env) : env_(env), seen_(env.memory), cells_(env.memory) {}

  /** @param start contains `from` under the shift, or is invalid where no cell does. O(cells that the segment touches);
   * at a start on a boundary also the cells that may contain it. Throws std::bad_alloc. */
  OpenSegmentResult ask(const double* from, const double* to, Cell start, uint32_t max_volumes);

 private:
  void enter(Cell c);
  bool find_first_cells(Cell start);
  void look_at_start(Cell c);
  void look(Cell c);
  void meet(HalfFacet h, uint32_t simplex, double time);
  void stop_at_start();

  const Environment<D>& env_;
  const double *from_ = nullptr, *to_ = nullptr;
  KeyTable seen_;
  Array<Cell> cells_;                  // entered, in order
  Array<Cell> at_start_{env_.memory};  // passable cells with `from` on their boundary
  OpenSegmentResult result_;
};

}  // namespace dsw
