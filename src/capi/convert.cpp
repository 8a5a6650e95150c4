#include "capi/convert.h"

namespace dsw::capi {
namespace {

template <class Id>
[[noreturn]] void fail_local(const Id& id, uint32_t count, const char* what, ArgumentName argument, size_t index) {
  fail(DSW_STATUS_STALE_ID, "%s {volume %u, generation %u, local %u}: the volume has %s 0 .. %u",
       ElementName(argument, index).text, id.volume, id.generation, id.local, what, count - 1);
}

template <int D, class Id>
Cell owner_of(const Map<D>& map, const Id& id, ArgumentName argument, size_t index) {
  if (!is_alive(map, dsw_volume_id{id.volume, id.generation})) {
    fail(DSW_STATUS_STALE_ID, "%s {volume %u, generation %u, local %u} names no volume that is alive; there are %u",
         ElementName(argument, index).text, id.volume, id.generation, id.local, map.cell_count);
  }
  return map.cell(id.volume);
}

template <int D>
[[noreturn]] void fail_volume(const Map<D>& map, dsw_volume_id id, ArgumentName argument, size_t index) {
  fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no volume that is alive; there are %u",
       ElementName(argument, index).text, id.index, id.generation, map.cell_count);
}

}  // namespace

template <int D>
Cell to_cell(const Map<D>& map, dsw_volume_id id, ArgumentName argument, size_t index) {
  if (!is_alive(map, id)) fail_volume(map, id, argument, index);
  return map.cell(id.index);
}

template <int D>
HalfFacet to_half_facet(const Map<D>& map, dsw_face_id id, ArgumentName argument, size_t index) {
  const Cell c = owner_of(map, id, argument, index);
  const uint32_t facets = map.facets_of(c);
  if (id.local >= facets) fail_local(id, facets, "faces", argument, index);
  return map.half_facet(c, id.local);
}

template <int D>
Dart to_dart(const Map<D>& map, dsw_edge_id id, ArgumentName argument, size_t index) {
  const Cell c = owner_of(map, id, argument, index);
  const uint32_t edges = map.shape(c).edge_count();
  if (id.local >= edges) fail_local(id, edges, "edges", argument, index);
  return dart_of_edge(map, c, id.local);
}

template <int D>
uint32_t to_vertex(const Map<D>& map, dsw_vertex_id id, ArgumentName argument, size_t index) {
  if (!map.is_vertex_alive(id.index, id.generation)) {
    fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no vertex that is alive; there are %u",
         ElementName(argument, index).text, id.index, id.generation, map.vertex_count);
  }
  return id.index;
}

void fail_kind(const char* name, dsw_cell_kind kind, int dimension) {
  fail(DSW_STATUS_UNSUPPORTED, "%s is %d, must be a vertex, %sface or volume", name, static_cast<int>(kind),
       dimension == 2 ? "" : "edge, ");
}

template <int D>
void check_hint(const Map<D>& map, dsw_volume_id id, const char* name) {
  if (!is_null(id) && !is_alive(map, id)) fail_volume(map, id, {name, false}, 0);
}

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
  for (size_t i = 0; i < count; ++i) {
    if (!is_null(ids[i]) && !is_alive(map, ids[i])) fail_volume(map, ids[i], {name, true}, i);
  }
}

void require_array(const void* array, size_t count, const char* name) {
  if (count != 0) require(array, name);
  // No array is so long: what a host gets that counts in signed numbers and ends below zero.
  if (count > PTRDIFF_MAX) fail(DSW_STATUS_WRONG_SIZE, "%s cannot have %zu entries", name, count);
}

template <int D>
size_t to_step(size_t count, size_t stride_bytes) {
  constexpr size_t kPoint = D * sizeof(double);
  if (stride_bytes == 0) stride_bytes = kPoint;
  if (stride_bytes < kPoint || stride_bytes % sizeof(double) != 0 || (count != 0 && stride_bytes > SIZE_MAX / count)) {
    fail(DSW_STATUS_WRONG_SIZE, "stride_bytes is %zu, must be 0 or a multiple of %zu from %zu on", stride_bytes,
         sizeof(double), kPoint);
  }
  return stride_bytes / sizeof(double);
}

template <int D>
PointArray to_points(const double* points, size_t count, size_t stride_bytes, const char* name) {
  const size_t step = to_step<D>(count, stride_bytes);
  require_array(points, count, name);
  return {points, step};
}

SegmentOptions to_options(const dsw_cast_options* options) {
  if (options == nullptr) return {};
  const dsw_cast_options o = read_struct(options, "options");
  check_flags(o.flags, DSW_CAST_START_KNOWN | DSW_CAST_NO_DETAIL, "options->flags");
  if (o.reserved != 0) fail(DSW_STATUS_UNSUPPORTED, "options->reserved is %u, must be 0", o.reserved);
  return {o.max_volumes, (o.flags & DSW_CAST_NO_DETAIL) == 0, (o.flags & DSW_CAST_START_KNOWN) != 0};
}

void check_flags(uint32_t flags, uint32_t known, const char* name) {
  if ((flags & ~known) != 0) {
    fail(DSW_STATUS_UNSUPPORTED, "%s is 0x%x, this version knows 0x%x", name, flags, known);
  }
}

SweepLevel to_level(const dsw_level& given, dsw_level highest, const char* name) {
  const uint32_t level = raw_value(given);
  if (level < DSW_LEVEL_POINTS || level > static_cast<uint32_t>(highest)) {
    fail(DSW_STATUS_UNSUPPORTED, "%s is %u, must be %d .. %d here", name, level, DSW_LEVEL_POINTS, highest);
  }
  return static_cast<SweepLevel>(level - DSW_LEVEL_POINTS);
}

dsw_level to_public(SweepLevel level) noexcept {
  return static_cast<dsw_level>(static_cast<uint32_t>(level) + DSW_LEVEL_POINTS);
}

void check_capacity(size_t needed, size_t capacity, const void* buffer, size_t* count) {
  require(count, "count");
  if (capacity < needed) {
    *count = needed;
    fail(DSW_STATUS_BUFFER_TOO_SMALL, "capacity is %zu, %zu are needed", capacity, needed);
  }
  require_array(buffer, needed, "buffer");
  *count = needed;
}

#define DSW_CONVERT(D)                                                                 \
  template Cell to_cell(const Map<D>&, dsw_volume_id, ArgumentName, size_t);           \
  template HalfFacet to_half_facet(const Map<D>&, dsw_face_id, ArgumentName, size_t);  \
  template Dart to_dart(const Map<D>&, dsw_edge_id, ArgumentName, size_t);             \
  template uint32_t to_vertex(const Map<D>&, dsw_vertex_id, ArgumentName, size_t);     \
  template void check_hint(const Map<D>&, dsw_volume_id, const char*);                 \
  template void check_hints(const Map<D>&, const dsw_volume_id*, size_t, const char*); \
  template size_t to_step<D>(size_t, size_t);                                          \
  template PointArray to_points<D>(const double*, size_t, size_t, const char*)
DSW_CONVERT(2);
DSW_CONVERT(3);
#undef DSW_CONVERT

}  // namespace dsw::capi
