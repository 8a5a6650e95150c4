#pragma once
// Which cells lie inside of a closed surface: those round whose centre it turns. How often it does is asked once, of a
// ray; from there on a flood knows it, as it changes only where the way from one centre to the next, by a vertex that
// the two cells share, crosses the surface.

#include "cutting/blade_tree.h"
#include "cutting/crossings.h"
#include "topology/edit.h"

namespace dsw {

template <int D>
class Inside {
 public:
  /** What the surface crosses is left in *crossings, `briefly` without the crossings of edges, and without passable
   * cells unless the flood has a start. Throws std::bad_alloc, as all here. */
  Inside(const Environment<D>& env, const Blade<D>& blade, bool briefly, Crossings<D>& crossings);

  /** Floods through cells that are inside or crossed, from a cell that is; else from the first that is crossed, see
   * start.h. O(facets of cells that are, with a search in a tree of simplices for each cell beside one). */
  void flood_from(Cell start, uint32_t* visited);
  /** Floods from all cells that are inside or crossed. The tree of cells finds them, or a scan if there is no tree
   * yet. */
  void flood_all();

  /** Cells that were looked at, and whether their centres are inside. */
  uint32_t cell_count() const { return static_cast<uint32_t>(cells_.size()); }
  Cell cell(uint32_t i) const { return cells_[i].cell; }
  bool is_inside(uint32_t i) const { return cells_[i].turns != 0; }
  /** Whether a point that is thought to lie in a cell is inside. */
  bool holds(Cell c, const double* point) const;

  /** What is inside becomes passable in an edit that is prepared, with `covers` also what the surface meets; lists those
   * cells that are not yet, as they will be. O(cells). */
  void carve(Edit<D>& edit, bool covers, Array<Cell>& carved) const;

 private:
  struct Known {
    Cell cell;
    int turns;     // of the surface round the cell's centre
    bool crossed;  // by the surface
  };

  bool flood(Cell start);
  bool has_centre_in(Cell c, const double* at) const;
  void add(Cell c);
  void look_beyond(const Known& known, HalfFacet h);
  bool seed(Cell c);
  bool is_met(Cell c) const;
  int crossings_of(uint32_t simplex, const double* from, const double* to) const;
  int crossings_in(Cell c, const double* from, const double* to) const;
  int turns_round(const double* point) const;

  const Environment<D>& env_;
  const Map<D>& map_;
  const Blade<D>& blade_;
  bool briefly_;
  Crossings<D>& crossings_;
  BladeTree<D> tree_;
  KeyTable numbers_{env_.memory};  // of cells, by unit
  Array<Known> cells_{env_.memory};
  uint32_t done_ = 0;  // cells whose neighbours have been looked at
};

/** Finds all that a blade crosses, anywhere. Takes what for_each_near() does. */
template <int D>
void find_all(const Environment<D>& env, const BladeTree<D>& tree, Crossings<D>& crossings);

/** Whether a blade crosses passable cells, and ends in none of them. O(cells crossed). */
template <int D>
bool closes(const Environment<D>& env, const Crossings<D>& crossings);

}  // namespace dsw
