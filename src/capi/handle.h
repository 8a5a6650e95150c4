#pragma once
// What the opaque pointers point at. Each begins with a number that tells what it is, so that a wrong or (as far as its
// memory still tells) a destroyed handle is refused.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/compiler.h"
#include "capi/guard.h"
#include "dartsweep/scene.h"
#include "scene/change.h"

namespace dsw::capi {
struct Recording;
struct CallWatch;
}  // namespace dsw::capi

struct dsw_context {
  static constexpr const char* kName = "context";
  static constexpr uint64_t kMagic = 0x6473775f63747831u;
  uint64_t magic = kMagic;
  dsw::Memory memory;
  dsw::Parallel parallel;
  const dsw::Kernels* kernels = nullptr;  // null: those that are fastest
  dsw_log_fn log = nullptr;
  void* user = nullptr;
  std::atomic<uint32_t> users{0};  // environments and traces made with it
};

struct dsw_environment {
  static constexpr const char* kName = "environment";
  static constexpr uint64_t kMagic = 0x6473775f656e7631u;
  uint64_t magic = kMagic;
  dsw_context* context;  // may be null
  dsw::Parallel parallel;
  std::variant<dsw::Environment<3>, dsw::Environment<2>> engine;  // see visit and space
  mutable std::mutex scenes_mutex;   // hosts make scenes of a shared environment on several threads
  dsw_scene* first_scene = nullptr;  // a list through dsw_scene::next
  uint32_t scene_count = 0;
  dsw::ChangeResults results;  // of changes of the topology

  /** `dimension`: 2 or 3. */
  dsw_environment(dsw_context* owner, uint32_t dimension);
};

struct dsw_scene {
  static constexpr const char* kName = "scene";
  static constexpr uint64_t kMagic = 0x6473775f73636e31u;
  uint64_t magic = kMagic;
  dsw_environment* environment;
  dsw::capi::Recording* recording = nullptr;  // owned; see recorded.h
  dsw::capi::CallWatch* watch = nullptr;      // of the replay that it belongs to
  dsw_scene* previous = nullptr;              // of the same environment
  dsw_scene* next = nullptr;
  std::variant<dsw::Scene<3>, dsw::Scene<2>> engine;  // of the dimension of its environment

  /** `env` is that of `home`. */
  template <int D>
  dsw_scene(dsw_environment* home, const dsw::Environment<D>& env, dsw::SceneFeatures features);
  ~dsw_scene();
};

