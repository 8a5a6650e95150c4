#pragma once
// What a blade meets, exact under the shift of predicates/: the blade is a body's surface that stands still. A flood
// goes from cell to cell and from simplex to simplex of the blade, through passable and impassable cells alike.

#include "base/key_table.h"
#include "cutting/blade.h"
#include "environment/environment.h"

namespace dsw {

/** Where the blade crosses an edge of the environment, at first: `a` is behind the blade, `b` before it. */
struct Crossing {
  uint32_t a, b;
  double share;  // of the way from a to b
  uint32_t simplex;
  bool once;  // no other simplex of the blade crosses this edge
};

/** A cell that the blade meets. */
struct MetCell {
  Cell cell;
  uint32_t last_simplex;  // the last one of those that meet it, see for_each_simplex
  bool holds_rim;         // the blade ends inside
  bool invalid;           // of moving points; nobody goes on from here
};

/** A point of the blade in a cell: a vertex, or where a side of a triangle, in the plane a segment, leaves the cell. In
 * space most of these are never asked for: where a side leaves is computed then. */
template <int D>
struct BladePoint {
  uint32_t cell;  // number of the met cell
  /** Points of the blade that the side joins, the first on the cell's side. If both are the same, the point is a vertex
   * of the blade, and `at` has it. */
  uint32_t inner = 0, outer = 0;
  uint32_t corners[3];  // vertices of the triangle through which it leaves
  double at[D];
};

template <int D>
class Crossings {
 public:
  Crossings(const Environment<D>& env, const Blade<D>& blade);

  /** Floods from a cell, if the blade meets it. Throws std::bad_alloc. O(pairs of cells and simplices that meet). */
  void flood(Cell start);
  /** Whether a simplex meets a cell; the flood will go on from there. */
  bool seed(Cell c, uint32_t simplex);
  /** Floods from what was seeded. */
  void run();
  /** Whether a cell is met by any simplex. O(simplices). */
  bool is_met(Cell c);
  /** Whether a simplex meets a cell. */
  bool is_met(Cell c, uint32_t simplex) { return meet(c, simplex, blade_.simplex(simplex)).simplex; }

  uint32_t cell_count() const { return static_cast<uint32_t>(cells_.size()); }
  const MetCell& cell(uint32_t i) const { return cells_[i]; }
  /** Number of a met cell, or KeyTable::kNone. */
  uint32_t number(Cell c) const { return cell_numbers_.find(c.unit); }

  uint32_t count() const { return static_cast<uint32_t>(crossings_.size()); }
  const Crossing& operator[](uint32_t i) const { return crossings_[i]; }
  /** Number of the crossing of an edge, or KeyTable::kNone. */
  uint32_t find(uint32_t a, uint32_t b) const { return edges_.find(pair_key(a, b)); }

  const Array<BladePoint<D>>& points() const { return points_; }
  /** Where one of these is. */
  void place(const BladePoint<D>& point, double* out) const;

  /** Calls visit(simplex) for those that meet a cell. */
  template <class Visit>
  void for_each_simplex(uint32_t cell, Visit visit) const {
    for (uint32_t i = cells_[cell].last_simplex; i != KeyTable::kNone; i = next_[i]) {
      visit(static_cast<uint32_t>(meetings_[i]));
    }
  }

 private:
  /** A vertex of the cell that is looked at. */
  struct Corner {
    const double* at;
    uint32_t vertex;
    int side;
    typename BladeSimplex<D>::View view;
  };
  /** Which sides of the simplex meet the cell that is looked at, and whether the simplex does. */
  struct Met {
    bool simplex = false, sides[D] = {};
  };

  void insert(Cell c, uint32_t simplex);
  uint32_t read_corners(Cell c, const BladeSimplex<D>& blade);
  void look_at(uint32_t meeting);
  Met meet(Cell c, uint32_t simplex, const BladeSimplex<D>& blade);
  bool meet_boundary(const uint16_t* local, uint32_t simplex, const BladeSimplex<D>& blade,
                     const double* const (&at)[D], Met& met);
  bool are_apart(const uint16_t* local) const;
  uint32_t outside(uint32_t a, uint32_t b, const BladeSimplex<D>& blade);
  bool holds(Cell c, uint32_t number);
  void note_crossings(Cell c, uint32_t simplex, const BladeSimplex<D>& blade);

  static constexpr size_t kMostKept = 64;  // corners
  static constexpr uint8_t kUnasked = 0xff;
  static constexpr uint32_t kBefore = 1u << 2 * D, kBehind = 2 * kBefore;  // above the bits of a box

  const Environment<D>& env_;
  const Map<D>& map_;
  const Blade<D>& blade_;
  Array<MetCell> cells_{env_.memory};
  KeyTable cell_numbers_{env_.memory};  // by unit
  KeyTable meetings_{env_.memory};      // number of the cell and simplex
  uint32_t looked_at_ = 0;              // of them
  Array<uint32_t> next_{env_.memory};   // the meeting of the same cell before
  Array<Crossing> crossings_{env_.memory};
  KeyTable edges_{env_.memory};
  Array<BladePoint<D>> points_{env_.memory};
  Array<Cell> holders_;  // of the blade's points: a cell that contains it, if one was found
  Array<Corner> corners_{env_.memory};
  Array<uint8_t> sides_{env_.memory};        // of corners: bits of the simplex's box, kBefore, kBehind; see are_apart()
  double lower_[D], upper_[D];               // box of the cell that is looked at
  double bound_ = 0;                         // see BladeSimplex
  Array<uint8_t> outside_{env_.memory};      // by both corners of an edge: see outside(); empty: too many corners
  Array<Cell> beyond_{env_.memory};          // behind the facets that the simplex passes
  Array<BladePoint<D>> found_{env_.memory};  // points of the simplex in the cell that is looked at
};

}  // namespace dsw
