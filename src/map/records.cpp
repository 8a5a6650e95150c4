#include "map/records.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/error.h"
#include "map/integrity.h"

namespace dsw {
namespace {

/** Makes room for a list of things of this size. */
void reserve_list(Array<uint32_t>& heads, uint32_t size) {
  if (size >= heads.size()) heads.resize(std::max<size_t>(size + 1, heads.size() * 2), kNoCell);
}

uint32_t next_shape(const uint16_t* table) { return table[1] | static_cast<uint32_t>(table[2]) << 16; }

template <int D>
void push_record(Map<D>& map, uint32_t unit, uint32_t units) noexcept {
  uint32_t* const w = map.record({unit});
  std::fill(w, w + size_t{units} * kUnitWords<D>, 0u);
  w[0] = static_cast<uint32_t>(Form::kFree) << kFormShift | units;
  w[1] = map.free_records[units];
  map.free_records[units] = unit;
}

template <int D>
void push_shape(Map<D>& map, uint32_t number) noexcept {
  uint16_t* const table = map.shape_tables.data() + map.shape_offsets[number];
  const uint32_t length = shape_length(map, number), next = map.free_shapes[length];
  std::fill(table, table + length, uint16_t{0});
  table[0] = kFreeShape;
  table[1] = static_cast<uint16_t>(next & 0xffffu);
  table[2] = static_cast<uint16_t>(next >> 16);
  map.free_shapes[length] = number;
}

/** Gives every polyhedron a table of its own: cells of space that change do not share. */
template <int D>
class OwnShapes {
 public:
  explicit OwnShapes(const Map<D>& map)
      : tables_(map.shape_tables.get_allocator()), offsets_(map.shape_offsets.get_allocator()) {
    if (D == 2) return;
    uint32_t cells = 0;
    for_each_cell(map, [&](Cell c) { cells += map.form(c) == Form::kGeneral ? 1u : 0u; });
    if (cells == map.shape_offsets.size()) return;
    offsets_.reserve(cells);
    for_each_cell(map, [&](Cell c) {
      if (map.form(c) != Form::kGeneral) return;
      const uint16_t* const table = map.shape(c).table();
      offsets_.push_back(static_cast<uint32_t>(tables_.size()));
      tables_.insert(tables_.end(), table, table + shape_length(map, map.record(c)[0] & kShapeMask));
      if (tables_.size() > UINT32_MAX) fail(DSW_STATUS_TOO_LARGE, "the polyhedra need more than 2^32 words of shapes");
    });
  }

  void apply(Map<D>& map) noexcept {
    if (offsets_.empty()) return;
    map.is_as_created = false;
    uint32_t number = 0;
    for_each_cell(map, [&](Cell c) {
      uint32_t& word0 = map.record(c)[0];
      if (form_of(word0) == Form::kGeneral) word0 = (word0 & ~kShapeMask) | number++;
    });
    map.shape_tables.swap(tables_);
    map.shape_offsets.swap(offsets_);
  }

