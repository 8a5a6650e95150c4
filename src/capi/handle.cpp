#include "capi/handle.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <thread>

#include "capi/recorded.h"
#include "capi/scene_handle.h"
#include "environment/moving.h"
#include "scene/deformation.h"
#include "walk/fastest.h"

dsw_environment::dsw_environment(dsw_context* owner, uint32_t dimension)
    : context(owner),
      engine(std::in_place_type<dsw::Environment<3>>, dsw::capi::memory_of(owner)),
      results(dsw::capi::memory_of(owner)) {
  dsw::capi::with_dimension(dimension, [&](auto d) {
    if (d != 3) engine.emplace<dsw::Environment<decltype(d)::value>>(dsw::capi::memory_of(owner));
  });
  if (owner != nullptr) {
    parallel = owner->parallel;
  } else {
    // Asked once: the answer costs a system call.
    parallel.thread_count = std::max(1u, std::thread::hardware_concurrency());
  }
  std::visit([&](auto& env) { env.index.share(parallel); }, engine);
}

template <int D>
dsw_scene::dsw_scene(dsw_environment* home, const dsw::Environment<D>& env, dsw::SceneFeatures features)
    : environment(home), engine(std::in_place_type<dsw::Scene<D>>, env, env.memory, home->parallel, features) {}

dsw_scene::~dsw_scene() {
  if constexpr (dsw::capi::kCanRecord) dsw::capi::end_recording(*this);
}

namespace dsw::capi {

void retain(dsw_context* context) noexcept {
  if (context != nullptr) context->users.fetch_add(1, std::memory_order_relaxed);
}

void release(dsw_context* context) noexcept {
  if (context != nullptr) context->users.fetch_sub(1, std::memory_order_release);
}

EnvironmentOwner make_environment(dsw_context* context, uint32_t dimension) {
  EnvironmentOwner made(create_object<dsw_environment>(memory_of(context), context, dimension));
  retain(context);
  if (dimension == 3) {  // in the plane there is one kernel
    const bool is_named = context != nullptr && context->kernels != nullptr;
    std::get<Environment<3>>(made->engine).kernels = is_named ? context->kernels : &fastest_kernels();
  }
  return made;
}

void choose_kernels(const dsw_environment& environment) noexcept {
  if (!is_planar(environment)) measure_kernels(space(environment));
}

void destroy_environment(dsw_environment* environment) noexcept {
  dsw_context* const context = environment->context;
  destroy_object(memory_of(context), environment);
  release(context);
}

SceneOwner make_scene(dsw_environment& home, SceneFeatures features) {
  return SceneOwner(
      visit(home, [&](const auto& env) { return create_object<dsw_scene>(env.memory, &home, env, features); }));
}

void destroy_scene(dsw_scene* scene) noexcept { destroy_object(memory_of(*scene->environment), scene); }

dsw_scene* enter(SceneOwner owner) {
  visit(*owner, [&](auto& scene) {
    auto& env = std::get<Environment<kDimension<decltype(scene)>>>(owner->environment->engine);
    if (scene.features.deforming) scene.deformation.make(env);
    attach(*owner);
    if (!scene.features.deforming) return;
    try {
      let_points_move(env);
    } catch (...) {
      detach(*owner);
      throw;
    }
  });
  return owner.release();
}

uint64_t memory_bytes(const dsw_environment& environment) {
  const uint64_t of_engine = visit(environment, [](const auto& env) { return env.memory_bytes() - sizeof env; });
  return of_engine + environment.results.memory_bytes() + sizeof environment;
}

uint32_t scene_count(const dsw_environment& environment) {
  const std::lock_guard<std::mutex> lock(environment.scenes_mutex);
  return environment.scene_count;
}

dsw_scene* only_scene(const dsw_environment& environment) {
  const std::lock_guard<std::mutex> lock(environment.scenes_mutex);
  if (environment.scene_count > 1) {
    fail(DSW_STATUS_SHARED, "environment is shared by %u scenes and cannot be changed", environment.scene_count);
  }
  return environment.first_scene;
}

void attach(dsw_scene& scene) {
  dsw_environment& home = *scene.environment;
  const std::lock_guard<std::mutex> lock(home.scenes_mutex);
  const dsw_scene* const other = home.first_scene;
  if (other != nullptr && (features_of(*other).deforming || features_of(scene).deforming)) {
    fail(DSW_STATUS_IN_USE, "%u scenes use the environment, and %s deforms it", home.scene_count,
         features_of(*other).deforming ? "one" : "the new one");
  }
  scene.next = home.first_scene;
  if (scene.next != nullptr) scene.next->previous = &scene;
  home.first_scene = &scene;
  ++home.scene_count;
}

void detach(dsw_scene& scene) {
  dsw_environment& home = *scene.environment;
  const std::lock_guard<std::mutex> lock(home.scenes_mutex);
  if (scene.next != nullptr) scene.next->previous = scene.previous;
  (scene.previous != nullptr ? scene.previous->next : home.first_scene) = scene.next;
  --home.scene_count;
}

void log_line(const dsw_context* context, dsw_log_level level, const char* format, ...) noexcept {
  if (context == nullptr || context->log == nullptr) return;
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  context->log(context->user, level, text);
}

}  // namespace dsw::capi
