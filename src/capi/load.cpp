// Handles of what was saved, for snapshots and recordings.

#include "capi/handle.h"
#include "capi/scene_handle.h"
#include "snapshot/block.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"

namespace dsw::capi {

dsw_environment* load_environment(dsw_context* context, const uint8_t* block, size_t size) {
  EnvironmentOwner owner = make_environment(context, saved_dimension(block, size));
  visit(*owner, [&](auto& env) { load(env, block, size); });
  choose_kernels(*owner);
  return owner.release();
}

dsw_scene* load_scene(dsw_environment& home, const uint8_t* block, size_t size) {
  const SceneFeatures features =
      visit(home, [&](const auto& env) { return saved_features<kDimension<decltype(env)>>(block, size); });
  SceneOwner owner = make_scene(home, features);
  visit(*owner, [&](auto& engine) { load(engine, block, size); });
  return enter(std::move(owner));
}

}  // namespace dsw::capi
