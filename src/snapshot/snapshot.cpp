// Saving copies arrays; nothing that can be worked out again is stored. Loading trusts no byte: sizes before memory, the
// checksum before contents, topology before geometry, and only blocks that `save` could have written are accepted, so that
// a loaded environment saves to the same bytes.

#include "snapshot/snapshot.h"

#include <cmath>

#include "base/error.h"
#include "environment/builder.h"
#include "environment/validity.h"
#include "map/dart.h"
#include "map/integrity.h"
#include "snapshot/bytes.h"

namespace dsw {
namespace {

constexpr uint8_t kMagic[8] = {'D', 'S', 'W', 'E', 'N', 'V', 0x1a, '\n'};
constexpr uint32_t kFormatVersion = 1;
constexpr uint32_t kHasGrid = 1;
constexpr uint64_t kMostUnits = uint64_t{1} << 28;

enum Section { kWords, kShapes, kPoints, kRegions, kTags, kEdgeMarks, kVertexMarks, kSectionCount };

/** Positions in the header. */
constexpr size_t kAtVersion = 8, kAtDimension = 12, kAtSize = 16, kAtChecksum = 24, kAtFlags = 32, kAtVertexCount = 36,
                 kAtCellCount = 40, kAtSectionCount = 44, kAtSections = 48;
constexpr size_t kHeaderBytes = kAtSections + 8 * kSectionCount;
static_assert(kHeaderBytes % 8 == 0, "sections begin at multiples of 8");

struct Header {
  uint32_t flags = 0, vertex_count = 0, cell_count = 0;
  uint64_t bytes[kSectionCount] = {};
};

constexpr uint64_t padded(uint64_t bytes) { return (bytes + 7) & ~uint64_t{7}; }
constexpr uint64_t vertex_mark_words(uint64_t vertices) { return (vertices + 63) / 64; }

[[noreturn]] void corrupt(const char* what) { fail(DSW_STATUS_CORRUPT, "the snapshot is damaged: %s", what); }

template <int D>
Header header_of(const Environment<D>& env) {
  if (env.map.has_changed()) fail(DSW_STATUS_UNSUPPORTED, "the topology has changed, which snapshots do not keep yet");
  Header h;
  h.flags = env.grid.empty() ? 0 : kHasGrid;
  h.vertex_count = env.map.vertex_count;
  h.cell_count = env.map.cell_count;
  h.bytes[kWords] = env.map.words.size() * sizeof(uint32_t);
  h.bytes[kShapes] = env.map.shape_tables.size() * sizeof(uint16_t);
  h.bytes[kPoints] = uint64_t{env.map.vertex_count} * D * sizeof(double);
  h.bytes[kRegions] = env.regions.size() * sizeof(int32_t);
  h.bytes[kTags] = env.tags.size() * sizeof(uint32_t);
  h.bytes[kEdgeMarks] = env.edge_marks.size() * sizeof(uint64_t);
  h.bytes[kVertexMarks] = env.marked_vertices == 0 ? 0 : env.vertex_marks.size() * sizeof(uint64_t);
  return h;
}

uint64_t total_bytes(const Header& h) {
  uint64_t total = kHeaderBytes;
  for (const uint64_t bytes : h.bytes) total += padded(bytes);
  return total;
}

/** The sum of all bytes but its own. */
uint64_t block_checksum(const uint8_t* block, size_t size) {
  const uint64_t head = checksum(0, block, kAtChecksum);
  return checksum(head, block + kAtChecksum + 8, size - kAtChecksum - 8);
}

/** Where a block ends and what is in it, as it claims; checked against its true size and against each other. */
template <int D>
Header read_header(const uint8_t* block, size_t size) {
  if (size < kHeaderBytes) {
    fail(DSW_STATUS_TRUNCATED, "the snapshot has %zu bytes, its header alone needs %zu", size, kHeaderBytes);
  }
  if (std::memcmp(block, kMagic, sizeof kMagic) != 0) corrupt("it does not begin like one");
  uint32_t version, dimension, sections;
  uint64_t total, sum;
  fetch(&version, block + kAtVersion, 1);
  fetch(&dimension, block + kAtDimension, 1);
  fetch(&sections, block + kAtSectionCount, 1);
  fetch(&total, block + kAtSize, 1);
  fetch(&sum, block + kAtChecksum, 1);
  if (version != kFormatVersion) {
    fail(DSW_STATUS_BAD_VERSION, "the snapshot has format version %u, this library reads %u", version, kFormatVersion);
  }
  if (size < total) {
    fail(DSW_STATUS_TRUNCATED, "the snapshot has %zu of %llu bytes", size, static_cast<unsigned long long>(total));
  }
  if (size > total) corrupt("there are bytes behind its end");
  if (size % 8 != 0) corrupt("its size is no multiple of 8");
  if (block_checksum(block, size) != sum) corrupt("its checksum is wrong");
  if (dimension != D) corrupt("it has another dimension");
  if (sections != kSectionCount) corrupt("it has another number of sections");
  Header h;
  fetch(&h.flags, block + kAtFlags, 1);
  fetch(&h.vertex_count, block + kAtVertexCount, 1);
  fetch(&h.cell_count, block + kAtCellCount, 1);
  fetch(h.bytes, block + kAtSections, kSectionCount);
  for (const uint64_t bytes : h.bytes) {
    if (bytes > size) corrupt("a section is larger than the block");
  }
  if (total_bytes(h) != size) corrupt("the sizes of its sections do not add up");
  return h;
}

/** Whether each section has the size that the counts ask for. */
template <int D>
void check_sizes(const Header& h) {
  const uint64_t units = h.bytes[kWords] / (kUnitWords * sizeof(uint32_t));
  if ((h.flags & ~kHasGrid) != 0) corrupt("it has unknown flags");
  if (h.vertex_count > kVertexMask) corrupt("it has too many vertices");
  if (h.bytes[kWords] % (kUnitWords * sizeof(uint32_t)) != 0 || units >= kMostUnits) corrupt("records: size");
  if (h.cell_count == 0 || h.cell_count > units) corrupt("number of cells");
  if (h.bytes[kShapes] % sizeof(uint16_t) != 0 || h.bytes[kShapes] / sizeof(uint16_t) > UINT32_MAX)
    corrupt("shapes: size");
  if (h.bytes[kPoints] != uint64_t{h.vertex_count} * D * sizeof(double)) corrupt("points: size");
  for (const Section s : {kRegions, kTags}) {
    if (h.bytes[s] != 0 && h.bytes[s] != uint64_t{h.cell_count} * sizeof(uint32_t)) corrupt("labels: size");
  }
  if (h.bytes[kEdgeMarks] % sizeof(uint64_t) != 0) corrupt("marked edges: size");
  if (h.bytes[kVertexMarks] != 0 && h.bytes[kVertexMarks] != vertex_mark_words(h.vertex_count) * sizeof(uint64_t)) {
    corrupt("marked vertices: size");
  }
}

/** Reads sections in order; what pads them must be zero. */
class SectionReader {
 public:
  SectionReader(const Header& header, const uint8_t* at) : header_(header), at_(at) {}
  template <class T>
  void read(Section section, Array<T>& out) {
    const uint64_t bytes = header_.bytes[section];
    out.resize(static_cast<size_t>(bytes / sizeof(T)));
    fetch(out.data(), at_, out.size());
    for (uint64_t i = bytes; i < padded(bytes); ++i) {
      if (at_[i] != 0) corrupt("bytes between its sections");
    }
    at_ += padded(bytes);
  }

