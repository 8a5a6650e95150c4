// The demo's vessel, for the tests of what is pushed through it.
#ifndef DARTSWEEP_PHYSICS_TESTS_IN_THE_VESSEL_H
#define DARTSWEEP_PHYSICS_TESTS_IN_THE_VESSEL_H

#include <gtest/gtest.h>

#include "library.h"
#include "lumen.h"

namespace physics {

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

}  // namespace physics

#endif
