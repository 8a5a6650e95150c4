// Environments that random changes are made to, and what is put into them.
#pragma once

#include "support.h"

#include "plane_scenes.h"

namespace dsw::oracle {

template <int D>
struct Ground;

template <>
struct Ground<3> : Place {
  Ground(const std::string& scene, uint64_t seed, dsw_context* context)
      : Place(make_place(scene, seed, seed % 2 * DSW_ENVIRONMENT_LOCATE_TREE, context)) {}
  double size() const { return world->size; }
  Vec start(Rng& rng) const { return Motions(*world, rng).start(); }
};

template <>
struct Ground<2> {
  plane::World world;
  EnvironmentPtr environment;

  Ground(const std::string& scene, uint64_t seed, dsw_context* context);
  dsw_environment* get() const { return environment.get(); }
  double size() const { return size_; }
  plane::Vec start(Rng& rng) const;

 private:
  double size_ = 0;
};

inline std::vector<std::string> plane_scene_names() {
  std::vector<std::string> names;
  for (const plane::Kind& kind : plane::kinds()) names.emplace_back(kind.name);
  return names;
}
#define DSW_FOR_ALL_PLANE_SCENES(name)                                                                         \
  INSTANTIATE_TEST_SUITE_P(All, name,                                                                          \
                           testing::ValuesIn(dsw::oracle::drawn_for(#name, dsw::oracle::plane_scene_names())), \
                           [](const testing::TestParamInfo<std::string>& i) { return i.param; })

/// Number `number` of those that go round: of four vertices, at every level. Not made where it would not be free.
void create_some_body(dsw_scene* scene, const std::vector<Vec>& at, uint32_t number);
void create_some_body(dsw_scene* scene, const std::vector<plane::Vec>& at, uint32_t number);

}  // namespace dsw::oracle
