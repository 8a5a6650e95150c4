// Swept edges and faces where one can say what they meet.

#include "corridor/sweep.h"
#include "corridor/corridor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "locate/locate.h"

namespace {

using namespace dsw;
using namespace dsw::test;

using Point = std::array<double, 3>;

struct Lattice {
  std::unique_ptr<Environment<3>> env;
  int n;

  explicit Lattice(int size) : n(size) {
    Mesh3 mesh;
    add_boxes(mesh, n, n, n);
    env = mesh.build();
    reserve_vertex_marks(*env);
    reserve_edge_marks(*env, 16);
  }
  uint32_t at(int x, int y, int z) const { return static_cast<uint32_t>(x + (n + 1) * (y + (n + 1) * z)); }
  Cell cell(int x, int y, int z) const { return env->map.cell(static_cast<uint32_t>(x + n * (y + n * z))); }
};

/** A face and where its first vertex goes. */
struct Moved {
  Point p, to, q, r;

  FaceMotion face() const { return {p.data(), to.data(), q.data(), r.data()}; }
  EdgeMotion edge(const Point& end) const { return {p.data(), to.data(), end.data()}; }
};

SweepResult sweep_face(const Environment<3>& env, const Moved& m, uint32_t max_volumes = 0) {
  SweepFlood<3> flood(env);
  return flood.sweep(m.face(), locate(env, m.p.data(), Cell{}, nullptr).cell, max_volumes);
}
SweepResult sweep_edge(const Environment<3>& env, const Moved& m, const Point& end) {
  SweepFlood<3> flood(env);
  return flood.sweep(m.edge(end), locate(env, m.p.data(), Cell{}, nullptr).cell, 0);
}

/** A large face that tilts down: at (x, y) its height is 5 - 4 t (1 - (x + y - 1) / 4.5), while p moves from 5 to 1. */
const Moved kTilt{{0.5, 0.5, 5}, {0.5, 0.5, 1}, {5, 0.5, 5}, {0.5, 5, 5}};

TEST(SweepFace, ASpikeThroughTheFaceIsFound) {
  Lattice lattice(6);
  Environment<3>& env = *lattice.env;
  EXPECT_EQ(sweep_face(env, kTilt).end, SweepEnd::kFree);
  for (int z = 0; z < 3; ++z) set_cell_mark(env, lattice.cell(1, 1, z), true);
  EXPECT_EQ(sweep_edge(env, kTilt, kTilt.q).end, SweepEnd::kFree);
  EXPECT_EQ(sweep_edge(env, kTilt, kTilt.r).end, SweepEnd::kFree);
  const SweepResult r = sweep_face(env, kTilt);
  ASSERT_EQ(r.end, SweepEnd::kContact);
  EXPECT_EQ(r.contact.vertex, lattice.at(1, 1, 3));
  EXPECT_EQ(kind_of(r.contact), ContactKind::kVertex);
  EXPECT_EQ(r.contact.front, lattice.cell(0, 0, 2))
      << "the lowest passable cell at the vertex that the tetrahedron meets";
  EXPECT_EQ(r.contact.facet, canonical(env.map, env.map.half_facet(lattice.cell(1, 1, 2), 2)))
      << "the side towards -y: of its lowest neighbour";
  EXPECT_NEAR(event_time<3>(kTilt.p.data(), kTilt.to.data(), r.contact.event), 2 / (4 * (1 - 1 / 4.5)), 1e-14);
}

TEST(SweepFace, MarkedVerticesAndEndsOfMarkedEdges) {
  Lattice lattice(6);
  Environment<3>& env = *lattice.env;
  set_vertex_mark(env, lattice.at(2, 1, 3), true);
  SweepResult r = sweep_face(env, kTilt);
  ASSERT_EQ(r.end, SweepEnd::kContact);
  EXPECT_EQ(r.contact.vertex, lattice.at(2, 1, 3));
  EXPECT_FALSE(r.contact.facet.valid());
  set_edge_mark(env, lattice.at(2, 2, 4), lattice.at(2, 2, 3), true);
  r = sweep_face(env, kTilt);
  EXPECT_EQ(r.contact.vertex, lattice.at(2, 2, 4)) << "met earlier";
  EXPECT_FALSE(r.contact.facet.valid());
  set_vertex_mark(env, lattice.at(2, 1, 3), false);
  set_edge_mark(env, lattice.at(2, 2, 4), lattice.at(2, 2, 3), false);
  set_vertex_mark(env, lattice.at(4, 4, 3), true);
  EXPECT_EQ(sweep_face(env, kTilt).end, SweepEnd::kFree) << "beside the tetrahedron";
}

TEST(SweepFace, WhatLiesFlatOrBehindAWallIsLeft) {
  Lattice lattice(6);
  Environment<3>& env = *lattice.env;
  Moved flat = kTilt;
  flat.to = {4, 4, 5};
  set_vertex_mark(env, lattice.at(2, 2, 5), true);
  EXPECT_EQ(sweep_face(env, flat).end, SweepEnd::kFree);
  EXPECT_EQ(sweep_face(env, flat).volumes_visited, 0u);
  set_vertex_mark(env, lattice.at(2, 2, 5), false);
  set_vertex_mark(env, lattice.at(1, 1, 2), true);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) set_facet_mark(env, env.map.half_facet(lattice.cell(x, y, 3), 5), true);  // z = 4
  }
  const SweepResult r = sweep_face(env, kTilt);
  ASSERT_EQ(r.end, SweepEnd::kContact);
  EXPECT_EQ(env.point(r.contact.vertex)[2], 4) << "the marked vertex lies behind the wall";
  EXPECT_EQ(sweep_edge(env, kTilt, kTilt.q).end, SweepEnd::kContact);
}

