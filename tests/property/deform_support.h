// What tests of deformations share.
#pragma once

#include <cmath>

#include "support.h"

namespace dsw::oracle {

inline std::vector<double> points_of(const dsw_environment* environment) {
  const double* points = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(environment, &points, &count), DSW_STATUS_OK);
  return std::vector<double>(points, points + 3 * count);
}

/// A wave through the points.
inline std::vector<double> bent(const std::vector<double>& points, double by) {
  std::vector<double> next = points;
  for (size_t i = 0; i + 2 < next.size(); i += 3) {
    next[i] += by * std::sin(3 * points[i + 1]);
    next[i + 2] += by * std::sin(2 * points[i] + points[i + 1]);
  }
  return next;
}

}  // namespace dsw::oracle
