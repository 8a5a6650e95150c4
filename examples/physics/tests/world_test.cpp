#include "world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "channel.h"
#include "verify.h"

namespace physics {
namespace {

// 8 x 4 x 4 cubes with a post of one cube in the middle, tagged 5.
Environment make_post() {
  Channel channel;
  channel.cubes = {8, 4, 4};
  channel.obstacles = {{4, 2, 1}};
  channel.tag = 5;
  return make_channel(channel);
}

SoftBody* add_line(World* world, const Positions& line, double stretching, double bending) {
  SoftBody* body = world->add(std::make_unique<SoftBody>(world->scene(), line, 1.0, SoftBodyOptions()));
  body->springs = make_rod(line, stretching, bending);
  return body;
}

TEST(World, WhatIsNoNumberIsRefusedAndTheSceneGoesOn) {
  const Environment environment = make_post();
  World world(environment.get());
  SoftBody* body = add_line(&world, {{1, 1.5, 1.5}, {2, 1.5, 1.5}}, 100, 0);
  body->points.velocity[0] = Vector3(1, 0, 0);
  EXPECT_EQ(world.step(0.01), 0u);
  const Positions before = body->points.position;
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    body->load.force = {Vector3::Zero(), Vector3(0, bad, 0)};
    EXPECT_EQ(world.step(0.01), 1u);
    EXPECT_EQ(world.report(0).status, DSW_STATUS_NON_FINITE);
    EXPECT_EQ(body->points.position[0], before[0]);
    EXPECT_EQ(body->points.position[1], before[1]);
    EXPECT_EQ(body->points.velocity[1], Vector3(0, 0, 0));
  }
  body->load.force.clear();
  body->points.velocity[0] = Vector3(1, 0, 0);
  EXPECT_EQ(world.step(0.01), 0u);
  EXPECT_NE(body->points.position[0], before[0]);
}

TEST(World, AMoveOf1e300EndsAtTheFirstWall) {
  const Environment environment = make_post();
  World world(environment.get());
  SoftBody* body = add_line(&world, {{1.5, 2.5, 1.5}}, 0, 0);
  body->options.move.vertex_response = DSW_RESPONSE_STOP;
  body->points.velocity[0] = Vector3(1e300, 0, 0);
  EXPECT_EQ(world.step(1), 0u);
  EXPECT_NEAR(body->points.position[0].x(), 4, 2e-9) << "next to it, but for the distance kept";
  EXPECT_LE(body->points.position[0].x(), 4);
  ASSERT_EQ(body->touches().size(), 1u);
  EXPECT_LT(body->touches()[0].normal.x(), -0.999);
  EXPECT_NEAR(body->touches()[0].at.x(), 4, 1e-9);
  EXPECT_NEAR(body->points.velocity[0].x(), 0, 1e290);
}

TEST(World, ALinkThatIsNotFreeStaysOutAndTheSceneGoesOn) {
  const Environment environment = make_post();
  World world(environment.get());
  SoftBody* body = add_line(&world, {{1.5, 2.5, 1.5}, {2.5, 2.5, 1.5}}, 100, 0);
  const Vector3 behind_the_post(6.5, 2.5, 1.5), beside(2.5, 3.5, 1.5);
  std::size_t added = 0;
  for (int again = 0; again < 2; ++again) {
    EXPECT_FALSE(body->add_vertex(behind_the_post, 1, 1, 100, 0, &added));
    EXPECT_EQ(world.step(0.01), 0u);
    EXPECT_EQ(body->count(), 2u);
  }
  EXPECT_TRUE(body->add_vertex(beside, 1, 1, 100, 0, &added));
  EXPECT_EQ(world.step(0.01), 0u);
  EXPECT_EQ(body->count(), 3u);
  EXPECT_TRUE(verify(world.scene(), body->id()).good());
}

TEST(World, InsertedVerticesAreRemovedAgain) {
  const Environment environment = make_post();
  World world(environment.get());
  // A line across the channel is pulled against the post: it gets vertices there. Pulled off again, it is straight without them.
  SoftBody* body = add_line(&world, {{3.5, 1, 1.5}, {3.5, 4 - 0.2, 1.5}}, 100, 0);
  body->points.held = {1, 1};
  const auto count_inserted = [body] {
    std::size_t count = 0;
    for (std::size_t i = 0; i < body->points.size(); ++i) {
      count += body->points.mass[i] > 0 && body->was_inserted(i) ? 1 : 0;
    }
    return count;
  };
  std::size_t most = 0;
  const double mass = 2;
  for (int step = 0; step < 400; ++step) {
    const Vector3 way(step < 100 ? 1.0 : step < 200 ? -1.5 : 0.0, 0, 0);
    body->points.velocity[0] = body->points.velocity[1] = way;
    world.step(0.01);
    EXPECT_TRUE(verify(world.scene(), body->id()).good());
    most = std::max(most, count_inserted());
  }
  EXPECT_GE(most, 1u);
  EXPECT_EQ(count_inserted(), 0u);
  EXPECT_EQ(body->springs.distances.size(), 1u);
  EXPECT_EQ(body->springs.angles.size(), 0u);
  double sum = 0;
  for (const double m : body->points.mass) {
    sum += m;
  }
  EXPECT_DOUBLE_EQ(sum, mass);
}

// A point slides on the top of the post for a while; returns its speed.
double speed_after_sliding(const Friction& friction, int contact_memory = 0, std::size_t* contacts = nullptr) {
  const Environment environment = make_post();
  World world(environment.get());
  SoftBody* body = add_line(&world, {{4.1, 2.5, 2.01}}, 0, 0);
  body->options.friction = friction;
  body->options.contact_memory = contact_memory;
  body->load.gravity = Vector3(0, 0, -10);
  body->points.velocity[0] = Vector3(1, 0, 0);
  for (int step = 0; step < 200; ++step) {
    world.step(1e-3);
    if (contacts != nullptr) {
      *contacts += world.report(0).move.contact_count;
    }
  }
  EXPECT_NEAR(body->points.position[0].z(), 2, 1e-2);
  return body->points.velocity[0].x();
}

TEST(World, FrictionComesFromTheCellsTag) {
  Friction friction;
  friction.otherwise = 0;
  EXPECT_NEAR(speed_after_sliding(friction), 1, 1e-6);
  friction.by_tag[5] = 0.2;
  // Falls 0.01 in 0.045 s, which costs friction * speed of the fall; then friction * gravity.
  EXPECT_NEAR(speed_after_sliding(friction), 1 - 0.2 * 10 * 0.2, 0.02);
  friction.by_tag[5] = 5;
  EXPECT_NEAR(speed_after_sliding(friction), 0, 1e-6);
}

TEST(World, AContactThatIsKnownRubsAsOneThatIsFound) {
  Friction friction;
  friction.otherwise = 0.2;
  std::size_t found = 0, rarely_found = 0;
  const double speed = speed_after_sliding(friction, 0, &found);
  EXPECT_NEAR(speed_after_sliding(friction, 4, &rarely_found), speed, 0.01);
  EXPECT_GT(rarely_found, 0u);
  EXPECT_LT(3 * rarely_found, found);
}

TEST(World, AShapeFallsAndStaysAShape) {
  const Environment environment = make_post();
  World world(environment.get());
  const Positions corners = {{4.2, 2.2, 2.5}, {5.2, 2.3, 2.5}, {4.3, 3.2, 2.6}, {4.5, 2.6, 3.3}};
  SoftBodyOptions options;
  options.match = 0.8;
  SoftBody* body = world.add(std::make_unique<SoftBody>(
      world.scene(), corners, std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, 1.0, options));
  body->shape.emplace(body->points);
  body->load.gravity = Vector3(0, 0, -10);
  std::size_t contacts = 0;
  for (int step = 0; step < 300; ++step) {
    world.step(5e-3);
    contacts += world.report(0).move.contact_count;
    ASSERT_TRUE(verify(world.scene(), body->id()).good());
  }
  EXPECT_GT(contacts, 10u);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double now = (body->points.position[i] - body->points.position[j]).norm();
      EXPECT_NEAR(now, (corners[i] - corners[j]).norm(), 0.1);
    }
  }
}

