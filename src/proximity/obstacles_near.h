#pragma once
// The obstacles that can be seen from a simplex of a body within a distance, found by a flood through passable cells.

#include "environment/obstacles.h"
#include "map/cell_queue.h"
#include "proximity/near_region.h"

namespace dsw {

/** A triangle of an impassable facet (in the plane its segment), a marked edge, or a marked vertex. Or a face, an edge
 * or a vertex of a body. */
template <int D>
struct NearObstacle {
  uint32_t vertices[D];  // the first `count`
  uint32_t count;
  HalfFacet facet;  // seen from a passable cell; invalid if it is none, and of a body
  Cell cell;        // of a marked edge or vertex: a cell at it

  bool has(uint32_t vertex) const noexcept {
    bool found = false;
    for (uint32_t i = 0; i < count; ++i) found |= vertices[i] == vertex;
    return found;
  }
};

/** Keeps its memory from one flood to the next. */
template <int D>
class ObstacleFlood {
 public:
  explicit ObstacleFlood(const Environment<D>& env) : env_(env), cells_(env.memory), extents_(env.memory) {}

  /** Appends all obstacles that may be in the region, at the passable cells that can be reached from `start` through
   * passable facets that may be in the region. Throws std::bad_alloc. */
  void find(Cell start, const NearRegion<D>& region, Array<NearObstacle<D>>& found);

 private:
  void visit(size_t number, const NearRegion<D>& region, Array<NearObstacle<D>>& found);
  void add_triangles(Cell c, const Shape& shape, uint32_t facet, const NearRegion<D>& region,
                     Array<NearObstacle<D>>& found) const;
  void add_thin(Cell c, const Shape& shape, const NearRegion<D>& region, Array<NearObstacle<D>>& found) const;

  const Environment<D>& env_;
  CellQueue cells_;
  Array<Extent> extents_;  // of the vertices of the cell that is visited
};

}  // namespace dsw
