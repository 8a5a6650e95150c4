// The boundary check against independent answers: intervals for boxes, sets for voxels, separating planes for
// tetrahedra, all in whole numbers; and cases made by hand for what these do not reach.

#include "environment/boundary_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

bool crosses(const Mesh3& mesh, Offenders* offenders = nullptr) { return boundary_crosses(*mesh.build(), offenders); }

/** A shear with whole numbers that leaves no plane where it was. */
void shear(Mesh3& mesh) {
  for (size_t i = 0; i < mesh.points.size(); i += 3) {
    const double x = mesh.points[i], y = mesh.points[i + 1], z = mesh.points[i + 2];
    mesh.points[i] = 5 * x + y + 2 * z;
    mesh.points[i + 1] = -x + 7 * y + z;
    mesh.points[i + 2] = 3 * x - 2 * y + 6 * z;
  }
}

TEST(BoundaryCheck, EveryPlaceOfTwoBoxes) {
  const double lower_a[3] = {1, 1, 1}, upper_a[3] = {3, 3, 3};
  int count = 0;
  for (int code = 0; code < 15 * 15 * 15; ++code) {
    int interval = code;
    double lower[3], upper[3];
    bool overlap = true;
    for (int k = 0; k < 3; ++k, interval /= 15) {
      int n = interval % 15;  // the intervals of 0 .. 5 that begin at 0 .. 4
      int low = 0;
      while (n >= 5 - low) n -= 5 - low++;
      lower[k] = low;
      upper[k] = low + 1 + n;
      overlap = overlap && lower[k] < upper_a[k] && upper[k] > lower_a[k];
    }
    Mesh3 mesh;
    add_box(mesh, lower_a, upper_a);
    add_box(mesh, lower, upper);
    ASSERT_EQ(crosses(mesh), overlap) << "box " << lower[0] << lower[1] << lower[2] << " - " << upper[0] << upper[1]
                                      << upper[2];
    if (code % 7 == 0) {
      shear(mesh);
      ASSERT_EQ(crosses(mesh), overlap) << "sheared, " << code;
      ++count;
    }
  }
  EXPECT_GT(count, 400);
}

/** Two sets of voxels, each a part (or several) with points of its own: they touch themselves and each other in points,
 * edges and faces, and lie in each other's cavities. */
TEST(BoundaryCheck, VoxelsOverlapAsSetsDo) {
  Random random(7);
  int with = 0, without = 0;
  const int rounds = std::max(effort_of(1500), 400);
  for (int round = 0; round < rounds; ++round) {
    const int density = 1 + random.below(7);
    std::set<std::array<int, 3>> fine;
    Mesh3 mesh;
    const auto solid = [&](int x, int y, int z) {
      if (random.below(8) >= density) return false;
      for (int i = 0; i < 8; ++i) fine.insert({2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2)});
      return true;
    };
    add_boxes(mesh, 3, 3, 3, 0, 0, 0, 2, solid);
    bool overlap = false;
    const int at[3] = {random.below(5), random.below(5), random.below(5)};
    const int other_density = round % 3 == 0 ? 1 : density;
    const bool avoid = round % 2 == 0;
    add_boxes(mesh, 3, 3, 3, at[0], at[1], at[2], 1, [&](int x, int y, int z) {
      const bool taken = fine.count({at[0] + x, at[1] + y, at[2] + z}) != 0;
      if (random.below(8) >= other_density || (taken && avoid)) return false;
      overlap = overlap || taken;
      return true;
    });
    if (mesh.types.empty()) continue;
    (overlap ? with : without) += 1;
    if (round % 4 == 1) shear(mesh);
    ASSERT_EQ(crosses(mesh), overlap) << "round " << round;
  }
  EXPECT_GT(with, rounds / 5);
  EXPECT_GT(without, rounds / 5);
}

