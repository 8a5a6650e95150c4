#pragma once
// The triangles of the facets of cells that are to be split.

#include "base/key_table.h"
#include "base/search.h"
#include "split/parts.h"

namespace dsw {

class FacetCuts {
 public:
  /** Cuts the facets of `cells`, which are ordered by their records. A facet of another cell keeps its triangles; so does one whose
   * triangles are all turned alike, seen along the axis along which it is largest. Else its ears are cut off, seen along an
   * axis along which that is possible. Throws std::bad_alloc. */
  FacetCuts(const Environment<3>& env, const Array<Cell>& cells);

  static constexpr uint32_t kNone = KeyTable::kNone;
  /** The number of a facet, by either of its sides. */
  uint32_t find(HalfFacet h) const { return numbers_.find(canonical(env_.map, h).word); }
  /** Whether the loop of a facet does not meet itself. */
  bool is_sound(uint32_t i) const { return is_sound_[i] != 0; }
  /** Calls visit(triangle) as seen from the cell of `h`, whose number is i. */
  template <class Visit>
  void for_each_triangle(uint32_t i, HalfFacet h, const Visit& visit) const {
    const bool is_turned = canonical(env_.map, h) != h;
    for (uint32_t t = first_[i]; t < first_[i + 1]; ++t) visit(is_turned ? turned(triangles_[t]) : triangles_[t]);
  }
  /** Cuts facets of a cell in another way, each `attempt` otherwise: into fans, if they are turned alike and positive seen
   * from a cell that stays. Not those that are kept. Throws std::bad_alloc. */
  void vary(Cell c, uint32_t attempt);
  /** The triangles of the facets of a cell stay. */
  void keep(Cell c);
  /** Its triangles take its place. */
  void break_up(uint32_t i) { is_broken_[i] = 1; }
  bool is_broken(uint32_t i) const { return is_broken_[i] != 0; }
  bool any_broken() const { return dsw::find(is_broken_.begin(), is_broken_.end(), 1) != is_broken_.end(); }

 private:
  void add(HalfFacet h);
  bool is_split(HalfFacet side) const;
  bool cut(HalfFacet h, const Array<uint32_t>& loop, PartHull<3>& out) const;
  bool is_good(HalfFacet h, const Array<uint32_t>& loop, const PartHull<3>& triangles) const;

  const Environment<3>& env_;
  const Array<Cell>& cells_;
  KeyTable numbers_;
  Array<uint32_t> first_;
  PartHull<3> triangles_;
  Array<uint8_t> is_sound_, is_broken_, is_kept_;
};

}  // namespace dsw
