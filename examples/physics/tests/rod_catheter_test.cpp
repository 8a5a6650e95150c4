// The rod in the demo's vessel, with the library.
#include "rod/rod_catheter.h"

#include <gtest/gtest.h>

#include "in_the_vessel.h"
#include "verify.h"
#include "world.h"

namespace physics {
namespace {

class RodInTheVessel : public InTheVessel {};

TEST_F(RodInTheVessel, ReachesTheEndWithoutStretchAndIsFree) {
  const Route route(environment_.get(), flow_);
  World world(environment_.get());
  RodCatheterOptions options;
  options.links = 40;
  options.link = 1.5;
  options.speed = 100;
  RodCatheter catheter(world.scene(), &route, options);
  std::size_t pressing = 0;
  for (int step = 0; step < 1500 && catheter.reached() + 2 * options.link < route.length(); ++step) {
    catheter.step(1e-3);
    const Validation validation = verify(world.scene(), catheter.id());
    ASSERT_TRUE(validation.good()) << "at step " << step;
    ASSERT_LT(catheter.rod().largest_stretch(), 0.01) << "at step " << step;
    pressing += catheter.contact_report().pressing;
  }
  EXPECT_GT(pressing, 100u);
  EXPECT_EQ(catheter.links(), 40u);
  EXPECT_GE(catheter.reached() + 2 * options.link, route.length());
}

// A wire that is held back at its tip: the hand stops pushing, and nothing is crushed.
TEST_F(RodInTheVessel, TheHandWaitsWhileTheWireIsHeldBack) {
  const Route route(environment_.get(), flow_);
  World world(environment_.get());
  RodCatheterOptions options;
  options.links = 8;
  options.speed = 50;
  options.steering = -5e5;
  RodCatheter catheter(world.scene(), &route, options);
  for (int step = 0; step < 1000; ++step) {
    catheter.step(1e-3);
    ASSERT_LT(catheter.rod().largest_stretch(), 0.01) << step;
    ASSERT_TRUE(verify(world.scene(), catheter.id()).good());
  }
}

TEST_F(RodInTheVessel, ATipCanBeBentAndSoft) {
  const Route route(environment_.get(), flow_);
  World world(environment_.get());
  RodCatheterOptions options;
  options.links = 10;
  options.link = 1;
  options.speed = 50;
  options.steering = 0;
  options.tip_length = 5;
  options.tip_softness = 0.2;
  options.tip_angle = 0.5;
  RodCatheter catheter(world.scene(), &route, options);
  while (catheter.links() < options.links) {
    catheter.step(1e-3);
  }
  const Rod& rod = catheter.rod();
  EXPECT_LT(rod.edges.front().bending, 0.4 * rod.edges.back().bending);
  double angle = 0;
  for (std::size_t i = 1; i < rod.edges.size(); ++i) {
    angle += std::acos(std::min(1.0, rod.shape.tangent[i - 1].dot(rod.shape.tangent[i])));
  }
  EXPECT_NEAR(angle, options.tip_angle, 0.15);
}

}  // namespace
}  // namespace physics
