#include "contact_response.h"

#include <gtest/gtest.h>

#include "random_line.h"

namespace physics {
namespace {

Touch touch_of(std::size_t point, const Vector3& normal, double friction) {
  Touch touch;
  touch.point[0] = point;
  touch.normal = normal;
  touch.friction = friction;
  return touch;
}

Points moving(const Vector3& velocity) {
  Points points;
  points.set(0, Vector3::Zero(), 2);
  points.velocity[0] = velocity;
  return points;
}

TEST(ContactResponse, EndsTheApproachAndNoMore) {
  Points points = moving(Vector3(3, 0, -4));
  std::vector<Touch> touches = {touch_of(0, Vector3(0, 0, 1), 0)};
  resolve(0, 4, &touches, &points);
  EXPECT_LT((points.velocity[0] - Vector3(3, 0, 0)).norm(), 1e-14);
  EXPECT_LT((touches[0].impulse - Vector3(0, 0, 8)).norm(), 1e-14);

  points = moving(Vector3(3, 0, 4));
  resolve(0, 4, &touches, &points);
  EXPECT_EQ(points.velocity[0], Vector3(3, 0, 4)) << "it leaves: nothing is done";
}

TEST(ContactResponse, RestitutionGivesSpeedBack) {
  Points points = moving(Vector3(0, 0, -4));
  std::vector<Touch> touches = {touch_of(0, Vector3(0, 0, 1), 0)};
  resolve(0.5, 4, &touches, &points);
  EXPECT_NEAR(points.velocity[0].z(), 2, 1e-14);
}

TEST(ContactResponse, FrictionStaysInItsCone) {
  std::mt19937 bits(1);
  int sticks = 0, slides = 0;
  for (int i = 0; i < 1000; ++i) {
    const double friction = 0.7;
    const Vector3 normal = random_vector(&bits).normalized(), before = random_vector(&bits);
    Points points = moving(before);
    std::vector<Touch> touches = {touch_of(0, normal, friction)};
    resolve(0, 4, &touches, &points);
    const double push = touches[0].impulse.dot(normal);
    const Vector3 rub = touches[0].impulse - push * normal;
    EXPECT_GE(push, 0);
    EXPECT_LE(rub.norm(), friction * push * (1 + 1e-12) + 1e-15);
    EXPECT_LT((2 * (points.velocity[0] - before) - touches[0].impulse).norm(), 1e-14)
        << "impulse is change of momentum";
    EXPECT_LE(points.velocity[0].norm(), before.norm() * (1 + 1e-14)) << "no contact adds energy";
    const Vector3 along = points.velocity[0] - points.velocity[0].dot(normal) * normal;
    const Vector3 along_before = before - before.dot(normal) * normal;
    EXPECT_GE(along.dot(along_before), -1e-14) << "friction turns nothing round";
    sticks += push > 0 && along.norm() < 1e-12;
    slides += push > 0 && along.norm() > 1e-3;
  }
  EXPECT_GT(sticks, 50);
  EXPECT_GT(slides, 50);
}

TEST(ContactResponse, AnEdgeSharesTheImpulseBetweenItsEnds) {
  Points points;
  points.set(0, Vector3(0, 0, 0), 1);
  points.set(1, Vector3(1, 0, 0), 3);
  points.velocity[0] = Vector3(0, 0, -2);
  points.velocity[1] = Vector3(0, 0, -1);
  const Vector3 before = momentum_of(points);
  Touch touch = touch_of(0, Vector3(0, 0, 1), 0);
  touch.count = 2;
  touch.point[1] = 1;
  touch.share[0] = 0.75;
  touch.share[1] = 0.25;
  touch.at = Vector3(0.25, 0, 0);
  const Vector3 spin = angular_momentum_of(points);
  std::vector<Touch> touches = {touch};
  resolve(0, 4, &touches, &points);
  EXPECT_NEAR((0.75 * points.velocity[0] + 0.25 * points.velocity[1]).z(), 0, 1e-14) << "the touching point rests";
  EXPECT_LT((momentum_of(points) - before - touches[0].impulse).norm(), 1e-14);
  EXPECT_LT((angular_momentum_of(points) - spin - touch.at.cross(touches[0].impulse)).norm(), 1e-14);
  EXPECT_GT(points.velocity[0].z() + 2, 0);
  EXPECT_GT(points.velocity[1].z() + 1, 0);
}

TEST(ContactResponse, TwoWallsHoldACorner) {
  Points points = moving(Vector3(-1, -2, 0.5));
  std::vector<Touch> touches = {touch_of(0, Vector3(1, 0, 0), 0), touch_of(0, Vector3(1, 1, 0).normalized(), 0)};
  resolve(0, 100, &touches, &points);
  for (const Touch& touch : touches) {
    EXPECT_GE(points.velocity[0].dot(touch.normal), -1e-9);
  }
  EXPECT_EQ(points.velocity[0].z(), 0.5);
}

TEST(ContactResponse, AHandIsNotMoved) {
  Points points = moving(Vector3(0, 0, -1));
  points.held[0] = 1;
  std::vector<Touch> touches = {touch_of(0, Vector3(0, 0, 1), 1)};
  resolve(0, 4, &touches, &points);
  EXPECT_EQ(points.velocity[0], Vector3(0, 0, -1));
  EXPECT_EQ(touches[0].impulse, Vector3(0, 0, 0));
}

TEST(Friction, ComesFromTheTag) {
  Friction friction;
  friction.otherwise = 0.1;
  friction.by_tag[7] = 0.9;
  EXPECT_EQ(friction.of(7), 0.9);
  EXPECT_EQ(friction.of(8), 0.1);
}

}  // namespace
}  // namespace physics
