#pragma once
// What a recording keeps of the calls that change a scene or its environment: src/record/README.md. A call is written when it can be read
// from its arguments and before the engine is asked, so that it is there if the process dies in it; calls that are refused until then change
// nothing and are left out, those that the engine refuses are written as failed.

#include <cstdio>
#include <cstring>

#include "base/owned.h"
#include "base/points.h"
#include "capi/convert.h"
#include "dartsweep/record.h"
#include "record/record.h"

namespace dsw::capi {

/** Numbers are those of recordings: new ones are appended. replay.cpp has a row for each. */
enum class Call : uint32_t {
  kMarkVolumes = 1,
  kMarkFaces,
  kMarkEdges,
  kMarkVertices,
  kMarkRegion,
  kMarkBetween,
  kSetTag,
  kAddVolumes,
  kRemoveVolumes,
  kSewFaces,
  kUnsewFace,
  kMergeVolumes,
  kSplitVolume,
  kMergeFaces,
  kSplitFace,
  kSplitEdge,
  kMergeEdges,
  kCollapseEdge,
  kCut,
  kTearFaces,
  kOpen,
  kCarve,
  kTie,
  kDetach,
  kRemesh,
  kDeform,
  kCreateParticle,
  kCreateParticles,
  kDestroyParticle,
  kMoveParticle,
  kMoveParticles,
  kCastFromParticles,
  kResetStatistics,
  kCreateBody,
  kDestroyBody,
  kSetLevel,
  kSetFilter,
  kAddBodyVertex,
  kAddBodyEdge,
  kAddBodyFace,
  kRemoveBodyFace,
  kRemoveBodyEdge,
  kRemoveBodyVertex,
  kSplitBodyEdge,
  kCollapseBodyEdge,
  kMoveBody,
  kMoveBodies,
  kMoveRigid,
  kCount
};

/** An array of plain things; null is told from empty. */
template <class T>
struct Items {
  const T* items;
  size_t count;
};
template <class T>
Items<T> items_of(const Array<T>& array) noexcept {
  return {array.data(), array.size()};
}

/** As a result: an empty array says the same whether there was ever memory for it or not. */
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
  size_t count;
  uint32_t dimension = 3;
};

/** The points of a deformation: those that are elsewhere than where the environment has them. */
template <int D>
struct MovedPoints {
  const double* next;
  const Environment<D>& env;
};
template <int D>
MovedPoints(const double*, const Environment<D>&) -> MovedPoints<D>;

/** A struct of the interface, whose pointers are written as null: what they point at is written after it. */
template <class T, class... Pointers>
T without(T given, Pointers... pointers) noexcept {
  given.struct_size = sizeof(T);  // also of defaults, which have none
  ((given.*pointers = nullptr), ...);
  return given;
}

constexpr uint64_t kNullArray = UINT64_MAX;

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
  const uint64_t count = array.points.data == nullptr ? kNullArray : array.dimension * uint64_t{array.count};
  use(&count, sizeof count);
  for (size_t i = 0; count != kNullArray && i < array.count; ++i) {
    use(array.points[i], array.dimension * sizeof(double));
  }
}
template <int D, class Use>
void for_each_part(const MovedPoints<D>& of, const Use& use) {
  for (uint32_t v = 0; v < of.env.map.vertex_count; ++v) {
    const double* const to = of.next + D * size_t{v};
    if (std::memcmp(to, of.env.point(v), D * sizeof(double)) == 0) continue;
    const uint64_t vertex = v;
    use(&vertex, sizeof vertex);
    use(to, D * sizeof(double));
  }
  use(&kNullArray, sizeof kNullArray);
}
/** Where a body is. */
template <int D, class Use>
void for_each_part(const Body<D>& body, const Use& use) {
  for (const BodyVertex<D>& v : body.vertices) use(v.position, sizeof v.position);
}

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

/** Before a call: begins a recording in memory anew where it has grown too long, or did not go on for want of memory. */
void renew_kept(dsw_scene& scene) noexcept;

/** Checksum of what is in a scene, and of its environment if asked for, as saved. Throws std::bad_alloc. */
uint64_t state_of(const dsw_scene& scene, bool with_environment);

/** Ends the recording of a scene, if it has one. False: not all of it was written. */
bool end_recording(dsw_scene& scene) noexcept;

/** What is told of the last call that changed a scene, to whom replays it. */
struct CallResult {
  bool made = false, failed = false, has_state = false;
  uint64_t digest = 0, state = 0;
};

/** What a replay and its scene tell each other. */
struct CallWatch {
  bool wants_state = false;
  /** For how many vertices the recorded host's points had room, and those of the deformation that is being made; there is memory for as many
   * as have been needed. */
  uint64_t room = 0, offered = 0;
  CallResult last;
};

/** What is written of the result of a call: whether it failed, the digest of what it answered and, if there is one, the checksum of the state. */
constexpr size_t kResultWords = 2, kMostResultWords = 3;

/** One call, from before it is made to its end. */
class Recorded {
 public:
  /** `scene` may be null: an environment without one. */
  template <class... Arguments>
  Recorded(dsw_scene* scene, Call call, const Arguments&... arguments) noexcept
      : scene_(scene != nullptr && (scene->recording != nullptr || scene->watch != nullptr) ? scene : nullptr),
        call_(call) {
    if (scene_ == nullptr || scene_->recording == nullptr) return;
    renew_kept(*scene_);
    RecordWriter& writer = scene_->recording->writer;
    uint64_t size = sizeof(uint64_t);
    [[maybe_unused]] const auto measure = [&](const void*, size_t bytes) { size += (bytes + 7) & ~size_t{7}; };
    (for_each_part(arguments, measure), ...);
    writer.begin(EntryKind::kCall, size);
    const auto number = static_cast<uint64_t>(call);
    writer.put(&number, sizeof number);
    [[maybe_unused]] const auto put = [&](const void* bytes, size_t count) {
      const size_t whole = count & ~size_t{7};
      writer.put(bytes, whole);
      if (whole == count) return;
      uint8_t rest[8] = {};
      std::memcpy(rest, static_cast<const uint8_t*>(bytes) + whole, count - whole);
      writer.put(rest, sizeof rest);
    };
    (for_each_part(arguments, put), ...);
    writer.end();
  }

  /** It has done what it should; `results` are what it answered or changed, whatever is quick to read. */
  template <class... Results>
  void done(const Results&... results) noexcept {
    if (scene_ == nullptr) return;
    Digest digest;
    [[maybe_unused]] const auto put = [&](const void* bytes, size_t count) { digest.put(bytes, count); };
    (for_each_part(as_result(results), put), ...);
    finish(false, digest.value());
  }

  /** Not done: it failed. */
  ~Recorded() {
    if (scene_ != nullptr) finish(true, 0);
  }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;

 private:
  void finish(bool failed, uint64_t digest) noexcept;

  dsw_scene* scene_;  // null: nobody wants to know
  Call call_;
};

}  // namespace dsw::capi
