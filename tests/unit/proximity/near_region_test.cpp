// Boxes in the directions of an edge and its way.
#include "proximity/near_region.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "effort.h"

namespace dsw {
namespace {

TEST(NearRegion, IsBoundedInThePlane) {
  const double points[4][2] = {{0, 0}, {1, 0}, {3, 2}, {4, 2}};  // the two ends of an edge, at the start and at the end
  const double* const corners[4] = {points[0], points[1], points[2], points[3]};
  for (const uint32_t count : {1u, 2u, 3u, 4u}) {
    const NearRegion<2> region(corners, count, 0.5);
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(region.outside(corners[i]), 0u) << count << " points";
    for (const std::array<double, 2>& far :
         std::vector<std::array<double, 2>>{{100, 0}, {-100, 0}, {0, 100}, {0, -100}})
      EXPECT_NE(region.outside(far.data()), 0u) << count << " points, " << far[0] << " " << far[1];
  }
}

/** A box is added as its corners are, but for rounding. */
template <int D>
void expect_boxes_as_corners() {
  std::mt19937_64 rng(seed_of(D));
  std::uniform_real_distribution<double> unit(-1, 1);
  for (size_t round = 0, n = static_cast<size_t>(effort_of(400)); round < n; ++round) {
    double points[4][D], low[D], high[D];
    const double* corners[4];
    for (int i = 0; i < 4; ++i) {
      corners[i] = points[i];
      for (int k = 0; k < D; ++k) points[i][k] = unit(rng) + (round % 3 == 0 ? 0x1p20 : 0);
    }
    for (int k = 0; k < D; ++k) {
      low[k] = points[0][k] + 2 * unit(rng);
      high[k] = low[k] + std::fabs(unit(rng));
    }
    NearRegion<D> boxed(corners, 4, 0.25), cornered = boxed;
    boxed.add_box(low, high);
    for (uint32_t corner = 0; corner < 1u << D; ++corner) {
      double at[D];
      for (int k = 0; k < D; ++k) at[k] = (corner >> k & 1) != 0 ? high[k] : low[k];
      cornered.add(at);
      EXPECT_EQ(boxed.outside(at), 0u);
    }
    EXPECT_LE(boxed.volume(), cornered.volume() * (1 + 1e-6));
    EXPECT_GE(boxed.volume(), cornered.volume() * (1 - 1e-6));
  }
}
TEST(NearRegion, TakesABoxAsItsCorners) {
  expect_boxes_as_corners<2>();
  expect_boxes_as_corners<3>();
}

}  // namespace
}  // namespace dsw
