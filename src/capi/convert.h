#pragma once
// Ids and arrays as the host gives them, checked and turned into the engine's. Every function throws a status that
// names the argument.

#include <cstring>

#include "base/points.h"
#include "capi/describe.h"
#include "capi/handle.h"
#include "map/dart.h"
#include "query/report.h"
#include "query/segments.h"
#include "query/sweeps.h"
#include "topology/edit.h"

namespace dsw {
struct RepairSettings;
}

namespace dsw::capi {

/** Throws STALE_ID, with the id of a volume or a vertex; `kind` is its name, `count` how many are alive. */
[[noreturn]] void fail_stale(uint32_t index, uint32_t generation, const char* kind, uint32_t count, ElementName name);
/** Throws STALE_ID, with the id of a face or an edge. `count`: of volumes, or with `parts` of the volume's parts. */
[[noreturn]] void fail_stale(dsw_face_id id, const char* parts, uint32_t count, ElementName name);

/** The volume, vertex, face or edge that an id names. Throws STALE_ID. */
template <int D>
Cell to_engine(const Map<D>& map, dsw_volume_id id, ArgumentName argument, size_t index = 0) {
  if (!is_alive(map, id)) fail_stale(id.index, id.generation, "volume", map.cell_count, {argument, index});
  return map.cell(id.index);
}
template <int D>
uint32_t to_engine(const Map<D>& map, dsw_vertex_id id, ArgumentName argument, size_t index = 0) {
  if (map.is_vertex_alive(id.index, id.generation)) return id.index;
  fail_stale(id.index, id.generation, "vertex", map.vertex_count, {argument, index});
}
/** The volume of a face or an edge, which has `count(volume)` of these `parts`. */
template <int D, class Count>
Cell to_owner(const Map<D>& map, dsw_face_id id, const char* parts, const Count& count, ArgumentName argument,
              size_t index) {
  if (!is_alive(map, dsw_volume_id{id.volume, id.generation})) {
    fail_stale(id, nullptr, map.cell_count, {argument, index});
  }
  const Cell c = map.cell(id.volume);
  if (id.local >= count(c)) fail_stale(id, parts, count(c), {argument, index});
  return c;
}
template <int D>
HalfFacet to_engine(const Map<D>& map, dsw_face_id id, ArgumentName argument, size_t index = 0) {
  const auto count = [&](Cell c) { return map.facets_of(c); };
  return map.half_facet(to_owner(map, id, "faces", count, argument, index), id.local);
}
/** One dart of the edge, in the plane of the side with the numbers of its face id. */
template <int D>
Dart to_engine(const Map<D>& map, dsw_edge_id id, ArgumentName argument, size_t index = 0) {
  const auto count = [&](Cell c) { return map.shape(c).edge_count(); };
  const dsw_face_id numbers{id.volume, id.generation, id.local};
  return dart_of_edge(map, to_owner(map, numbers, "edges", count, argument, index), id.local);
}

/** An array of ids in the engine's terms, on the stack if they are few. */
template <class Id>
class Converted {
  using T = decltype(to_engine(std::declval<const Map<3>&>(), Id{}, "", 0));

 public:
  template <int D>
  Converted(const Environment<D>& env, const Id* ids, size_t count, const char* name)
      : count_(count), many_(env.memory) {
    require_array(ids, count, name);
    if (count > kFew) many_.resize(count);
    for (size_t i = 0; i < count; ++i) data()[i] = to_engine(env.map, ids[i], {name, true}, i);
  }
  T* data() { return many_.empty() ? few_ : many_.data(); }
  T* begin() { return data(); }
  T* end() { return data() + count_; }
  T& operator[](size_t i) { return data()[i]; }