 private:
  const Header& header_;
  const uint8_t* at_;
};

/** Finds the shapes and where each record starts, by the rules of creation. */
template <int D>
void restore_layout(Map<D>& map) {
  Array<uint16_t> scratch(map.shape_tables.get_allocator());
  for (size_t at = 0; at < map.shape_tables.size();) {
    const size_t length = sound_table_length<D>(map.shape_tables.data() + at, map.shape_tables.size() - at, scratch);
    if (length == 0) corrupt("a shape");
    map.shape_offsets.push_back(static_cast<uint32_t>(at));
    at += length;
  }
  const uint32_t units = static_cast<uint32_t>(map.words.size() / kUnitWords);
  const auto units_at = [&](uint32_t unit) { return record_units(map, map.words[size_t{unit} * kUnitWords]); };
  const uint32_t first_units = units_at(0);
  bool uniform = first_units != 0 && uint64_t{map.cell_count} * first_units == units;
  for (uint32_t unit = 0; uniform && unit < units; unit += first_units) {
    const uint32_t word0 = map.words[size_t{unit} * kUnitWords];
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
    if (unit >= units) corrupt("records: fewer than cells");
    const uint32_t n = units_at(static_cast<uint32_t>(unit));
    if (n == 0) corrupt("a record's form");
    map.unit_of_cell[i] = static_cast<uint32_t>(unit);
    map.cell_of_unit[unit] = i;
    unit += n;
  }
  if (unit != units) corrupt("records: another number than cells");
}

template <int D>
void load_map(Map<D>& map) {
  restore_layout(map);
  count_facets(map, &map.facet_count, &map.boundary_facet_count);
  const char* const broken = check_integrity(map);
  if (broken != nullptr) corrupt(broken);
}

/** Every cell again: that it is valid, and that it says rightly whether it is convex. */
template <int D>
void check_cells(const Environment<D>& env) {
  const Map<D>& map = env.map;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const CellState state = check_cell(env, c);
    if (state != CellState::kValid && state != CellState::kValidConvex) corrupt("a cell is not valid");
    if (map.convex(c) != (state == CellState::kValidConvex)) corrupt("a cell is wrongly called convex, or not");
  }
}

/** Calls visit(edge key) for the edges of all cells, more than once for most. */
template <int D, class Visit>
void for_each_edge_key(const Map<D>& map, const Visit& visit) {
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    for (uint32_t d = 0, n = map.shape(c).dart_count(); d < n; ++d) {
      const uint64_t a = dart_vertex(map, {c, d}), b = dart_target(map, {c, d});
      visit(a < b ? a << 32 | b : b << 32 | a);
    }
  }
}

