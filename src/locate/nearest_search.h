#pragma once
// What the flood of nearest.h finds, without the flood: the tree of obstacles says what is near, and a search back from
// there says when the flood would come to it.
//
// The flood enters a cell through a facet only if the facet's distance, its key, is within the best distance so far, and
// it takes the lowest key first, then the lowest cell. The level of a cell is the least number L for which passable
// facets with keys up to L lead from the start to the cell; that of the start is 0. The flood enters all cells of a
// level before any cell of a higher one, because a facet with a lower key always waits where such a cell is left. So
//
// - let `reach` be a distance, and let all obstacles within it be known, each with the cells that see it;
// - for each such sight let `due` be the larger one of the obstacle's distance and of the cell's level;
// - let `end` be the least of these numbers, and let it be within `reach`.
//
// Cells of lower levels than `end` see nothing nearer than `end`. The flood enters all of them, and the cells of level
// `end` after them. If none of the cells of this level sees anything within `end`, then what is left are the sights at
// distance `end` from lower levels: the first by name wins, and of two sights of one obstacle, which may differ in the
// last bits, the one of the lower level. Else the cells of level `end` are entered here as the flood does it: cells that
// no sight depends on change nothing, since they offer nothing and since waiting cells are ordered by key and cell only.
// No cell of a higher level is entered, as the best distance is within `end` by then. None of this takes any distance to
// be right: rounded numbers are compared as the flood compares them.
//
// The rounded distances of obstacles lie within 2^-44 of the environment's size from the true ones, so that boxes
// (cell_tree.h) leave out nothing that is near enough.

#include "base/key_table.h"
#include "locate/distances.h"

namespace dsw {

enum class SearchEnd { kFound, kNothing, kUnknown };

template <int D>
class NearestSearch {
 public:
  /** Of distances whose scale is 1. */
  NearestSearch(const Distances<D>& distances, const CellTree<D>& tree, const double* point, Cell start, double radius);

  /** Unknown: two sights cannot be told apart, or it is too much work; then only the flood knows. */
  SearchEnd run(NearestResult& result);

 private:
  /** An obstacle as a cell sees it. */
  struct Sight {
    double distance, level;
    Vec at;
    FeatureRef feature;
    Cell cell;
  };
  /** A cell from which others are entered, on the way back from a sight. */
  struct Step {
    double key;
    Cell cell;
    uint32_t next;  // the step that is entered from it
    bool operator<(const Step& o) const { return key > o.key; }
  };
  static constexpr size_t kMostSights = 256;
  static constexpr uint32_t kMostSteps = 1u << 14, kMostLast = 512;

  double reach() const;
  bool gather();
  void forget_far();
  void look(Cell c);
  bool set_levels();
  double level_of(Cell c);
  void note_way(uint32_t step);
  bool take_lower(double end);
  bool take_last(double end);
  bool find_last(double end, Array<Visit>& waiting);
  void offer(const Sight& sight);
  template <class Wanted, class Visitor>
  void for_each_way_in(Cell c, Wanted is_wanted, Visitor visit) const;

  const Distances<D>& distances_;
  const Environment<D>& env_;
  const Map<D>& map_;
  const CellTree<D>& tree_;
  const double* point_;
  Cell start_;
  double radius_, slack_, nearest_;
  Array<Sight> sights_;
  KeyTable looked_, known_, seen_, last_;  // units of cells
  Array<double> levels_;                   // at most, of known cells
  Array<Step> steps_, heap_;
  uint32_t step_count_ = 0;
  const Sight* best_ = nullptr;
};

}  // namespace dsw
