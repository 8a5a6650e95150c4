// Which corners of faces go towards the inside: by the signs of products, and the same for every instruction set.

#include "response/inwards.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/compiler.h"

#include "../../effort.h"

namespace {

using namespace dsw;

struct Surface {
  std::vector<BodyVertex<3>> vertices;
  std::vector<BodyFace> faces;
  std::vector<double> targets;
  std::vector<Course<3>::Vertex> turns;
};

/// Vertices in few places, so that products are 0; in many; or far from 1. One face in five is a free slot.
Surface any_surface(std::mt19937& random) {
  const int kind = static_cast<int>(random() % 3), exponent = kind == 2 ? static_cast<int>(random() % 2000) - 1000 : 0;
  const auto number = [&] {
    const double x = kind == 0 ? static_cast<double>(random() % 3) - 1 : static_cast<double>(random()) * 0x1p-31 - 1;
    return std::ldexp(x, exponent);
  };
  Surface made;
  for (int v = 0; v < 8; ++v) {
    BodyVertex<3> vertex;
    for (double& x : vertex.position) x = number();
    vertex.cell = {static_cast<uint32_t>(random())};
    vertex.first_edge = static_cast<uint32_t>(random() % 4);
    made.vertices.push_back(vertex);
    for (int k = 0; k < 3; ++k) made.targets.push_back(number());
    Course<3>::Vertex turn;
    if (random() % 4 != 0) turn.rank = static_cast<uint32_t>(v);
    turn.inwards = random() % 2 != 0;  // of another move
    made.turns.push_back(turn);
  }
  for (int f = 0; f < 10; ++f) {
    BodyFace face;
    if (random() % 5 != 0) {
      for (uint32_t& corner : face.corners) corner = static_cast<uint32_t>(random() % 8);
    }
    made.faces.push_back(face);
  }
  return made;
}

/// Whether vertex v goes against the normal of a face, in the order of operations that FindInwards promises.
bool goes_in(const Surface& s, const BodyFace& face, uint32_t v) {
  const double *p = s.vertices[face.corners[0]].position, *q = s.vertices[face.corners[1]].position,
               *r = s.vertices[face.corners[2]].position, *at = s.vertices[v].position, *to = &s.targets[3 * size_t{v}];
  const double a[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, b[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
  const double way[3] = {to[0] - at[0], to[1] - at[1], to[2] - at[2]};
  const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  return (way[0] * x + way[1] * y) + way[2] * z < 0;
}

std::vector<bool> told(FindInwards find, Surface s) {
  std::vector<double> ways(4 * s.vertices.size());
  find({s.faces.data(), s.faces.size(), s.vertices.data(), s.vertices.size(), {s.targets.data(), 3}}, ways.data(),
       s.turns.data());
  std::vector<bool> inwards;
  for (const Course<3>::Vertex& turn : s.turns) inwards.push_back(turn.inwards);
  return inwards;
}

TEST(Inwards, AreTheVerticesThatGoAgainstAllNormals) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(12)));
  int inwards = 0, outwards = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    const Surface surface = any_surface(random);
    std::vector<bool> wanted;
    for (uint32_t v = 0; v < surface.vertices.size(); ++v) {
      bool in = surface.turns[v].rank != kNone;
      for (const BodyFace& face : surface.faces) {
        const bool at_face = face.corners[0] == v || face.corners[1] == v || face.corners[2] == v;
        in = in && (!at_face || goes_in(surface, face, v));
      }
      wanted.push_back(in);
      (in ? inwards : outwards) += surface.turns[v].rank != kNone ? 1 : 0;
    }
    ASSERT_EQ(told(find_inwards, surface), wanted) << i;
#if DSW_X86_64
    if (DSW_CPU_HAS("avx2")) {
      ASSERT_EQ(told(find_inwards_avx2, surface), wanted) << i;
    }
#endif
  }
  EXPECT_GT(inwards, 100);
  EXPECT_GT(outwards, 100);
}

}  // namespace
