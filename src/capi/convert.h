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

namespace dsw::capi {

template <int D>
Cell to_cell(const Map<D>& map, dsw_volume_id id, ArgumentName argument, size_t index = 0);
template <int D>
HalfFacet to_half_facet(const Map<D>& map, dsw_face_id id, ArgumentName argument, size_t index = 0);
/** One dart of the edge, in the plane of the side with the numbers of its face id. */
template <int D>
Dart to_dart(const Map<D>& map, dsw_edge_id id, ArgumentName argument, size_t index = 0);
template <int D>
uint32_t to_vertex(const Map<D>& map, dsw_vertex_id id, ArgumentName argument, size_t index = 0);

/** An array of `count` things; null is allowed when there are none. A count that no array can have is WRONG_SIZE. */
void require_array(const void* array, size_t count, const char* name);

// By the type of the id.
template <int D>
Cell to_engine(const Map<D>& map, dsw_volume_id id, ArgumentName argument, size_t index) {
  return to_cell(map, id, argument, index);
}
template <int D>
HalfFacet to_engine(const Map<D>& map, dsw_face_id id, ArgumentName argument, size_t index) {
  return to_half_facet(map, id, argument, index);
}
template <int D>
Dart to_engine(const Map<D>& map, dsw_edge_id id, ArgumentName argument, size_t index) {
  return to_dart(map, id, argument, index);
}
template <int D>
uint32_t to_engine(const Map<D>& map, dsw_vertex_id id, ArgumentName argument, size_t index) {
  return to_vertex(map, id, argument, index);
}

/** An array of ids in the engine's terms, on the stack if they are few. */
template <class Id>
class Converted {
  using T = decltype(to_engine(std::declval<const Map<3>&>(), Id{}, ArgumentName{}, 0));

 public:
  template <int D>
  Converted(const Environment<D>& env, const Id* ids, size_t count, const char* name)
      : count_(count), many_(Allocator<T>(env.memory)) {
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
void check_hint(const Map<D>& map, dsw_volume_id id, const char* name);
/** Likewise; null gives a cell that is not valid. */
template <int D>
Cell to_hint(const Map<D>& map, dsw_volume_id id, const char* name) {
  check_hint(map, id, name);
  return is_null(id) ? Cell{} : map.cell(id.index);
}
/** `ids` may be null. */
template <int D>
void check_hints(const Map<D>& map, const dsw_volume_id* ids, size_t count, const char* name);

/** `dimension`: of the environment, which says what there is. */
[[noreturn]] void fail_kind(const char* name, dsw_cell_kind kind, int dimension);

/** Calls the function of `visitor` that suits the kind of a cell: vertex(uint32_t), edge(Dart) in space,
 * face(HalfFacet) or volume(Cell). */
template <int D, class Visitor>
auto visit_cell(const Map<D>& map, dsw_cell cell, const Visitor& visitor) {
  const ArgumentName name{"cell", false};
  switch (cell.kind) {
    case DSW_CELL_VERTEX:
      return visitor.vertex(to_vertex(map, {cell.index, cell.generation}, name));
    case DSW_CELL_EDGE:
      if constexpr (D == 3) return visitor.edge(to_dart(map, {cell.index, cell.generation, cell.local}, name));
      break;
    case DSW_CELL_FACE:
      return visitor.face(to_half_facet(map, {cell.index, cell.generation, cell.local}, name));
    case DSW_CELL_VOLUME:
      return visitor.volume(to_cell(map, {cell.index, cell.generation}, name));
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

/** As many finite coordinates as there are dimensions. */
template <int D>
void check_point(const double* point, const char* name) {
  require(point, name);
  check_finite({point, D}, 1, D, {name, false});
}

/** The host's stride in doubles. */
template <int D>
size_t to_step(size_t count, size_t stride_bytes);

/** An array of points with the host's stride, not yet checked to be finite. */
template <int D>
PointArray to_points(const double* points, size_t count, size_t stride_bytes, const char* name);

/** Likewise, and finite. */
template <int D>
PointArray to_finite_points(const double* points, size_t count, size_t stride_bytes, const char* name) {
  const PointArray all = to_points<D>(points, count, stride_bytes, name);
  check_finite(all, count, D, {name, true});
  return all;
}

/** How cells are repaired; 0 means the default. Throws OUT_OF_RANGE. */
RepairSettings to_repair_settings(uint32_t radius, uint32_t max_faces);

/** Options of a flight; null: defaults. */
SegmentOptions to_options(const dsw_cast_options* options);

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

/** Refuses flags that this version does not know. */
void check_flags(uint32_t flags, uint32_t known, const char* name);

/** An array that is kept for the host. */
template <class T>
void hand_out(const Array<T>& array, const T** items, size_t* count, const char* name) {
  require(items, name);
  require(count, "count");
  *items = array.data();
  *count = array.size();
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
void copy_ids(size_t slot_count, const SlotPool& slots, Id* out, size_t capacity, size_t* count) {
  check_capacity(slots.alive_count(), capacity, out, count);
  for (uint32_t i = 0; i < slot_count; ++i) {
    if (slots.alive(i, slots.generation(i))) *out++ = {i, slots.generation(i)};
  }
}

}  // namespace dsw::capi