namespace dsw::capi {

inline const Memory* memory_of(const dsw_context* context) { return context == nullptr ? nullptr : &context->memory; }
inline const Memory* memory_of(const dsw_environment& environment) { return memory_of(environment.context); }

/** Calls use(engine) with the engine of an environment or a scene, whatever its dimension: for functions that serve
 * space and plane. */
template <class Handle, class Use>
decltype(auto) visit(Handle& handle, const Use& use) {
  return std::visit(use, handle.engine);
}

/** Whether an environment or a scene is of the plane. */
template <class Handle>
bool is_planar(const Handle& handle) {
  return handle.engine.index() != 0;
}

/** The engine of an environment or a scene in space; refuses planar ones: for functions of space. */
template <class Handle>
auto& space(Handle& handle) {
  if (is_planar(handle)) fail(DSW_STATUS_UNSUPPORTED, "this function is not available in the plane");
  return std::get<0>(handle.engine);
}

/** Refuses null and what is not a live object of this kind; `name` is the parameter's. */
template <class Handle>
Handle& check_handle(Handle* handle, const char* name = Handle::kName) {
  require(handle, name);
  if (handle->magic != Handle::kMagic) fail(DSW_STATUS_STALE_ID, "%s is not a live object of its type", name);
  return *handle;
}

/** Runs the body of the entry point named `function` with the engine of a handle, whatever its dimension. */
template <class Handle, class Body>
dsw_status guarded_visit(const char* function, Handle* handle, const Body& body) noexcept {
  return guard(function, [&] { visit(check_handle(handle), body); });
}

/** The dimension of an engine as visit passes it. */
template <class Engine>
constexpr int kDimension = std::decay_t<Engine>::kDimension;

/** A context is optional: null passes. */
inline dsw_context* check_context(dsw_context* context) {
  return context == nullptr ? nullptr : &check_handle(context);
}

/** Makes an object in the host's memory. */
template <class T, class... Arguments>
T* create_object(const Memory* memory, Arguments&&... arguments) {
  static_assert(alignof(T) <= kBlockAlignment);
  void* const block = allocate_bytes(memory, sizeof(T), kBlockAlignment);
  try {
    return new (block) T(std::forward<Arguments>(arguments)...);
  } catch (...) {
    release_bytes(memory, block, sizeof(T), kBlockAlignment);
    throw;
  }
}

/** `memory` must not lie inside the object. */
template <class T>
void destroy_object(const Memory* memory, T* object) noexcept {
  *const_cast<volatile uint64_t*>(&object->magic) = 0;  // else the compiler drops a store into what is about to end
  object->~T();
  release_bytes(memory, object, sizeof(T), kBlockAlignment);
}

/** Something made with a context keeps it from being destroyed. Null is allowed. */
void retain(dsw_context* context) noexcept;
void release(dsw_context* context) noexcept;

/** Gives back an environment handle that no scene uses. */
void destroy_environment(dsw_environment* environment) noexcept;
/** Gives back a scene handle that its environment does not know. */
void destroy_scene(dsw_scene* scene) noexcept;

/** Handles that are being made: gone again unless they are released. */
struct DestroyHandle {
  void operator()(dsw_environment* environment) const noexcept { destroy_environment(environment); }
  void operator()(dsw_scene* scene) const noexcept { destroy_scene(scene); }
};
using EnvironmentOwner = std::unique_ptr<dsw_environment, DestroyHandle>;
using SceneOwner = std::unique_ptr<dsw_scene, DestroyHandle>;
EnvironmentOwner make_environment(dsw_context* context, uint32_t dimension);
SceneOwner make_scene(dsw_environment& home, SceneFeatures features);
/** The environment knows of the scene from here on. Throws as `attach` and `let_points_move`. */
dsw_scene* enter(SceneOwner scene);

/** Makes what was saved. Throws as the engine's load. */
dsw_environment* load_environment(dsw_context* context, const uint8_t* block, size_t size);
dsw_scene* load_scene(dsw_environment& home, const uint8_t* block, size_t size);

/** All memory that an environment holds; borrowed points included. */
uint64_t memory_bytes(const dsw_environment& environment);
/** Scenes that use an environment now. */
uint32_t scene_count(const dsw_environment& environment);
/** The only scene; null if there is none. Throws if there are several. */
dsw_scene* only_scene(const dsw_environment& environment);
/** Calls use(scene) for each scene of an environment. */
template <class Use>
void for_each_scene(const dsw_environment& environment, const Use& use) {
  const std::lock_guard<std::mutex> lock(environment.scenes_mutex);
  for (dsw_scene* scene = environment.first_scene; scene != nullptr; scene = scene->next) use(*scene);
}
/** Gives the engine of a scene whose environment is given; null for a null scene. */
template <int D>
Scene<D>* engine_of(dsw_scene* scene, const Environment<D>&) {
  return scene == nullptr ? nullptr : &std::get<Scene<D>>(scene->engine);
}
inline SceneFeatures features_of(const dsw_scene& scene) {
  return visit(scene, [](const auto& engine) { return engine.features; });
}
/** Throws IN_USE where a scene that deforms the environment would not be its only one. */
void attach(dsw_scene& scene);
void detach(dsw_scene& scene);

/** One line to the host's log, if it has one. */
DSW_PRINTF(3, 4) void log_line(const dsw_context* context, dsw_log_level level, const char* format, ...) noexcept;

}  // namespace dsw::capi
