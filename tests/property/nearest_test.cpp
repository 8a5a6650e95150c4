// The nearest impassable feature against a scan over all of them. The straight way to the nearest obstacle meets no
// other one, so whatever is nearest of all is also seen.
#include "obstacles.h"

#include <cmath>
#include <limits>

namespace dsw::oracle {
namespace {

class NearestTest : public SceneTest {};
DSW_FOR_ALL_SCENES(NearestTest);

using L3 = std::array<long double, 3>;
L3 sub(const Vec& a, const Vec& b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}
long double dot(const L3& a, const L3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
L3 cross(const L3& a, const L3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long double length(const L3& a) { return std::sqrt(dot(a, a)); }

long double to_segment(const Vec& p, const Vec& a, const Vec& b) {
  const L3 u = sub(b, a), v = sub(p, a);
  long double t = dot(u, v) / dot(u, u);
  t = std::min(1.0L, std::max(0.0L, t));
  return length({v[0] - t * u[0], v[1] - t * u[1], v[2] - t * u[2]});
}

long double to_triangle(const Vec& p, const Vec& a, const Vec& b, const Vec& c) {
  const L3 n = cross(sub(b, a), sub(c, a));
  const bool inside = dot(n, cross(sub(b, a), sub(p, a))) >= 0 && dot(n, cross(sub(c, b), sub(p, b))) >= 0 &&
                      dot(n, cross(sub(a, c), sub(p, c))) >= 0;
  if (inside) return std::fabs(dot(n, sub(p, a))) / length(n);
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

TEST_P(NearestTest, DistanceIsThatOfTheNearestOfAll) {
  const bool thin = GetParam().find("thin") != std::string::npos || GetParam().find("sliver") != std::string::npos;
  int touching = 0;
  for (uint64_t seed = 61; seed < 61 + seeds_of(4); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    World& world = *place.world;
    Rng rng(seed);
    Motions motions(world, rng);
    const Obstacles obstacles(place, rng);
    for (int i = 0; i < 60; ++i) {
      const Vec p = rng.chance(0.8) ? motions.start() : motions.site();
      const int cell = world.locate(world.body(p.data()));
      dsw_nearest near;
      const dsw_volume_id start =
          cell >= 0 && rng.chance(0.5) ? world.ids[static_cast<size_t>(cell)] : dsw_volume_id{0, 0};
      const dsw_status status =
          dsw_environment_find_nearest(place.get(), p.data(), start, std::numeric_limits<double>::infinity(), &near);
      if (cell < 0 || world.cell_marked[static_cast<size_t>(cell)] != 0) {
        const dsw_cell touched = obstacles.touched(p);
        if (touched.kind == DSW_CELL_NONE) {
          EXPECT_EQ(status, cell < 0 ? DSW_STATUS_OUTSIDE : DSW_STATUS_IMPASSABLE);
        } else {
          ++touching;
          EXPECT_EQ(status, DSW_STATUS_OK) << hex(p) << dsw_last_error_message();
          EXPECT_EQ(near.distance, 0);
          EXPECT_TRUE(same(near.cell, touched)) << hex(p) << " names " << near.cell << " for " << touched;
        }
        continue;
      }
      ASSERT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message();
      const dsw_cell touched = obstacles.touched(p);
      if (touched.kind != DSW_CELL_NONE) {
        EXPECT_EQ(near.distance, 0) << hex(p);
        EXPECT_TRUE(same(near.cell, touched)) << hex(p) << " names " << near.cell;
      }
      SCOPED_TRACE("seed " + std::to_string(seed) + " point " + hex(p) + " start " + std::to_string(start.index) + "." +
                   std::to_string(start.generation) + ", in " + std::to_string(cell));
      long double best = HUGE_VAL, named = HUGE_VAL;
      obstacles.for_each([&](const dsw_cell& cell_name, const std::vector<Vec>& at) {
        const long double d = at.size() == 3   ? to_triangle(p, at[0], at[1], at[2])
                              : at.size() == 2 ? to_segment(p, at[0], at[1])
                                               : length(sub(p, at[0]));
        best = std::min(best, d);
        if (same(near.cell, cell_name)) named = std::min(named, d);
      });
      // Rounding: a few units in the last place of the coordinates; thin triangles have no better plane.
      const long double tolerance = (thin ? 1e-11L : 1e-13L) * world.size;
      EXPECT_NEAR(static_cast<double>(near.distance), static_cast<double>(best), static_cast<double>(tolerance))
          << hex(p);
      EXPECT_NEAR(static_cast<double>(named), static_cast<double>(best), static_cast<double>(tolerance))
          << hex(p) << " names " << near.cell;
      const Vec at = {near.point[0], near.point[1], near.point[2]};
      EXPECT_NEAR(static_cast<double>(length(sub(p, at))), near.distance, static_cast<double>(tolerance)) << hex(p);
      EXPECT_GE(near.volumes_visited, 1u);
      const L3 n = {near.normal[0], near.normal[1], near.normal[2]};
      if (near.distance == 0) {
        EXPECT_EQ(length(n), 0);
      } else if (near.distance > 1e-3 * world.size) {
        EXPECT_NEAR(static_cast<double>(length(n)), 1, 1e-14);
        EXPECT_NEAR(static_cast<double>(dot(n, sub(p, at))), near.distance, static_cast<double>(tolerance));
      }
      // A radius: found when it reaches, nothing when it does not. Below the rounding of distances there is no telling.
      if (near.distance < 1e-9 * world.size) continue;
      dsw_nearest again;
      ASSERT_EQ(dsw_environment_find_nearest(place.get(), p.data(), start, near.distance * 1.001, &again),
                DSW_STATUS_OK);
      EXPECT_EQ(again.distance, near.distance);
      EXPECT_TRUE(same(again.cell, near.cell)) << hex(p) << ": " << again.cell << " for " << near.cell;
      ASSERT_EQ(dsw_environment_find_nearest(place.get(), p.data(), start, near.distance * 0.999, &again),
                DSW_STATUS_OK);
      EXPECT_EQ(again.distance, std::numeric_limits<double>::infinity());
      EXPECT_EQ(again.cell.kind, DSW_CELL_NONE);
    }
  }
  EXPECT_GT(touching, 0);
}

TEST(NearestArgumentTest, BadRadiusAndPoint) {
  const Place place = make_place("hex", 65);
  ASSERT_PLACE(place);
  const double p[3] = {1, 1, 1}, nan[3] = {1, std::nan(""), 1};
  dsw_nearest near;
  EXPECT_EQ(dsw_environment_find_nearest(place.get(), p, {0, 0}, -1, &near), DSW_STATUS_OUT_OF_RANGE);
  EXPECT_EQ(dsw_environment_find_nearest(place.get(), nan, {0, 0}, 1, &near), DSW_STATUS_NON_FINITE);
  EXPECT_EQ(dsw_environment_find_nearest(place.get(), p, {0, 0}, std::nan(""), &near), DSW_STATUS_OUT_OF_RANGE);
  EXPECT_EQ(dsw_environment_find_nearest(place.get(), p, {0, 7}, 1, &near), DSW_STATUS_STALE_ID);
}

}  // namespace
}  // namespace dsw::oracle
