#pragma once
// The parts of the cells of one mesh.

#include "environment/outer_facets.h"
#include "split/facet_cuts.h"

namespace dsw {

/** Why a cell can't be split. */
enum class SplitDefect { kNone, kInsideOut, kBadFacet, kMeetsItself, kTooLarge, kNeedsPoint, kNotFilled };
const char* text_of(SplitDefect defect);

template <int D>
class CellParts;

/** Polygons. */
template <>
class CellParts<2> {
 public:
  CellParts(const Environment<2>& env, const Array<Cell>& cells, bool)
      : env_(env), at_(env), parts_(cells.size(), Array<PartHull<2>>(env.memory), env.memory) {}

  /** Splits a cell, which is number `cell` of them. */
  SplitDefect split(size_t cell, Cell c);
  uint32_t count(size_t cell) const { return static_cast<uint32_t>(parts_[cell].size()); }
  /** Appends the corners of part `part` of cell number `cell`. */
  void append(size_t cell, Cell c, uint32_t part, Loops& out) const;
  bool changes_others() const { return false; }
  bool append_other(Cell, Loops&) const { return false; }
  const PartPoints<2>& places() const { return at_; }

 private:
  const Environment<2>& env_;
  PartPoints<2> at_;
  Array<Array<PartHull<2>>> parts_;
};

/** Polyhedra. */
template <>
class CellParts<3> {
 public:
  /** `may_add`: there may be new points. */
  CellParts(const Environment<3>& env, const Array<Cell>& cells, bool may_add)
      : env_(env),
        may_add_(may_add),
        at_(env),
        cuts_(env, cells),
        parts_(cells.size(), Array<PartHull<3>>(env.memory), env.memory) {}

  SplitDefect split(size_t cell, Cell c);
  uint32_t count(size_t cell) const { return static_cast<uint32_t>(parts_[cell].size()); }
  /** Appends the facets of a part, once all cells are split. */
  void append(size_t cell, Cell c, uint32_t part, Loops& out) const;
  /** Whether cells that are not split have facets that are. */
  bool changes_others() const { return cuts_.any_broken(); }
  /** Appends the facets of such a cell; false, and nothing is appended: it has none. */
  bool append_other(Cell c, Loops& out) const;
  const PartPoints<3>& places() const { return at_; }

 private:
  SplitDefect fill(Cell c, Array<PartHull<3>>& parts);
  bool fill_between_points(const PartHull<3>& surface, Array<PartHull<3>>& parts);
  bool fill_round_points(const PartHull<3>& surface, Array<PartHull<3>>& parts);
  PartHull<3> surface_of(Cell c) const;
  void break_facets(Cell c, const Array<PartHull<3>>& parts);

  const Environment<3>& env_;
  bool may_add_;
  PartPoints<3> at_;
  FacetCuts cuts_;
  Array<Array<PartHull<3>>> parts_;
};

}  // namespace dsw
