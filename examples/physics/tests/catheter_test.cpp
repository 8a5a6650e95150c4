#include "catheter.h"

#include <gtest/gtest.h>

#include "lumen.h"
#include "verify.h"

namespace physics {
namespace {

class InTheVessel : public testing::Test {
 protected:
  void SetUp() override {
    demo_mesh mesh;
    ASSERT_EQ(mesh_make_vessel(2.0, &mesh), 0);
    environment_.reset(create_environment(nullptr, &mesh));
    mark_wall(environment_.get(), &mesh);
    ASSERT_EQ(flow_create(environment_.get(), &mesh, 0, &flow_), DSW_STATUS_OK);
    mesh_free(&mesh);
  }
  void TearDown() override { flow_destroy(&flow_); }

  Environment environment_;
  demo_flow flow_;
};

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
      const Verdict verdict = verify(world.scene(), catheter.body().id());
      ASSERT_TRUE(verdict.good()) << name_of(method) << " at step " << step;
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

}  // namespace
}  // namespace physics
