#include "catheter.h"

#include <gtest/gtest.h>

#include "in_the_vessel.h"
#include "verify.h"

namespace physics {
namespace {

TEST_F(InTheVessel, ACatheterIsExactlyFreeAtEveryStep) {
  const Route route(environment_.get(), flow_);
  for (const Integrator method : {Integrator::kImplicitEuler, Integrator::kXpbd}) {
    World world(environment_.get());
    CatheterOptions options;
    options.body.integrator.method = method;
    options.speed = 300;
    Catheter catheter(&world, &route, options);
    std::size_t contacts = 0, inserted = 0, removed = 0;
    for (int step = 0; step < 250; ++step) {
      catheter.step(1e-3);
      const Validation validation = verify(world.scene(), catheter.body().id());
      ASSERT_TRUE(validation.good()) << name_of(method) << " at step " << step;
      ASSERT_TRUE(is_finite(catheter.body().points));
      contacts += world.report(0).move.contact_count;
      inserted += world.report(0).inserted;
      removed += world.report(0).removed;
    }
    EXPECT_GT(contacts, 50u) << name_of(method);
    EXPECT_GT(inserted, 0u) << name_of(method);
    EXPECT_GT(removed, 0u) << name_of(method);
    EXPECT_GT(catheter.reached(), 30) << name_of(method);
    EXPECT_GT(verify(world.scene(), catheter.body().id()).edges, 20u);
  }
}

TEST_F(InTheVessel, ARouteIsSmoothAndFree) {
  const Route route(environment_.get(), flow_);
  EXPECT_GT(route.length(), 0.5 * flow_.length);
  EXPECT_LT(route.length(), flow_.length);  // the way over middles of volumes zigzags
  EXPECT_EQ(route.at(-1), route.at(0));
  EXPECT_EQ(route.at(2 * route.length()), route.at(route.length()));
  const double piece = 0.5;
  for (double way = piece; way < route.length(); way += piece) {
    EXPECT_LT((route.at(way) - route.at(way - piece)).norm(), 1.001 * piece);
    EXPECT_NEAR(route.nearest(route.at(way)), way, 2 * flow_.radius);
    dsw_flight flight;
    const Vector3 a = route.at(way - piece), b = route.at(way);
    ASSERT_EQ(dsw_environment_cast(environment_.get(), {0, 0}, a.data(), b.data(), nullptr, &flight), DSW_STATUS_OK);
    EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
  }
}

TEST_F(InTheVessel, AHandGoesOnOnceAllLinksAreIn) {
  const Route route(environment_.get(), flow_);
  World world(environment_.get());
  CatheterOptions options;
  options.links = 5;
  options.speed = 100;
  options.feeding = 400;
  Catheter catheter(&world, &route, options);
  int fed = 0;
  for (int step = 0; step < 300; ++step) {
    catheter.step(1e-3);
    fed += catheter.links() < 5 ? 1 : 0;
  }
  EXPECT_EQ(catheter.links(), 5u);
  EXPECT_NEAR(fed, 4 * options.link / 0.4, 4);
  const std::vector<std::size_t> line = catheter.line();
  EXPECT_GE(line.size(), 6u);
  EXPECT_NEAR(route.nearest(catheter.body().points.position[line.front()]), 0.1 * (300 - fed), 2);
  EXPECT_GT(catheter.reached(), 0.1 * (300 - fed) + 4 * options.link);
}

TEST_F(InTheVessel, AHandRestsWhenTheTipIsAtTheEnd) {
  const Route route(environment_.get(), flow_);
  World world(environment_.get());
  CatheterOptions options;
  options.links = 5;
  options.speed = 200;
  options.feeding = 400;
  Catheter catheter(&world, &route, options);
  const double seconds = 1.5 * route.length() / options.speed;
  double stretch = 0;
  for (int step = 0; step < 1000 * seconds; ++step) {
    catheter.step(1e-3);
    const SoftBody& body = catheter.body();
    stretch = std::max(stretch, body.springs.largest_stretch(body.points.position));
  }
  EXPECT_GT(catheter.reached(), route.length() - 2 * options.link);
  const std::vector<std::size_t> line = catheter.line();
  EXPECT_LT(route.nearest(catheter.body().points.position[line.front()]), route.length() - 3 * options.link);
  EXPECT_LT(stretch, 0.5);
}

TEST_F(InTheVessel, AHandWaitsWhileTheWireIsHeldBack) {
  const Route route(environment_.get(), flow_);
  World world(environment_.get());
  CatheterOptions options;
  options.links = 3;
  options.speed = 100;
  Catheter catheter(&world, &route, options);
  while (catheter.links() < options.links) {
    catheter.step(1e-3);
  }
  SoftBody& body = catheter.body();
  const std::size_t tip = catheter.line().back();
  body.points.held[tip] = 1;
  body.points.velocity[tip].setZero();
  for (int step = 0; step < 300; ++step) {
    catheter.step(1e-3);
    EXPECT_LT(body.springs.largest_stretch(body.points.position), 0.3) << step;
  }
}

}  // namespace
}  // namespace physics
