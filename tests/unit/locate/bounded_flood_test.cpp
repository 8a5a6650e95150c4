// The flood by bounds finds the same bits as the flood by distances; bounds hold, and have the same bits everywhere.

#include "locate/bounded_flood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "../../effort.h"
#include "base/processor.h"
#include "environment/moving.h"
#include "locate/locate.h"
#include "obstacle_meshes.h"
#include "walk/standard_facets.h"

namespace {

using namespace dsw;
using namespace dsw::test;

struct Tally {
  int found = 0, nothing = 0, passing = 0;
};

template <int D>
void expect_same_answer(const Environment<D>& env, const SegmentNearest& a, const SegmentNearest& b) {
  ASSERT_NO_FATAL_FAILURE(expect_same_nearest(env, a, b));
  ASSERT_EQ(a.parameter, b.parameter);
  ASSERT_EQ(std::memcmp(a.segment_point, b.segment_point, sizeof a.segment_point), 0);
  ASSERT_EQ(a.crossed, b.crossed);
  ASSERT_EQ(a.last, b.last);
}

/** Segments anywhere; between vertices and points halfway between them, where much is equally far; long and short. */
template <int D>
void ask_segments(const Environment<D>& env, Random& random, int count, Tally& tally) {
  BoundedNotes notes(env.memory), other_notes(env.memory);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random.below(static_cast<int>(n))); };
  for (int i = 0; i < count; ++i) {
    const double *const a = env.point(below(env.map.vertex_count)), *const b = env.point(below(env.map.vertex_count));
    const double share = random.below(4) * 0.25, reach = std::ldexp(1.0, -3 * random.below(5));
    double p[D], q[D];
    for (int k = 0; k < D; ++k) {
      const double size = env.upper[k] - env.lower[k];
      p[k] = i % 3 == 0 ? a[k] + share * (b[k] - a[k]) : env.lower[k] + random.unit() * size;
      q[k] = i % 5 == 0 ? b[k] : i % 7 == 0 ? p[k] : p[k] + reach * (random.unit() - 0.5) * size;
    }
    Cell start = locate(env, p, Cell{}, nullptr).cell;
    if (!start.valid() || is_closed(env, start)) continue;
    const double radius = random.below(3) != 0 ? kNoLimit : 3 * random.unit();
    SegmentNearest fast, slow;
    const bool found = find_nearest_to_segment(env, p, q, start, radius, notes, fast);
    ASSERT_EQ(find_nearest_to_segment(env, p, q, start, radius, other_notes, slow, true), found) << "segment " << i;
    ASSERT_NO_FATAL_FAILURE(expect_same_answer(env, fast, slow)) << "segment " << i;
    ++(!found ? tally.nothing : fast.crossed.valid() ? tally.passing : tally.found);
  }
}

template <int D, class Mesh>
void floods_agree(Mesh& mesh, uint64_t seed, int marks, Tally& tally) {
  Random random(seed);
  const auto env = mesh.build();
  mark_some(*env, random, marks, true);
  for (int round = 0; round < 6; ++round) {
    ASSERT_NO_FATAL_FAILURE(ask_segments(*env, random, 100, tally)) << "seed " << seed << " round " << round;
    mark_some(*env, random, 1 + marks / 4, round % 2 == 0);
  }
}

TEST(BoundedFlood, InTetrahedra) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(12); ++seed) {
    Mesh3 mesh;
    Random random(seed);
    add_tetrahedra(mesh, 7);
    if (seed % 3 != 0) shake(mesh, 0.2, random);
    ASSERT_NO_FATAL_FAILURE(floods_agree<3>(mesh, seed, static_cast<int>(seed % 4) * 80, tally));
  }
  EXPECT_GT(tally.found, effort_of(1500));
  EXPECT_GT(tally.nothing, effort_of(100));
}

TEST(BoundedFlood, InTheLatticeWhereMuchIsEquallyFar) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(12); ++seed) {
    Mesh3 mesh;
    add_boxes(mesh, 9, 8, 7, -3, 0, 0, seed % 2 == 0 ? 0.5 : 0.3);
    ASSERT_NO_FATAL_FAILURE(floods_agree<3>(mesh, seed, static_cast<int>(seed % 4) * 40, tally));
  }
  EXPECT_GT(tally.found, effort_of(1500));
}

