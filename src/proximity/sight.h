#pragma once
// Whether the nearest point of an obstacle is seen from that of a part: a walk through cells along the exact segment.

#include "environment/environment.h"
#include "map/cell_queue.h"
#include "predicates/sightline.h"

namespace dsw {

/** Where a walk along a sightline ended. */
struct SightResult {
  bool is_hit = false;  // a facet there is impassable
  Cell cell;            // the last cell entered
};

/** Walks from a cell that contains the start of a line, under the shift, to the end or to an impassable facet. Every step
 * crosses a facet later than the one before.
 * @param target vertices: the end lies on every facet that has all of them. Throws std::bad_alloc. */
template <int D>
SightResult walk_along(const Environment<D>& env, Sightline<D>& line, Cell start, const uint32_t* target,
                       uint32_t target_count);

/** A cell with an obstacle at which a line ends that ends in the cell `end`; invalid if it ends at none. The other lip of
 * a closed slit has vertices of its own. It can lie before this lip up to rounding, but this line does not end at it, nor
 * at a sheet that overlaps.
 * @param vertices of the obstacle. @param cells is overwritten. Throws std::bad_alloc. */
template <int D>
Cell find_cell_at_end(const Environment<D>& env, Sightline<D>& line, Cell end, const uint32_t* vertices, uint32_t count,
                      CellQueue& cells);

/** The cells at a vertex, an edge or a triangle that can be reached from one of them through passable facets there. Walls
 * can part the cells at an edge into several such fans. */
template <int D>
class PassableFan {
 public:
  /** @param first has the vertices. @param cells is overwritten, and used as long as the fan. */
  PassableFan(const Environment<D>& env, Cell first, const uint32_t* vertices, uint32_t count, CellQueue& cells)
      : env_(env), vertices_(vertices), count_(count), cells_(cells) {
    cells_.clear();
    cells_.insert(first);
  }
  Cell first() const { return cells_[0]; }
  /** Whether a cell is in the fan. Looks no farther than it has to. Throws std::bad_alloc. */
  bool reaches(Cell c);

 private:
  const Environment<D>& env_;
  const uint32_t* vertices_;
  uint32_t count_;
  CellQueue& cells_;
  size_t next_ = 0;  // the first cell whose neighbours are not in `cells_` yet
};

}  // namespace dsw
