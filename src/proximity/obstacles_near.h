#pragma once
// The obstacles that can be seen from a simplex of a body within a distance, found by a flood through passable cells.

#include "environment/obstacles.h"
#include "map/cell_queue.h"
#include "proximity/near_list.h"
#include "proximity/near_region.h"

namespace dsw {

/** Keeps its memory from one flood to the next. */
template <int D>
class ObstacleFlood {
 public:
  explicit ObstacleFlood(const Environment<D>& env) : env_(env), cells_(env.memory), outside_(env.memory) {}

  /** Appends all obstacles that may be in the region, at the passable cells that can be reached from `start` through
   * passable facets that may be in the region. Throws std::bad_alloc. */
  void find(Cell start, const NearRegion<D>& region, NearList<D>& found);

 private:
  void visit(size_t number, const NearRegion<D>& region, NearList<D>& found);
  void add_triangles(Cell c, const Shape& shape, uint32_t facet, NearList<D>& found) const;
  void add_thin(Cell c, const Shape& shape, NearList<D>& found) const;

  const Environment<D>& env_;
  CellQueue cells_;
  Array<uint32_t> outside_;  // see NearRegion, of the vertices of the cell that is visited
};

}  // namespace dsw
