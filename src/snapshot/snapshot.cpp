// Saving copies arrays; nothing that can be worked out again is stored. Loading trusts no byte: sizes before memory,
// the checksum before contents, topology before geometry, and only blocks that `save` could have written are accepted,
// so that a loaded environment saves to the same bytes.

#include "snapshot/snapshot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dimensions.h"
#include "base/search.h"
#include "environment/builder.h"
#include "environment/moving.h"
#include "environment/validity.h"
#include "map/dart.h"
#include "map/integrity.h"
#include "snapshot/block.h"
#include "snapshot/wide_records.h"

namespace dsw {
namespace {

enum Section {
  kWords,
  kShapes,
  kPoints,
  kRegions,
  kTags,
  kEdgeMarks,
  kVertexMarks,
  kBox,        // where cells have changed or points move: then it is not that of the present points
  kCellUnits,  // this and what follows where cells have changed
  kCellSlots,
  kFreeCells,
  kVertexSlots,
  kFreeVertices,
  kShapeOffsets,
  kFreeRecords,
  kFreeShapes,
  kParents,  // where cells were split: since version 4, in space 3
  kExits,    // where there are exits: since version 5, in space 4
  kSectionCount
};

/** Numbers of the plane's blocks have been narrow since version 3. The last version is written where there are exits, the one
 * before it where cells were split, else the first of these three. */
template <int D>
constexpr uint32_t kPlainVersion = D == 2 ? 3 : 2;
template <int D>
constexpr BlockKind kind_of_version(uint32_t version, uint32_t sections) {
  // Sections of version 2 and of those after it.
  return D == 2 ? BlockKind{"DSWENV\x1a\n", version, 2, sections, {kParents, kParents, kExits}}
                : BlockKind{"DSWENV\x1a\n", version, 2, sections, {kParents, kExits, kExits}};
}
template <int D>
constexpr BlockKind kUnsplitKind = kind_of_version<D>(kPlainVersion<D>, kParents);
template <int D>
constexpr BlockKind kSplitKind = kind_of_version<D>(kPlainVersion<D> + 1, kExits);
template <int D>
constexpr BlockKind kKind = kind_of_version<D>(kPlainVersion<D> + 2, kSectionCount);
constexpr uint32_t kLastWideVersion = 2;

template <int D>
const BlockKind& kind_of(const Environment<D>& env) {
  return !env.exits.empty() ? kKind<D> : !env.parents.empty() ? kSplitKind<D> : kUnsplitKind<D>;
}
constexpr uint32_t kHasTree = 1, kHasChanged = 2, kPointsMove = 4;

constexpr uint64_t vertex_mark_words(uint64_t vertices) { return (vertices + 63) / 64; }

template <class T>
uint64_t bytes_of(const Array<T>& array) {
  return array.size() * sizeof(T);
}

template <int D>
BlockHeader header_of(const Environment<D>& env) {
  const Map<D>& map = env.map;
  const bool changed = map.has_changed() && !map.is_as_created, moving = env.has_moved();
  BlockHeader h;
  const bool tree = env.index.use() == TreeUse::kAtOnce && !moving;
  h.flags = (tree ? kHasTree : 0) | (changed ? kHasChanged : 0) | (moving ? kPointsMove : 0);
  h.counts[0] = map.vertex_count;
  h.counts[1] = map.cell_count;
  h.bytes[kWords] = bytes_of(map.words);
  h.bytes[kShapes] = bytes_of(map.shape_tables);
  h.bytes[kPoints] = uint64_t{map.vertex_count} * D * sizeof(double);
  h.bytes[kRegions] = bytes_of(env.regions);
  h.bytes[kTags] = bytes_of(env.tags);
  h.bytes[kParents] = bytes_of(env.parents);
  h.bytes[kExits] = bytes_of(env.exits.all());
  h.bytes[kEdgeMarks] = env.edge_marks.size() * sizeof(uint64_t);
  h.bytes[kVertexMarks] = env.marked_vertices == 0 ? 0 : bytes_of(env.vertex_marks);
  h.bytes[kBox] = changed || moving ? sizeof env.lower + sizeof env.upper : 0;
  if (!changed) return h;
  h.bytes[kCellUnits] = bytes_of(map.unit_of_cell);
  h.bytes[kCellSlots] = bytes_of(map.cell_slots.words());
  h.bytes[kFreeCells] = bytes_of(map.cell_slots.free_slots());
  h.bytes[kVertexSlots] = bytes_of(map.vertex_slots.words());
  h.bytes[kFreeVertices] = bytes_of(map.vertex_slots.free_slots());
  h.bytes[kShapeOffsets] = bytes_of(map.shape_offsets);
  h.bytes[kFreeRecords] = bytes_of(map.free_records);
  h.bytes[kFreeShapes] = bytes_of(map.free_shapes);
  return h;
}

/** Whether each section has the size that the counts ask for. */
template <int D>
void check_sizes(const BlockHeader& h, uint32_t unit_words) {
  const bool changed = (h.flags & kHasChanged) != 0, moving = (h.flags & kPointsMove) != 0;
  const uint64_t units = h.bytes[kWords] / (unit_words * sizeof(uint32_t));
  const uint64_t vertices = h.counts[0], cells = h.counts[1];
  if ((h.flags & ~(kHasTree | kHasChanged | kPointsMove)) != 0) fail_corrupt("it has unknown flags");
  const bool wide = unit_words != kUnitWords<D>;
  if (((changed || moving) && wide) || (moving && (h.flags & kHasTree) != 0)) {
    fail_corrupt("flags that do not go together");
  }
  if (vertices > kVertexMask) fail_corrupt("it has too many vertices");
  if (h.bytes[kWords] % (unit_words * sizeof(uint32_t)) != 0 || units >= kMostUnits) fail_corrupt("records: size");
  if (cells == 0 || cells > units) fail_corrupt("number of cells");
  if (h.bytes[kShapes] / sizeof(uint16_t) > UINT32_MAX) fail_corrupt("shapes: size");
  if (h.bytes[kPoints] != vertices * D * sizeof(double)) fail_corrupt("points: size");
  const uint64_t label_bytes = changed ? h.bytes[kCellUnits] : cells * sizeof(uint32_t);
  for (const Section s : {kRegions, kTags, kParents}) {
    if (h.bytes[s] != 0 && h.bytes[s] != label_bytes) fail_corrupt("labels: size");
  }
  if (h.bytes[kVertexMarks] != 0 && h.bytes[kVertexMarks] != vertex_mark_words(vertices) * sizeof(uint64_t)) {
    fail_corrupt("marked vertices: size");
  }
  if (h.bytes[kBox] != (changed || moving ? 2 * D * sizeof(double) : 0)) fail_corrupt("box: size");
  for (uint32_t s = kCellUnits; s < kParents; ++s) {
    if (!changed && h.bytes[s] != 0) fail_corrupt("changes of what has not changed");
  }
  if (!changed) return;
  if (h.bytes[kCellUnits] == 0 || h.bytes[kCellSlots] != h.bytes[kCellUnits] ||
      h.bytes[kVertexSlots] != vertices * sizeof(uint32_t)) {
    fail_corrupt("generations: size");
  }
}

/** Finds the shapes, by the rules of creation; where cells have changed it is known where they start. */
template <int D>
void restore_shapes(Map<D>& map, bool changed) {
  const Array<uint16_t>& tables = map.shape_tables;
  Array<uint16_t> scratch(tables.get_allocator());
  uint32_t number = 0;
  for (size_t at = 0; at < tables.size(); ++number) {
    size_t length = 0;
    if (changed && tables[at] == kFreeShape) {
      const size_t next = size_t{number} + 1;
      const size_t end = next < map.shape_offsets.size() ? map.shape_offsets[next] : tables.size();
      length = end > at && end <= tables.size() ? end - at : 0;
    } else {
      length = sound_table_length<D>(tables.data() + at, tables.size() - at, scratch);
    }
    if (length == 0) fail_corrupt("a shape");
    if (!changed) map.shape_offsets.push_back(static_cast<uint32_t>(at));
    if (number >= map.shape_offsets.size() || map.shape_offsets[number] != at) fail_corrupt("where a shape starts");
    at += length;
  }
  if (number != map.shape_offsets.size()) fail_corrupt("a shape behind the last");
}

/** Finds where each record starts, by the rules of creation. */
template <int D>
void restore_layout(Map<D>& map) {
  const uint32_t units = static_cast<uint32_t>(map.words.size() / kUnitWords<D>);
  const auto units_at = [&](uint32_t unit) { return record_units(map, map.words[size_t{unit} * kUnitWords<D>]); };
  const uint32_t first_units = units_at(0);
  bool uniform = first_units != 0 && uint64_t{map.cell_count} * first_units == units;
  for (uint32_t unit = 0; uniform && unit < units; unit += first_units) {
    const uint32_t word0 = map.words[size_t{unit} * kUnitWords<D>];
    uniform = form_of(word0) != Form::kGeneral && units_at(unit) == first_units;
  }
  if (uniform) {
    map.units_per_cell = first_units;
    return;
  }
  map.unit_of_cell.resize(map.cell_count);
  map.cell_of_unit.assign(units, kNoCell);
  uint64_t unit = 0;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    if (unit >= units) fail_corrupt("records: fewer than cells");
    const uint32_t n = units_at(static_cast<uint32_t>(unit));
    if (n == 0) fail_corrupt("a record's form");
    map.unit_of_cell[i] = static_cast<uint32_t>(unit);
    map.cell_of_unit[static_cast<uint32_t>(unit)] = i;
    unit += n;
  }
  if (unit != units) fail_corrupt("records: another number than cells");
}

/** The tables of cells that have changed: from where their records are said to start, as far as it takes to read them;
 * whether all of that is sound, check_integrity says. */
template <int D>
void restore_changes(Map<D>& map) {
  const size_t units = map.words.size() / kUnitWords<D>;
  map.cell_of_unit.assign(units, kNoCell);
  map.vertex_uses.assign(map.vertex_count, 0);
  for (uint32_t i = 0; i < map.unit_of_cell.size(); ++i) {
    const Cell c{map.unit_of_cell[i]};
    if (!c.valid()) continue;
    if (c.unit >= units || map.cell_of_unit[c.unit] != kNoCell) fail_corrupt("where a record starts");
    const uint32_t word0 = map.record(c)[0], n = record_units(map, word0);
    if (n == 0 || n > units - c.unit) fail_corrupt("a record's form");
    if (form_of(word0) == Form::kGeneral && map.shape_tables[map.shape_offsets[word0 & kShapeMask]] == kFreeShape) {
      fail_corrupt("a record without a shape");
    }
    map.cell_of_unit[c.unit] = i;
    for (uint32_t k = 0, count = map.vertices_of(c); k < count; ++k) {
      const uint32_t v = map.vertex(c, k);
      if (v >= map.vertex_count) fail_corrupt("a vertex of a cell");
      ++map.vertex_uses[v];
    }
  }
}

/** Every cell again: that it is valid, and that it says rightly whether it is convex. */
template <int D>
void check_cells(const Environment<D>& env) {
  const Map<D>& map = env.map;
  for_each_cell(map, [&](Cell c) {
    const CellState state = check_cell(env, c);
    if (state != CellState::kValid && state != CellState::kValidConvex) fail_corrupt("a cell is not valid");
    if (map.convex(c) != (state == CellState::kValidConvex)) fail_corrupt("a cell is wrongly called convex, or not");
  });
}

/** Calls visit(edge key) for the edges of all cells, more than once for most. */
template <int D, class Visit>
void for_each_edge_key(const Map<D>& map, const Visit& visit) {
  for_each_cell(map, [&](Cell c) {
    for (uint32_t d = 0, n = map.shape(c).dart_count(); d < n; ++d) {
      const uint64_t a = dart_vertex(map, {c, d}), b = dart_target(map, {c, d});
      visit(a < b ? a << 32 | b : b << 32 | a);
    }
  });
}

template <int D>
void load_edge_marks(Environment<D>& env, const Array<uint64_t>& keys) {
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i != 0 && keys[i - 1] >= keys[i]) fail_corrupt("marked edges are not in order");
    const uint64_t a = keys[i] >> 32, b = keys[i] & 0xffffffffu;
    if (a >= b || b >= env.map.vertex_count) fail_corrupt("a marked edge");
  }
  if (keys.empty()) return;
  Array<uint8_t> found(keys.size(), 0, env.memory);
  for_each_edge_key(env.map, [&](uint64_t key) {
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    if (at != keys.end() && *at == key) found[static_cast<size_t>(at - keys.begin())] = 1;
  });
  if (dsw::find(found.begin(), found.end(), 0) != found.end()) fail_corrupt("a marked edge is none");
  env.edge_marks.reserve(keys.size());
  for (const uint64_t key : keys) {
    env.edge_marks.insert(static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key));
  }
}