 private:
  static constexpr size_t kFew = 64;
  size_t count_;
  T few_[kFew];
  Array<T> many_;
};

/** A hint or start: alive or null. */
template <int D>
void check_hint(const Map<D>& map, dsw_volume_id id, ArgumentName argument, size_t index = 0) {
  if (!is_null(id)) to_engine(map, id, argument, index);
}
/** Gives the cell of a hint, which is alive or null; a null hint gives a cell that is not valid. */
template <int D>
Cell to_hint(const Map<D>& map, dsw_volume_id id, const char* name) {
  return is_null(id) ? Cell{} : to_engine(map, id, name);
}
/** `ids` may be null. */
template <int D>
void check_hints(const Map<D>& map, const dsw_volume_id* ids, size_t count, const char* name) {
  if (ids == nullptr) return;
  if (!map.has_changed()) {
    const uint32_t cell_count = map.cell_count;
    uint32_t bad = 0;  // without branches: this runs over every cast of a batch
    for (size_t i = 0; i < count; ++i) {
      const uint32_t index = ids[i].index, generation = ids[i].generation;
      const bool alive = (generation == 1) & (index < cell_count);
      bad |= static_cast<uint32_t>(!alive & ((index | generation) != 0));
    }
    if (bad == 0) return;
  }
  for (size_t i = 0; i < count; ++i) check_hint(map, ids[i], {name, true}, i);
}

/** `dimension`: of the environment, which says what there is. */
[[noreturn]] void fail_kind(const char* name, dsw_cell_kind kind, int dimension);

/** Calls the function of `visitor` that suits the kind of a cell: vertex(uint32_t), edge(Dart) in space,
 * face(HalfFacet) or volume(Cell). */
template <int D, class Visitor>
auto visit_cell(const Map<D>& map, dsw_cell cell, const Visitor& visitor) {
  const auto [kind, index, generation, local] = cell;
  switch (kind) {
    case DSW_CELL_VERTEX:
      return visitor.vertex(to_engine(map, dsw_vertex_id{index, generation}, "cell"));
    case DSW_CELL_EDGE:
      if constexpr (D == 3) return visitor.edge(to_engine(map, dsw_edge_id{index, generation, local}, "cell"));
      break;
    case DSW_CELL_FACE:
      return visitor.face(to_engine(map, dsw_face_id{index, generation, local}, "cell"));
    case DSW_CELL_VOLUME:
      return visitor.volume(to_engine(map, dsw_volume_id{index, generation}, "cell"));
    default:
      break;
  }
  fail_kind("cell.kind", cell.kind, D);
}

using dsw::edge_id;
template <int D>
dsw_vertex_id vertex_id(const Map<D>& map, uint32_t vertex) noexcept {
  return {vertex, map.vertex_generation(vertex)};
}

/** How cells are repaired; 0 means the default. Throws OUT_OF_RANGE. */
RepairSettings to_repair_settings(uint32_t radius, uint32_t max_faces);

/** Throws NOT_ENABLED unless the scene was made with a feature. */
void check_enabled(bool enabled, const char* feature);

/** Options of a flight; null: defaults.
 * @param other flags that the function knows besides those of every flight. */
SegmentOptions to_options(const dsw_cast_options* options, uint32_t other = 0);

/** Refuses levels that are unknown or above `highest`. */
SweepLevel to_level(const dsw_level& given, dsw_level highest, const char* name);
dsw_level to_public(SweepLevel level) noexcept;

/** The number in an enum that a host has set, also one that the enum cannot hold. */
template <class Enum>
uint32_t raw_value(const Enum& given) noexcept {
  uint32_t value;
  std::memcpy(&value, &given, sizeof value);
  return value;
}
/** Gives the number in an enum that a host has set, and refuses a number above `last`. */
template <class Enum>
uint32_t to_number(const Enum& given, uint32_t last, const char* name) {
  const uint32_t value = raw_value(given);
  if (value > last) fail(DSW_STATUS_UNSUPPORTED, "%s is %u, this version knows 0 .. %u", name, value, last);
  return value;
}

// Options that are numbers, refused where they are out of range. Where there is an `instead`, 0 stands for that.
uint32_t to_count(uint32_t given, uint32_t last, uint32_t instead, const char* name);
double to_length(double given, const char* name);
double to_quarter(double given, double instead, const char* name);
double to_min_part(double given, double instead);
void check_edge_parameter(double given);

/** An array that is kept for the host. */
template <class T>
void hand_out(const T* kept, size_t size, const T** items, size_t* count, const char* name) {
  require(items, name);
  require(count, "count");
  *items = kept;
  *count = size;
}
template <class T>
void hand_out(const Array<T>& array, const T** items, size_t* count, const char* name) {
  hand_out(array.data(), array.size(), items, count, name);
}

/** Gives a result to a host that has to take it. */
template <class T>
void give(T* out, const char* name, const T& value) {
  require(out, name);
  *out = value;
}

/** Sets `count` and fails if there is no room. */
void check_capacity(size_t needed, size_t capacity, const void* buffer, size_t* count);

/** Copies the ids of what lives in slots. */
template <class Id>
void copy_ids(const SlotPool& slots, Id* out, size_t capacity, size_t* count) {
  check_capacity(slots.alive_count(), capacity, out, count);
  for (uint32_t i = 0; i < slots.slot_count(); ++i) {
    if (slots.alive(i, slots.generation(i))) *out++ = {i, slots.generation(i)};
  }
}

}  // namespace dsw::capi
