// Boxes of which one can say what they meet.

#include "corridor/box_probe.h"

#include <gtest/gtest.h>

#include <random>

#include "base/compiler.h"
#include "environment/marking.h"
#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

constexpr int kSize = 4;

class BoxProbeTest : public testing::Test {
 protected:
  BoxProbeTest() {
    add_boxes(mesh_, kSize, kSize, kSize);
    env_ = mesh_.build();
    reserve_vertex_marks(*env_);
    reserve_edge_marks(*env_, 1);
  }
  Cell cell(int x, int y, int z) const { return env_->map.cell(static_cast<uint32_t>(x + kSize * (y + kSize * z))); }
  static Bounds<3> box(double x0, double y0, double z0, double x1, double y1, double z1) {
    const double low[3] = {x0, y0, z0}, high[3] = {x1, y1, z1};
    return bounds<3>(low, high);
  }

  Mesh3 mesh_;
  std::unique_ptr<Environment<3>> env_;
};

TEST_F(BoxProbeTest, EntersWhatTheBoxMeets) {
  BoxProbe<3> probe(*env_);
  EXPECT_TRUE(probe.is_free(box(1.2, 1.2, 1.2, 1.8, 1.8, 1.8), cell(1, 1, 1)));
  EXPECT_TRUE(probe.has_entered(cell(1, 1, 1)));
  EXPECT_FALSE(probe.has_entered(cell(2, 1, 1)));
  EXPECT_TRUE(probe.is_free(box(1.5, 1.5, 1.5, 2, 2.5, 2.5), cell(1, 1, 1)));
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(probe.has_entered(cell(1 + i % 2, 1 + i / 2 % 2, 1 + i / 4))) << "also where it touches a facet";
  }
  EXPECT_FALSE(probe.is_free(box(0.5, 1.5, 1.5, 2.5, 2.5, 2.5), cell(1, 1, 1))) << "twelve cells";
}

TEST_F(BoxProbeTest, IsNotFreeWhereSomethingImpassableIsMet) {
  BoxProbe<3> probe(*env_);
  const Bounds two = box(1.5, 1.2, 1.2, 2.5, 1.8, 1.8), touching = box(1.5, 1.2, 1.2, 2, 1.8, 1.8),
               beside = box(1.5, 1.2, 1.2, 1.99, 1.8, 1.8);
  EXPECT_TRUE(probe.is_free(two, cell(1, 1, 1)));
  set_cell_mark(*env_, cell(2, 1, 1), true);
  EXPECT_FALSE(probe.is_free(two, cell(1, 1, 1)));
  EXPECT_FALSE(probe.is_free(touching, cell(1, 1, 1)));
  EXPECT_TRUE(probe.is_free(beside, cell(1, 1, 1)));
  set_cell_mark(*env_, cell(2, 1, 1), false);
  set_facet_mark(*env_, env_->map.half_facet(cell(2, 1, 1), 0), true);
  EXPECT_FALSE(probe.is_free(two, cell(1, 1, 1)));
  EXPECT_TRUE(probe.is_free(beside, cell(1, 1, 1)));
  EXPECT_FALSE(probe.is_free(box(-0.1, 0.2, 0.2, 0.5, 0.8, 0.8), cell(0, 0, 0))) << "the boundary";
}

TEST_F(BoxProbeTest, MarkedEdgesAndVerticesAreNotLookedFor) {
  BoxProbe<3> probe(*env_);
  const Bounds inside = box(1.2, 1.2, 1.2, 1.8, 1.8, 1.8);
  set_vertex_mark(*env_, 0, true);
  EXPECT_FALSE(probe.is_free(inside, cell(1, 1, 1)));
  set_vertex_mark(*env_, 0, false);
  EXPECT_TRUE(probe.is_free(inside, cell(1, 1, 1)));
  set_edge_mark(*env_, 0, 1, true);
  EXPECT_FALSE(probe.is_free(inside, cell(1, 1, 1)));
}

TEST(FacetsInBox, AreTheSameForAllInstructionSets) {
#if DSW_X86_64
  if (!DSW_CPU_HAS("avx2")) GTEST_SKIP();
  std::mt19937 random(static_cast<uint32_t>(seed_of(5)));
  const auto coordinate = [&] { return static_cast<double>(random() % 8) - 3.5; };
  const uint32_t vertices[8] = {7, 6, 5, 4, 3, 2, 1, 0};
  uint32_t seen = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    double points[24], low[3], high[3];
    for (double& x : points) x = coordinate();
    for (double& x : low) x = coordinate() / 2;
    for (double& x : high) x = coordinate() / 2;
    const Bounds<3> box = bounds<3>(low, high);
    const uint32_t met = facets_in_box(points, vertices, box);
    ASSERT_EQ(facets_in_box_avx2(points, vertices, box), met);
    seen |= 1u << met % 32;
  }
  EXPECT_EQ(seen, 0xffffffffu);
#else
  GTEST_SKIP();
#endif
}

}  // namespace