TEST(BoundedFlood, InMixedCells) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(20); ++seed) {
    Mesh3 mesh = mixed_mesh();
    ASSERT_NO_FATAL_FAILURE(floods_agree<3>(mesh, seed, static_cast<int>(seed % 4), tally));
  }
  EXPECT_GT(tally.found, effort_of(500));
}

TEST(BoundedFlood, InThePlane) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(24); ++seed) {
    Mesh2 mesh;
    Random random(seed);
    add_squares(mesh, 14, 12, seed % 2 == 0);
    if (seed % 3 != 0) shake(mesh, 0.2, random);
    ASSERT_NO_FATAL_FAILURE(floods_agree<2>(mesh, seed, static_cast<int>(seed % 4) * 12, tally));
  }
  EXPECT_GT(tally.found, effort_of(1500));
}

/** Turns a bar into a helix that is passed more than twice, so that turns overlap. */
void wind(std::vector<double>& points) {
  for (size_t i = 0; i < points.size(); i += 3) {
    const double angle = -0.25 * points[i], radius = 4 + points[i + 1];
    points[i + 2] += 0.02 * points[i];
    points[i] = radius * std::cos(angle);
    points[i + 1] = radius * std::sin(angle);
  }
}

TEST(BoundedFlood, InPartsThatOverlap) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(12); ++seed) {
    Mesh3 mesh;
    add_boxes(mesh, 60, 4, 4);
    wind(mesh.points);
    ASSERT_NO_FATAL_FAILURE(floods_agree<3>(mesh, seed, static_cast<int>(seed % 4) * 30, tally));
  }
  EXPECT_GT(tally.found, effort_of(500));
}

/** Prisms round an axis that turn more than once. The last face stands beside points of the second prism, but the way
 * there leads round the axis, which is farther: only the flood by distances knows what is reached first. */
TEST(BoundedFlood, AsksTheOtherFloodWhereTheNearestIsNotReached) {
  constexpr int kPrisms = 8;
  Mesh3 mesh;
  std::vector<int64_t> above, below;
  const auto add = [&](double x, double y) {
    above.push_back(mesh.point({x, y, 2}));
    below.push_back(mesh.point({x, y, -2}));
  };
  add(0, 0);
  constexpr double kSixth = 3.14159265358979323846 / 3;
  for (int k = 0; k <= kPrisms; ++k) add(2 * std::cos(k * kSixth), 2 * std::sin(k * kSixth));
  for (size_t k = 1; k <= kPrisms; ++k)
    mesh.cell(kWedge, {above[0], above[k], above[k + 1], below[0], below[k], below[k + 1]});
  const auto env = mesh.build();
  Random random(5);
  BoundedNotes notes(env->memory);
  int unknown = 0, reached = 0;
  for (int i = 0; i < at_least(300); ++i) {
    const double angle = 1.1 + random.unit() * 0.98, radius = 0.2 + 1.5 * random.unit(), size = i % 2 * 0.1;
    const double p[3] = {radius * std::cos(angle), radius * std::sin(angle), random.unit()};
    const double q[3] = {p[0] * (1 - size), p[1] * (1 - size), p[2] + size};
    const Cell start = env->map.cell(1);
    SegmentNearest fast, slow;
    ASSERT_TRUE(find_nearest_to_segment(*env, p, q, start, kNoLimit, notes, fast));
    ASSERT_TRUE(find_nearest_to_segment(*env, p, q, start, kNoLimit, notes, slow, true));
    ASSERT_NO_FATAL_FAILURE(expect_same_answer(*env, fast, slow)) << i;
    const Distances<3, FromSegment<3>> distances(*env, p, q);
    notes.starts.assign(1, start);
    const SearchEnd end = BoundedFlood<3, FromSegment<3>>(distances, kNoLimit, notes, fast).run();
    ++(end == SearchEnd::kUnknown ? unknown : reached);
  }
  EXPECT_GT(unknown, 20);
  EXPECT_GT(reached, 20);
}

TEST(BoundedFlood, WherePointsMoveAndCellsTurnInsideOut) {
  Tally tally;
  Mesh3 mesh;
  add_tetrahedra(mesh, 6);
  const auto env = mesh.build();
  let_points_move(*env);
  Random random(9);
  for (int round = 1; round <= 8; ++round) {
    std::vector<double> moved = mesh.points;
    for (double& x : moved) x += 0.1 * std::sin(round + 3 * x);
    for (int k = 0; k < round % 3; ++k) moved[static_cast<size_t>(random.below(900))] += 1.5;
    env->points = moved.data();
    env->note_move();
    env->checked.forget_all();
    mark_some(*env, random, 10, true);
    ASSERT_NO_FATAL_FAILURE(ask_segments(*env, random, 80, tally)) << "round " << round;
  }
  EXPECT_GT(tally.found, 200);
}