 private:
  Array<uint16_t> tables_;
  Array<uint32_t> offsets_;  // empty: all have one
};

/** In the plane the first table of every length; in space none, since none is free. */
template <int D>
Array<uint32_t> shapes_by_length(const Map<D>& map) {
  Array<uint32_t> numbers(map.free_shapes.get_allocator());
  for (uint32_t i = 0; D == 2 && i < map.shape_offsets.size(); ++i) {
    const uint32_t length = shape_length(map, i);
    reserve_list(numbers, length);
    if (numbers[length] == kNoCell) numbers[length] = i;
  }
  return numbers;
}

}  // namespace

template <int D>
uint32_t shape_length(const Map<D>& map, uint32_t number) noexcept {
  const size_t end = number + 1 < map.shape_offsets.size() ? map.shape_offsets[number + 1] : map.shape_tables.size();
  return static_cast<uint32_t>(end - map.shape_offsets[number]);
}

template <int D>
void make_ready(Map<D>& map) {
  map.has_asked_for_tables = true;
  if (map.has_changed()) return;
  const auto allocator = map.words.get_allocator();
  const bool uniform = map.unit_of_cell.empty();
  OwnShapes<D> own(map);
  Array<uint32_t> unit_of_cell(allocator), cell_of_unit(allocator), uses(map.vertex_count, 0u, allocator);
  SlotPool cells(allocator.memory), vertices(allocator.memory);
  Array<uint32_t> shared = shapes_by_length(map);
  if (uniform) {
    unit_of_cell.resize(map.cell_count);
    cell_of_unit.assign(map.words.size() / kUnitWords<D>, kNoCell);
    for (uint32_t i = 0; i < map.cell_count; ++i) {
      unit_of_cell[i] = map.cell(i).unit;
      cell_of_unit[unit_of_cell[i]] = i;
    }
  }
  for_each_cell(map, [&](Cell c) {
    for (uint32_t k = 0, n = map.vertices_of(c); k < n; ++k) ++uses[map.vertex(c, k)];
  });
  cells.start(map.cell_count);
  vertices.start(map.vertex_count);
  own.apply(map);
  map.free_shapes.swap(shared);
  if (uniform) {
    map.unit_of_cell.swap(unit_of_cell);
    map.cell_of_unit.swap(cell_of_unit);
    map.units_per_cell = 0;
  }
  map.vertex_uses.swap(uses);
  map.cell_slots = std::move(cells);
  map.vertex_slots = std::move(vertices);
}

template <int D>
uint32_t take_record(Map<D>& map, uint32_t units) {
  reserve_list(map.free_records, units);
  uint32_t unit = map.free_records[units];
  if (unit != kNoCell) {
    uint32_t* const w = map.record({unit});
    map.free_records[units] = w[1];
    w[0] = w[1] = 0;
    return unit;
  }
  const size_t first = map.words.size() / kUnitWords<D>;
  if (first + units >= kMostUnits) fail(DSW_STATUS_TOO_LARGE, "the volumes need more than 2^28 records");
  reserve_more(map.words, size_t{units} * kUnitWords<D>);
  reserve_more(map.cell_of_unit, units);
  map.words.resize(map.words.size() + size_t{units} * kUnitWords<D>, 0u);
  map.cell_of_unit.resize(map.cell_of_unit.size() + units, kNoCell);
  return static_cast<uint32_t>(first);
}

template <int D>
uint32_t take_shape(Map<D>& map, const Array<uint16_t>& table) {
  const auto length = static_cast<uint32_t>(table.size());
  reserve_list(map.free_shapes, length);
  uint32_t number = map.free_shapes[length];
  if (D == 2 && number != kNoCell) return number;
  if (number != kNoCell) {
    map.free_shapes[length] = next_shape(map.shape_tables.data() + map.shape_offsets[number]);
  } else {
    if (map.shape_tables.size() + length > UINT32_MAX || map.shape_offsets.size() >= kShapeMask) {
      fail(DSW_STATUS_TOO_LARGE, "the polyhedra need more than 2^32 words of shapes");
    }
    reserve_more(map.shape_offsets, 1);
    reserve_more(map.shape_tables, length);
    number = static_cast<uint32_t>(map.shape_offsets.size());
    map.shape_offsets.push_back(static_cast<uint32_t>(map.shape_tables.size()));
    map.shape_tables.resize(map.shape_tables.size() + length);
  }
  std::copy(table.begin(), table.end(), map.shape_tables.data() + map.shape_offsets[number]);
  if (D == 2) map.free_shapes[length] = number;
  return number;
}

template <int D>
void reserve_return(Map<D>& map, Cell c) {
  const uint32_t word0 = map.record(c)[0];
  reserve_list(map.free_records, record_units(map, word0));
  if (D == 3 && form_of(word0) == Form::kGeneral) reserve_list(map.free_shapes, shape_length(map, word0 & kShapeMask));
}

template <int D>
void give_back(Map<D>& map, Cell c) noexcept {
  const uint32_t word0 = map.record(c)[0], units = record_units(map, word0);
  map.cell_of_unit[c.unit] = kNoCell;
  push_record(map, c.unit, units);
  if (D == 3 && form_of(word0) == Form::kGeneral) push_shape(map, word0 & kShapeMask);
}

template <int D>
Room room_of(const Map<D>& map) noexcept {
  return {map.words.size() / kUnitWords<D>, map.shape_offsets.size(), map.shape_tables.size(), map.free_records.size(),
          map.free_shapes.size()};
}

template <int D>
void untake_record(Map<D>& map, uint32_t unit, uint32_t units, const Room& before) noexcept {
  map.cell_of_unit[unit] = kNoCell;
  if (unit < before.units) push_record(map, unit, units);
}

template <int D>
void untake_shape(Map<D>& map, uint32_t number, const Room& before) noexcept {
  if (D == 2) {
    if (number >= before.shapes) map.free_shapes[shape_length(map, number)] = kNoCell;
  } else if (number < before.shapes) {
    push_shape(map, number);
  }
}

template <int D>
void shrink(Map<D>& map, const Room& before) noexcept {
  map.words.resize(before.units * kUnitWords<D>);
  map.cell_of_unit.resize(before.units);
  map.shape_offsets.resize(before.shapes);
  map.shape_tables.resize(before.shape_words);
  map.free_records.resize(before.record_lists);
  map.free_shapes.resize(before.shape_lists);
}

DSW_INSTANTIATE(make_ready);
DSW_INSTANTIATE(take_record);
DSW_INSTANTIATE(take_shape);
DSW_INSTANTIATE(reserve_return);
DSW_INSTANTIATE(give_back);
DSW_INSTANTIATE(room_of);
DSW_INSTANTIATE(untake_record);
DSW_INSTANTIATE(untake_shape);
DSW_INSTANTIATE(shrink);
DSW_INSTANTIATE(shape_length);

}  // namespace dsw
