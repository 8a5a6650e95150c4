#pragma once
// The combinatorial map: cells as records in one array of 32-bit words, linked facet to facet.
//
// Records are made of units of 2 (D + 1) words and start on one: a simplex fills a unit. Word 0 of every unit that can
// be pointed at tells what it is: bit 31 the cell's own impassable mark, bits 28 to 30 its Form; of the rest a simplex
// keeps the index of its vertex 0, any other form bit 27 "convex with flat facets" and in bits 0 to 26 its cuts or its
// shape number.
//   simplex            1 unit:  w0..wD vertices, then as many links of facets
//   pyramid .. box     2 units: links at the end of the first, vertices from the second on
//   general            links, then vertices, in all words but word 0 of its units, vertices in space from a new unit
//                      on; word 0 of every unit but the first is a continuation that counts back to the first
//   free               units that a cell has left: their number in bits 0 to 26, in w1 the next free one of that size
// A facet of a cell (a "half-facet") is named by the address of its link word, so a link needs no decoding: it is the
// address of the half-facet on the other side, with bit 31 for the facet's own mark. kNoFacet: the outer boundary.
// Nothing else is stored: beta1 and beta2 come from the shape, beta3 from the link.

#include <cstdint>

#include "base/assert.h"
#include "base/memory.h"
#include "base/slot_pool.h"
#include "map/shape.h"

namespace dsw {

constexpr uint32_t kMarkBit = 0x80000000u;
constexpr uint32_t kNoFacet = 0x7fffffffu;
constexpr uint64_t kMostUnits = uint64_t{1} << 28;
constexpr uint32_t kVertexMask = 0x0fffffffu;
constexpr uint32_t kConvexBit = 0x08000000u;
constexpr uint32_t kShapeMask = 0x07ffffffu;
constexpr uint32_t kFormShift = 28;
constexpr uint32_t kNoCell = 0xffffffffu;

/** 32 bytes in space, 24 in the plane. */
template <int D>
constexpr uint32_t kUnitWords = 2 * (D + 1);
/** How many links or vertices of a general cell are in a unit; below, how many units they take and which word one
 * has. */
template <int D>
constexpr uint32_t kUnitItems = kUnitWords<D> - 1;
template <int D>
constexpr uint32_t units_for(uint32_t items) {
  return (items + kUnitItems<D> - 1) / kUnitItems<D>;
}
template <int D>
constexpr uint32_t item_word(uint32_t item) {
  return item / kUnitItems<D> * kUnitWords<D> + 1 + item % kUnitItems<D>;
}
/** Which of them is its first vertex. In space that begins a unit; polygons, which have few, would waste room so. */
template <int D>
constexpr uint32_t first_vertex_item(uint32_t facets) {
  return D == 3 ? units_for<D>(facets) * kUnitItems<D> : facets;
}
template <int D>
constexpr uint32_t general_units(uint32_t facets, uint32_t vertices) {
  return units_for<D>(first_vertex_item<D>(facets) + vertices);
}
/** Writes word 0 of all units of a general record but the first. */
template <int D>
void write_continuations(uint32_t* record, uint32_t units) {
  for (uint32_t u = 1; u < units; ++u) {
    record[u * kUnitWords<D>] = static_cast<uint32_t>(Form::kContinuation) << kFormShift | u;
  }
}

/** A cell of full dimension: the unit its record starts at. */
struct Cell {
  uint32_t unit = kNoCell;
  bool operator==(Cell o) const { return unit == o.unit; }
  bool operator!=(Cell o) const { return unit != o.unit; }
  bool valid() const { return unit != kNoCell; }
};

/** A facet seen from one of its cells: the address of its link word. */
struct HalfFacet {
  uint32_t word = kNoFacet;
  bool operator==(HalfFacet o) const { return word == o.word; }
  bool operator!=(HalfFacet o) const { return word != o.word; }
  bool valid() const { return word != kNoFacet; }
};

/** A dart: its cell and its number in the cell's shape. */
struct Dart {
  Cell cell;
  uint32_t local = 0;
  bool operator==(Dart o) const { return cell == o.cell && local == o.local; }
};

constexpr Form form_of(uint32_t word0) { return static_cast<Form>((word0 >> kFormShift) & 7u); }

template <int D>
struct Map {
  Array<uint32_t> words;          // all records
  Array<uint16_t> shape_tables;   // tables of general cells
  Array<uint32_t> shape_offsets;  // shape number -> start in shape_tables
  Array<uint32_t> unit_of_cell;   // public index -> unit, kNoCell: no cell; empty when all records have the same size
  Array<uint32_t> cell_of_unit;   // the way back; empty likewise
  SlotPool cell_slots;            // generations by public index; empty before the first change, see records.h
  SlotPool vertex_slots;          // likewise by vertex
  Array<uint32_t> vertex_uses;    // how many cells have a vertex; empty likewise
  Array<uint32_t> free_records;   // by size in units: the first free record, or kNoCell
  Array<uint32_t> free_shapes;  // by length: the first free table's number, or kNoCell; in the plane that of all cells
  uint32_t cell_count = 0;
  uint32_t units_per_cell = 0;  // 1 or 2, when there are no such tables
  uint32_t vertex_count = 0;
  uint32_t boundary_facet_count = 0;
  uint32_t facet_count = 0;          // a facet between two cells counts once
  uint32_t convex_bit = kConvexBit;  // 0 once points have moved: then records say of simplices alone that they are
                                     // convex

