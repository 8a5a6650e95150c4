// For every type of a parameter: what a call takes, and what is wrong with it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

#include "host.h"

namespace boundary {

/** What a call with something wrong must answer, besides the statuses. */
enum Wanted : int {
  kAnything = -1,
  kAsBefore = -2,    // what the call answers with nothing wrong
  kRefused = -3,     // if that is OK, something else
  kNullMayPass = -4  // NULL_ARGUMENT, unless it is optional
};

constexpr size_t kScratchBytes = 1 << 13;
constexpr unsigned char kUntouched = 0xa5;

/** One parameter of a call that is about to be made. */
struct Argument {
  std::string_view function, name;
  Host* host;
  unsigned char* scratch;  // memory of its own
  bool called(const char* other) const { return name == other; }
  bool of(const char* other) const { return function == other; }
  bool ends_with(std::string_view end) const {
    return name.size() >= end.size() && name.substr(name.size() - end.size()) == end;
  }
};

// Structs that begin with their size.
template <class T>
constexpr bool is_report = false;
template <class T>
constexpr bool is_description = false;
template <class T>
void initialise(T*) {}
#define FUNCTION(name, parameters)
#define REPORT(type) \
  template <>        \
  inline constexpr bool is_report<type> = true;
#define DESCRIPTION(type)                            \
  template <>                                        \
  inline constexpr bool is_description<type> = true; \
  template <>                                        \
  inline void initialise(type* d) {                  \
    type##_init(d, sizeof *d);                       \
  }
#define MEMBER(type, member)
#include "functions.inc"
#undef MEMBER
#define MEMBER(type, member) \
  {name_of<type>, #member, offsetof(type, member), sizeof(type::member), kind_of<decltype(type::member)>()},
#undef REPORT
#define REPORT(type)
#undef DESCRIPTION
#define DESCRIPTION(type)

enum class Kind { POINTER, NUMBER, SIZE, WORD, ID, OTHER };
template <class T>
constexpr Kind kind_of() {
  if constexpr (std::is_pointer_v<T>) return Kind::POINTER;
  if constexpr (std::is_same_v<T, double>) return Kind::NUMBER;
  if constexpr (std::is_same_v<T, size_t>) return Kind::SIZE;
  if constexpr (std::is_enum_v<T> || (std::is_integral_v<T> && sizeof(T) == 4)) return Kind::WORD;
  if constexpr (std::is_same_v<T, dsw_volume_id>) return Kind::ID;
  return Kind::OTHER;
}

/** Stands for a type. */
template <class T>
inline const char name_of[1] = {};

struct Member {
  const char* type;
  std::string_view name;
  size_t offset, size;
  Kind kind;
};
inline const Member kMembers[] = {
#include "functions.inc"
};
#undef FUNCTION

template <class T, class... Any>
constexpr bool is_any = (std::is_same_v<T, Any> || ...);
template <class T>
constexpr bool is_handle = is_any<T, dsw_context, dsw_environment, dsw_scene, dsw_trace, dsw_replay>;
template <class T>
constexpr bool is_id = is_any<T, dsw_vertex_id, dsw_volume_id, dsw_face_id, dsw_edge_id, dsw_particle_id, dsw_body_id,
                              dsw_body_vertex_id, dsw_body_edge_id, dsw_body_face_id>;

/** A cell in the third cube, which is empty; of the scene, its first things. */
template <class T>
T good_id(const Argument& a, size_t i) {
  T id;
  if constexpr (std::is_same_v<T, dsw_face_id> || std::is_same_v<T, dsw_edge_id>) {
    id = {2, 1, static_cast<uint32_t>(i)};
  } else if constexpr (std::is_same_v<T, dsw_particle_id>) {
    id = a.host->particles[i % 2];
  } else if constexpr (std::is_same_v<T, dsw_body_id>) {
    id = a.host->bodies[i % 2];
  } else {
    id = {static_cast<uint32_t>(i), 1};
    if (std::is_same_v<T, dsw_volume_id> && (a.called("volumes") || a.of("dsw_environment_split_volume")))
      id.index = 2 + i % 2;
  }
  return id;
}

/** An id that names nothing; the first is null, which can mean "none". */
template <class T>
bool bad_id(size_t k, T* id, int* wanted) {
  const uint32_t values[][2] = {{0, 0}, {0, 2}, {1u << 28, 1}, {UINT32_MAX, 1}, {UINT32_MAX, UINT32_MAX}, {1, 0}};
  if (k >= sizeof values / sizeof values[0]) return false;
  std::memset(id, 0xff, sizeof *id);  // also the number of a face or edge
  std::memcpy(id, values[k], sizeof values[k]);
  *wanted = k == 0 ? static_cast<int>(kAnything) : static_cast<int>(kRefused);
  return true;
}

/** The one of a host, or of the graveyard. */
template <class T, class Home>
T* handle_in(const Home& home) {
  if constexpr (std::is_same_v<T, dsw_context>) {
    return home.context;
  } else if constexpr (std::is_same_v<T, dsw_environment>) {
    return home.environment;
  } else if constexpr (std::is_same_v<T, dsw_scene>) {
    return home.scene;
  } else if constexpr (std::is_same_v<T, dsw_trace>) {
    return home.trace;
  } else {
    return home.replay;
  }
}

template <class T>
T* good_handle(const Argument& a) {
  if constexpr (std::is_same_v<T, dsw_environment>) {
    if (a.of("dsw_scene_create") || a.of("dsw_scene_load") || a.of("dsw_environment_coarsen"))
      return a.host->shared_environment;
  }
  return handle_in<T>(*a.host);
}

template <class T>
bool bad_handle(const Argument& a, size_t k, T** handle, int* wanted) {
  const Graveyard& dead = graveyard();
  const bool may_be_null = a.called("context") || a.function.substr(a.function.size() - 8) == "_destroy";
  *wanted = k == 0 ? may_be_null ? static_cast<int>(kAnything) : DSW_STATUS_NULL_ARGUMENT : DSW_STATUS_STALE_ID;
  if (k == 0) *handle = nullptr;
  if (k == 1) *handle = handle_in<T>(dead);
  if (k == 2) *handle = static_cast<T*>(dead.zeros);
  if (k == 3) {  // of another kind
    *handle = reinterpret_cast<T*>(std::is_same_v<T, dsw_scene> ? static_cast<void*>(a.host->environment)
                                                                : static_cast<void*>(a.host->scene));
  }
  if (k == 4) {  // another one, which ids and the rest are not of
    *wanted = kAnything;
    if constexpr (std::is_same_v<T, dsw_environment>) {
      *handle = a.host->shared_environment;
    } else if constexpr (std::is_same_v<T, dsw_scene>) {
      *handle = a.host->shared_scene;
    } else {
      return false;
    }
  }
  return k < 5;
}

/** Counts and sizes that nothing in memory has. Where addresses have 64 bits, some times the size of an entry fit into
 * a size_t again. */
constexpr size_t kHuge[] = {SIZE_MAX,          SIZE_MAX - 1,    SIZE_MAX - 7,      SIZE_MAX / 2 + 1, SIZE_MAX / 8,
                            SIZE_MAX / 16 + 1,
#if SIZE_MAX > UINT32_MAX
                            SIZE_MAX / 16,     SIZE_MAX / 24,   SIZE_MAX / 24 + 1, SIZE_MAX / 32,    SIZE_MAX / 48,
                            SIZE_MAX / 152,    size_t{1} << 61, size_t{1} << 57
#endif
};
constexpr size_t kHugeCount = sizeof kHuge / sizeof *kHuge;

/** A struct with its size: sizes that never were, one of a later version, and what is wrong in it. */
template <class T>
bool bad_struct(const Argument& a, size_t k, T** value, int* wanted) {
  constexpr uint32_t kSizes[] = {0, 4, 4097, UINT32_MAX};
  constexpr uint32_t kLater = sizeof(T) + 64;
  *wanted = kRefused;
  if (k == 0) {
    *value = nullptr;
    *wanted = kNullMayPass;
    return true;
  }
  k -= 1;
  if (k < 4) {
    (*value)->struct_size = kSizes[k];
    return true;
  }
  k -= 4;
  if (k < 2) {
    (*value)->struct_size = kLater;
    std::memset(a.scratch + sizeof(T), 0, 64);
    if (k == 1) a.scratch[kLater - 1] = 1;  // a member of that version, in use
    *wanted = k == 1 && is_description<T> ? DSW_STATUS_UNSUPPORTED : static_cast<int>(kAsBefore);
    return true;
  }
  if constexpr (!is_description<T>) return false;
  k -= 2;
  for (const Member& m : kMembers) {
    if (m.type != name_of<T>) continue;
    const double numbers[] = {std::nan(""), HUGE_VAL, -1, 1e300};
    const uint32_t words[] = {UINT32_MAX, 77, 0x7ffffffe, 0}, ids[][2] = {{0, 2}, {UINT32_MAX, 1}, {1, 0}, {77, 1}};
    const size_t ways = m.kind == Kind::SIZE ? kHugeCount + 1 : m.kind == Kind::POINTER ? 1 : 4;
    if (k >= ways) {
      k -= ways;
      continue;
    }
    const bool is_count = m.name.size() > 6 && m.name.substr(m.name.size() - 6) == "_count";
    *wanted = m.kind == Kind::SIZE && is_count && k < kHugeCount ? kRefused : kAnything;
    auto* const to = reinterpret_cast<unsigned char*>(*value) + m.offset;
    if (m.kind == Kind::POINTER || m.kind == Kind::SIZE) std::memset(to, 0, m.size);
    if (m.kind == Kind::NUMBER) std::memcpy(to, numbers + k, m.size);
    if (m.kind == Kind::SIZE && k < kHugeCount) std::memcpy(to, kHuge + k, m.size);
    if (m.kind == Kind::WORD) std::memcpy(to, words + k, m.size);
    if (m.kind == Kind::ID) std::memcpy(to, ids + k, m.size);
    return true;
  }
  return false;
}

/** Points in the first cube. */
inline void fill_numbers(double* to) {
  for (size_t i = 0; i < 96; ++i) to[i] = 0.1 + 0.007 * static_cast<double>(i);
}

/** An array that is read, with something wrong at its beginning. */
template <class T>
bool bad_items(size_t k, T* items, int* wanted) {
  *wanted = kAnything;
  if constexpr (std::is_same_v<T, double>) {
    const double numbers[] = {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, 5e-324, -1e-300};
    items[k % 3] = numbers[k % 6];
    return k < 6;
  } else if constexpr (is_id<T>) {
    return bad_id(k, items, wanted);
  } else if constexpr (std::is_integral_v<T>) {
    items[k % 2] = std::numeric_limits<T>::max();
    return k < 2;
  } else {
    return false;
  }
}

inline const Block& block_of(const Argument& a) {
  if (a.of("dsw_scene_load")) return a.host->shared_block;
  return a.of("dsw_replay_create") ? a.host->recording : a.host->environment_block;
}

/** An entry of an array of integers. */
inline size_t good_number(const Argument& a, size_t i) {
  if (a.called("offsets")) return 4 * i;
  return a.called("kinds") ? (a.host->dimension == 2 ? size_t{DSW_PAIR_VERTEX_EDGE} : i % 2) : i;
}

template <class T>
T good_pointer(const Argument& a) {
  using Pointee = std::remove_pointer_t<T>;
  using Value = std::remove_const_t<Pointee>;
  if constexpr (is_handle<Value>) {
    return good_handle<Value>(a);
  } else if constexpr (std::is_same_v<Pointee, const void>) {
    return block_of(a).data();
  } else if constexpr (!std::is_const_v<Pointee>) {
    std::memset(a.scratch, kUntouched, kScratchBytes);
    auto* const to = reinterpret_cast<Value*>(a.scratch);
    if constexpr (is_report<Value>) to->struct_size = sizeof *to;
    if (a.called("next")) std::memcpy(a.scratch, a.host->next.data(), a.host->next.size() * sizeof(double));
    return to;
  } else {
    std::memset(a.scratch, 0, kScratchBytes);
    auto* const to = reinterpret_cast<Value*>(a.scratch);
    if constexpr (std::is_same_v<Value, double>) fill_numbers(to);
    for (size_t i = 0; i < 16; ++i) {
      if constexpr (std::is_integral_v<Value>) to[i] = static_cast<Value>(good_number(a, i));
      if constexpr (is_id<Value>) to[i] = good_id<Value>(a, i);
    }
    if constexpr (std::is_same_v<Value, dsw_rigid_motion>) to->rotation[3] = 1;
    if constexpr (is_description<Value>) {
      initialise(to);
      describe(*to, a.host->dimension);
    }
    return to;
  }
}

template <class T>
bool bad_pointer(const Argument& a, size_t k, T* value, int* wanted) {
  using Pointee = std::remove_pointer_t<T>;
  using Value = std::remove_const_t<Pointee>;
  auto* items = const_cast<Value*>(*value);
  bool some = false;
  if constexpr (is_handle<Value>) {
    some = bad_handle(a, k, &items, wanted);
  } else if constexpr ((is_description<Value> && std::is_const_v<Pointee>) || is_report<Value>) {
    some = bad_struct(a, k, &items, wanted);
  } else if (k == 0) {
    items = nullptr;
    *wanted = kNullMayPass;
    some = true;
  } else if constexpr (std::is_const_v<Pointee> || std::is_same_v<Value, double>) {
    if (std::is_const_v<Pointee> || a.called("next")) some = bad_items(k - 1, items, wanted);
  }
  *value = items;
  return some;
}

inline size_t good_size(const Argument& a) {
  if (a.called("stride_bytes")) return 0;
  if (a.called("size_bytes")) return block_of(a).size();
  if (a.called("capacity_bytes")) return kScratchBytes;
  if (a.called("size") || a.called("capacity")) return 20;
  if (a.called("target_count")) return a.of("dsw_body_move") ? 4 : 8;
  if (a.called("point_count")) return a.host->next.size() / a.host->dimension;
  return a.of("dsw_environment_split_volume") && a.host->dimension == 3 ? 4 : 2;
}

inline bool bad_size(const Argument& a, size_t k, size_t* value, int* wanted) {
  *wanted = kAnything;
  // What fits, and then what no memory has. Room may be as large as it likes: no more is written than there is.
  const bool is_size = a.called("size_bytes") || a.called("size"),
             is_room = a.called("capacity") || a.ends_with("_bytes"), is_stride = a.called("stride_bytes");
  const size_t sizes[] = {0, 1, 4, 8, *value - 1}, rooms[] = {0, 1}, strides[] = {24, 1, 8, 23, 25};
  const size_t* const few = is_size ? sizes : is_stride ? strides : rooms;
  const size_t few_count = is_size || is_stride ? 5 : is_room ? 2 : 1;
  if (k >= few_count + kHugeCount) return false;
  *value = k < few_count ? few[k] : kHuge[k - few_count];
  if (k < few_count ? is_stride && k != 0 : !is_room || is_size || is_stride) *wanted = kRefused;
  return true;
}

template <class T>
T good(const Argument& a) {
  if constexpr (std::is_pointer_v<T>) {
    return good_pointer<T>(a);
  } else if constexpr (is_id<T>) {
    if (std::is_same_v<T, dsw_vertex_id> && a.called("b"))
      return good_id<T>(a, a.host->dimension == 2 ? 7 : 18);  // across a face from a, or a square
    if (std::is_same_v<T, dsw_vertex_id>) return good_id<T>(a, 3);
    return good_id<T>(a, a.called("b") ? 3 : a.called("c") ? 2 : std::is_same_v<T, dsw_volume_id> ? 0 : 1);
  } else if constexpr (std::is_same_v<T, dsw_cell>) {
    return {DSW_CELL_VOLUME, 2, 1, 0};
  } else if constexpr (std::is_same_v<T, double>) {
    return 0.5;
  } else if constexpr (std::is_same_v<T, size_t>) {
    return good_size(a);
  } else {
    return static_cast<T>(a.called("dimension") ? a.host->dimension : a.called("flags") ? 0 : 1);
  }
}

/** Makes a good value the k-th bad one. Returns false where there is none. */
template <class T>
bool spoil(const Argument& a, size_t k, T* value, int* wanted) {
  *wanted = kAnything;
  if constexpr (std::is_pointer_v<T>) {
    return bad_pointer(a, k, value, wanted);
  } else if constexpr (is_id<T>) {
    return bad_id(k, value, wanted);
  } else if constexpr (std::is_same_v<T, size_t>) {
    return bad_size(a, k, value, wanted);
  } else if constexpr (std::is_same_v<T, dsw_cell>) {
    const dsw_cell cells[] = {{DSW_CELL_NONE, 0, 0, 0},
                              {static_cast<dsw_cell_kind>(5), 2, 1, 0},
                              {DSW_CELL_VOLUME, UINT32_MAX, 1, 0},
                              {DSW_CELL_FACE, 2, 1, UINT32_MAX},
                              {DSW_CELL_EDGE, 2, 2, 0},
                              {DSW_CELL_VERTEX, 1u << 28, 1, 0}};
    *value = cells[k % 6];
    *wanted = kRefused;
    return k < 6;
  } else if constexpr (std::is_same_v<T, double>) {
    const double numbers[] = {std::nan(""), HUGE_VAL, -HUGE_VAL, -1, 0, 1e300, 5e-324};
    *value = numbers[k % 7];
    return k < 7;
  } else {
    const uint32_t words[] = {0, 7, 1u << 28, 0x7ffffffe};
    *value = static_cast<T>(words[k % 4]);
    return k < 4;
  }
}

}  // namespace boundary
