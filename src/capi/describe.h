#pragma once
// Structs that begin with their size: how a program built against an older or newer header is understood.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "capi/guard.h"
#include "dartsweep/dartsweep.h"

namespace dsw::capi {

/** Size of each struct in the release that introduced it; never changes when members are appended. */
template <class T>
constexpr size_t first_size = 0;
#define DSW_FIRST_SIZE(type, last_member) \
  template <>                             \
  inline constexpr size_t first_size<type> = offsetof(type, last_member) + sizeof(type::last_member)
DSW_FIRST_SIZE(dsw_context_desc, parallel_for);
DSW_FIRST_SIZE(dsw_environment_desc, reserved);
DSW_FIRST_SIZE(dsw_build_report, convex_volume_count);
DSW_FIRST_SIZE(dsw_volumes_desc, reserved);
DSW_FIRST_SIZE(dsw_environment_info, upper);
DSW_FIRST_SIZE(dsw_cast_options, reserved);
DSW_FIRST_SIZE(dsw_sweep_options, max_volumes);
DSW_FIRST_SIZE(dsw_scene_desc, features);
DSW_FIRST_SIZE(dsw_statistics, candidates);
DSW_FIRST_SIZE(dsw_body_desc, motion_share);
DSW_FIRST_SIZE(dsw_body_counts, reserved);
DSW_FIRST_SIZE(dsw_move_options, order_count);
DSW_FIRST_SIZE(dsw_near_options, radius);
DSW_FIRST_SIZE(dsw_together_options, response);
DSW_FIRST_SIZE(dsw_scene_deform_options, point_room);
DSW_FIRST_SIZE(dsw_deform_options, min_part);
DSW_FIRST_SIZE(dsw_cut_desc, snap);
DSW_FIRST_SIZE(dsw_carve_desc, snap);
DSW_FIRST_SIZE(dsw_tie_desc, snap);
DSW_FIRST_SIZE(dsw_open_crack_desc, tag);
DSW_FIRST_SIZE(dsw_detach_desc, max_volumes);
DSW_FIRST_SIZE(dsw_remesh_desc, max_faces);
DSW_FIRST_SIZE(dsw_coarsen_options, max_trials);
DSW_FIRST_SIZE(dsw_coarsen_report, trials);
DSW_FIRST_SIZE(dsw_recording_desc, user);
DSW_FIRST_SIZE(dsw_replay_info, validation);
DSW_FIRST_SIZE(dsw_validation, text);
DSW_FIRST_SIZE(dsw_bug_report_desc, note);
DSW_FIRST_SIZE(dsw_trace_data, triangle_count);
DSW_FIRST_SIZE(dsw_change, body_face_count);
#undef DSW_FIRST_SIZE

/** No struct will ever be larger: what claims to be is garbage and must not be read. */
constexpr size_t kLargestStruct = 4096;

/** Checks a struct_size; `name` is the parameter's. kFirst, kKnown: the size in the first release and the size now. */
template <size_t kFirst, size_t kKnown>
void check_size(uint32_t size, const char* name) {
  static_assert(kFirst != 0 && kFirst <= kKnown);
  if (size < kFirst) {
    fail(DSW_STATUS_BAD_STRUCT_SIZE, "%s->struct_size is %u, must be at least %zu", name, size, kFirst);
  }
  if (size > kLargestStruct) {
    fail(DSW_STATUS_UNSUPPORTED, "%s->struct_size is %u, this version knows %zu", name, size, kKnown);
  }
}
/** Checks the struct_size of a caller's struct. */
template <class T>
void check_size(const T* given, const char* name) {
  static_assert(offsetof(T, struct_size) == 0);
  check_size<first_size<T>, sizeof(T)>(given->struct_size, name);
}

/** Copies what is known of a struct of any size into zeros. What is unknown must be 0. */
template <size_t kFirst, size_t kKnown>
void copy_known(void* own, const void* given, const char* name) {
  uint32_t size;
  std::memcpy(&size, given, sizeof size);
  check_size<kFirst, kKnown>(size, name);
  const auto* bytes = static_cast<const unsigned char*>(given);
  for (size_t i = kKnown; i < size; ++i) {
    if (bytes[i] != 0) {
      fail(DSW_STATUS_UNSUPPORTED,
           "%s has a non-zero byte at %zu, in a member this version does not know (it knows %zu)", name, i, kKnown);
    }
  }
  std::memcpy(own, given, std::min<size_t>(size, kKnown));
}

/** Reads a caller's struct of any size: members it lacks are 0, members unknown here must be. */
template <class T>
T read_struct(const T* given, const char* name) {
  static_assert(offsetof(T, struct_size) == 0);
  T own{};
  copy_known<first_size<T>, sizeof(T)>(&own, given, name);
  own.struct_size = sizeof(T);
  return own;
}

/** Reads a caller's struct as read_struct does; null gives a struct in which every other member is 0. */
template <class T>
T read_optional(const T* given, const char* name) {
  if (given != nullptr) return read_struct(given, name);
  T own{};
  own.struct_size = sizeof(T);
  return own;
}
/** Reads a caller's struct, which may be null, and refuses flags that are not known. */
template <class T>
T read_optional(const T* given, const char* name, uint32_t known_flags) {
  const T own = read_optional(given, name);
  check_flags(own.flags, known_flags, name, "->flags");
  return own;
}
/** Reads a caller's struct and refuses null. */
template <class T, class... KnownFlags>
T read_required(const T* given, const char* name, KnownFlags... known) {
  require(given, name);
  return read_optional(given, name, static_cast<uint32_t>(known)...);
}

/** Writes into a struct whose size was checked: at most what it can hold, zeros into members unknown here. */
template <class T>
void write_struct(T* out, const T& value) {
  const uint32_t size = out->struct_size;
  auto* bytes = reinterpret_cast<unsigned char*>(out);
  std::memcpy(bytes, &value, std::min<size_t>(size, sizeof(T)));
  if (size > sizeof(T)) std::memset(bytes + sizeof(T), 0, size - sizeof(T));
  out->struct_size = size;
}

/** Gives a result in a caller's struct of any size. */
template <class T>
void give_struct(T* out, const char* name, const T& value) {
  require(out, name);
  check_size(out, name);
  write_struct(out, value);
}

}  // namespace dsw::capi
