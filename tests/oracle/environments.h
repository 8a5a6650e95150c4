// Handles that end with their scope, and environments of meshes.
#pragma once

#include "mesh.h"

#include <memory>

namespace dsw::oracle {

struct EnvironmentDelete {
  void operator()(dsw_environment* e) const { dsw_environment_destroy(e); }
};
using EnvironmentPtr = std::unique_ptr<dsw_environment, EnvironmentDelete>;

inline dsw_change empty_change() {
  dsw_change change{};
  change.struct_size = sizeof change;
  return change;
}
/// The last change of the topology.
inline dsw_change change_of(const dsw_environment* environment) {
  dsw_change change = empty_change();
  dsw_environment_get_change(environment, &change);
  return change;
}
struct SceneDelete {
  void operator()(dsw_scene* s) const { dsw_scene_destroy(s); }
};
using ScenePtr = std::unique_ptr<dsw_scene, SceneDelete>;

/// Creates the environment of a mesh; null with a message on stderr if the library refuses it.
EnvironmentPtr create_environment(const Mesh& mesh, const Layout& layout = {}, uint32_t flags = 0,
                                  dsw_context* context = nullptr);

}  // namespace dsw::oracle