TEST(BoundedFlood, AtAnyScale) {
  for (const int exponent : {-1060, -1000, -400, -200, -140, 0, 140, 200, 400, 1000, 1018}) {
    Tally tally;
    Mesh3 mesh;
    add_boxes(mesh, 5, 5, 5);
    for (double& x : mesh.points) x = std::ldexp(x, exponent);
    const auto env = mesh.build();
    Random random(7);
    ASSERT_NO_FATAL_FAILURE(ask_segments(*env, random, 50, tally)) << exponent;
    EXPECT_GT(tally.found, 5) << exponent;
  }
}

/** Both lips of a crack are equally near. The flood comes to the lip of the triangle, because the way to the other lip, which
 * has the lower name, is longer than the answer. */
TEST(BoundedFlood, OfTwoLipsTheOneThatIsReachedIsNamed) {
  Mesh2 mesh;
  const int64_t tip = mesh.point({-4, 0.5}), above = mesh.point({4.2, 60}), below = mesh.point({0, -12});
  mesh.cell(kQuad, {tip, above, mesh.point({-16, -8}), mesh.point({-4, -8})});
  mesh.cell(kTriangle, {tip, mesh.point({-4, -8}), below});
  mesh.cell(kPolygon, {tip, below, mesh.point({8, -12}), mesh.point({8, 16}), above});
  const auto env = mesh.build();
  const double p[2] = {0, 0};
  BoundedNotes notes(env->memory);
  NearestResult near;
  ASSERT_TRUE(find_nearest_far(*env, p, env->map.cell(2), kNoLimit, notes, near));
  EXPECT_EQ(near.distance, 4);
  EXPECT_EQ(env->map.index(near.feature.cell), 1u);
}

/** Triangles of any shape: also slivers, needles and those that are far away. */
void any_triangle(Random& random, double* corners) {
  const double away = std::ldexp(1.0, random.below(3) == 0 ? random.below(30) : 0);
  double size = 1;
  for (int i = 0; i < 9; ++i) {
    if (i % 3 == 0 && i > 0) size = std::ldexp(1.0, -random.below(3) * random.below(20));
    corners[i] = i < 3 ? away * (random.unit() - 0.5) : corners[i - 3] + size * (random.unit() - 0.5);
  }
}

/** The environment's box is that of its first points. Where they have moved far out of it, singles overflow. */
TEST(FacetBounds, AreNumbersFarOutsideOfTheBox) {
  Random random(4);
  for (int i = 0; i < at_least(100); ++i) {
    double corners[72], ends[6];
    const double* all[24];
    for (double& x : corners) x = 1e15 * (random.unit() - 0.5);
    for (double& x : ends) x = random.unit() - 0.5;
    for (int t = 0; t < 24; ++t) all[t] = corners + 3 * t;
    const FromSegment<3> from{ends, ends + 3, 1};
    const SegmentFrame<3> frame(ends, from.line.along, 1);
    FacetBounds bounds;
    portable_bounds<3>().of_triangles(frame, all, bounds);
    for (int t = 0; t < 8; ++t) {
      const auto corner = [&](int k) { return from.corner(all[8 * k + t]); };
      const double distance = std::sqrt(from.way(corner(0), corner(1), corner(2), HUGE_VAL).squared) * frame.scale;
      ASSERT_LE(bounds.lower[t], distance) << i;
    }
#if defined(__x86_64__)
    if (!has_avx2()) continue;
    FacetBounds others;
    avx2_bounds<3>().of_triangles(frame, all, others);
    ASSERT_EQ(std::memcmp(&bounds, &others, sizeof bounds), 0);
#endif
  }
}

