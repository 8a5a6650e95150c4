#pragma once
// The cells a flood has met, each once, in the order of discovery. Keeps its memory from flood to flood.

#include <algorithm>

#include "base/memory.h"
#include "map/map.h"

namespace dsw {

class CellQueue {
 public:
  explicit CellQueue(const Memory* memory) : cells_(memory), slots_(kFirstSlots, kNoCell, memory) {}

  size_t size() const { return cells_.size(); }
  Cell operator[](size_t i) const { return cells_[i]; }
  bool contains(Cell c) const { return slots_[slot_of(c)] == c.unit; }

  void insert(Cell c) {
    insert_if(c, [] { return true; });
  }
  /** Inserts a cell if admits() says so, which is asked only if the cell is not there. Returns whether it is there afterwards. */
  template <class Admits>
  bool insert_if(Cell c, Admits admits) {
    const size_t slot = slot_of(c);
    if (slots_[slot] == c.unit) return true;
    if (!admits()) return false;
    cells_.push_back(c);
    slots_[slot] = c.unit;
    if (2 * cells_.size() >= slots_.size()) grow();
    return true;
  }

  /** A small flood takes its cells out one by one, the last in first, so that no chain breaks: a table that a large one has made is
   * not swept. */
  void clear() {
    if (slots_.size() <= kFewSlots * cells_.size()) {
      std::fill(slots_.begin(), slots_.end(), kNoCell);
      cells_.clear();
    }
    for (; !cells_.empty(); cells_.pop_back()) slots_[slot_of(cells_.back())] = kNoCell;
  }

 private:
  static constexpr size_t kFirstSlots = 64;
  static constexpr size_t kFewSlots = 16;  // for a cell, to be filled at once

  size_t slot_of(Cell c) const {
    size_t slot = (c.unit * 0x9e3779b1u) & (slots_.size() - 1);
    while (slots_[slot] != kNoCell && slots_[slot] != c.unit) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kNoCell);
    for (const Cell each : cells_) slots_[slot_of(each)] = each.unit;
  }

  Array<Cell> cells_;
  Array<uint32_t> slots_;  // their units by hash, linear probing; kNoCell is empty
};

/** The three facets at each vertex of a tetrahedron or a hexahedron. */
template <int kVertices>
struct FacetsAt {
  uint8_t of[kVertices][3] = {};
  template <int kFacets, int kCorners>
  constexpr explicit FacetsAt(const uint8_t (&facets)[kFacets][kCorners]) {
    uint32_t count[kVertices] = {};
    for (int f = 0; f < kFacets; ++f) {
      for (const uint8_t vertex : facets[f]) of[vertex][count[vertex]++] = static_cast<uint8_t>(f);
    }
  }
};
inline constexpr FacetsAt<4> kTetrahedronFacetsAt{kTetrahedronFacets};
inline constexpr FacetsAt<8> kBoxFacetsAt{kBoxFacets};

/** Calls visit(half-facet, its number) for the facets of a cell at one of its vertices. */
template <int D, class Visit>
void for_each_facet_at_vertex(const Map<D>& map, Cell c, uint32_t vertex, Visit visit) {
  if constexpr (D == 3) {
    const uint32_t* const w = map.record(c);
    const Form form = form_of(w[0]);
    const uint32_t end = (c.unit + 1) * kUnitWords<D>;
    if (form == Form::kBox) {
      uint32_t local = 0;
      while (w[kUnitWords<D> + local] != vertex) ++local;
      for (const uint32_t f : kBoxFacetsAt.of[local]) visit(HalfFacet{end - 6 + f}, f);
      return;
    }
    if (form == Form::kSimplex) {
      uint32_t local = 0;
      while ((w[local] & kVertexMask) != vertex) ++local;
      for (const uint32_t f : kTetrahedronFacetsAt.of[local]) visit(HalfFacet{end - 4 + f}, f);
      return;
    }
  }
  const Shape shape = map.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    for_each_facet_vertex<D>(shape, f, [&](uint32_t local) {
      if (map.vertex(c, local) == vertex) visit(map.half_facet(c, f), f);
    });
  }
}

/** Adds to `around` the cells that can be reached from those in it through facets at a vertex, passable or not;
 * visit(cell) is called for all. At a pinched boundary there can be others. Returns whether all of the cells and of these
 * facets are passable. Throws std::bad_alloc. */
template <int D, class Visit>
bool for_each_cell_at_vertex(const Map<D>& map, uint32_t vertex, CellQueue& around, Visit visit) {
  bool passable = true;
  for (size_t i = 0; i < around.size(); ++i) {
    const Cell at = around[i];
    visit(at);
    passable = passable && !map.marked(at);
    for_each_facet_at_vertex(map, at, vertex, [&](HalfFacet h, uint32_t) {
      const HalfFacet o = map.opposite(h);
      passable = passable && o.valid() && !map.facet_marked(h);
      if (o.valid()) around.insert(map.cell_of(o));
    });
  }
  return passable;
}

}  // namespace dsw
