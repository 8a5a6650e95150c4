// What is saved, as bytes.
#pragma once

#include "support.h"

namespace dsw::oracle {

using Bytes = std::vector<unsigned char>;

template <class Object>
Bytes saved_by(dsw_status (*save)(const Object*, void*, size_t, size_t*), const Object* object) {
  size_t size = 0, again = 0;
  EXPECT_EQ(save(object, nullptr, 0, &size), DSW_STATUS_OK) << dsw_last_error_message();
  Bytes block(size);
  EXPECT_EQ(save(object, block.data(), block.size(), &again), DSW_STATUS_OK);
  EXPECT_EQ(again, size);
  return block;
}
inline Bytes saved(const dsw_environment* environment) { return saved_by(dsw_environment_save, environment); }
inline Bytes saved(const dsw_scene* scene) { return saved_by(dsw_scene_save, scene); }

/// A scene behind its environment.
inline std::string saved_both(const dsw_scene* scene) {
  const Bytes blocks[2] = {saved(dsw_scene_get_environment(scene)), saved(scene)};
  return std::string(blocks[0].begin(), blocks[0].end()).append(blocks[1].begin(), blocks[1].end());
}

template <class Block>
EnvironmentPtr load_environment(const Block& block) {
  dsw_environment* environment = nullptr;
  EXPECT_EQ(dsw_environment_load(nullptr, block.data(), block.size(), &environment), DSW_STATUS_OK)
      << dsw_last_error_message();
  return EnvironmentPtr(environment);
}
template <class Block>
ScenePtr load_scene(dsw_environment* environment, const Block& block) {
  dsw_scene* scene = nullptr;
  EXPECT_EQ(dsw_scene_load(environment, block.data(), block.size(), &scene), DSW_STATUS_OK) << dsw_last_error_message();
  return ScenePtr(scene);
}

/// An environment and what is in it.
struct Loaded {
  EnvironmentPtr environment;
  ScenePtr scene;
};
template <class Block>
Loaded load_both(const Block& of_environment, const Block& of_scene) {
  Loaded loaded;
  loaded.environment = load_environment(of_environment);
  loaded.scene = load_scene(loaded.environment.get(), of_scene);
  return loaded;
}

}  // namespace dsw::oracle