TEST(FacetBounds, HoldForDistances) {
  Random random(3);
  double tight = 0;
  int counted = 0;
  const BoundsKernel<3> portable = portable_bounds<3>();
  for (int i = 0; i < effort_of(20000); ++i) {
    double corners[72], ends[6];
    const double *all[24], *facets[24], reach = std::ldexp(1.0, -random.below(25));
    for (int t = 0; t < 8; ++t) {
      any_triangle(random, corners + 9 * t);
      for (int k = 0; k < 3; ++k) all[8 * k + t] = corners + 9 * t + 3 * k;
    }
    for (int k = 0; k < 3; ++k) {
      ends[k] = random.unit() - 0.5;
      ends[k + 3] = i % 11 == 0 ? ends[k] : ends[k] + reach * (random.unit() - 0.5);
    }
    const FromSegment<3> from{ends, ends + 3, 1};
    double largest = 0;
    for (const double x : corners) largest = std::max(largest, std::fabs(x));
    for (const double x : ends) largest = std::max(largest, std::fabs(x));
    const SegmentFrame<3> frame(ends, from.line.along, largest);
    FacetBounds bounds, of_facets;
    portable.of_triangles(frame, all, bounds);
    for (int t = 0; t < 8; ++t) {
      const auto corner = [&](int k) { return from.corner(all[8 * k + t]); };
      const double distance = std::sqrt(from.way(corner(0), corner(1), corner(2), HUGE_VAL).squared) * frame.scale;
      // Where the segment pierces the triangle, the distance is that of its sides.
      ASSERT_LE(bounds.lower[t], distance) << i;
      if (!(bounds.lower[t] > 0)) continue;
      ASSERT_GE(bounds.upper[t], distance) << i;
      tight += bounds.lower[t] / distance;
      ++counted;
    }
    // The facets of tetrahedra are triangles, for which more rounding is allowed for.
    const double* const* vertices = all;
    FacetBounds tetrahedra;
    portable.of_tetrahedra(frame, vertices, tetrahedra);
    for (int f = 0; f < 8; ++f) {
      for (int k = 0; k < 3; ++k) facets[8 * k + f] = vertices[f / 4 * 4 + kTetrahedronFacets[f % 4][k]];
    }
    portable.of_triangles(frame, facets, of_facets);
    for (int f = 0; f < 8; ++f) {
      ASSERT_LE(tetrahedra.lower[f], of_facets.lower[f]);
      ASSERT_GE(tetrahedra.upper[f], of_facets.upper[f]);
      ASSERT_NEAR(tetrahedra.upper[f], of_facets.upper[f], 0x1p-14);
    }
#if defined(__x86_64__)
    if (!has_avx2()) continue;
    FacetBounds others;
    avx2_bounds<3>().of_triangles(frame, all, others);
    ASSERT_EQ(std::memcmp(&bounds, &others, sizeof bounds), 0);
    avx2_bounds<3>().of_tetrahedra(frame, vertices, others);
    ASSERT_EQ(std::memcmp(&tetrahedra, &others, sizeof bounds), 0);
#endif
  }
  EXPECT_GT(tight, 0.9 * counted) << "bounds are near to distances";
}

/** From points, from segments along an axis, and from any others. */
TEST(FacetBounds, HoldForSidesInThePlane) {
  Random random(6);
  double tight = 0;
  int counted = 0;
  for (int i = 0; i < at_least(5000); ++i) {
    double corners[32], ends[4];
    const double* all[16];
    for (double& x : corners) x = random.unit() - 0.5;
    for (int k = 0; k < 16; ++k) all[k] = corners + 2 * k;
    for (int k = 0; k < 2; ++k) {
      ends[k] = random.unit() - 0.5;
      ends[k + 2] = (i >> k) % 2 == 0 ? ends[k] : random.unit() - 0.5;
    }
    const FromSegment<2> from{ends, ends + 2, 1};
    const SegmentFrame<2> frame(ends, from.line.along, 0.5);
    FacetBounds bounds;
    portable_bounds<2>().of_triangles(frame, all, bounds);
    for (int t = 0; t < 8; ++t) {
      const SegmentWay way = from.way(from.corner(all[t]), from.corner(all[8 + t]));
      const double distance = std::sqrt(way.squared) * frame.scale;
      ASSERT_LE(bounds.lower[t], distance) << i;
      if (!(bounds.lower[t] > 0)) continue;
      ASSERT_GE(bounds.upper[t], distance) << i;
      tight += bounds.lower[t] / distance;
      ++counted;
    }
#if defined(__x86_64__)
    if (!has_avx2()) continue;
    FacetBounds others;
    avx2_bounds<2>().of_triangles(frame, all, others);
    ASSERT_EQ(std::memcmp(&bounds, &others, sizeof bounds), 0);
#endif
  }
  EXPECT_GT(tight, 0.9 * counted) << "bounds are near to distances";
}

}  // namespace
