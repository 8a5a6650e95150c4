#include "capi/convert.h"

#include "topology/repair.h"

namespace dsw::capi {

void fail_stale(uint32_t index, uint32_t generation, const char* kind, uint32_t count, ElementName name) {
  fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no %s that is alive; there are %u", name.text, index,
       generation, kind, count);
}

void fail_stale(dsw_face_id id, const char* parts, uint32_t count, ElementName name) {
  if (parts == nullptr) {
    fail(DSW_STATUS_STALE_ID, "%s {volume %u, generation %u, local %u} names no volume that is alive; there are %u",
         name.text, id.volume, id.generation, id.local, count);
  }
  fail(DSW_STATUS_STALE_ID, "%s {volume %u, generation %u, local %u}: the volume has %s 0 .. %u", name.text, id.volume,
       id.generation, id.local, parts, count - 1);
}

void fail_kind(const char* name, dsw_cell_kind kind, int dimension) {
  fail(DSW_STATUS_UNSUPPORTED, "%s is %d, must be a vertex, %sface or volume", name, static_cast<int>(kind),
       dimension == 2 ? "" : "edge, ");
}

void check_enabled(bool enabled, const char* feature) {
  if (!enabled) fail(DSW_STATUS_NOT_ENABLED, "the scene does not enable %s", feature);
}

SegmentOptions to_options(const dsw_cast_options* options, uint32_t other) {
  const dsw_cast_options o = read_optional(options, "options", DSW_CAST_START_KNOWN | DSW_CAST_NO_DETAIL | other);
  if (o.reserved != 0) fail(DSW_STATUS_UNSUPPORTED, "options->reserved is %u, must be 0", o.reserved);
  return {o.max_volumes, (o.flags & DSW_CAST_NO_DETAIL) == 0, (o.flags & DSW_CAST_START_KNOWN) != 0,
          (o.flags & DSW_CAST_OPEN_ENDS) != 0, (o.flags & DSW_CAST_LEAVE) != 0};
}

uint32_t to_count(uint32_t given, uint32_t last, uint32_t instead, const char* name) {
  if (given > last) fail(DSW_STATUS_OUT_OF_RANGE, "%s is %u, must be 1 to %u, or 0", name, given, last);
  return given == 0 ? instead : given;
}

double to_length(double given, const char* name) {
  if (given >= 0 && std::isfinite(given)) return given;
  fail(DSW_STATUS_OUT_OF_RANGE, "%s is %g, must be finite and not negative", name, given);
}

double to_quarter(double given, double instead, const char* name) {
  if (given >= 0 && given <= 0.25) return given == 0 ? instead : given;
  fail(DSW_STATUS_OUT_OF_RANGE, "%s is %g, must be above 0 and at most 0.25, or 0", name, given);
}

double to_min_part(double given, double instead) {
  if (given >= 0 && given <= 0.5) return given == 0 ? instead : given;
  fail(DSW_STATUS_OUT_OF_RANGE, "options->min_part is %g, must be in (0, 0.5], or 0", given);
}

void check_edge_parameter(double given) {
  if (given > 0 && given < 1) return;
  fail(DSW_STATUS_OUT_OF_RANGE, "edge_parameter is %g, must be above 0 and below 1", given);
}

SweepLevel to_level(const dsw_level& given, dsw_level highest, const char* name) {
  const uint32_t level = raw_value(given);
  if (level < DSW_LEVEL_POINTS || level > static_cast<uint32_t>(highest)) {
    fail(DSW_STATUS_UNSUPPORTED, "%s is %u, must be %d .. %d here", name, level, DSW_LEVEL_POINTS, highest);
  }
  return static_cast<SweepLevel>(level - DSW_LEVEL_POINTS);
}

RepairSettings to_repair_settings(uint32_t radius, uint32_t max_faces) {
  RepairSettings s;
  if (radius > 8) fail(DSW_STATUS_OUT_OF_RANGE, "the radius is %u, must be 1 to 8, or 0", radius);
  if (max_faces != 0 && (max_faces < 4 || max_faces > kMostRim)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "max_faces is %u, must be 4 to %u, or 0", max_faces, kMostRim);
  }
  if (radius != 0) s.radius = radius;
  if (max_faces != 0) s.most_faces = max_faces;
  return s;
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
  if (needed != 0) require(buffer, "buffer");
  *count = needed;
}

}  // namespace dsw::capi
