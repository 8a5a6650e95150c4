#pragma once
// Kinds of arguments. A kind knows which argument of a function it is, or which member of a struct: it writes that to a recording, reads it
// back, and prints it. calls.h says which function has which.

#include <memory>
#include <tuple>

#include "capi/handle.h"
#include "capi/words.h"

namespace dsw::capi {

/** What a kind has to know besides the arguments, where calls are made and where they are made again. */
struct CallPlace {
  const dsw_scene* scene;  // that is recorded; null: the call is made again
  dsw_replay* replay;      // or null
  size_t dimension;
};
/** Room, until the next call, for what a call that is made again points at. */
void* keep_bytes(dsw_replay& replay, size_t size);
template <class T>
T* keep(dsw_replay& replay, size_t count = 1) {
  T* const kept = static_cast<T*>(keep_bytes(replay, count * sizeof(T)));
  std::uninitialized_value_construct_n(kept, count);
  return kept;
}

/** The argument at a position of the declaration. The handle is at 0. */
template <size_t P>
struct Argument {
  template <class Given>
  auto& operator()(Given& given) const {
    return std::get<P>(given);
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

/** An id, a number or an enum. */
template <class At>
struct Value {
  const char* label;
  At at;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace&, const Use& use) const {
    for_each_part(at(given), use);
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace&) const {
    at(given) = from.get<TypeAt<At, Given>>();
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print(from.get<TypeAt<At, Given>>());
  }
};

/** A struct without its size, which a pointer names. */
template <class At>
struct Pointed {
  const char* label;
  At at;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace&, const Use& use) const {
    for_each_part(*at(given), use);
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    auto* const kept = keep<ElementAt<At, Given>>(*place.replay);
    at(given) = kept;
    *kept = from.get<ElementAt<At, Given>>();
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print(from.get<ElementAt<At, Given>>());
  }
};

/** How many an array has: the argument at a position. If kSets, the array tells when it is read; else it was told before. */
template <size_t P, bool kSets>
struct CountAt {
  template <class Given>
  size_t operator()(const Given& given, size_t) const {
    return std::get<P>(given);
  }
  template <class Given>
  void accept(Given& given, bool is_null, size_t count, size_t) const {
    if constexpr (kSets) std::get<P>(given) = count;
    WordReader::require(is_null || count == std::get<P>(given));
  }
};
/** As many as a member of a struct says, or a function of the struct and the dimension. */
template <class Length>
struct CountOf {
  Length length;
  template <class T>
  size_t operator()(const T& of, size_t dimension) const {
    if constexpr (std::is_member_pointer_v<Length>)
      return of.*length;
    else
      return length(of, dimension);
  }
  template <class T>
  void accept(const T& of, bool is_null, size_t count, size_t dimension) const {
    WordReader::require(is_null || count == (*this)(of, dimension));
  }
};
/** One. */
constexpr auto one_point = [](const auto&, size_t) { return size_t{1}; };

/** An array, which may be null; of void* bytes. */
template <class At, class Count>
struct ArrayOf {
  const char* label;
  At at;
  Count count;
  template <class Given>
  using Each = std::conditional_t<std::is_void_v<ElementAt<At, Given>>, uint8_t, ElementAt<At, Given>>;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    using T = Each<Given>;
    for_each_part(Items<T>{static_cast<const T*>(at(given)), count(given, place.dimension)}, use);
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    const auto all = from.get_items<Each<Given>>();
    at(given) = all.items;
    count.accept(given, all.items == nullptr, all.count, place.dimension);
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print(from.get_items<Each<Given>>());
  }
};

struct Packed {};
/** Points, and where their stride is. */
template <class At, class Count, class Stride>
struct PointsOf {
  const char* label;
  At at;
  Count count;
  Stride stride;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    size_t bytes = 0;
    if constexpr (!std::is_same_v<Stride, Packed>) bytes = stride(given);
    const size_t step = bytes == 0 ? place.dimension : bytes / sizeof(double);
    for_each_part(Points{{at(given), step}, count(given, place.dimension), place.dimension}, use);
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    const auto all = from.get_points();
    at(given) = all.items;
    if constexpr (!std::is_same_v<Stride, Packed>) stride(given) = 0;
    count.accept(given, all.items == nullptr, all.count, place.dimension);
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print(from.get_items<double>());
  }
};

