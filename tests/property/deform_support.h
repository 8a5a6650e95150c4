// What tests of deformations share.
#pragma once

#include "support.h"

namespace dsw::oracle {

inline std::vector<double> points_of(const dsw_environment* environment) {
  const double* points = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(environment, &points, &count), DSW_STATUS_OK);
  return std::vector<double>(points, points + 3 * count);
}

inline ScenePtr make_deforming(dsw_environment* environment) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* scene = nullptr;
  EXPECT_EQ(dsw_scene_create(environment, &desc, &scene), DSW_STATUS_OK) << dsw_last_error_message();
  return ScenePtr(scene);
}

}  // namespace dsw::oracle