using Int3 = std::array<int64_t, 3>;
Int3 minus(const Int3& a, const Int3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Int3 cross(const Int3& a, const Int3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int64_t dot(const Int3& a, const Int3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** Convex bodies share no inner point exactly if a plane along a face of one or two edges of both separates them. */
bool tets_overlap(const std::array<Int3, 4>& a, const std::array<Int3, 4>& b) {
  std::vector<Int3> edges[2], normals;
  for (int body = 0; body < 2; ++body) {
    const auto& t = body == 0 ? a : b;
    for (size_t i = 0; i < 4; ++i) {
      for (size_t j = i + 1; j < 4; ++j) {
        edges[body].push_back(minus(t[j], t[i]));
        for (size_t k = j + 1; k < 4; ++k) normals.push_back(cross(minus(t[j], t[i]), minus(t[k], t[i])));
      }
    }
  }
  for (const Int3& u : edges[0]) {
    for (const Int3& v : edges[1]) normals.push_back(cross(u, v));
  }
  for (const Int3& n : normals) {
    if (n == Int3{0, 0, 0}) continue;
    int64_t low[2], high[2];
    for (int body = 0; body < 2; ++body) {
      const auto& t = body == 0 ? a : b;
      low[body] = high[body] = dot(n, t[0]);
      for (const Int3& p : t) {
        low[body] = std::min(low[body], dot(n, p));
        high[body] = std::max(high[body], dot(n, p));
      }
    }
    if (high[0] <= low[1] || high[1] <= low[0]) return false;
  }
  return true;
}

TEST(BoundaryCheck, TetrahedraOverlapUnlessAPlaneSeparatesThem) {
  Random random(11);
  int with = 0, without = 0;
  const int rounds = std::max(effort_of(40000), 10000);
  for (int round = 0; round < rounds; ++round) {
    const int size = 2 + random.below(3);
    std::array<Int3, 4> t[2];
    Mesh3 mesh;
    for (auto& tet : t) {
      int64_t volume = 0;
      while (volume == 0) {
        for (Int3& p : tet) p = {random.below(size + 1), random.below(size + 1), random.below(size + 1)};
        volume = dot(cross(minus(tet[1], tet[0]), minus(tet[2], tet[0])), minus(tet[3], tet[0]));
      }
      if (volume < 0) std::swap(tet[0], tet[1]);
      std::vector<int64_t> ids;
      for (const Int3& p : tet) {
        ids.push_back(mesh.point({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}));
      }
      mesh.cell(kTetra, ids);
    }
    const bool overlap = tets_overlap(t[0], t[1]);
    (overlap ? with : without) += 1;
    ASSERT_EQ(crosses(mesh), overlap) << "round " << round;
  }
  EXPECT_GT(with, rounds / 8);
  EXPECT_GT(without, rounds / 20);
}

TEST(BoundaryCheck, SameAnswerFarAwayAndAtAnyScale) {
  for (const double scale : {0x1p-1060, 0x1p-300, 1.0, 0x1p300, 0x1p1010}) {  // exact, so that planes stay planes
    for (const int overlap : {0, 1}) {
      Mesh3 mesh;
      add_boxes(mesh, 3, 3, 3, 0, 0, 0, 1, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; });
      const double lower[3] = {1, 1, 1}, upper[3] = {2, 2, overlap == 0 ? 2 : 2.25};
      add_box(mesh, lower, upper);
      shear(mesh);
      for (double& x : mesh.points) x *= scale;
      EXPECT_EQ(crosses(mesh), overlap != 0) << scale;
    }
  }
  Mesh3 mesh;
  add_boxes(mesh, 2, 2, 2, 1e8, -1e8, 1e8);
  EXPECT_FALSE(crosses(mesh));
  add_boxes(mesh, 1, 1, 1, 1e8 + 0.5, -1e8, 1e8, 0x1p-20);
  EXPECT_TRUE(crosses(mesh));
}

TEST(BoundaryCheck, NestedPartsAreFoundAndNamed) {
  Mesh3 mesh;
  add_boxes(mesh, 1, 1, 1, 0, 0, 0, 10);
  add_boxes(mesh, 1, 1, 1, 20, 0, 0, 1);
  add_boxes(mesh, 2, 1, 1, 4, 4, 4, 0.5);
  Offenders offenders;
  EXPECT_TRUE(crosses(mesh, &offenders));
  ASSERT_GE(offenders.count, 1u);
  EXPECT_TRUE(std::is_sorted(offenders.index, offenders.index + offenders.count));
  for (uint32_t i = 0; i < offenders.count; ++i) EXPECT_NE(offenders.index[i], 1u);
}

/** A shell of one layer of cells whose middle layer holds another shell: no boundary crosses, no centre tells. */
TEST(BoundaryCheck, ShellInsideOfAShell) {
  Mesh3 mesh;
  const auto shell = [](int x, int y, int z) { return x % 4 == 0 || y % 4 == 0 || z % 4 == 0; };
  add_boxes(mesh, 5, 5, 5, 0, 0, 0, 4, shell);
  Mesh3 inside = mesh;
  add_boxes(inside, 16, 16, 16, 2, 2, 2, 1,
            [](int x, int y, int z) { return x % 15 == 0 || y % 15 == 0 || z % 15 == 0; });
  EXPECT_FALSE(crosses(mesh));
  EXPECT_TRUE(crosses(inside));
}

/** Two solids that have one closed line in common and pass through each other along it; the cells that a ray meets
 * first are not those that overlap. */
TEST(BoundaryCheck, SheetsThatCrossInEdgesOnly) {
  const auto square = [](Mesh3& mesh, double low, double high, double z) {
    return std::vector<int64_t>{mesh.point({low, low, z}), mesh.point({high, low, z}), mesh.point({high, high, z}),
                                mesh.point({low, high, z})};
  };
  const auto pyramid = [](Mesh3& mesh, const std::vector<int64_t>& base, double z) {
    const int64_t apex = mesh.point({1, 1, z});
    if (z > mesh.points[3 * static_cast<size_t>(base[0]) + 2]) {
      mesh.cell(kPyramid, {base[0], base[1], base[2], base[3], apex});
    } else {
      mesh.cell(kPyramid, {base[3], base[2], base[1], base[0], apex});
    }
  };
  for (const int order : {0, 1, 2, 3}) {
    for (const bool sheared : {false, true}) {
      Mesh3 edges;  // two double pyramids over one square
      const auto a = square(edges, 0, 2, 0);
      pyramid(edges, a, order % 2 == 0 ? -3 : 1);
      pyramid(edges, a, order % 2 == 0 ? 1 : -3);
      const auto b = square(edges, 0, 2, 0);
      pyramid(edges, b, order / 2 == 0 ? 3 : -1);
      pyramid(edges, b, order / 2 == 0 ? -1 : 3);
      if (sheared) shear(edges);
      EXPECT_TRUE(crosses(edges)) << order;

      Mesh3 faces;  // a box, and a solid whose edges run round it: its roof inside, its base around the box
      const double lower[3] = {0, 0, 0}, upper[3] = {2, 2, 2};
      if (order % 2 == 0) add_box(faces, lower, upper);
      const auto base = square(faces, -1, 3, -1), top = square(faces, 0, 2, 1);
      std::vector<int64_t> frustum = base;
      frustum.insert(frustum.end(), top.begin(), top.end());
      if (order / 2 == 0) faces.cell(kHexahedron, frustum);
      pyramid(faces, top, 1.5);
      if (order / 2 != 0) faces.cell(kHexahedron, frustum);
      if (order % 2 != 0) add_box(faces, lower, upper);
      if (sheared) shear(faces);
      EXPECT_TRUE(crosses(faces)) << order;
    }
  }
}

/** Wedges round an axis, `turns` of them a quarter turn each, at growing radius so that no outer faces meet. */
Mesh3 winding(int quarters, bool closed, bool growing) {
  Mesh3 mesh;
  const int64_t low = mesh.point({0, 0, 0}), high = mesh.point({0, 0, 1});
  std::vector<int64_t> below, above;
  constexpr int kX[4] = {1, 0, -1, 0}, kY[4] = {0, 1, 0, -1};
  for (int i = 0; i < quarters + (closed ? 0 : 1); ++i) {
    const double r = growing ? 1 + 0.25 * i : 1;
    below.push_back(mesh.point({r * kX[i % 4], r * kY[i % 4], 0}));
    above.push_back(mesh.point({r * kX[i % 4], r * kY[i % 4], 1}));
  }
  for (int i = 0; i < quarters; ++i) {
    const size_t a = static_cast<size_t>(i), b = (a + 1) % below.size();
    // A wedge's first triangle is counter-clockwise seen from outside.
    mesh.cell(kWedge, {low, below[b], below[a], high, above[b], above[a]});
  }
  return mesh;
}

TEST(BoundaryCheck, WindingOnceRoundAnEdgeIsSoundTwiceIsNot) {
  EXPECT_FALSE(crosses(winding(4, true, false)));   // a ring
  EXPECT_FALSE(crosses(winding(4, false, false)));  // its ends touch
  EXPECT_FALSE(crosses(winding(3, false, true)));
  EXPECT_TRUE(crosses(winding(5, false, true)));  // a spiral that has nothing but its axis in common
  EXPECT_TRUE(crosses(winding(5, false, false)));
  EXPECT_TRUE(crosses(winding(8, true, true)));  // an inner edge with cells twice round it
  EXPECT_TRUE(crosses(winding(8, true, false)));
}

TEST(BoundaryCheck, MixedCellsAndCommonPointsAreSound) {
  EXPECT_FALSE(crosses(mixed_mesh()));
  Mesh3 mesh;  // two boxes joined by the points of one edge, and a third by one point
  add_boxes(mesh, 3, 3, 3, 0, 0, 0, 1, [](int x, int y, int z) {
    return (x == 0 && y == 0 && z == 0) || (x == 1 && y == 1 && z == 0) || (x == 2 && y == 2 && z == 1);
  });
  EXPECT_FALSE(crosses(mesh));
}

}  // namespace