/** A struct that begins with its size, null for defaults, and the arrays that it points at. Its pointers are written as null. */
template <class At, class... Arrays>
struct Struct {
  const char* label;
  At at;
  std::tuple<Arrays...> arrays;

  template <class Use>
  void for_each_array(const Use& use) const {
    std::apply([&](const Arrays&... each) { (use(each), ...); }, arrays);
  }
  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    using T = ElementAt<At, Given>;
    const T whole = read_optional(at(given), label);
    T bare = whole;
    for_each_array([&](const auto& each) { each.at(bare) = nullptr; });
    use(&bare, sizeof bare);
    for_each_array([&](const auto& each) { each.write(whole, place, use); });
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    auto* const kept = keep<ElementAt<At, Given>>(*place.replay);
    at(given) = kept;
    *kept = from.get_struct<ElementAt<At, Given>>();
    for_each_array([&](const auto& each) { each.read(from, *kept, place); });
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    text.print_words(from.get_sized());
    for_each_array([&](const auto& each) {
      text.label(each.label);
      each.template print<ElementAt<At, Given>>(from, text);
    });
  }
};

/** Results that a host has to take, one or as many as another argument says: not recorded. */
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

/** The points of a deformation, whose options stand before: of those that move their numbers and places, and kNullArray. */
struct MovedPoints {
  const char* label;

  template <class Given, class Use>
  void write(const Given& given, const CallPlace& place, const Use& use) const {
    visit(*place.scene->environment, [&](const auto& env) {
      constexpr size_t D = kDimension<decltype(env)>;
      for (uint64_t v = 0; v < env.map.vertex_count; ++v) {
        const double* const to = std::get<1>(given) + D * v;
        if (std::memcmp(to, env.point(static_cast<uint32_t>(v)), D * sizeof(double)) == 0) continue;
        use(&v, sizeof v);
        use(to, D * sizeof(double));
      }
    });
    use(&kNullArray, sizeof kNullArray);
  }
  template <class Given>
  void read(WordReader& from, Given& given, const CallPlace& place) const {
    auto& [scene, next, count, options, report] = given;
    auto* const own = keep<dsw_deform_options>(*place.replay);
    *own = *options;
    options = own;
    next = read_moved_points(from, *place.replay, own->point_room, count);
  }
  template <class Given>
  void print(WordReader& from, Text& text) const {
    print_moved_points(from, text);
  }
};

// What the rows of calls.h are written with: positions of arguments, names for people.
template <size_t P>
constexpr Value<Argument<P>> value(const char* label = "") {
  return {label, {}};
}
template <size_t P>
constexpr Pointed<Argument<P>> pointed(const char* label) {
  return {label, {}};
}
template <size_t P, size_t kCount>
constexpr ArrayOf<Argument<P>, CountAt<kCount, true>> array(const char* label) {
  return {label, {}, {}};
}
/** With the count of an array before. */
template <size_t P, size_t kCount>
constexpr ArrayOf<Argument<P>, CountAt<kCount, false>> array_like(const char* label) {
  return {label, {}, {}};
}
template <size_t P>
constexpr auto point(const char* label) {
  return PointsOf<Argument<P>, CountOf<decltype(one_point)>, Packed>{label, {}, {one_point}, {}};
}
template <size_t P, size_t kCount, size_t kStride>
constexpr PointsOf<Argument<P>, CountAt<kCount, true>, Argument<kStride>> points(const char* label) {
  return {label, {}, {}, {}};
}
template <size_t P, size_t kCount, size_t kStride>
constexpr PointsOf<Argument<P>, CountAt<kCount, false>, Argument<kStride>> points_like(const char* label) {
  return {label, {}, {}, {}};
}
template <size_t P, class... Arrays>
constexpr Struct<Argument<P>, Arrays...> structure(const char* label, Arrays... arrays) {
  return {label, {}, {arrays...}};
}
template <class T, class E, class Length>
constexpr ArrayOf<Member<T, E*>, CountOf<Length>> array(const char* label, E* T::*member, Length length) {
  return {label, {member}, {length}};
}
template <class T, class Length>
constexpr PointsOf<Member<T, const double*>, CountOf<Length>, Packed> points(const char* label,
                                                                             const double* T::*member, Length length) {
  return {label, {member}, {length}, {}};
}
template <class T, class Length>
constexpr auto points(const char* label, const double* T::*member, Length length, size_t T::*stride) {
  return PointsOf<Member<T, const double*>, CountOf<Length>, Member<T, size_t>>{label, {member}, {length}, {stride}};
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
