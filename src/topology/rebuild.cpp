#include "topology/rebuild.h"

#include <algorithm>

#include "base/error.h"
#include "environment/validity.h"
#include "map/integrity.h"
#include "map/records.h"

namespace dsw {
namespace {

/** Shapes of polyhedra, each once. */
class SharedShapes {
 public:
  explicit SharedShapes(Map<3>& map) : map_(map), slots_(kFirstSlots, kNoCell, map.words.get_allocator()) {}

  uint32_t number_of(const Polyhedron& p) {
    uint32_t at = slot_of(p);
    while (slots_[at] != kNoCell && !is_like(slots_[at], p)) at = (at + 1) & mask();
    if (slots_[at] != kNoCell) return slots_[at];
    const uint32_t number = add(p);
    slots_[at] = number;
    if (2 * ++used_ > slots_.size()) grow();
    return number;
  }

 private:
  static constexpr size_t kFirstSlots = 256;

  uint32_t mask() const { return static_cast<uint32_t>(slots_.size() - 1); }
  template <class Corner>
  uint32_t hash(uint32_t corner_count, Corner corner) const {
    uint32_t value = 2166136261u;
    for (uint32_t i = 0; i < corner_count; ++i) value = (value ^ corner(i)) * 16777619u;
    return (value ^ value >> 15) & mask();
  }
  uint32_t slot_of(const Polyhedron& p) const {
    return hash(3 * p.facet_count, [&](uint32_t i) { return uint32_t{p.triangles[i]}; });
  }
  Shape shape(uint32_t number) const { return Shape(map_.shape_tables.data() + map_.shape_offsets[number]); }
  bool is_like(uint32_t number, const Polyhedron& p) const {
    const Shape s = shape(number);
    return s.facet_count() == p.facet_count &&
           std::equal(p.triangles, p.triangles + 3 * p.facet_count, s.dart_vertices());
  }
  uint32_t add(const Polyhedron& p) {
    uint16_t corners[3 * kMostFacets], first[kMostFacets + 1];
    std::copy_n(p.triangles, 3 * p.facet_count, corners);
    for (uint32_t f = 0; f <= p.facet_count; ++f) first[f] = static_cast<uint16_t>(3 * f);
    map_.shape_offsets.push_back(static_cast<uint32_t>(map_.shape_tables.size()));
    const ShapeDefect defect =
        append_polyhedron({corners, first, p.facet_count, p.vertex_count}, nullptr, map_.shape_tables);
    DSW_ASSERT(defect == ShapeDefect::kNone);
    static_cast<void>(defect);
    return static_cast<uint32_t>(map_.shape_offsets.size() - 1);
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kNoCell);
    for (uint32_t number = 0; number < map_.shape_offsets.size(); ++number) {
      const Shape s = shape(number);
      uint32_t at = hash(s.dart_count(), [&](uint32_t i) { return s.dart_vertex(i); });
      while (slots_[at] != kNoCell) at = (at + 1) & mask();
      slots_[at] = number;
    }
  }

  Map<3>& map_;
  Array<uint32_t> slots_;  // open addressing; kNoCell: empty
  size_t used_ = 0;
};

class Rebuild {
 public:
  Rebuild(const Environment<3>& source, Merging& merging, Environment<3>& target, Array<uint32_t>& new_index)
      : source_(source),
        target_(target),
        from_(source.map),
        map_(target.map),
        merging_(merging),
        new_index_(new_index),
        roots_(source.memory),
        new_word_(source.map.words.size(), kNoFacet, roots_.get_allocator()) {}

  void run() {
    copy_points();
    number_cells();
    lay_out();
    SharedShapes merged_shapes(map_);
    // Shapes of merged cells come first: the tables of cells that are kept are not looked at when one is searched.
    for (uint32_t i = 0; i < roots_.size(); ++i) {
      if (const Polyhedron* const p = merging_.polyhedron(roots_[i]))
        write(map_.cell(i), *p, merged_shapes.number_of(*p));
    }
    for (uint32_t i = 0; i < roots_.size(); ++i) {
      if (merging_.polyhedron(roots_[i]) == nullptr) copy(map_.cell(i), from_.cell(roots_[i]));
    }
    link();
    copy_labels();
    for_each_cell(map_, [&](Cell c) {
      if (map_.form(c) == Form::kGeneral && check_cell(target_, c) == CellState::kValidConvex) {
        map_.record(c)[0] |= kConvexBit;
      }
    });
  }

 private:
  void copy_points() {
    map_.vertex_count = from_.vertex_count;
    target_.owned_points.assign(source_.points, source_.points + size_t{from_.vertex_count} * 3);
    target_.points = target_.owned_points.data();
  }

  /** Unions in the order of the cells with the lowest index. */
  void number_cells() {
    new_index_.assign(from_.index_count(), kNoCell);
    for_each_cell(from_, [&](Cell c) {
      const uint32_t i = from_.index(c), root = merging_.root(i);
      if (root == i) {
        new_index_[i] = static_cast<uint32_t>(roots_.size());
        roots_.push_back(i);
      } else {
        new_index_[i] = new_index_[root];
      }
    });
    map_.cell_count = static_cast<uint32_t>(roots_.size());
  }

