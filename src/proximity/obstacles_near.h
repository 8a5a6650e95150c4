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

  /** Appends all obstacles that may be in the region, at the passable cells that can be reached from `starts` through
   * passable facets that may be in the region. Throws std::bad_alloc. */
  void find(const Cell* starts, size_t count, const NearRegion<D>& region, NearList<D>& found);
  /** Goes on from one more cell, unless that has been reached. */
  void find_from(Cell start, const NearRegion<D>& region, NearList<D>& found);
  /** Makes find() append what may be in the region at any time while the environment's points go straight to `points`.
   * Null: the points stand still. */
  void set_next(const double* points) noexcept { next_ = points; }
  /** The cells that were reached last. */
  const CellQueue& cells() const noexcept { return cells_; }

 private:
  /** What is known of a vertex that stands in its place. */
  struct Known {
    uint32_t vertex, bits;
  };
  static constexpr uint32_t kKnown = 256;

  /** See NearRegion. */
  uint32_t outside(uint32_t vertex, const NearRegion<D>& region) noexcept {
    const Known& known = known_[vertex % kKnown];
    return known.vertex == vertex ? known.bits : find_outside(vertex, region);
  }
  uint32_t find_outside(uint32_t vertex, const NearRegion<D>& region) noexcept;
  /** Visits the cells from that number on, and those that are reached from them. */
  void go_on(size_t from, const NearRegion<D>& region, NearList<D>& found);
  void visit(Cell c, const NearRegion<D>& region, NearList<D>& found);
  void visit_tetrahedron(Cell c, const NearRegion<D>& region, NearList<D>& found);
  /** Through a facet, if it is passable. `outside` is that of the cell's vertices. */
  void follow(Cell c, uint32_t facet, const uint32_t* outside, NearList<D>& found);
  void add_triangles(Cell c, uint32_t facet, const uint32_t* outside, NearList<D>& found) const;
  bool has_thin() const { return env_.marked_edges != 0 || env_.marked_vertices != 0; }
  DSW_COLD void add_thin(Cell c, const uint32_t* outside, NearList<D>& found) const;

  const Environment<D>& env_;
  const double* next_ = nullptr;
  CellQueue cells_;
  bool are_open_ = true;     // the cells that were reached: none of them is marked or invalid
  Array<uint32_t> outside_;  // of the vertices of the cell that is visited, unless that is a tetrahedron
  Known known_[kKnown];
};

}  // namespace dsw
