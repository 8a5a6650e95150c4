#pragma once
// What a scene's opaque pointer points at.

#include "capi/handle.h"
#include "scene/scene.h"

namespace dsw::capi {
struct Recording;
struct CallWatch;
}  // namespace dsw::capi

struct dsw_scene {
  static constexpr const char* kName = "scene";
  static constexpr uint64_t kMagic = 0x6473775f73636e31u;
  uint64_t magic = kMagic;
  dsw_environment* environment;
  dsw::capi::Recording* recording = nullptr;  // owned; see recorded.h
  dsw::capi::CallWatch* watch = nullptr;      // of the replay that it belongs to
  dsw_scene* previous = nullptr;              // of the same environment
  dsw_scene* next = nullptr;
  dsw::capi::OfAnyDimension<dsw::Scene> engine;  // of the dimension of its environment

  /** `env` is that of `home`. */
  template <int D>
  dsw_scene(dsw_environment* home, const dsw::Environment<D>& env, dsw::SceneFeatures features);
  ~dsw_scene();
};

namespace dsw::capi {

/** Gives back a scene handle that its environment does not know. */
void destroy_scene(dsw_scene* scene) noexcept;
/** A handle that is being made: gone again unless it is released. */
struct DestroyScene {
  void operator()(dsw_scene* scene) const noexcept { destroy_scene(scene); }
};
using SceneOwner = std::unique_ptr<dsw_scene, DestroyScene>;
SceneOwner make_scene(dsw_environment& home, SceneFeatures features);
/** The environment knows of the scene from here on. Throws as `attach` and `let_points_move`. */
dsw_scene* enter(SceneOwner scene);
/** Makes what was saved. Throws as the engine's load. */
dsw_scene* load_scene(dsw_environment& home, const uint8_t* block, size_t size);

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

}  // namespace dsw::capi
