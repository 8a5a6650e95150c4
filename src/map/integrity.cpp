// Checked in an order in which nothing is followed before it is known to be sound: shapes, then records and the tables
// that find them, then links.

#include "map/integrity.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/dimensions.h"
#include "base/search.h"
#include "base/sort.h"
#include "map/records.h"

namespace dsw {
namespace {

uint32_t side_key(uint32_t from, uint32_t to) { return from << 16 | to; }

/** Whether the triangles of facet f fill its loop: they have each of its darts for a side, and every other side twice,
 * once in either direction. As there are two less than vertices, that leaves no room for anything but a disc. */
bool fills_loop(const Shape& shape, uint32_t f, Array<uint32_t>& sides, Array<uint32_t>& darts) {
  sides.clear();
  darts.clear();
  for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
    const uint16_t* v = shape.simplices() + 3 * s;
    for (uint32_t k = 0; k < 3; ++k) sides.push_back(side_key(v[k], v[(k + 1) % 3]));
  }
  const uint32_t first = shape.facet_first(f), n = shape.facet_size(f);
  for (uint32_t k = 0; k < n; ++k) {
    darts.push_back(side_key(shape.dart_vertex(first + k), shape.dart_vertex(first + (k + 1) % n)));
  }
  dsw::sort(sides.begin(), sides.end());
  dsw::sort(darts.begin(), darts.end());
  if (std::adjacent_find(sides.begin(), sides.end()) != sides.end()) return false;
  if (!std::includes(sides.begin(), sides.end(), darts.begin(), darts.end())) return false;
  return dsw::all_of(sides.begin(), sides.end(), [&](uint32_t side) {
    const uint32_t turned = side_key(side & 0xffffu, side >> 16);
    if (std::binary_search(darts.begin(), darts.end(), side)) return true;
    return std::binary_search(sides.begin(), sides.end(), turned) &&
           !std::binary_search(darts.begin(), darts.end(), turned);
  });
}

/** Makes the table anew from the loops and triangles of one whose counts fit into what may be read. */
bool remake(const Shape& shape, Array<uint16_t>& out) {
  const uint32_t facets = shape.facet_count(), n = shape.dart_count(), vertices = shape.vertex_count();
  uint32_t end = 0;
  for (uint32_t f = 0; f <= facets; ++f) {
    const uint32_t first = shape.facet_first(f);
    if (f == 0 ? first != 0 : first < end + 3) return false;
    if (first > n || shape.simplex_first(f) != first - 2 * f) return false;
    end = first;
  }
  if (end != n || shape.simplex_count() != n - 2 * facets) return false;
  const FacetLoops loops{shape.dart_vertices(), shape.table() + Shape::kHeader, facets, vertices};
  if (append_polyhedron(loops, nullptr, out) != ShapeDefect::kNone) return false;
  Array<uint32_t> sides(out.get_allocator()), darts(out.get_allocator());
  for (uint32_t f = 0; f < facets; ++f) {
    if (!fills_loop(shape, f, sides, darts)) return false;
    set_triangles(out.data(), f, shape.simplices() + 3 * shape.simplex_first(f));
  }
  return true;
}

template <int D>
bool shapes_sound(const Map<D>& map) {
  Array<uint16_t> scratch(map.shape_tables.get_allocator());
  size_t at = 0;
  for (size_t i = 0; i < map.shape_offsets.size(); ++i) {
    if (map.shape_offsets[i] != at || at >= map.shape_tables.size()) return false;
    const bool last = i + 1 == map.shape_offsets.size();
    const size_t end = last ? map.shape_tables.size() : map.shape_offsets[i + 1];
    if (end <= at || end > map.shape_tables.size()) return false;
    const bool is_free = D == 3 && map.has_changed() && map.shape_tables[at] == kFreeShape;
    if (is_free ? end - at < 3 : sound_table_length<D>(&map.shape_tables[at], end - at, scratch) != end - at)
      return false;
    at = end;
  }
  return at == map.shape_tables.size();
}

/** Links end at the first unit's last word in standard records. */
template <int D>
uint32_t first_link_slot(Form form) {
  return kUnitWords<D> - Map<D>::standard_facet_count(form);
}

/** Checks the record of one cell, whose units lie inside of the words. */
template <int D>
const char* check_record(const Map<D>& map, Cell c, uint32_t units) {
  const uint32_t* w = map.record(c);
  const Form form = form_of(w[0]);
  const uint32_t vertices = map.vertices_of(c);
  const auto all_zero = [&](uint32_t begin, uint32_t end) {
    return dsw::all_of(w + begin, w + end, [](uint32_t word) { return word == 0; });
  };
  bool clear = true;
  if (form == Form::kSimplex) {
    for (uint32_t k = 1; k <= static_cast<uint32_t>(D); ++k) clear = clear && w[k] <= kVertexMask;
    clear = clear && all_zero(D + 1, first_link_slot<D>(form));
  } else if (form == Form::kGeneral) {
    for (uint32_t u = 1; u < units; ++u) {
      if (w[u * kUnitWords<D>] != ((static_cast<uint32_t>(Form::kContinuation) << kFormShift) | u)) {
        return "a continuation does not lead back to its record";
      }
    }
    const uint32_t facets = map.facets_of(c), first = first_vertex_item<D>(facets);
    for (uint32_t item = facets; item < first; ++item) clear = clear && w[item_word<D>(item)] == 0;
    for (uint32_t item = first + vertices; item < units * kUnitItems<D>; ++item) {
      clear = clear && w[item_word<D>(item)] == 0;
    }
  } else {
    const uint32_t cuts = w[0] & kShapeMask;
    if (cuts >= (D == 3 ? 1u << quad_count(form) : 1u)) return "a record has cuts that its form does not have";
    clear = all_zero(1, first_link_slot<D>(form)) && all_zero(kUnitWords<D> + vertices, 2 * kUnitWords<D>);
  }
  if (!clear) return "an unused word of a record is not zero";
  return nullptr;
}

/** Whether vertices exist and differ. `sorted` is overwritten. */
template <int D>
bool vertices_sound(const Map<D>& map, Cell c, Array<uint32_t>& sorted) {
  sorted.clear();
  for (uint32_t k = 0, n = map.vertices_of(c); k < n; ++k) sorted.push_back(map.vertex(c, k));
  dsw::sort(sorted.begin(), sorted.end());
  return sorted.back() < map.vertex_count && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

/** Whether `count` things are in lists, each once and in that of its size; `next` leads on. */
template <class SizeOf, class Next>
bool lists_sound(const Array<uint32_t>& heads, size_t count, SizeOf size_of, Next next) {
  for (uint32_t size = 0; size < heads.size(); ++size) {
    for (uint32_t i = heads[size]; i != kNoCell; i = next(i)) {
      // A size of 0 is that of what is not free. A list that runs in a circle has too many.
      if (size == 0 || size_of(i) != size || count-- == 0) return false;
    }
  }
  return count == 0;
}

/** Tells of a map of the plane that has changed whether each length that shapes have is noted with one such shape. */
template <int D>
bool shared_shapes_sound(const Map<D>& map) {
  for (uint32_t i = 0; i < map.shape_offsets.size(); ++i) {
    const uint32_t length = shape_length(map, i);
    if (length >= map.free_shapes.size() || map.free_shapes[length] == kNoCell) return false;
  }
  for (size_t length = 0; length < map.free_shapes.size(); ++length) {
    const uint32_t i = map.free_shapes[length];
    if (i != kNoCell && (i >= map.shape_offsets.size() || shape_length(map, i) != length)) return false;
  }
  return true;
}

/** Checks that the lists of a map that has changed hold all that is free. Records are known to be sound; `records` of
 * them and `shapes` of their shapes are free. */
template <int D>
const char* check_free(const Map<D>& map, size_t records, size_t shapes) {
  const auto units_of_free = [&](uint32_t unit) {
    if (unit >= map.cell_of_unit.size() || map.cell_of_unit[unit] != kNoCell) return 0u;
    const uint32_t word0 = map.words[size_t{unit} * kUnitWords<D>];
    return form_of(word0) == Form::kFree ? word0 & kShapeMask : 0u;
  };
  const auto next_record = [&](uint32_t unit) { return map.words[size_t{unit} * kUnitWords<D> + 1]; };
  if (!lists_sound(map.free_records, records, units_of_free, next_record)) return "a free record is in no list";
  if (D == 2) return shared_shapes_sound(map) ? nullptr : "a shape is not found by its length";
  const auto length_of_free = [&](uint32_t number) -> size_t {
    const bool is_free = number < map.shape_offsets.size() && map.shape_tables[map.shape_offsets[number]] == kFreeShape;
    return is_free ? shape_length(map, number) : 0;
  };
  const auto next_shape = [&](uint32_t number) {
    const uint16_t* const table = map.shape_tables.data() + map.shape_offsets[number];
    return table[1] | static_cast<uint32_t>(table[2]) << 16;
  };
  if (!lists_sound(map.free_shapes, shapes, length_of_free, next_shape)) return "a free shape is in no list";
  return nullptr;
}

/** Checks the slots and uses of a map that has changed. Records and tables are known to be sound. */
template <int D>
const char* check_slots(const Map<D>& map) {
  if (map.cell_slots.alive_count() != map.cell_count) return "cells are counted wrongly";
  if (map.vertex_slots.slot_count() != map.vertex_count || map.vertex_uses.size() != map.vertex_count) {
    return "the tables of vertices have the wrong size";
  }
  for (uint32_t i = 0; i < map.unit_of_cell.size(); ++i) {
    if (map.cell_slots.alive(i, map.cell_slots.generation(i)) != map.cell(i).valid()) return "an index without a cell";
  }
  Array<uint32_t> uses(map.vertex_count, 0u, map.words.get_allocator());
  for_each_cell(map, [&](Cell c) {
    for (uint32_t k = 0, n = map.vertices_of(c); k < n; ++k) ++uses[map.vertex(c, k)];
  });
  for (uint32_t v = 0; v < map.vertex_count; ++v) {
    if (uses[v] != map.vertex_uses[v]) return "uses of a vertex are counted wrongly";
    if (uses[v] != 0 && !map.vertex_slots.alive(v, map.vertex_slots.generation(v)))
      return "a cell has a vertex that is gone";
  }
  return nullptr;
}

/** Records follow each other without gaps and the tables say where; before the first change in the order of cells. */
template <int D>
const char* check_records(const Map<D>& map) {
  const uint64_t units = map.words.size() / kUnitWords<D>;
  const bool uniform = map.unit_of_cell.empty();
  if (uniform) {
    const uint32_t n = map.units_per_cell;
    if (n == 0 || map.has_changed() || !map.cell_of_unit.empty() || uint64_t{map.cell_count} * n != units)
      return "records and cells differ in number";
  } else if (map.units_per_cell != 0 || map.unit_of_cell.size() != map.index_count() ||
             map.cell_of_unit.size() != units) {
    return "the tables of records have the wrong size";
  }
  Array<uint8_t> shape_used(map.shape_offsets.size(), 0, map.words.get_allocator());
  Array<uint32_t> sorted(map.words.get_allocator());
  size_t shapes = 0, free_records = 0;
  uint64_t unit = 0;
  for (uint32_t found = 0; found < map.cell_count || (map.has_changed() && unit < units);) {
    if (unit >= units) return "records and cells differ in number";
    const Cell c{static_cast<uint32_t>(unit)};
    const uint32_t word0 = map.record(c)[0];
    const bool is_free = map.has_changed() && form_of(word0) == Form::kFree;
    const uint32_t n = is_free ? word0 & kShapeMask : record_units(map, word0);
    if (n == 0 || n > units - unit) return "a record has no form, or no room";
    if (is_free) {
      const uint32_t* const w = map.record(c);
      if ((word0 & kMarkBit) != 0 || map.cell_of_unit[c.unit] != kNoCell) return "a free record has a cell";
      if (dsw::any_of(w + 2, w + size_t{n} * kUnitWords<D>, [](uint32_t word) { return word != 0; })) {
        return "an unused word of a record is not zero";
      }
      for (uint32_t u = 1; u < n; ++u) {
        if (map.cell_of_unit[c.unit + u] != kNoCell) return "a cell begins inside of a record";
      }
      ++free_records;
      unit += n;
      continue;
    }
    const uint32_t i = map.has_changed() ? map.cell_of_unit[c.unit] : found;
    ++found;
    if (!uniform && (i >= map.unit_of_cell.size() || map.unit_of_cell[i] != c.unit || map.cell_of_unit[c.unit] != i))
      return "a cell and its record disagree";
    if (uniform && (n != map.units_per_cell || form_of(word0) == Form::kGeneral)) return "records differ in size";
    if (const char* broken = check_record(map, c, n)) return broken;
    if (!vertices_sound(map, c, sorted)) return "a cell names a vertex twice, or one that does not exist";
    for (uint32_t u = 1; !uniform && u < n; ++u) {
      if (map.cell_of_unit[c.unit + u] != kNoCell) return "a cell begins inside of a record";
    }
    if (form_of(word0) == Form::kGeneral) {
      uint8_t& used = shape_used[word0 & kShapeMask];
      if (D == 3 && used != 0 && map.has_changed()) return "two cells of a map that changes share a shape";
      shapes += used == 0 ? 1u : 0u;
      used = 1;
    }
    unit += n;
  }
  if (unit != units) return "records and cells differ in number";
  if (map.has_changed()) {
    if (const char* broken = check_free(map, free_records, map.shape_offsets.size() - shapes)) return broken;
    return check_slots(map);
  }
  return shapes == map.shape_offsets.size() ? nullptr : "a shape belongs to no cell";
}

/** The cell to whose link words a half-facet belongs; invalid if it is none. Records are sound. */
template <int D>
Cell owner_of_link(const Map<D>& map, HalfFacet h) {
  if (h.word >= map.words.size()) return {};
  uint32_t unit = h.word / kUnitWords<D>;
  if (map.unit_of_cell.empty()) {
    unit -= unit % map.units_per_cell;
  } else if (map.cell_of_unit[unit] == kNoCell) {
    // A vertex, which is what the second unit of a standard record begins with, is too small to look like this.
    const uint32_t word0 = map.words[size_t{unit} * kUnitWords<D>];
    if (form_of(word0) != Form::kContinuation) return {};
    unit -= word0 & kShapeMask;
  }
  const Cell c{unit};
  const Form form = map.form(c);
  const uint32_t slot = h.word - unit * kUnitWords<D>;
  if (form == Form::kGeneral) {
    return slot % kUnitWords<D> != 0 && map.local_of(h, c) < map.facets_of(c) ? c : Cell{};
  }
  return slot >= first_link_slot<D>(form) && slot < kUnitWords<D> ? c : Cell{};
}

/** Whether two facets with the same vertices, more than three, have the same triangles. */
bool cut_alike(const Map<3>& map, Cell a, uint32_t fa, Cell b, uint32_t fb) {
  const auto triangle = [&](Cell c, const Shape& shape, uint32_t s) {
    const uint16_t* v = shape.simplices() + 3 * s;
    std::array<uint32_t, 3> t{map.vertex(c, v[0]), map.vertex(c, v[1]), map.vertex(c, v[2])};
    dsw::sort(t.begin(), t.end());
    return t;
  };
  const Shape sa = map.shape(a), sb = map.shape(b);
  const uint32_t at = sa.simplex_first(fa), bt = sb.simplex_first(fb), n = sa.facet_size(fa) - 2;
  if (n == 2) {  // each triangle leaves out one end of the other diagonal
    const auto first = triangle(b, sb, bt);
    return triangle(a, sa, at) == first || triangle(a, sa, at + 1) == first;
  }
  std::vector<std::array<uint32_t, 3>> ta, tb;
  for (uint32_t k = 0; k < n; ++k) {
    ta.push_back(triangle(a, sa, at + k));
    tb.push_back(triangle(b, sb, bt + k));
  }
  dsw::sort(ta.begin(), ta.end());
  dsw::sort(tb.begin(), tb.end());
  return ta == tb;
}

/** Whether two facets run through the same vertices in opposite order and are cut alike. */
bool facets_fit(const Map<3>& map, Cell a, uint32_t fa, Cell b, uint32_t fb) {
  const Shape sa = map.shape(a), sb = map.shape(b);
  const uint32_t n = sa.facet_size(fa);
  if (sb.facet_size(fb) != n) return false;
  const auto at = [&](Cell c, const Shape& s, uint32_t f, uint32_t k) {
    return map.vertex(c, s.dart_vertex(s.facet_first(f) + k % n));
  };
  uint32_t turn = 0;
  while (turn < n && at(b, sb, fb, turn) != at(a, sa, fa, 0)) ++turn;
  if (turn == n) return false;
  for (uint32_t k = 1; k < n; ++k) {
    if (at(a, sa, fa, k) != at(b, sb, fb, turn + n - k)) return false;
  }
  return n == 3 || cut_alike(map, a, fa, b, fb);
}

bool facets_fit(const Map<2>& map, Cell a, uint32_t fa, Cell b, uint32_t fb) {
  const uint32_t na = map.facets_of(a), nb = map.facets_of(b);
  return map.vertex(a, fa) == map.vertex(b, (fb + 1) % nb) && map.vertex(a, (fa + 1) % na) == map.vertex(b, fb);
}

template <int D>
const char* check_links(const Map<D>& map) {
  for (uint32_t i = 0, count = map.index_count(); i < count; ++i) {
    const Cell c = map.cell(i);
    if (!c.valid()) continue;
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      if (!o.valid()) continue;
      const Cell other = owner_of_link(map, o);
      if (!other.valid()) return "a link leads to no facet";
      if (other == c) return "a cell is linked to itself";
      if (map.opposite(o) != h) return "a link does not lead back";
      if (map.facet_marked(o) != map.facet_marked(h)) return "a facet is marked on one side only";
      if (o.word > h.word && !facets_fit(map, c, f, other, map.local_of(o, other))) {
        return "two linked facets do not have the same vertices in opposite order, cut alike";
      }
    }
  }
  return nullptr;
}

}  // namespace

