#pragma once
// The kinds of arguments. A kind knows which argument of a function it stands for, or which member of a struct. It
// writes that argument to a recording, reads it back, and prints it. calls.h says which function has which kinds.

#include <memory>

#include "capi/pack.h"
#include "capi/scene_handle.h"
#include "capi/words.h"

namespace dsw::capi {

/** What a kind has to know besides the arguments. */
struct CallPlace {
  const dsw_scene* scene;  // of a call that is recorded, else null
  dsw_replay* replay;      // of a call that is made again, else null
  size_t dimension;
};
/** Memory for what the arguments of a call point at while the call is made again. It lasts until the next call is read.
 * */
void* keep_bytes(dsw_replay& replay, size_t size);
template <class T>
T* keep(dsw_replay& replay, size_t count = 1) {
  if (count > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
  T* const kept = static_cast<T*>(keep_bytes(replay, count * sizeof(T)));
  std::uninitialized_value_construct_n(kept, count);
  return kept;
}

/** The argument at a position of the declaration. The handle is at 0. */
template <size_t P>
struct Argument {
  template <class Given>
  auto& operator()(Given& given) const {
    return get<P>(given);
  }
};
template <class T, class M>
struct Member {
  M T::*member;
  auto& operator()(const T& of) const { return of.*member; }
  auto& operator()(T& of) const { return of.*member; }
};
template <class At, class Given>
using TypeAt = std::decay_t<decltype(std::declval<At>()(std::declval<Given&>()))>;
template <class At, class Given>
using ElementAt = std::remove_const_t<std::remove_pointer_t<TypeAt<At, Given>>>;

/** An id, a number or an enum. If the argument is a pointer, the struct that it points at. */
template <class At>
struct Value {
  const char* label;
  At at;
  template <class Given>
  static constexpr bool is_pointer = std::is_pointer_v<TypeAt<At, Given>>;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace&, const Use& use) const {
    static_assert(has_one_size<ElementAt<At, Given>>);
    if constexpr (is_pointer<Given>) {
      for_each_part(*at(given), use);
    } else {
      for_each_part(at(given), use);
    }
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    const auto value = from.get<ElementAt<At, Given>>();
    if constexpr (is_pointer<Given>) {
      auto* const kept = keep<ElementAt<At, Given>>(*place.replay);
      *kept = value;
      at(given) = kept;
    } else {
      at(given) = value;
    }
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print(from.get<ElementAt<At, Given>>());
  }
};

/** The count of an array is the argument at a position. If kSets, reading the array sets that argument; else it has
 * been set by an array before. */
template <size_t P, bool kSets>
struct CountAt {
  template <class Given>
  size_t operator()(const Given& given, size_t) const {
    return get<P>(given);
  }
  template <class Given>
  void accept(Given& given, bool is_null, size_t count, size_t) const {
    if constexpr (kSets) get<P>(given) = count;
    WordReader::require(is_null || count == get<P>(given));
  }
};
/** The count of an array is a member of the struct, or a function of the struct and the dimension. */
template <class Length>
struct CountOf {
  Length length;
  template <class T>
  size_t operator()(const T& of, size_t dimension) const {
    if constexpr (std::is_member_pointer_v<Length>) {
      return of.*length;
    } else {
      return length(of, dimension);
    }
  }
  template <class T>
  void accept(const T& of, bool is_null, size_t count, size_t dimension) const {
    WordReader::require(is_null || count == (*this)(of, dimension));
  }
};
/** One. */
inline constexpr auto one_point = [](const auto&, size_t) { return size_t{1}; };

struct NoPoints {};
struct Packed {};
/** An array, which may be null. An array of void is one of bytes. An array with a stride, or Packed, is one of points.
 * */
template <class At, class Count, class Stride = NoPoints>
struct ArrayOf {
  const char* label;
  At at;
  Count count;
  Stride stride;
  template <class Given>
  using Each = std::conditional_t<std::is_void_v<ElementAt<At, Given>>, uint8_t, ElementAt<At, Given>>;
  static constexpr bool has_points = !std::is_same_v<Stride, NoPoints>;
  static constexpr bool has_stride = has_points && !std::is_same_v<Stride, Packed>;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    using T = Each<Given>;
    static_assert(has_one_size<T>);
    const size_t all = count(given, place.dimension);
    if constexpr (has_points) {
      size_t step = place.dimension;
      if constexpr (has_stride) step = stride(given) == 0 ? step : stride(given) / sizeof(double);
      for_each_part(Points{{at(given), step}, all, place.dimension}, use);
    } else {
      for_each_part(Items<T>{static_cast<const T*>(at(given)), all}, use);
    }
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    Items<Each<Given>> all = from.get_items<Each<Given>>();
    if constexpr (has_points) {
      WordReader::require(all.count % place.dimension == 0);
      all.count /= place.dimension;
    }
    if constexpr (has_stride) stride(given) = 0;
    at(given) = all.items;
    count.accept(given, all.items == nullptr, all.count, place.dimension);
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print(from.get_items<Each<Given>>());
  }
};

