// Nearest points that are so close that their distance has few bits.
#include "proximity/near_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsw {
namespace {

constexpr double kLeast = 0x1p-1074;

template <int D>
void expect_diagonal(const double* p, std::initializer_list<const double*> obstacle) {
  const NearPoints n = find_near_points<D>(&p, 1, obstacle.begin(), static_cast<uint32_t>(obstacle.size()));
  EXPECT_NEAR(n.normal[0], -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(n.normal[1], std::sqrt(0.5), 1e-15);
  EXPECT_EQ(n.normal[2], 0);
  EXPECT_GE(n.distance, kLeast);
  EXPECT_LE(n.distance, 2 * kLeast);
}

TEST(NearPoints, ANormalIsAUnitVectorAtTheLeastDistanceToAPoint) {
  const double p[3] = {-kLeast, kLeast, 0}, a[3] = {};
  expect_diagonal<3>(p, {a});
  expect_diagonal<2>(p, {a});
}

TEST(NearPoints, ANormalIsAUnitVectorAtTheLeastDistanceToAnEdge) {
  const double p[3] = {-kLeast, kLeast, 0}, a[3] = {}, b[3] = {0, 0, 1};
  expect_diagonal<3>(p, {a, b});
}

}  // namespace
}  // namespace dsw
