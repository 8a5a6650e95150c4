#include "points.h"

#include <gtest/gtest.h>

namespace physics {
namespace {

Points two_points() {
  Points points;
  points.set(0, Vector3(0, 0, 0), 2);
  points.set(1, Vector3(1, 2, 3), 5);
  points.velocity[0] = Vector3(1, 0, -1);
  points.velocity[1] = Vector3(0.5, 3, 2);
  return points;
}

TEST(Points, SplittingKeepsMassAndMomentum) {
  Points points = two_points();
  const Vector3 before = momentum_of(points);
  points.split(0, 1, 4, 0.25, 0.5);
  EXPECT_DOUBLE_EQ(points.mass[0] + points.mass[1] + points.mass[4], 7);
  EXPECT_DOUBLE_EQ(points.mass[4], 0.5 * (0.75 * 2 + 0.25 * 5));
  EXPECT_LT((momentum_of(points) - before).norm(), 1e-14);
  EXPECT_EQ(points.mass[2] + points.mass[3], 0) << "slots between are free";
}

TEST(Points, MergingGivesBackWhatSplittingTook) {
  Points points = two_points();
  const Vector3 before = momentum_of(points);
  points.split(0, 1, 2, 0.25, 0.5);
  points.velocity[2] += Vector3(1, 1, 1);
  const Vector3 pushed = momentum_of(points);
  points.merge(2, 0, 1, 0.25);
  EXPECT_NEAR(points.mass[0] + points.mass[1], 7, 1e-14);
  EXPECT_EQ(points.mass[2], 0);
  EXPECT_LT((momentum_of(points) - pushed).norm(), 1e-14);
  EXPECT_GT((pushed - before).norm(), 1);
}

TEST(Points, HeldPointsGiveAndTakeNoMass) {
  Points points = two_points();
  points.held[0] = 1;
  points.split(0, 1, 2, 0.5, 0.5);
  EXPECT_EQ(points.mass[0], 2);
  EXPECT_EQ(points.mass[1], 5 - 0.25 * 5);
  points.merge(2, 0, 1, 0.5);
  EXPECT_EQ(points.mass[0], 2);
  EXPECT_EQ(points.inverse_mass(0), 0);
}

TEST(Points, SharedOutAnewTheyKeepTheirMomentum) {
  Points points = two_points();
  const Vector3 before = momentum_of(points);
  const double sum = points.mass[0] + points.mass[1];
  points.share_out({0.25 * sum, 0.75 * sum});
  EXPECT_EQ(points.mass[0], 0.25 * sum);
  EXPECT_LT((momentum_of(points) - before).norm(), 1e-14);
}

}  // namespace
}  // namespace physics
