#pragma once
// Values as the words of a recording: written, read back, and printed for people.

#include <cstring>
#include <type_traits>

#include "base/compiler.h"
#include "base/points.h"
#include "body/body.h"
#include "capi/fields.h"
#include "scene/change_results.h"

namespace dsw::capi {

/** An array. In a recording null is told from empty. */
template <class T>
struct Items {
  const T* items;
  size_t count;
};
template <class T>
Items<T> items_of(const Array<T>& array) noexcept {
  return {array.data(), array.size()};
}
/** Gives an array as a result: an empty array has the same words whether memory was allocated for it or not. */
template <class T>
Items<T> as_result(const Items<T>& array) noexcept {
  return {array.count == 0 ? nullptr : array.items, array.count};
}
template <class T>
const T& as_result(const T& value) noexcept {
  return value;
}

struct Points {
  PointArray points;
  size_t count, dimension;
};

constexpr uint64_t kNullArray = UINT64_MAX;

/** Takes the bytes of what is written, part by part. */
struct WordSink {
  void* to;
  void (*put)(void* to, const void* bytes, size_t size);

  void operator()(const void* bytes, size_t size) const { put(to, bytes, size); }
};

/** Calls use(bytes, size) for each part of what is written of something. */
template <class T, class Use>
void for_each_part(const T& value, const Use& use) {
  use(&value, sizeof value);
}
template <class T, class Use>
void for_each_part(const Items<T>& array, const Use& use) {
  const uint64_t count = array.items == nullptr ? kNullArray : array.count;
  use(&count, sizeof count);
  if (array.items != nullptr && array.count != 0) use(array.items, array.count * sizeof(T));
}
template <class Use>
void for_each_part(const Points& array, const Use& use) {
  const uint64_t count = array.points.data == nullptr ? kNullArray : uint64_t{array.dimension} * array.count;
  use(&count, sizeof count);
  for (size_t i = 0; count != kNullArray && i < array.count; ++i) {
    use(array.points[i], array.dimension * sizeof(double));
  }
}
/** What a change has done: its numbers, and its lists but not where they lie. */
template <class Use>
void for_each_part(const ChangeResults& change, const Use& use) {
  static_assert(offsetof(dsw_change, volumes) == 88, "the numbers are the same bytes on every machine");
  use(&change.numbers, offsetof(dsw_change, volumes));
  const auto add = [&](const auto& list) { for_each_part(as_result(items_of(list)), use); };
  add(change.volumes), add(change.vertices), add(change.faces), add(change.whole), add(change.carved);
  add(change.unrepaired), add(change.detached), add(change.body_vertices), add(change.body_faces);
}
/** Where a body is. */
template <int D, class Use>
void for_each_part(const Body<D>& body, const Use& use) {
  for (const BodyVertex<D>& v : body.vertices) use(v.position, sizeof v.position);
}

/** Reads the words of a recorded call, in their order. A recording is not trusted: what can't be is CORRUPT. */
class WordReader {
 public:
  explicit WordReader(const Array<uint64_t>& words, uint32_t dimension = 3)
      : at_(words.data()), end_(words.data() + words.size()), dimension_(dimension) {}

  /** Doubles of a point. */
  uint32_t dimension() const noexcept { return dimension_; }

  /** A plain value; of an enum one that it can hold. */
  template <class T>
  T get() {
    if constexpr (std::is_enum_v<T>) {
      const auto number = get<uint32_t>();
      if (number > INT32_MAX) fail(DSW_STATUS_CORRUPT, "the recording is damaged: %u names nothing", number);
      return static_cast<T>(number);
    } else {
      T value;
      std::memcpy(&value, take(sizeof(T)), sizeof(T));
      return value;
    }
  }
  /** The words of a struct that begins with its size, which another version may have written. */
  Items<uint32_t> get_sized() {
    const auto size = WordReader(*this).get<uint32_t>();
    return {static_cast<const uint32_t*>(take(size)), size / sizeof size};
  }
  template <class T>
  T get_struct() {
    return read_recorded<T>(get_sized().items, "a recorded struct");
  }
  template <class T>
  Items<T> get_items() {
    const auto count = get<uint64_t>();
    if (count == kNullArray) return {nullptr, 0};
    require(count <= static_cast<uint64_t>(end_ - at_) * sizeof(uint64_t) / sizeof(T));
    const auto size = static_cast<size_t>(count);
    return {static_cast<const T*>(take(size * sizeof(T))), size};
  }
  static void require(bool holds) {
    if (!holds) fail(DSW_STATUS_CORRUPT, "the recording is damaged: arguments of a call");
  }

 private:
  const void* take(size_t bytes) {
    require(bytes <= static_cast<size_t>(end_ - at_) * sizeof(uint64_t));
    const void* const from = at_;
    at_ += (bytes + 7) / 8;
    return from;
  }

  const uint64_t* at_;
  const uint64_t* end_;
  uint32_t dimension_;
};

/** Text for whoever reads a bug report; as much is kept as there is room for. */
class Text {
 public:
  Text(char* out, size_t capacity) : out_(out), capacity_(capacity) {}

  DSW_PRINTF(2, 3) void add(const char* format, ...) noexcept;
  /** What the next values are, if that has a name. */
  void label(const char* name) noexcept {
    if (*name != 0) add("%s%s", size_ == 0 ? "" : " ", name);
  }
  size_t size() const { return size_; }

  void print(double number) noexcept { add(" %.17g", number); }
  void print(const dsw_rigid_motion& motion) noexcept;
  template <class T>
  void print(const T& value) noexcept {
    if constexpr (std::is_signed_v<T>) {
      add(" %d", value);
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      add(" %u", static_cast<uint32_t>(value));
    } else if constexpr (std::is_same_v<T, dsw_face_id> || std::is_same_v<T, dsw_edge_id>) {
      add(" %u.%u/%u", value.volume, value.generation, value.local);
    } else if constexpr (std::is_same_v<T, dsw_cut_face>) {
      print(value.front);
      print(value.back);
    } else {
      add(" %u.%u", value.index, value.generation);
    }
  }
  template <class T>
  void print(const Items<T>& all) noexcept {
    constexpr size_t kMost = 60;
    if constexpr (std::is_same_v<T, uint8_t>) return add(" of %zu bytes", all.count);
    add(all.items == nullptr ? " null" : " [");
    for (size_t i = 0; i < all.count && i < kMost; ++i) print(all.items[i]);
    if (all.count > kMost) add(" ... %zu in all", all.count);
    if (all.items != nullptr) add(" ]");
  }
  /** Words of a struct beyond its size, in hexadecimal. */
  void print_words(const Items<uint32_t>& words) noexcept;

 private:
  char* out_;
  size_t capacity_, size_ = 0;
};

}  // namespace dsw::capi