/** A struct that begins with its size, and the arrays that it points at: fields.h. A null pointer stands for defaults.
 * The pointers in the struct are written as null. */
template <class At, class... Arrays>
struct Struct {
  const char* label;
  At at;
  Pack<Arrays...> arrays;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    using T = ElementAt<At, Given>;
    const T whole = read_optional(at(given), label);
    T bare = whole;
    arrays.for_each([&](const auto& each) { each.at(bare) = nullptr; });
    use_recorded(bare, use);
    arrays.for_each([&](const auto& each) { each.write(whole, place, use); });
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    auto* const kept = keep<ElementAt<At, Given>>(*place.replay);
    at(given) = kept;
    *kept = from.get_struct<ElementAt<At, Given>>();
    arrays.for_each([&](const auto& each) { each.read(from, *kept, place); });
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print_words(from.get_sized());
    arrays.for_each([&](const auto& each) {
      text.label(each.label);
      each.template print<ElementAt<At, Given>>(from, text);
    });
  }
};

/** A result that the host has to take, or as many as another argument says. Results are not recorded. */
template <class At, class Count>
struct Result {
  const char* label = "";
  At at;
  Count count;

  template <class Given, class Use>
  void write(const Given&, const CallPlace&, const Use&) const {}
  template <class Given>
  void read(WordReader&, Given& given, const CallPlace& place) const {
    at(given) = keep<ElementAt<At, Given>>(*place.replay, count(given, place.dimension));
  }
  template <class Given>
  void print(WordReader&, Text&) const {}
};

/** Reads the points of a deformation into an array of the replay; `room` becomes that of this array. */
double* read_moved_points(WordReader& from, dsw_replay& replay, size_t& room, size_t& count);
void print_moved_points(WordReader& from, Text& text);

/** The points of a deformation: number and coordinates of each point that moves, then kNullArray. The options are read
 * before. */
template <size_t kOptions>
struct MovedPoints {
  const char* label;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    visit(*place.scene->environment, [&](const auto& env) {
      constexpr size_t D = kDimension<decltype(env)>;
      for (uint64_t v = 0; v < env.map.vertex_count; ++v) {
        const double* const to = get<1>(given) + D * v;
        if (std::memcmp(to, env.point(static_cast<uint32_t>(v)), D * sizeof(double)) == 0) continue;
        use(&v, sizeof v);
        use(to, D * sizeof(double));
      }
    });
    use(&kNullArray, sizeof kNullArray);
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    auto& options = get<kOptions>(given);
    auto* const own = keep<std::decay_t<decltype(*options)>>(*place.replay);
    *own = *options;
    options = own;
    get<1>(given) = read_moved_points(from, *place.replay, own->point_room, get<2>(given));
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    print_moved_points(from, text);
  }
};

// What the rows of calls.h are written with: positions of arguments, names for people. kSameCount: with the count of an
// array before.
constexpr bool kSameCount = false;
template <size_t P>
constexpr Value<Argument<P>> value(const char* label = "") {
  return {label, {}};
}
template <size_t P, size_t kCount, bool kSets = true>
constexpr ArrayOf<Argument<P>, CountAt<kCount, kSets>> array(const char* label) {
  return {label, {}, {}, {}};
}
template <size_t P>
constexpr auto point(const char* label) {
  return ArrayOf<Argument<P>, CountOf<decltype(one_point)>, Packed>{label, {}, {one_point}, {}};
}
template <size_t P, size_t kCount, size_t kStride, bool kSets = true>
constexpr ArrayOf<Argument<P>, CountAt<kCount, kSets>, Argument<kStride>> points(const char* label) {
  return {label, {}, {}, {}};
}
template <size_t P, class... Arrays>
constexpr Struct<Argument<P>, Arrays...> structure(const char* label, Arrays... arrays) {
  return {label, {}, {{arrays}...}};
}
template <class T, class E, class Length>
constexpr ArrayOf<Member<T, E*>, CountOf<Length>> array(const char* label, E* T::*member, Length length) {
  return {label, {member}, {length}, {}};
}
template <class T, class Length>
constexpr ArrayOf<Member<T, const double*>, CountOf<Length>, Packed> points(const char* label, const double* T::*member,
                                                                            Length length) {
  return {label, {member}, {length}, {}};
}
template <class T, class Length>
constexpr auto points(const char* label, const double* T::*member, Length length, size_t T::*stride) {
  return ArrayOf<Member<T, const double*>, CountOf<Length>, Member<T, size_t>>{label, {member}, {length}, {stride}};
}
template <size_t P>
constexpr auto result() {
  return Result<Argument<P>, CountOf<decltype(one_point)>>{"", {}, {one_point}};
}
template <size_t P, size_t kCount>
constexpr Result<Argument<P>, CountAt<kCount, false>> results() {
  return {"", {}, {}};
}

}  // namespace dsw::capi
