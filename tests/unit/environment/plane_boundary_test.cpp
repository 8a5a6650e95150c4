// The boundary check in the plane against independent answers, in whole numbers: separating lines for triangles, sets
// for pixels.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "environment/boundary_check.h"
#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

bool crosses(const Mesh2& mesh) { return boundary_crosses(*mesh.build(), nullptr); }

using Point = std::array<int, 2>;
using Triangle = std::array<Point, 3>;

int turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** Whether all of `other` lies on a side of t, or beyond it. */
bool is_separated(const Triangle& t, const Triangle& other) {
  for (size_t k = 0; k < 3; ++k) {
    const auto beyond = [&](const Point& p) { return turn(t[k], t[(k + 1) % 3], p) <= 0; };
    if (std::all_of(other.begin(), other.end(), beyond)) return true;
  }
  return false;
}

TEST(PlaneBoundaryCheck, PairsOfTriangles) {
  Random random(1);
  int overlaps = 0;
  for (int i = 0; i < at_least(20000); ++i) {
    std::array<Triangle, 2> pair;
    for (Triangle& t : pair) {
      do {
        for (Point& p : t) p = {random.below(5), random.below(5)};
      } while (turn(t[0], t[1], t[2]) <= 0);
    }
    Mesh2 mesh;
    for (const Triangle& t : pair) {
      std::vector<int64_t> corners;
      for (const Point& p : t) corners.push_back(mesh.point({double(p[0]), double(p[1])}));
      mesh.cell(kTriangle, corners);
    }
    const bool overlap = !is_separated(pair[0], pair[1]) && !is_separated(pair[1], pair[0]);
    ASSERT_EQ(crosses(mesh), overlap) << "pair " << i;
    overlaps += overlap ? 1 : 0;
  }
  EXPECT_GT(overlaps, 2000);
  EXPECT_LT(overlaps, 18000);
}

/** Two sets of pixels, each a part (or several) with points of its own: they touch themselves and each other in points
 * and along sides, one can lie in a hole of the other, or in the middle of it. */
TEST(PlaneBoundaryCheck, SetsOfPixels) {
  Random random(2);
  constexpr int kSize = 5;
  int overlaps = 0, apart = 0;
  for (int i = 0; i < at_least(3000); ++i) {
    Mesh2 mesh;
    std::set<int> taken;
    bool overlap = false;
    for (int set = 0; set < 2; ++set) {
      int64_t points[(kSize + 1) * (kSize + 1)];
      for (int k = 0; k < (kSize + 1) * (kSize + 1); ++k) {
        points[k] = mesh.point({double(k % (kSize + 1)), double(k / (kSize + 1))});
      }
      const int share = set == 0 ? 2 : 3 + random.below(20);
      for (int pixel = 0; pixel < kSize * kSize; ++pixel) {
        if (random.below(share) != 0) continue;
        if (set == 1 && taken.count(pixel) != 0 && random.below(12) != 0) continue;
        overlap = overlap || (set == 1 && taken.count(pixel) != 0);
        if (set == 0) taken.insert(pixel);
        const int a = pixel % kSize + (kSize + 1) * (pixel / kSize), d = a + kSize + 1;
        mesh.cell(kQuad, {points[a], points[a + 1], points[d + 1], points[d]});
      }
    }
    if (mesh.types.empty()) continue;
    ASSERT_EQ(crosses(mesh), overlap) << "sets " << i;
    (overlap ? overlaps : apart) += 1;
  }
  EXPECT_GT(overlaps, 300);
  EXPECT_GT(apart, 300);
}

}  // namespace
