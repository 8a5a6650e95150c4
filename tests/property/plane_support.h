// Environments of the plane for property tests.
#pragma once

#include "support.h"

#include <vector>

namespace dsw::oracle {

/// A grid of n * n squares whose inner points have been moved, each cut into two triangles or left as a quadrilateral.
inline EnvironmentPtr make_squares(uint32_t n, bool cut, dsw_context* context = nullptr, double size = 1) {
  Rng rng(n);
  std::vector<double> points;
  std::vector<int32_t> corners;
  for (uint32_t y = 0; y <= n; ++y) {
    for (uint32_t x = 0; x <= n; ++x) {
      const double jitter = x == 0 || y == 0 || x == n || y == n ? 0 : 0.2;
      for (const uint32_t at : {x, y}) points.push_back(size * (at + rng.range(-jitter, jitter)));
    }
  }
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      const auto a = static_cast<int32_t>(x + (n + 1) * y), b = a + 1, d = a + static_cast<int32_t>(n) + 1, c = d + 1;
      if (cut) {
        corners.insert(corners.end(), {a, b, c, a, c, d});
      } else {
        corners.insert(corners.end(), {a, b, c, d});
      }
    }
  }
  return create_from(uniform_desc(2, cut ? DSW_CELL_TYPE_TRIANGLE : DSW_CELL_TYPE_QUAD, cut ? 3 : 4, points, corners),
                     context);
}

}  // namespace dsw::oracle
