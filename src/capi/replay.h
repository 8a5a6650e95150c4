#pragma once
// A recording that is made again: what replay.cpp and the rows of calls share.

#include <optional>
#include <type_traits>

#include "capi/recorded.h"

struct dsw_replay {
  static constexpr uint64_t kMagic = 0x6473775f72706c31u;
  uint64_t magic = kMagic;
  dsw_context* context;
  dsw::RecordReader reader;
  dsw_environment* environment = nullptr;
  dsw_scene* scene = nullptr;
  dsw::capi::CallWatch watch;
  uint64_t calls = 0;  // made so far
  uint32_t version = 0, flags = 0;
  const char* note = "";
  std::optional<dsw_verdict> verdict;
  dsw::Array<uint64_t> words;    // the arguments of a call
  dsw::Array<double> points[2];  // lent to the environment in turn
  size_t needed_room = 0;        // vertices for which these need memory, as far as is known

  dsw_replay(dsw_context* owner, const uint8_t* bytes, size_t size);
  ~dsw_replay();
  dsw_replay(const dsw_replay&) = delete;
  dsw_replay& operator=(const dsw_replay&) = delete;
};

namespace dsw::capi {

/** The arguments of a recorded call, in the order in which for_each_part wrote them. Throws CORRUPT where there are none left. */
class Arguments {
 public:
  explicit Arguments(const Array<uint64_t>& words, uint32_t dimension = 3)
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
  /** A struct that begins with its size, which another version has written. */
  template <class T>
  T get_struct() {
    need(1);
    uint32_t size;
    std::memcpy(&size, at_, sizeof size);
    return read_struct(static_cast<const T*>(take(size)), "a recorded struct");
  }
  /** The words of a struct that begins with its size. */
  Items<uint32_t> get_sized() {
    need(1);
    uint32_t size;
    std::memcpy(&size, at_, sizeof size);
    return {static_cast<const uint32_t*>(take(size)), size / sizeof size};
  }
  /** As many as are expected, or null. */
  template <class T>
  const T* get_items(size_t count) {
    const Items<T> items = get_items<T>();
    if (items.items != nullptr && items.count != count) fail_short();
    return items.items;
  }
  const double* get_points(size_t count) {
    const Items<double> points = get_points();
    if (points.items != nullptr && points.count != count) fail_short();
    return points.items;
  }
  /** With the number of points. */
  Items<double> get_points() {
    const Items<double> items = get_items<double>();
    if (items.count % dimension_ != 0) fail_short();
    return {items.items, items.count / dimension_};
  }
  template <class T>
  Items<T> get_items() {
    const auto count = get<uint64_t>();
    if (count == kNullArray) return {nullptr, 0};
    if (count > static_cast<uint64_t>(end_ - at_) * sizeof(uint64_t) / sizeof(T)) fail_short();
    const auto size = static_cast<size_t>(count);
    return {static_cast<const T*>(take(size * sizeof(T))), size};
  }

 private:
  [[noreturn]] static void fail_short() { fail(DSW_STATUS_CORRUPT, "the recording is damaged: arguments of a call"); }
  void need(size_t words) const {
    if (words > static_cast<size_t>(end_ - at_)) fail_short();
  }
  const void* take(size_t bytes) {
    const size_t words = (bytes + 7) / 8;
    need(words);
    const void* const from = at_;
    at_ += words;
    return from;
  }

  const uint64_t* at_;
  const uint64_t* end_;
  uint32_t dimension_;
};

/** How a call is made again. */
struct ReplayRow {
  const char* function;  // null: none of these
  dsw_status (*make)(dsw_replay& replay, Arguments& arguments);
};
/** Calls that change the environment, and all others. */
ReplayRow environment_row(Call call) noexcept;
ReplayRow body_row(Call call) noexcept;

/** Of what is made again. */
uint32_t dimension_of(const dsw_replay& replay) noexcept;

/** Vertices for which there is memory where the host had room for `room`: recordings are not trusted, so there is as much as calls have
 * needed. 0: its points were not to be written. */
size_t made_room(const dsw_replay& replay, uint64_t room) noexcept;

/** A call that is about to be made again. */
struct NextCall {
  Call call;
  ReplayRow row;
  Arguments arguments;
  bool is_finished;  // what came of it was recorded
  CallResult result;
  RecordReader after;
};
/** Reads the next call; false at the end. Throws CORRUPT. */
bool read_next(dsw_replay& replay, std::optional<NextCall>& next);
/** Makes it again. */
void make_again(dsw_replay& replay, const NextCall& next, dsw_replay_report* report);

}  // namespace dsw::capi