template <int D>
size_t sound_table_length(const uint16_t* table, size_t available, Array<uint16_t>& scratch) {
  if (available < Shape::kHeader) return 0;
  const Shape shape(table);
  const size_t length = Shape::kHeader + 2 * (size_t{shape.facet_count()} + 1) + 4 * size_t{shape.dart_count()} +
                        (D + 1) * size_t{shape.simplex_count()};
  if (length > available) return 0;
  scratch.clear();
  if constexpr (D == 3) {
    if (!remake(shape, scratch)) return 0;
  } else {
    if (append_polygon(shape.vertex_count(), scratch) != ShapeDefect::kNone) return 0;
  }
  return scratch.size() == length && std::equal(scratch.begin(), scratch.end(), table) ? length : 0;
}

template <int D>
uint32_t record_units(const Map<D>& map, uint32_t word0) {
  const Form form = form_of(word0);
  switch (form) {
    case Form::kSimplex:
      return 1;
    case Form::kPyramid:
    case Form::kPrism:
      return D == 3 ? 2 : 0;
    case Form::kBox:
      return 2;
    case Form::kGeneral: {
      if ((word0 & kShapeMask) >= map.shape_offsets.size()) return 0;
      const Shape shape(map.shape_tables.data() + map.shape_offsets[word0 & kShapeMask]);
      return general_units<D>(shape.facet_count(), shape.vertex_count());
    }
    default:
      return 0;
  }
}

