// Casts in cells that once went wrong.

#include "walk/cast.h"

#include <gtest/gtest.h>

#include <random>

#include "environment/moving.h"
#include "locate/locate.h"
#include "small_meshes.h"
#include "walk/packet.h"

#include "../../effort.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;

SmallMesh one_hexahedron(const std::vector<double>& points) {
  SmallMesh mesh;
  mesh.name = "a hexahedron";
  mesh.points = points;
  mesh.offsets = {0};
  mesh.cell(kHexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  return mesh;
}

void expect_contact(const Environment<3>& env, const double* from, const double* to) {
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = locate(env, from, Cell{}, nullptr).cell;
  ASSERT_TRUE(request.start.valid());
  ASSERT_FALSE(locate(env, to, Cell{}, nullptr).cell.valid());
  EXPECT_EQ(cast(env, request, nullptr).end, CastEnd::kHit);
}

/** A corner of 180 degrees, as a node hanging in the middle of an edge makes it: three vertices of a flat face lie in
 * a row and give no plane. Targets on the plane and an ulp beyond it are left to exact arithmetic. */
TEST(Cast, LeavesAFlatFaceWithAStraightCorner) {
  Environment<3> env(nullptr);
  build_mesh(env, one_hexahedron({0, 0, 0, 1, 0, 0, 1, .5, .5, 0, .5, .5, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1}));
  ASSERT_TRUE(env.map.convex(env.map.cell(0)));
  const double from[3] = {.5, .25, .75};
  for (const double x : {1.0, 1.0000000000000002, 1.5}) {
    const double to[3] = {x, .25, .75};
    expect_contact(env, from, to);
  }
}

/** A flat cell has one plane a facet. After a move its facets may be bent, with two. */
TEST(Cast, FollowsFacetsThatBend) {
  Environment<3> env(nullptr);
  build_mesh(env, one_hexahedron({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1}));
  let_points_move(env);
  const double from[3] = {.5, .5, .5}, to[3] = {.05, .05, -.05};
  EXPECT_EQ(cast(env, from, to, env.map.cell(0)).end, CastEnd::kHit);
  std::vector<double> moved(env.points, env.points + 24);
  moved[2] = -.25;
  env.points = moved.data();
  env.note_move();
  EXPECT_EQ(cast(env, from, to, env.map.cell(0)).end, CastEnd::kReached);
}

/** Two faces in one plane, one of them L-shaped: the volume is convex, the face is not, and lines that leave through it
 * run on both sides of its rim. */
TEST(Cast, LeavesAnLShapedFaceOfAConvexVolume) {
  SmallMesh mesh;
  mesh.name = "a box with a divided top";
  mesh.points = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 1, 2, 0, 1, 2, 2, 1, 0, 2, 1, 2, 1, 1, 1, 1, 1, 1, 2, 1};
  mesh.offsets = {0};
  mesh.cell(kPolyhedron, {7, 4,  0, 3, 2, 1, 4, 0, 1, 5, 4, 5, 1, 2,  6, 8, 5, 5, 2, 3,
                          7, 10, 6, 4, 3, 0, 4, 7, 6, 4, 5, 8, 9, 10, 7, 4, 9, 8, 6, 10});
  Environment<3> env(nullptr);
  build_mesh(env, mesh);
  EXPECT_FALSE(env.map.convex(env.map.cell(0)));
  const double from[3] = {.75, .5, .5};
  for (const double x : {1.75, .25}) {
    for (const double y : {.25, 1.75}) {
      const double to[3] = {x, y, 1.75};
      expect_contact(env, from, to);
    }
  }
}

TEST(Cast, LeavesASlantedFaceWithAStraightCorner) {
  Environment<3> env(nullptr);
  build_mesh(env, one_hexahedron({0, 0, 0, .5, 0, .5, 1, 2, 1, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2}));
  const double from[3] = {.25, 1, 1.5}, to[3] = {1.25, -4.9406564584124654e-324, 1.75};
  expect_contact(env, from, to);
}

/** What joins a point from which all of a cell is seen to another point in it lies in it. In the middle are most of
 * these points; not all of a cell that is not convex is. `ends`: vertices that lie about all round vertex 0. */
template <int D>
void expect_to_stay(const SmallMesh& mesh, const uint32_t (&ends)[D]) {
  Environment<D> env(nullptr);
  build_mesh(env, mesh);
  std::mt19937 random(static_cast<uint32_t>(seed_of(7)));
  std::uniform_real_distribution<double> part(-0.2, 1.2);
  uint32_t seen = 0, unseen = 0;
  for_each_cell(env.map, [&](Cell c) {
    if (env.map.convex(c)) return;
    double points[12][D];
    uint32_t count = 0;
    for (int tries = 0; tries < 200 && count < 12; ++tries) {
      double weights[D];
      for (double& w : weights) w = part(random);
      const double* const o = env.point(c, 0);
      for (int k = 0; k < D; ++k) {
        points[count][k] = o[k];
        for (int i = 0; i < D; ++i) points[count][k] += weights[i] * (env.point(c, ends[i])[k] - o[k]);
      }
      count += contains(env, c, points[count]) ? 1 : 0;
    }
    double apex[D];
    centre(env, c, apex);
    EXPECT_TRUE(sees_all(env, c, apex, nullptr));
    for (uint32_t i = 0; i < count; ++i) {
      const bool sees = sees_all(env, c, points[i], nullptr);
      (sees ? seen : unseen) += 1;
      for (uint32_t j = 0; j < count && sees; ++j) {
        EXPECT_EQ(cast(env, points[i], points[j], c).volumes_visited, 1u);
        EXPECT_EQ(cast(env, points[j], points[i], c).volumes_visited, 1u);
      }
    }
  });
  EXPECT_GT(seen, 200u);
  EXPECT_GT(unseen, 20u);
}

TEST(Cast, StaysInACellThatItsStartSeesAllOf) { expect_to_stay<3>(lattice(5, kHexahedron, 0.15), {1, 3, 4}); }

TEST(Cast, StaysInAPolygonThatItsStartSeesAllOf) {
  SmallMesh mesh;
  mesh.dimension = 2;
  std::mt19937 random(static_cast<uint32_t>(seed_of(3)));
  std::uniform_real_distribution<double> depth(0.05, 0.3), height(0.4, 0.6);
  for (int64_t i = 0; i < 60; ++i) {  // arrowheads
    const double x = 2.0 * static_cast<double>(i);
    mesh.point(x, 0), mesh.point(x + 1, height(random)), mesh.point(x, 1), mesh.point(x + depth(random), 0.5);
    mesh.cell(kQuad, {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  expect_to_stay<2>(mesh, {1, 2});
}

}  // namespace