/** Exits are facets of the outer boundary, in their order. */
template <int D>
void load_exits(Environment<D>& env, const Array<uint32_t>& words) {
  static_assert(sizeof(Exit) == 3 * sizeof(uint32_t));
  const Map<D>& map = env.map;
  if (words.size() % 3 != 0) fail_corrupt("exits: size");
  Array<Exit> exits{env.memory};
  for (size_t i = 0; i < words.size(); i += 3) exits.push_back({words[i], words[i + 1], words[i + 2]});
  for (const Exit& exit : exits) {
    if (exit.cell >= map.index_count() || !map.cell(exit.cell).valid()) fail_corrupt("the cell of an exit");
    const Cell c = map.cell(exit.cell);
    if (exit.local >= map.facets_of(c)) fail_corrupt("the face of an exit");
    if (map.opposite(map.half_facet(c, exit.local)).valid()) fail_corrupt("an exit is not on the outer boundary");
  }
  if (!env.exits.restore(std::move(exits))) fail_corrupt("exits are not in order");
}

/** Counts marks anew. */
template <int D>
void count_marks(Environment<D>& env) {
  const Map<D>& map = env.map;
  for_each_cell(map, [&](Cell c) {
    env.marked_cells += map.marked(c) ? 1u : 0u;
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (map.facet_marked(h) && canonical(map, h) == h) ++env.marked_facets;
    }
  });
  env.marked_edges = env.edge_marks.size();
  for (const uint64_t word : env.vertex_marks) {
    for (uint64_t bits = word; bits != 0; bits &= bits - 1) ++env.marked_vertices;
  }
  if (env.vertex_marks.empty()) return;
  const uint32_t used = map.vertex_count % 64;
  if (used != 0 && env.vertex_marks.back() >> used != 0) fail_corrupt("a marked vertex");
  if (env.marked_vertices == 0) fail_corrupt("marks of vertices without any");
}

