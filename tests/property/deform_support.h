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

}  // namespace dsw::oracle