TEST(SweepFace, TheWorkLimitTellsOfNoContact) {
  Lattice lattice(6);
  Environment<3>& env = *lattice.env;
  set_vertex_mark(env, lattice.at(1, 1, 4), true);
  const uint32_t all = sweep_face(env, kTilt).volumes_visited;
  EXPECT_EQ(sweep_face(env, kTilt, all).end, SweepEnd::kContact);
  const SweepResult r = sweep_face(env, kTilt, all - 1);
  EXPECT_EQ(r.end, SweepEnd::kWorkLimit);
  EXPECT_EQ(r.volumes_visited, all - 1);
  EXPECT_EQ(r.contact.vertex, kNoVertex);
}

/** A marked edge along q r: its end inside, and where it leaves the cell, are met at one time, shifted or not. */
TEST(SweepContact, AtOneTimeVerticesComeBeforeEdgesBeforePlanes) {
  Lattice lattice(6);
  Environment<3>& env = *lattice.env;
  const Moved m{{2.25, 0.5, 4.5}, {2.25, 0.5, 0.5}, {0.25, 5.5, 4.5}, {5.75, 5.5, 4.5}};
  set_edge_mark(env, lattice.at(2, 2, 3), lattice.at(3, 2, 3), true);
  set_edge_mark(env, lattice.at(3, 2, 3), lattice.at(4, 2, 3), true);
  const SweepResult face = sweep_face(env, m), edge = sweep_edge(env, m, m.r);
  ASSERT_EQ(face.end, SweepEnd::kContact);
  ASSERT_EQ(edge.end, SweepEnd::kContact);
  EXPECT_EQ(compare_events<3>(m.p.data(), m.to.data(), face.contact.event, edge.contact.event).sign, 0);
  EXPECT_TRUE(comes_before(env.map, m.p.data(), m.to.data(), face.contact, edge.contact));
  EXPECT_FALSE(comes_before(env.map, m.p.data(), m.to.data(), edge.contact, face.contact));
  EXPECT_FALSE(comes_before(env.map, m.p.data(), m.to.data(), face.contact, face.contact));
  EXPECT_EQ(face.contact.vertex, lattice.at(2, 2, 3)) << "of two at one time the lower";
  SweepContact plane = edge.contact;
  plane.dart = kNoFacet;  // as if it lay on a diagonal
  EXPECT_EQ(kind_of(plane), ContactKind::kPlane);
  EXPECT_TRUE(comes_before(env.map, m.p.data(), m.to.data(), edge.contact, plane));
}