  bool is_as_created = true;  // tables for changes were made by calls that failed alone: a snapshot leaves them out

  bool has_asked_for_tables = false;  // the call that is under way

  /** A call begins. */
  void begin_call() noexcept { has_asked_for_tables = false; }
  /** A call has succeeded: tables that it made, or would have made, stay. */
  void keep_tables() noexcept { is_as_created = is_as_created && !has_asked_for_tables; }

  explicit Map(const Memory* memory)
      : words(memory),
        shape_tables(memory),
        shape_offsets(memory),
        unit_of_cell(memory),
        cell_of_unit(memory),
        cell_slots(memory),
        vertex_slots(memory),
        vertex_uses(memory),
        free_records(memory),
        free_shapes(memory) {}

  /** Whether cells have changed, or are about to: only then are there indices without a cell. */
  bool has_changed() const { return cell_slots.slot_count() != 0; }
  /** Public indices are below. */
  uint32_t index_count() const { return has_changed() ? static_cast<uint32_t>(cell_slots.slot_count()) : cell_count; }
  uint32_t generation(Cell c) const { return has_changed() ? cell_slots.generation(index(c)) : 1u; }
  bool is_alive(uint32_t index, uint32_t generation) const {
    return has_changed() ? cell_slots.alive(index, generation) : generation == 1 && index < cell_count;
  }
  uint32_t vertex_generation(uint32_t vertex) const { return has_changed() ? vertex_slots.generation(vertex) : 1u; }
  bool is_vertex_alive(uint32_t vertex, uint32_t generation) const {
    return has_changed() ? vertex_slots.alive(vertex, generation) : generation == 1 && vertex < vertex_count;
  }

  /** Invalid where an index has no cell. */
  Cell cell(uint32_t index) const { return {unit_of_cell.empty() ? index * units_per_cell : unit_of_cell[index]}; }
  uint32_t index(Cell c) const { return cell_of_unit.empty() ? c.unit >> (units_per_cell - 1) : cell_of_unit[c.unit]; }

  const uint32_t* record(Cell c) const { return words.data() + size_t{c.unit} * kUnitWords<D>; }
  uint32_t* record(Cell c) { return words.data() + size_t{c.unit} * kUnitWords<D>; }
  Form form(Cell c) const { return form_of(record(c)[0]); }
  bool marked(Cell c) const { return (record(c)[0] & kMarkBit) != 0; }
  /** Exactly convex with exactly flat facets: simplices always, others by a bit set when they were validated, until
   * points move. */
  bool convex(Cell c) const { return form(c) == Form::kSimplex || (record(c)[0] & convex_bit) != 0; }
  /** The form of a cell and its convex bit, which a simplex has not. */
  uint32_t kind_bits(Cell c) const { return (record(c)[0] & (7u << kFormShift | convex_bit)) >> (kFormShift - 1); }
  Shape shape(Cell c) const;
  /** Gives the shape of a cell of general form, by word 0 of its record. */
  Shape general_shape(uint32_t word0) const { return Shape(shape_tables.data() + shape_offsets[word0 & kShapeMask]); }

  /** Facets of the standard forms; general cells have as many as their shape says. */
  static constexpr uint32_t standard_facet_count(Form form) {
    if (D == 2) return form == Form::kSimplex ? 3u : 4u;
    return form == Form::kSimplex ? 4u : form == Form::kBox ? 6u : 5u;
  }
  static constexpr uint32_t standard_vertex_count(Form form) {
    if (D == 2) return form == Form::kSimplex ? 3u : 4u;
    return form == Form::kSimplex ? 4u : form == Form::kPyramid ? 5u : form == Form::kPrism ? 6u : 8u;
  }
  uint32_t facets_of(Cell c) const {
    const Form f = form(c);
    return f == Form::kGeneral ? shape(c).facet_count() : standard_facet_count(f);
  }