template <int D>
void load_edge_marks(Environment<D>& env, const Array<uint64_t>& keys) {
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i != 0 && keys[i - 1] >= keys[i]) corrupt("marked edges are not in order");
    const uint64_t a = keys[i] >> 32, b = keys[i] & 0xffffffffu;
    if (a >= b || b >= env.map.vertex_count) corrupt("a marked edge");
  }
  if (keys.empty()) return;
  Array<uint8_t> found(keys.size(), 0, Allocator<uint8_t>(env.memory));
  for_each_edge_key(env.map, [&](uint64_t key) {
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    if (at != keys.end() && *at == key) found[static_cast<size_t>(at - keys.begin())] = 1;
  });
  if (std::find(found.begin(), found.end(), 0) != found.end()) corrupt("a marked edge is none");
  env.edge_marks.reserve(keys.size());
  for (const uint64_t key : keys) {
    env.edge_marks.insert(static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key));
  }
}

/** Counts marks anew. */
template <int D>
void count_marks(Environment<D>& env) {
  const Map<D>& map = env.map;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    env.marked_cells += map.marked(c) ? 1u : 0u;
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (map.facet_marked(h) && canonical(map, h) == h) ++env.marked_facets;
    }
  }
  env.marked_edges = env.edge_marks.size();
  for (const uint64_t word : env.vertex_marks) {
    for (uint64_t bits = word; bits != 0; bits &= bits - 1) ++env.marked_vertices;
  }
  if (env.vertex_marks.empty()) return;
  const uint32_t used = map.vertex_count % 64;
  if (used != 0 && env.vertex_marks.back() >> used != 0) corrupt("a marked vertex");
  if (env.marked_vertices == 0) corrupt("marks of vertices without any");
}