TEST(World, WallsGiveWayAndSpringBack) {
  const Environment environment = make_post();
  std::unique_ptr<Walls> kept;  // the environment reads its points
  {
    World world(environment.get(), DSW_FEATURE_DEFORMING);
    WallOptions options;
    options.stretching = 50;
    options.anchor = 20;
    Walls* walls = world.add_walls(options);
    walls->load.drag = 5;
    ASSERT_EQ(walls->vertices().size(), 8u);
    const Positions rest = walls->points.position;
    SoftBody* body = add_line(&world, {{3.7, 2.5, 1.5}}, 0, 0);
    body->points.velocity[0] = Vector3(3, 0, 0);
    const double momentum = 3;
    double deepest = 0, pushed = 0;
    for (int step = 0; step < 600; ++step) {
      world.step(5e-3);
      EXPECT_TRUE(verify(world.scene(), body->id()).good());
      Vector3 wall = Vector3::Zero();
      for (std::size_t i = 0; i < 8; ++i) {
        deepest = std::max(deepest, (walls->points.position[i] - rest[i]).norm());
        wall += walls->points.velocity[i];
      }
      pushed = std::max(pushed, wall.x());
    }
    EXPECT_GT(deepest, 0.01);
    EXPECT_GT(pushed, 0.5 * momentum * (1 - 5 * 5e-3)) << "the wall took the momentum that the point lost";
    EXPECT_LT(body->points.velocity[0].x(), 0.5);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_LT((walls->points.position[i] - rest[i]).norm(), 1e-3) << "back at rest";
    }
    // What is no number stays out, and the world goes on.
    walls->load.force = {Vector3(std::nan(""), 0, 0)};
    EXPECT_EQ(world.step(5e-3), 1u);
    walls->load.force.clear();
    EXPECT_EQ(world.step(5e-3), 0u);
    EXPECT_TRUE(is_finite(walls->points));
    kept = world.release_walls();
  }
}

}  // namespace
}  // namespace physics
