#pragma once
// What the flood of nearest.h finds, without the flood: the tree of obstacles says what is near, and a search back from
// there says when the flood would come to it.
//
// The flood enters a cell through a passable facet if the facet's distance, its key, is within the best distance so
// far, or within that of a cell that was entered. It takes the lowest key first. The level of a cell is the least number L for which passable facets with keys up
// to L lead from the start to the cell; that of the start is 0. The flood enters all cells of a level before any cell
// of a higher one, because a facet with a low enough key waits as long as one is left.
//
// A sight is an obstacle as one cell sees it. It is due at the larger one of its distance and its cell's level. Let all
// sights within `reach` be known, and let `end` be the least number at which one of them is due. If `end` is within
// `reach`, what the flood finds follows. The flood enters all cells of levels up to `end`, since cells of lower levels see
// nothing nearer than `end`. Then its limit is `end`, so it enters no other cell. It keeps the nearest sight, ties by
// name. All sights of one obstacle have the same bits.
//
// No distance has to be right for this: rounded numbers are compared as the flood compares them. Only the tree relies
// on rounding errors being small (cell_tree.h).

#include "base/heap.h"
#include "base/key_table.h"
#include "locate/distances.h"

namespace dsw {

enum class SearchEnd { kFound, kNothing, kUnknown };

template <int D>
class NearestSearch {
 public:
  /** The scale of the distances must be 1. */
  NearestSearch(const Distances<D>& distances, const CellTree<D>& tree, const double* point, Cell start, double radius);

  /** Unknown if it is too much work, or if no near obstacle is reached. Then only the flood knows. */
  SearchEnd run(NearestResult& result);

 private:
  /** An obstacle as a cell sees it. */
  struct Sight {
    double distance, level;
    Vec at;
    FeatureRef feature;
    Cell cell;
  };
  /** A cell from which others are entered, on the way back from a sight. Of equal keys any may come first, but the
   * same on all platforms: what is visited is reported. */
  struct Step {
    double key;
    Cell cell;
    uint32_t next;  // the step that is entered from it
    bool operator<(const Step& o) const { return key > o.key; }
  };
  static constexpr size_t kMostSights = 256;
  static constexpr uint32_t kMostSteps = 1u << 14;

  double reach() const;
  bool gather();
  void forget_far();
  void look(Cell c);
  bool set_levels();
  double level_of(Cell c);
  void note_way(uint32_t step);
  template <class Wanted, class Visit>
  void for_each_way_in(Cell c, Wanted is_wanted, Visit visit) const;

  const Distances<D>& distances_;
  const Environment<D>& env_;
  const Map<D>& map_;
  const CellTree<D>& tree_;
  const double* point_;
  Cell start_;
  double radius_, slack_, nearest_;
  Array<Sight> sights_;
  KeyTable looked_, known_, seen_;  // units of cells
  Array<double> levels_;            // at most, of known cells
  Array<Step> steps_;
  Heap<Step> heap_;
  uint32_t step_count_ = 0;
};

}  // namespace dsw