template <int D>
void count_facets(const Map<D>& map, uint32_t* facets, uint32_t* boundary_facets) {
  uint64_t sides = 0, boundary = 0;
  for_each_cell(map, [&](Cell c) {
    const uint32_t n = map.facets_of(c);
    sides += n;
    for (uint32_t f = 0; f < n; ++f) boundary += map.opposite(map.half_facet(c, f)).valid() ? 0u : 1u;
  });
  *facets = static_cast<uint32_t>((sides - boundary) / 2 + boundary);
  *boundary_facets = static_cast<uint32_t>(boundary);
}

template <int D>
const char* check_integrity(const Map<D>& map) {
  if (map.words.size() % kUnitWords<D> != 0 || map.words.size() / kUnitWords<D> >= kMostUnits)
    return "records are cut off, or too many";
  if (map.cell_count == 0 || map.vertex_count > kVertexMask) return "no cells, or too many vertices";
  if (!shapes_sound(map)) return "a shape is not sound";
  if (const char* broken = check_records(map)) return broken;
  if (const char* broken = check_links(map)) return broken;
  uint32_t facets, boundary;
  count_facets(map, &facets, &boundary);
  return facets == map.facet_count && boundary == map.boundary_facet_count ? nullptr : "facets are counted wrongly";
}

DSW_INSTANTIATE(check_integrity);
DSW_INSTANTIATE(sound_table_length);
DSW_INSTANTIATE(record_units);
DSW_INSTANTIATE(count_facets);

}  // namespace dsw
