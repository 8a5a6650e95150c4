#pragma once
// Structs that begin with their size, as recordings have them: the members one behind another, each of the size that it
// has where a pointer has 8 bytes. On such machines these are the bytes in memory. On others a struct is translated.

#include <cstdint>

#include "capi/describe.h"

namespace dsw::capi {

/** A member: where it lies in the struct, its bytes there, and its bytes in recordings. */
struct Field {
  size_t at, size, recorded;
};
/** The members of a recorded struct, all of them in their order. */
template <class T>
struct Fields;

/** False for pointers and size_t. Where pointers have 4 bytes size_t can be the type of other numbers, too. */
template <class T>
constexpr bool has_one_size = !std::is_pointer_v<T> && (sizeof(size_t) == 4 || !std::is_same_v<T, size_t>);

/** A member that has the same size on every machine. */
template <class M>
constexpr Field same_field(size_t at) {
  static_assert(has_one_size<M>, "name it in DSW_WIDE");
  return {at, sizeof(M), sizeof(M)};
}
/** A pointer, or an integer without a sign, that has 8 bytes in recordings. */
template <class M>
constexpr Field wide_field(size_t at) {
  static_assert(std::is_pointer_v<M> || std::is_unsigned_v<M>);
  static_assert(sizeof(M) == 4 || sizeof(M) == 8);
  return {at, sizeof(M), 8};
}

/** Bytes of a struct in a recording of this version. */
template <class T>
constexpr size_t recorded_size() {
  size_t size = 0;
  for (const Field& each : Fields<T>::all) size += each.recorded;
  return size;
}
/** Bytes in a recording of a struct as it was in the release that introduced it. */
template <class T>
constexpr size_t recorded_first_size() {
  size_t size = 0;
  for (const Field& each : Fields<T>::all) {
    size += each.recorded;
    if (each.at + each.size == first_size<T>) return size;
  }
  return 0;
}
/** Whether a struct lies in memory as in a recording. */
template <class T>
constexpr bool lies_as_recorded() {
  size_t at = 0;
  for (const Field& each : Fields<T>::all) {
    if (each.at != at || each.size != each.recorded) return false;
    at += each.recorded;
  }
  return at == sizeof(T);
}

#define DSW_FIELDS(type, ...)                     \
  template <>                                     \
  struct Fields<type> {                           \
    using T = type;                               \
    static constexpr Field all[] = {__VA_ARGS__}; \
  };                                              \
  static_assert(lies_as_recorded<type>() || sizeof(void*) != 8, "a member is missing, or there is padding")
#define DSW_SAME(member) same_field<decltype(T::member)>(offsetof(T, member))
#define DSW_WIDE(member) wide_field<decltype(T::member)>(offsetof(T, member))
// clang-format off
DSW_FIELDS(dsw_volumes_desc,
  DSW_SAME(struct_size), DSW_SAME(index_bytes), DSW_WIDE(vertices), DSW_WIDE(vertex_count), DSW_WIDE(points),
  DSW_WIDE(point_count), DSW_WIDE(point_stride_bytes), DSW_WIDE(cell_types), DSW_WIDE(volume_count), DSW_WIDE(offsets),
  DSW_WIDE(connectivity), DSW_WIDE(connectivity_count), DSW_WIDE(regions), DSW_WIDE(tags), DSW_WIDE(sew_to),
  DSW_WIDE(sew_count), DSW_SAME(uniform_cell_type), DSW_SAME(reserved));
DSW_FIELDS(dsw_cut_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_WIDE(points), DSW_WIDE(point_stride_bytes), DSW_SAME(rows),
  DSW_SAME(columns), DSW_SAME(start), DSW_SAME(snap));
DSW_FIELDS(dsw_open_crack_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_WIDE(faces), DSW_WIDE(face_count), DSW_SAME(width), DSW_SAME(region),
  DSW_SAME(tag));
DSW_FIELDS(dsw_carve_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_WIDE(points), DSW_WIDE(point_count), DSW_WIDE(point_stride_bytes),
  DSW_WIDE(triangles), DSW_WIDE(triangle_count), DSW_SAME(start), DSW_SAME(snap), DSW_SAME(finest));
DSW_FIELDS(dsw_tie_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_WIDE(points), DSW_WIDE(point_count), DSW_WIDE(point_stride_bytes),
  DSW_SAME(start), DSW_SAME(snap));
DSW_FIELDS(dsw_detach_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(level), DSW_SAME(category), DSW_SAME(mask), DSW_SAME(halvings),
  DSW_SAME(motion_share), DSW_SAME(gap), DSW_SAME(volume), DSW_WIDE(max_volumes));
DSW_FIELDS(dsw_remesh_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_WIDE(volumes), DSW_WIDE(volume_count), DSW_WIDE(next),
  DSW_WIDE(point_count), DSW_SAME(radius), DSW_SAME(max_faces));
DSW_FIELDS(dsw_deform_options,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(method), DSW_SAME(response), DSW_SAME(invalid),
  DSW_SAME(most_halvings), DSW_SAME(min_part), DSW_WIDE(point_room), DSW_SAME(remesh_radius),
  DSW_SAME(remesh_max_faces), DSW_SAME(max_holds), DSW_SAME(reserved));
DSW_FIELDS(dsw_body_desc,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(level), DSW_SAME(reserved), DSW_WIDE(positions),
  DSW_WIDE(vertex_count), DSW_WIDE(stride_bytes), DSW_WIDE(hints), DSW_WIDE(edges), DSW_WIDE(edge_count),
  DSW_WIDE(face_offsets), DSW_WIDE(face_corners), DSW_WIDE(face_count), DSW_WIDE(face_corner_count),
  DSW_SAME(motion_share), DSW_SAME(category), DSW_SAME(mask), DSW_SAME(radius));
DSW_FIELDS(dsw_move_options,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(vertex_response), DSW_SAME(edge_response), DSW_SAME(search),
  DSW_SAME(bisection_depth), DSW_SAME(max_volumes), DSW_SAME(passes), DSW_SAME(min_part), DSW_SAME(min_length),
  DSW_SAME(stand_off), DSW_SAME(noise_share), DSW_WIDE(order), DSW_WIDE(order_count));
DSW_FIELDS(dsw_together_options,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(stop), DSW_SAME(max_rounds), DSW_SAME(max_work),
  DSW_SAME(response));
DSW_FIELDS(dsw_scene_deform_options,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(stop), DSW_SAME(max_rounds), DSW_SAME(max_work),
  DSW_SAME(response), DSW_WIDE(point_room));
DSW_FIELDS(dsw_cast_options,
  DSW_SAME(struct_size), DSW_SAME(flags), DSW_SAME(max_volumes), DSW_SAME(reserved));
DSW_FIELDS(dsw_validation,
  DSW_SAME(struct_size), DSW_SAME(is_right), DSW_WIDE(places), DSW_WIDE(lost), DSW_WIDE(edges), DSW_WIDE(crossing),
  DSW_WIDE(faces), DSW_WIDE(pierced), DSW_WIDE(ways), DSW_WIDE(missed), DSW_WIDE(contacts), DSW_WIDE(wrong),
  DSW_WIDE(not_validated), DSW_SAME(text));
// clang-format on
#undef DSW_FIELDS
#undef DSW_SAME
#undef DSW_WIDE

/** Writes a struct as a recording has it. */
template <class T>
void to_recorded(const T& value, uint8_t (&bytes)[recorded_size<T>()]) noexcept {
  const auto* const from = reinterpret_cast<const uint8_t*>(&value);
  uint8_t* to = bytes;
  for (const Field& each : Fields<T>::all) {
    if (each.size == each.recorded) {
      std::memcpy(to, from + each.at, each.size);
    } else {
      uint32_t narrow;
      std::memcpy(&narrow, from + each.at, sizeof narrow);
      const uint64_t wide = narrow;
      std::memcpy(to, &wide, sizeof wide);
    }
    to += each.recorded;
  }
  constexpr auto kSize = static_cast<uint32_t>(recorded_size<T>());
  std::memcpy(bytes, &kSize, sizeof kSize);
}
/** Reads a recorded struct of any size, as read_struct does. A number that is too large becomes the largest one. */
template <class T>
T from_recorded(const void* recorded, const char* name) {
  uint8_t bytes[recorded_size<T>()] = {};
  copy_known<recorded_first_size<T>(), sizeof bytes>(bytes, recorded, name);
  T own{};
  auto* const to = reinterpret_cast<uint8_t*>(&own);
  const uint8_t* from = bytes;
  for (const Field& each : Fields<T>::all) {
    if (each.size == each.recorded) {
      std::memcpy(to + each.at, from, each.size);
    } else {
      uint64_t wide;
      std::memcpy(&wide, from, sizeof wide);
      const auto narrow = static_cast<uint32_t>(std::min<uint64_t>(wide, UINT32_MAX));
      std::memcpy(to + each.at, &narrow, sizeof narrow);
    }
    from += each.recorded;
  }
  own.struct_size = sizeof(T);
  return own;
}

/** Calls use(bytes, size) with a struct as a recording has it. */
template <class T, class Use>
void use_recorded(const T& value, const Use& use) {
  if constexpr (lies_as_recorded<T>()) {
    use(&value, sizeof value);
  } else {
    uint8_t bytes[recorded_size<T>()];
    to_recorded(value, bytes);
    use(bytes, sizeof bytes);
  }
}
/** Reads a recorded struct. */
template <class T>
T read_recorded(const void* recorded, const char* name) {
  if constexpr (lies_as_recorded<T>()) {
    return read_struct(static_cast<const T*>(recorded), name);
  } else {
    return from_recorded<T>(recorded, name);
  }
}

}  // namespace dsw::capi
