#pragma once
// A piece of what is impassable: cells that hang together through facets, and the cracks round them.

#include "map/cell_queue.h"
#include "topology/operations.h"

namespace dsw {

class Piece {
 public:
  /** All that hangs together with `start`. Throws BAD_TOPOLOGY if that is passable, TOO_LARGE where it is more than
   * `most` cells, INVALID_CELL where one of them is, and std::bad_alloc. The map is ready to change. */
  Piece(const Environment<3>& env, Cell start, size_t most);

  size_t size() const { return cells_.size(); }
  Cell operator[](size_t i) const { return cells_[i]; }
  bool contains(Cell c) const { return cells_.contains(c); }

  /** Cracks of which both sides have the same vertices and triangles; `a` is the piece's, or both are. */
  const Array<FacetPair>& cracks() const { return cracks_; }
  /** The other side of one of its facets when those are sewn; invalid at the outer boundary. */
  HalfFacet behind(HalfFacet h) const;
  /** Whether something else lies behind one of its facets then, or nothing. */
  bool is_surface(HalfFacet h) const {
    const HalfFacet o = behind(h);
    return !o.valid() || !contains(env_.map.cell_of(o));
  }

 private:
  void find_cells(Cell start, size_t most);
  void find_cracks();

  const Environment<3>& env_;
  CellQueue cells_{env_.memory};
  Array<FacetPair> cracks_{env_.memory};
  Array<FacetPair> sewn_{env_.memory};  // the same from each side that is the piece's, sorted by `a`
};

}  // namespace dsw