  uint32_t vertices_of(Cell c) const {
    const Form f = form(c);
    return f == Form::kGeneral ? shape(c).vertex_count() : standard_vertex_count(f);
  }

  HalfFacet half_facet(Cell c, uint32_t local) const {
    const Form f = form(c);
    if (f == Form::kGeneral) return {c.unit * kUnitWords<D> + item_word<D>(local)};
    return {c.unit * kUnitWords<D> + kUnitWords<D> - standard_facet_count(f) + local};
  }
  Cell cell_of(HalfFacet h) const {
    const uint32_t unit = h.word / kUnitWords<D>, word0 = words[size_t{unit} * kUnitWords<D>];
    return {form_of(word0) == Form::kContinuation ? unit - (word0 & kShapeMask) : unit};
  }
  uint32_t local_of(HalfFacet h, Cell c) const {
    const Form f = form(c);
    const uint32_t slot = h.word % kUnitWords<D>;
    if (f == Form::kGeneral) return (h.word / kUnitWords<D> - c.unit) * kUnitItems<D> + slot - 1u;
    return slot - (kUnitWords<D> - standard_facet_count(f));
  }
  /** beta_D as a facet: the same facet seen from the other cell; invalid at the outer boundary. */
  HalfFacet opposite(HalfFacet h) const { return {words[h.word] & ~kMarkBit}; }
  bool facet_marked(HalfFacet h) const { return (words[h.word] & kMarkBit) != 0; }

  uint32_t vertex(Cell c, uint32_t local) const {
    const uint32_t* w = record(c);
    const Form f = form_of(w[0]);
    if (f == Form::kSimplex) return w[local] & kVertexMask;
    if (f != Form::kGeneral) return w[kUnitWords<D> + local];
    return w[item_word<D>(first_vertex_item<D>(shape(c).facet_count()) + local)];
  }
  /** Calls visit(vertex) for those of a cell, in their order. */
  template <class Visit>
  void for_each_vertex(Cell c, Visit visit) const {
    const uint32_t* w = record(c);
    const Form f = form_of(w[0]);
    if (f == Form::kSimplex) {
      for (uint32_t k = 0; k <= D; ++k) visit(w[k] & kVertexMask);
    } else if (f != Form::kGeneral) {
      for (uint32_t k = 0; k < standard_vertex_count(f); ++k) visit(w[kUnitWords<D> + k]);
    } else {
      const Shape of = general_shape(w[0]);
      const uint32_t first = first_vertex_item<D>(of.facet_count());
      w += item_word<D>(first);
      uint32_t left = kUnitItems<D> - first % kUnitItems<D>;  // in the unit
      for (uint32_t k = of.vertex_count(); k != 0; --k, ++w, --left) {
        if (left == 0) {
          ++w;  // word 0 of a unit
          left = kUnitItems<D>;
        }
        visit(*w);
      }
    }
  }
  uint64_t memory_bytes() const {
    return array_bytes(words) + array_bytes(shape_tables) + array_bytes(shape_offsets) + array_bytes(unit_of_cell) +
           array_bytes(cell_of_unit) + cell_slots.memory_bytes() + vertex_slots.memory_bytes() +
           array_bytes(vertex_uses) + array_bytes(free_records) + array_bytes(free_shapes);
  }
};

/** Calls visit(cell) for all cells in the order of their public indices. */
template <int D, class Visit>
void for_each_cell(const Map<D>& map, Visit visit) {
  for (uint32_t i = 0, count = map.index_count(); i < count; ++i) {
    const Cell c = map.cell(i);
    if (c.valid()) visit(c);
  }
}

/** The lower of the two names of a facet: the one that every report gives. */
template <int D>
HalfFacet canonical(const Map<D>& map, HalfFacet h) {
  const HalfFacet o = map.opposite(h);
  return o.valid() && map.index(map.cell_of(o)) < map.index(map.cell_of(h)) ? o : h;
}

/** A facet is impassable by its own mark, by that of a cell on either side, or because there is no other side. */
template <int D>
bool is_impassable(const Map<D>& map, HalfFacet h) {
  const HalfFacet o = map.opposite(h);
  return !o.valid() || map.facet_marked(h) || map.marked(map.cell_of(h)) || map.marked(map.cell_of(o));
}

}  // namespace dsw