/** The box only grows while cells change, and does not follow points that move. */
template <int D>
void load_box(Environment<D>& env, const Array<double>& box, bool moving) {
  for (int k = 0; k < D && !box.empty(); ++k) {
    const double lower = box[static_cast<size_t>(k)], upper = box[static_cast<size_t>(D + k)];
    const bool holds = moving ? lower <= upper : lower <= env.lower[k] && upper >= env.upper[k];
    if (!holds || !std::isfinite(lower) || !std::isfinite(upper)) fail_corrupt("the box");
    env.lower[k] = lower;
    env.upper[k] = upper;
  }
}

void read_slots(BlockReader& reader, SlotPool& slots, const Memory* memory) {
  Array<uint32_t> words{memory}, free{memory};
  reader.read(words);
  reader.read(free);
  if (!slots.restore(std::move(words), std::move(free))) fail_corrupt("generations");
}

}  // namespace

template <int D>
size_t snapshot_bytes(const Environment<D>& env) {
  return block_bytes(kind_of(env), header_of(env));
}

template <int D>
void save(const Environment<D>& env, uint8_t* out) {
  const Map<D>& map = env.map;
  const BlockHeader h = header_of(env);
  Array<uint64_t> edges{env.memory};
  edges.reserve(env.edge_marks.size());
  env.edge_marks.copy_sorted(edges);

  BlockWriter writer(kind_of(env), h, D, out);
  const auto write = [&](Section section, const auto* values) {
    writer.write(values, static_cast<size_t>(h.bytes[section] / sizeof(*values)));
    writer.end_section();
  };
  write(kWords, map.words.data());
  write(kShapes, map.shape_tables.data());
  write(kPoints, env.points);
  write(kRegions, env.regions.data());
  write(kTags, env.tags.data());
  write(kEdgeMarks, edges.data());
  write(kVertexMarks, env.vertex_marks.data());
  if (h.bytes[kBox] != 0) {
    writer.write(env.lower, D);
    writer.write(env.upper, D);
    writer.end_section();
  }
  write(kCellUnits, map.unit_of_cell.data());
  write(kCellSlots, map.cell_slots.words().data());
  write(kFreeCells, map.cell_slots.free_slots().data());
  write(kVertexSlots, map.vertex_slots.words().data());
  write(kFreeVertices, map.vertex_slots.free_slots().data());
  write(kShapeOffsets, map.shape_offsets.data());
  write(kFreeRecords, map.free_records.data());
  write(kFreeShapes, map.free_shapes.data());
  if (!env.parents.empty() || !env.exits.empty()) write(kParents, env.parents.data());
  if (!env.exits.empty()) write(kExits, reinterpret_cast<const uint32_t*>(env.exits.all().data()));
  writer.finish();
}

