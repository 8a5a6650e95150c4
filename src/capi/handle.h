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
#include "environment/environment.h"
#include "scene/change_results.h"

namespace dsw::capi {

#if DSW_WITHOUT_PLANE
inline constexpr bool kHasPlane = false;
#else
inline constexpr bool kHasPlane = true;
#endif
template <template <int> class Engine>
using OfAnyDimension = std::conditional_t<kHasPlane, std::variant<Engine<3>, Engine<2>>, std::variant<Engine<3>>>;

/** Calls use(D) with the number of dimensions, 2 or else 3, as a constant. Throws NOT_BUILT without the plane. */
template <class Use>
decltype(auto) with_dimension(uint32_t dimension, const Use& use) {
  if (dimension == 2) {
    if constexpr (kHasPlane) return use(std::integral_constant<int, 2>{});
    fail(DSW_STATUS_NOT_BUILT, "this library was built without the plane (DSW_WITH_PLANE)");
  }
  return use(std::integral_constant<int, 3>{});
}

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
  dsw::capi::OfAnyDimension<dsw::Environment> engine;  // see visit and space
  mutable std::mutex scenes_mutex;                     // hosts make scenes of a shared environment on several threads
  dsw_scene* first_scene = nullptr;                    // a list through dsw_scene::next
  uint32_t scene_count = 0;
  dsw::ChangeResults results;  // of changes of the topology

  /** `dimension`: 2 or 3. */
  dsw_environment(dsw_context* owner, uint32_t dimension);
};

namespace dsw::capi {

inline const Memory* memory_of(const dsw_context* context) { return context == nullptr ? nullptr : &context->memory; }
inline const Memory* memory_of(const dsw_environment& environment) { return memory_of(environment.context); }

/** Whether an environment or a scene is of the plane. */
template <class Handle>
bool is_planar(const Handle& handle) {
  return handle.engine.index() != 0;
}

/** Calls use(engine) with the engine of an environment or a scene, whatever its dimension: for functions that serve
 * space and plane. It takes less time to compile than std::visit. */
template <class Handle, class Use>
decltype(auto) visit(Handle& handle, const Use& use) {
  if constexpr (kHasPlane) {
    if (is_planar(handle)) return use(*std::get_if<1>(&handle.engine));
  }
  return use(*std::get_if<0>(&handle.engine));
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

/** A handle that is being made: gone again unless it is released. */
struct DestroyEnvironment {
  void operator()(dsw_environment* environment) const noexcept { destroy_environment(environment); }
};
using EnvironmentOwner = std::unique_ptr<dsw_environment, DestroyEnvironment>;
EnvironmentOwner make_environment(dsw_context* context, uint32_t dimension);
/** Finds the fastest walks for the kinds of cells that a new environment has. */
void choose_kernels(const dsw_environment& environment) noexcept;

/** Makes what was saved. Throws as the engine's load. */
dsw_environment* load_environment(dsw_context* context, const uint8_t* block, size_t size);

/** All memory that an environment holds; borrowed points included. */
uint64_t memory_bytes(const dsw_environment& environment);
/** Scenes that use an environment now. */
uint32_t scene_count(const dsw_environment& environment);
/** The only scene; null if there is none. Throws if there are several. */
dsw_scene* only_scene(const dsw_environment& environment);
/** One line to the host's log, if it has one. */
DSW_PRINTF(3, 4) void log_line(const dsw_context* context, dsw_log_level level, const char* format, ...) noexcept;

}  // namespace dsw::capi
