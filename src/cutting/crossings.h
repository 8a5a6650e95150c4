#pragma once
// What a blade meets, exact under the shift of predicates/: the blade is a body's surface that stands still. A flood goes from
// cell to cell and from triangle to triangle of the blade, through passable and impassable cells alike.

#include "base/key_table.h"
#include "cutting/blade.h"
#include "environment/environment.h"

namespace dsw {

/** Where the blade crosses an edge of the environment, at first: `a` is behind the blade, `b` before it. */
struct Crossing {
  uint32_t a, b;
  double share;  // of the way from a to b
  uint32_t triangle;
  bool once;  // no other triangle of the blade crosses this edge
};

/** A cell that the blade meets. */
struct MetCell {
  Cell cell;
  uint32_t last_triangle;  // the last one of those that meet it, see next_triangle
  bool holds_rim;          // the blade ends inside
  bool invalid;            // of moving points; nobody goes on from here
};

/** A point of the blade in a cell: a vertex, or where a side of a triangle leaves the cell. */
struct BladePoint {
  uint32_t cell;  // number of the met cell
  double at[3];
};

class Crossings {
 public:
  Crossings(const Environment<3>& env, const Blade& blade);

  /** Floods from a cell, if the blade meets it. Throws std::bad_alloc. O(pairs of cells and triangles that meet). */
  void flood(Cell start);
  /** Whether a triangle meets a cell; the flood will go on from there. */
  bool seed(Cell c, uint32_t triangle);
  /** Floods from what was seeded. */
  void run();
  /** Whether a cell is met by any triangle. O(triangles). */
  bool is_met(Cell c);

  uint32_t cell_count() const { return static_cast<uint32_t>(cells_.size()); }
  const MetCell& cell(uint32_t i) const { return cells_[i]; }
  /** Number of a met cell, or KeyTable::kNone. */
  uint32_t number(Cell c) const { return cell_numbers_.find(c.unit); }

  uint32_t count() const { return static_cast<uint32_t>(crossings_.size()); }
  const Crossing& operator[](uint32_t i) const { return crossings_[i]; }
  /** Number of the crossing of an edge, or KeyTable::kNone. */
  uint32_t find(uint32_t a, uint32_t b) const { return edges_.find(pair_key(a, b)); }

  const Array<BladePoint>& points() const { return points_; }

  /** Calls visit(triangle) for those that meet a cell. */
  template <class Visit>
  void for_each_triangle(uint32_t cell, Visit visit) const {
    for (uint32_t i = cells_[cell].last_triangle; i != KeyTable::kNone; i = next_[i]) {
      visit(static_cast<uint32_t>(meetings_[i]));
    }
  }

 private:
  /** A vertex of the cell that is looked at. */
  struct Corner {
    const double* at;
    uint32_t vertex, beyond;  // sides of the triangle's box
    int side;
  };
  /** Which sides of the triangle meet the cell that is looked at, and whether the triangle does. */
  struct Met {
    bool triangle = false, sides[3] = {};
  };

  void insert(Cell c, uint32_t triangle);
  void read_corners(Cell c, const SweptTriangle& triangle);
  void look_at(uint32_t meeting);
  Met meet(Cell c, uint32_t triangle, const SweptTriangle& swept);
  bool meet_simplex(const uint16_t* local, const SweptTriangle& swept, const double* const* at, Met& met);
  int side(Corner& corner, const SweptTriangle& swept) const;
  bool holds(Cell c, const double* point) const;
  void note_crossings(Cell c, uint32_t triangle, const SweptTriangle& swept);

  const Environment<3>& env_;
  const Map<3>& map_;
  const Blade& blade_;
  Array<MetCell> cells_;
  KeyTable cell_numbers_;   // by unit
  KeyTable meetings_;       // number of the cell and triangle
  uint32_t looked_at_ = 0;  // of them
  Array<uint32_t> next_;    // the meeting of the same cell before
  Array<Crossing> crossings_;
  KeyTable edges_;
  Array<BladePoint> points_;
  Array<Corner> corners_;
  Array<Cell> beyond_;       // behind the facets that the triangle passes
  Array<BladePoint> found_;  // points of the triangle in the cell that is looked at
};

}  // namespace dsw
