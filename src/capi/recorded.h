#pragma once
// Recordings of scenes, and calls as they are recorded: src/snapshot/README.md. A call is written when its arguments have
// been checked and before the engine is asked, so that it is there if the process dies in it. What is refused before
// changes nothing and is left out; what the engine refuses is written as failed.

#include <cstdio>

#include "base/owned.h"
#include "capi/calls.h"
#include "capi/convert.h"
#include "capi/scene_handle.h"
#include "scene/untested.h"
#include "snapshot/record.h"
#include "snapshot/scene_snapshot.h"

namespace dsw::capi {

#if DSW_WITHOUT_RECORD
inline constexpr bool kCanRecord = false;
#else
inline constexpr bool kCanRecord = true;
#endif

/** A recording of a scene that is being made. */
struct Recording {
  RecordWriter writer;
  uint32_t flags;
  dsw_write_fn write;
  void* user;
  std::FILE* file = nullptr;  // ours, if the host has named one
  Array<uint8_t> kept;        // with DSW_RECORDING_LATEST: all of it
  size_t most_kept = 0;       // bytes after which it begins anew

  /** Throws WRITE_FAILED where the file can't be written. */
  Recording(const Memory* memory, const dsw_recording_desc& desc);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
};

/** Makes a recording with its beginning, which is not the scene's yet. Throws WRITE_FAILED. */
void begin_recording(const dsw_scene& scene, const dsw_recording_desc& desc, Owned<Recording>& made);
/** Ends the recording of a scene, if it has one. False: not all of it was written. */
bool end_recording(dsw_scene& scene) noexcept;
/** Checksum of the state of a scene, without counters and forecasts, and of its environment if asked for. Throws
 * std::bad_alloc. */
uint64_t state_of(const dsw_scene& scene, bool with_environment, uint32_t format = kSceneFormat);

/** What is told of the last call that changed a scene, to whom replays it. */
struct CallResult {
  bool made = false, failed = false, has_state = false;
  uint64_t digest = 0, state = 0;
};
/** What a replay and its scene tell each other. */
struct CallWatch {
  bool wants_state = false;
  /** The format of the snapshots whose checksums are the states. Snapshots before kOldestStateFormat hold forecasts,
   * which are made anew. */
  uint32_t state_format = kSceneFormat;
  /** For how many vertices the recorded host's points had room, and those of the deformation that is being made; there
   * is memory for as many as have been needed. */
  uint64_t room = 0, offered = 0;
  CallResult last;
};
/** What is written of the result of a call: whether it failed, the digest of what it answered and, if there is one, the
 * checksum of the state. */
constexpr size_t kResultWords = 2, kMostResultWords = 3;

/** One call, from before it is made to its end. */
class Recorded {
 public:
  /** `scene` may be null: an environment without one. The arguments are those of the function behind its handle;
   * results can be left out. */
  template <class Row, class... Arguments>
  Recorded(dsw_scene* scene, const Row& row, const Arguments&... arguments) noexcept
      : host_(scene),
        scene_(scene != nullptr && (scene->recording != nullptr || scene->watch != nullptr) ? scene : nullptr),
        with_environment_(changes_environment(row)) {
    if (host_ != nullptr) visit(*host_->environment, [](auto& env) { env.map.begin_call(); });
    if constexpr (kCanRecord) write(row, arguments...);
    if (needs_free_bodies(Row::number)) hide_edges();
  }

  /** It has done what it should; `results` are what it answered or changed, whatever is quick to read. */
  template <class... Results>
  void done(const Results&... results) noexcept {
    if (host_ != nullptr) visit(*host_->environment, [](auto& env) { env.map.keep_tables(); });
    show_edges(true);
    if (!kCanRecord || scene_ == nullptr) return;
    Digest digest;
    [[maybe_unused]] const WordSink add{
        &digest, [](void* to, const void* bytes, size_t count) { static_cast<Digest*>(to)->put(bytes, count); }};
    (for_each_part(as_result(results), add), ...);
    finish(false, digest.value());
  }

  /** Not done: it failed. */
  ~Recorded() {
    show_edges(false);
    if (kCanRecord && scene_ != nullptr) finish(true, 0);
  }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;

 private:
  template <class Row, class... Arguments>
  void write(const Row& row, const Arguments&... arguments) noexcept {
    if (scene_ == nullptr || scene_->recording == nullptr) return;
    typename Row::Given given{};
    fill(std::index_sequence_for<Arguments...>(), given, arguments...);
    write_call(row.number, &row, &given,
               [](const void* of, const void* all, const CallPlace& place, const WordSink& use) {
                 static_cast<const Row*>(of)->kinds.for_each(
                     [&](const auto& kind) { kind.write(*static_cast<const typename Row::Given*>(all), place, use); });
               });
  }
  /** Writes a call whose arguments `put` gives to a sink, first to learn how many words they are. */
  void write_call(uint64_t number, const void* row, const void* given,
                  void (*put)(const void* row, const void* given, const CallPlace& place,
                              const WordSink& use)) noexcept;
  template <size_t... I, class Given, class... Arguments>
  static void fill(std::index_sequence<I...>, [[maybe_unused]] Given& given, const Arguments&... arguments) noexcept {
    ((get<I + 1>(given) = arguments), ...);
  }

  void finish(bool failed, uint64_t digest) noexcept;

  void hide_edges() noexcept {
    if (host_ == nullptr) return;
    visit(*host_, [&](auto& scene) {
      hides_ = has_untested(scene);
      if (hides_) hide_blocked_edges(scene, true);
    });
  }
  void show_edges(bool changed) noexcept {
    if (!std::exchange(hides_, false)) return;
    visit(*host_, [&](auto& scene) { dsw::show_edges(scene, changed); });
  }

  dsw_scene* host_;   // null: an environment without one
  dsw_scene* scene_;  // null: nobody wants to know
  bool with_environment_;
  bool hides_ = false;  // edges of bodies, while the call is made
};

}  // namespace dsw::capi