template <int D>
void load(Environment<D>& env, const uint8_t* block, size_t size) {
  BlockReader reader(kKind<D>, D, block, size);
  const BlockHeader& h = reader.header();
  const bool wide = D == 2 && reader.version() <= kLastWideVersion;
  check_sizes<D>(h, wide ? kWideUnitWords : kUnitWords<D>);
  const bool changed = (h.flags & kHasChanged) != 0, moving = (h.flags & kPointsMove) != 0;
  const bool has_exits = reader.version() == kKind<D>.version;
  const bool has_parents = has_exits || reader.version() == kSplitKind<D>.version;
  if (has_parents && !has_exits && h.bytes[kParents] == 0) fail_corrupt("parents: size");
  if (has_exits && h.bytes[kExits] == 0) fail_corrupt("exits: size");
  Map<D>& map = env.map;
  map.is_as_created = !changed;
  map.vertex_count = h.counts[0];
  map.cell_count = h.counts[1];
  Array<uint64_t> edges{env.memory};
  Array<double> box{env.memory};
  reader.read(map.words);
  reader.read(map.shape_tables);
  reader.read(env.owned_points);
  reader.read(env.regions);
  reader.read(env.tags);
  reader.read(edges);
  reader.read(env.vertex_marks);
  reader.read(box);
  reader.read(map.unit_of_cell);
  read_slots(reader, map.cell_slots, env.memory);
  read_slots(reader, map.vertex_slots, env.memory);
  reader.read(map.shape_offsets);
  reader.read(map.free_records);
  reader.read(map.free_shapes);
  if (has_parents) reader.read(env.parents);
  Array<uint32_t> exits{env.memory};
  if (has_exits) reader.read(exits);
  env.points = env.owned_points.data();
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (!moving && !dsw::all_of(env.owned_points.begin(), env.owned_points.end(), is_finite)) {
    fail_corrupt("a point is not finite");
  }
  restore_shapes(map, changed);
  if constexpr (D == 2) {
    if (wide) narrow_records(map);
  }
  if (changed) {
    restore_changes(map);
  } else {
    restore_layout(map);
  }
  count_facets(map, &map.facet_count, &map.boundary_facet_count);
  if (const char* const broken = check_integrity(map)) fail_corrupt(broken);
  if (!moving) check_cells(env);  // after a move cells need not be valid, and the bits mean nothing
  load_edge_marks(env, edges);
  load_exits(env, exits);
  count_marks(env);
  finish_topology(env, nullptr);
  load_box(env, box, moving);
  if (moving) {
    let_points_move(env);
    env.note_move();
  }
  if ((h.flags & kHasTree) == 0) return;
  env.index.set_use(TreeUse::kAtOnce);
  env.index.build(env);
}

DSW_INSTANTIATE(snapshot_bytes);
DSW_INSTANTIATE(save);
DSW_INSTANTIATE(load);

}  // namespace dsw
