// A checksum of results. Machines that compute the same bits have the same one.
#pragma once

#include "dartsweep/dartsweep.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace dsw::portable {

/// FNV-1a in 64 bits. Every number counts as eight bytes, the lowest first. Structs are added member by member, so
/// neither padding nor pointers nor sizes of memory are.
class Sum {
 public:
  template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number> || std::is_enum_v<Number>>>
  Sum& operator<<(Number number) {
    if constexpr (std::is_same_v<Number, double>) {
      uint64_t bits;
      std::memcpy(&bits, &number, sizeof bits);
      return add(bits);
    } else {
      static_assert(!std::is_floating_point_v<Number>);
      return add(static_cast<uint64_t>(number));
    }
  }
  template <class T, size_t N>
  Sum& operator<<(const T (&items)[N]) {
    for (const T& each : items) *this << each;
    return *this;
  }
  template <class... Parts>
  Sum& all(const Parts&... parts) {
    return (*this << ... << parts);
  }
  /// Their number, then each.
  template <class T>
  Sum& list(const T* items, size_t count) {
    *this << count;
    for (size_t i = 0; i < count; ++i) *this << items[i];
    return *this;
  }
  Sum& bytes(const uint8_t* from, size_t count) {
    for (size_t i = 0; i < count; ++i) mix(from[i]);
    return *this;
  }
  uint64_t value() const { return value_; }

 private:
  Sum& add(uint64_t word) {
    for (int i = 0; i < 8; ++i) mix(static_cast<uint8_t>(word >> (8 * i)));
    return *this;
  }
  void mix(uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }

  uint64_t value_ = 0xcbf29ce484222325u;
};

template <class Id, class = decltype(Id::index), class = std::enable_if_t<sizeof(Id) == 8>>
Sum& operator<<(Sum& sum, const Id& id) {
  return sum.all(id.index, id.generation);
}
Sum& operator<<(Sum& sum, const dsw_face_id& id);
Sum& operator<<(Sum& sum, const dsw_edge_id& id);
Sum& operator<<(Sum& sum, const dsw_cell& cell);
Sum& operator<<(Sum& sum, const dsw_contact& contact);
Sum& operator<<(Sum& sum, const dsw_flight& flight);
Sum& operator<<(Sum& sum, const dsw_crossing& crossing);
Sum& operator<<(Sum& sum, const dsw_sweep& sweep);
Sum& operator<<(Sum& sum, const dsw_nearest& nearest);
Sum& operator<<(Sum& sum, const dsw_segment_nearest& nearest);
Sum& operator<<(Sum& sum, const dsw_body_contact& contact);
Sum& operator<<(Sum& sum, const dsw_previous_contact& contact);
Sum& operator<<(Sum& sum, const dsw_contact_partner& partner);
Sum& operator<<(Sum& sum, const dsw_body_edit& edit);
Sum& operator<<(Sum& sum, const dsw_move_report& report);
Sum& operator<<(Sum& sum, const dsw_deform_report& report);
Sum& operator<<(Sum& sum, const dsw_wall_contact& contact);
Sum& operator<<(Sum& sum, const dsw_near_row& row);
Sum& operator<<(Sum& sum, const dsw_pair_touch& touch);
Sum& operator<<(Sum& sum, const dsw_statistics& statistics);
Sum& operator<<(Sum& sum, const dsw_build_report& report);
Sum& operator<<(Sum& sum, const dsw_volume_change& change);
Sum& operator<<(Sum& sum, const dsw_cut_face& face);
Sum& operator<<(Sum& sum, const dsw_face_origin& origin);
Sum& operator<<(Sum& sum, const dsw_vertex_origin& origin);
/// Without struct_size, which counts pointers.
Sum& operator<<(Sum& sum, const dsw_change& change);

/// What the last calls left to be asked for: positions, contacts, edits, changes. Also looks for near rows.
void add_state(Sum& sum, dsw_scene* scene);
/// Both snapshots.
void add_snapshots(Sum& sum, const dsw_scene* scene);

}  // namespace dsw::portable