TEST(SweepEdge, AllContactsAreCollectedInTheirOrder) {
  Lattice lattice(6);
  Environment<3>& env = *lattice.env;
  const Point p{0.5, 0.5, 5.5}, to{5.5, 0.5, 0.5}, q{0.5, 5.5, 0.5};
  set_edge_mark(env, lattice.at(1, 1, 4), lattice.at(1, 1, 5), true);
  set_edge_mark(env, lattice.at(3, 1, 2), lattice.at(3, 1, 3), true);
  set_edge_mark(env, lattice.at(2, 2, 2), lattice.at(2, 2, 3), true);
  set_edge_mark(env, lattice.at(4, 4, 1), lattice.at(4, 4, 2), true);
  SweepFlood<3> flood(env);
  const SweepResult r = flood.sweep(EdgeMotion{p.data(), to.data(), q.data()}, lattice.cell(0, 0, 5), 0, true);
  ASSERT_EQ(r.end, SweepEnd::kContact);
  ASSERT_EQ(flood.all().size(), 3u);
  const double* const first = flood.all()[0].event.points[1];
  EXPECT_EQ(first[0], 1);
  EXPECT_EQ(first, r.contact.event.points[1]);
  EXPECT_EQ(flood.all()[1].event.points[1][0], 2);
  EXPECT_EQ(flood.all()[2].event.points[1][0], 3);
  EXPECT_EQ(flood.sweep(EdgeMotion{p.data(), to.data(), q.data()}, lattice.cell(0, 0, 5), 0).end, SweepEnd::kContact);
  EXPECT_TRUE(flood.all().empty()) << "only what was asked for";
}

/** Two boxes that share a square in two facets: one like an L, and what it leaves out, which is impassable. */
TEST(Corridor, FacetsThatAreNotConvexDoNotSettle) {
  Mesh3 mesh;
  const auto add = [&](double x, double y, double z) { return mesh.point({x, y, z}); };
  const int64_t s[9] = {add(0, 0, 1), add(1, 0, 1), add(2, 0, 1), add(0, 1, 1), add(1, 1, 1),
                        add(2, 1, 1), add(0, 2, 1), add(1, 2, 1), add(2, 2, 1)};
  for (const int side : {0, 1}) {
    const double z = side == 0 ? 0 : 2;
    const int64_t f[4] = {add(0, 0, z), add(2, 0, z), add(2, 2, z), add(0, 2, z)};
    std::vector<std::vector<int64_t>> faces = {
        {f[0], f[3], f[2], f[1]},       {f[0], f[1], s[2], s[1], s[0]},
        {f[1], f[2], s[8], s[5], s[2]}, {f[2], f[3], s[6], s[7], s[8]},
        {f[3], f[0], s[0], s[3], s[6]}, {s[0], s[1], s[4], s[5], s[8], s[7], s[6], s[3]},
        {s[1], s[2], s[5], s[4]}};
    if (side == 1) {
      for (auto& face : faces) std::reverse(face.begin(), face.end());
    }
    mesh.polyhedron(faces);
  }
  const auto env = mesh.build();
  const Map<3>& map = env->map;
  const Cell low = map.cell(0), high = map.cell(1);
  EXPECT_FALSE(map.convex(low) || map.convex(high));
  // From one arm of the L to the other, over the corner that it leaves out.
  set_facet_mark(*env, map.half_facet(low, 6), true);
  const Point p{0.5, 0.25, 0.75}, to{1.75, 1.5, 0.75}, q{1.1, 0.9, 1.5};
  Corridor<3> passed{Array<uint32_t>::allocator_type(nullptr)};
  passed.add(*env, map.half_facet(low, 5), true);
  EXPECT_FALSE(follows(*env, passed, p.data(), q.data(), low, high) &&
               follows(*env, passed, to.data(), q.data(), low, high));
  SweepFlood<3> flood(*env);
  EXPECT_EQ(flood.sweep(EdgeMotion{p.data(), to.data(), q.data()}, low, 0).end, SweepEnd::kContact);
}

}  // namespace