  uint32_t units_of(uint32_t root) const {
    const Polyhedron* const p = merging_.polyhedron(root);
    if (p == nullptr) return record_units(from_, from_.record(from_.cell(root))[0]);
    return general_units<3>(p->facet_count, p->vertex_count);
  }
  bool is_general(uint32_t root) const {
    return merging_.polyhedron(root) != nullptr || from_.form(from_.cell(root)) == Form::kGeneral;
  }

  /** Gives each cell its units as creation does: the tables between cells and units exist only if records may differ. */
  void lay_out() {
    const uint32_t first_units = units_of(roots_[0]);
    uint64_t units = 0;
    bool uniform = true;
    for (const uint32_t root : roots_) {
      uniform = uniform && units_of(root) == first_units && !is_general(root);
      units += units_of(root);
    }
    if (units >= kMostUnits) fail(DSW_STATUS_TOO_LARGE, "the merged cells need more than 2^28 records");
    const auto unit_count = static_cast<size_t>(units);
    map_.words.assign(unit_count * kUnitWords<3>, 0);
    map_.units_per_cell = uniform ? first_units : 0;
    if (uniform) return;
    map_.unit_of_cell.reserve(roots_.size());
    map_.cell_of_unit.assign(unit_count, kNoCell);
    uint32_t unit = 0;
    for (const uint32_t root : roots_) {
      map_.cell_of_unit[unit] = static_cast<uint32_t>(map_.unit_of_cell.size());
      map_.unit_of_cell.push_back(unit);
      unit += units_of(root);
    }
  }

  void write(Cell c, const Polyhedron& p, uint32_t shape) {
    uint32_t* const w = map_.record(c);
    w[0] = static_cast<uint32_t>(Form::kGeneral) << kFormShift | shape;
    write_continuations<3>(w, general_units<3>(p.facet_count, p.vertex_count));
    for (uint32_t k = 0; k < p.vertex_count; ++k)
      w[item_word<3>(first_vertex_item<3>(p.facet_count) + k)] = p.vertices[k];
    for (uint32_t f = 0; f < p.facet_count; ++f) new_word_[p.facets[f]] = map_.half_facet(c, f).word;
  }

  void copy(Cell c, Cell old) {
    const uint32_t* const w = from_.record(old);
    std::copy_n(w, size_t{record_units(from_, w[0])} * kUnitWords<3>, map_.record(c));
    if (form_of(w[0]) == Form::kGeneral) {
      const uint16_t* const table = from_.shape(old).table();
      const auto number = static_cast<uint32_t>(map_.shape_offsets.size());
      map_.shape_offsets.push_back(static_cast<uint32_t>(map_.shape_tables.size()));
      map_.shape_tables.insert(map_.shape_tables.end(), table, table + shape_length(from_, w[0] & kShapeMask));
      map_.record(c)[0] = (w[0] & ~(kShapeMask | kConvexBit)) | number;
    }
    for (uint32_t f = 0, count = from_.facets_of(old); f < count; ++f) {
      new_word_[from_.half_facet(old, f).word] = map_.half_facet(c, f).word;
    }
  }

  void link() {
    uint32_t half_facets = 0;
    for (uint32_t word = 0; word < new_word_.size(); ++word) {
      if (new_word_[word] == kNoFacet) continue;
      const HalfFacet o = from_.opposite({word});
      map_.words[new_word_[word]] = (from_.words[word] & kMarkBit) | (o.valid() ? new_word_[o.word] : kNoFacet);
      ++half_facets;
      map_.boundary_facet_count += o.valid() ? 0 : 1;
    }
    map_.facet_count = (half_facets + map_.boundary_facet_count) / 2;
  }

  void copy_labels() {
    for (const uint32_t root : roots_) {
      if (!source_.regions.empty()) target_.regions.push_back(source_.regions[root]);
      if (!source_.parents.empty()) target_.parents.push_back(source_.parents[root]);
      if (!source_.tags.empty()) target_.tags.push_back(source_.tags[root]);
    }
    Array<uint64_t> edges(source_.memory);
    source_.edge_marks.copy_sorted(edges);
    target_.edge_marks.reserve(edges.size());
    for (const uint64_t key : edges) {
      target_.edge_marks.insert(static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key));
    }
    target_.vertex_marks.assign(source_.vertex_marks.begin(), source_.vertex_marks.end());
    copy_exits();
    target_.marked_cells = source_.marked_cells;
    target_.marked_facets = source_.marked_facets;
    target_.marked_edges = source_.marked_edges;
    target_.marked_vertices = source_.marked_vertices;
  }

  void copy_exits() {
    Array<Exit> exits(source_.memory);
    for (const Exit& exit : source_.exits.all()) {
      const HalfFacet h{new_word_[from_.half_facet(from_.cell(exit.cell), exit.local).word]};
      const Cell c = map_.cell_of(h);
      exits.push_back({map_.index(c), map_.local_of(h, c), exit.patch});
    }
    target_.exits.reserve(exits.size());
    target_.exits.set(exits.data(), exits.size());
  }

  const Environment<3>& source_;
  Environment<3>& target_;
  const Map<3>& from_;
  Map<3>& map_;
  Merging& merging_;
  Array<uint32_t>& new_index_;
  Array<uint32_t> roots_;     // by new index
  Array<uint32_t> new_word_;  // half-facet of the source -> of the target
};

}  // namespace

void rebuild(const Environment<3>& source, Merging& merging, Environment<3>& target, Array<uint32_t>& new_index) {
  Rebuild(source, merging, target, new_index).run();
}

}  // namespace dsw