/** The records as they are when points stay: cells of moving ones do not say that they are convex. */
template <int D>
Array<uint32_t> words_of_rest(const Environment<D>& env) {
  Array<uint32_t> words = env.map.words;
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    if (env.map.form(c) != Form::kSimplex && check_cell(env, c) == CellState::kValidConvex) {
      words[size_t{c.unit} * kUnitWords] |= kConvexBit;
    }
  }
  return words;
}

}  // namespace

template <int D>
size_t snapshot_bytes(const Environment<D>& env) {
  return static_cast<size_t>(total_bytes(header_of(env)));
}

template <int D>
void save(const Environment<D>& env, uint8_t* out) {
  const Header h = header_of(env);
  const uint64_t total = total_bytes(h);
  Array<uint64_t> edges{Allocator<uint64_t>(env.memory)};
  edges.reserve(env.edge_marks.size());
  env.edge_marks.copy_sorted(edges);

  std::memset(out, 0, kHeaderBytes);
  std::memcpy(out, kMagic, sizeof kMagic);
  const uint32_t dimension = D, sections = kSectionCount;
  store(out + kAtVersion, &kFormatVersion, 1);
  store(out + kAtDimension, &dimension, 1);
  store(out + kAtSize, &total, 1);
  store(out + kAtFlags, &h.flags, 1);
  store(out + kAtVertexCount, &h.vertex_count, 1);
  store(out + kAtCellCount, &h.cell_count, 1);
  store(out + kAtSectionCount, &sections, 1);
  store(out + kAtSections, h.bytes, kSectionCount);
  uint8_t* at = out + kHeaderBytes;
  const auto write = [&](Section section, const auto* values) {
    const uint64_t bytes = h.bytes[section];
    store(at, values, static_cast<size_t>(bytes / sizeof(*values)));
    std::fill(at + bytes, at + padded(bytes), uint8_t{0});
    at += padded(bytes);
  };
  write(kWords, env.checked.active() ? words_of_rest(env).data() : env.map.words.data());
  write(kShapes, env.map.shape_tables.data());
  write(kPoints, env.points);
  write(kRegions, env.regions.data());
  write(kTags, env.tags.data());
  write(kEdgeMarks, edges.data());
  write(kVertexMarks, env.vertex_marks.data());
  const uint64_t sum = block_checksum(out, static_cast<size_t>(total));
  store(out + kAtChecksum, &sum, 1);
}

template <int D>
void load(Environment<D>& env, const uint8_t* block, size_t size) {
  const Header h = read_header<D>(block, size);
  check_sizes<D>(h);
  Map<D>& map = env.map;
  map.vertex_count = h.vertex_count;
  map.cell_count = h.cell_count;
  Array<uint64_t> edges{Allocator<uint64_t>(env.memory)};
  SectionReader reader(h, block + kHeaderBytes);
  reader.read(kWords, map.words);
  reader.read(kShapes, map.shape_tables);
  reader.read(kPoints, env.owned_points);
  reader.read(kRegions, env.regions);
  reader.read(kTags, env.tags);
  reader.read(kEdgeMarks, edges);
  reader.read(kVertexMarks, env.vertex_marks);
  env.points = env.owned_points.data();
  for (const double x : env.owned_points) {
    if (!std::isfinite(x)) corrupt("a point is not finite");
  }
  load_map(map);
  check_cells(env);
  load_edge_marks(env, edges);
  count_marks(env);
  finish_topology(env, nullptr);
  if ((h.flags & kHasGrid) != 0) build_grid(env);
}

template size_t snapshot_bytes(const Environment<2>&);
template size_t snapshot_bytes(const Environment<3>&);
template void save(const Environment<2>&, uint8_t*);
template void save(const Environment<3>&, uint8_t*);
template void load(Environment<2>&, const uint8_t*, size_t);
template void load(Environment<3>&, const uint8_t*, size_t);

}  // namespace dsw
