// The walk gives the same results and counts the same work for every instruction set and however casts are
// grouped.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/compiler.h"
#include "environment/marking.h"
#include "environment/moving.h"
#include "flown.h"
#include "locate/locate.h"
#include "pyramid_lattice.h"
#include "topology/coarsen.h"
#include "walk/shear.h"
#include "walks.h"

#include "../../effort.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;
using namespace dsw::testing_walk;
using dsw::testing_walk::expect_same;  // beside that of counters

constexpr int kSize = 5;
// For each of the scenes and scales below: more than 2e5 in all, and half as many where effort is less.
constexpr int kCasts = 3300;

void expect_same(const CastCounters& a, const CastCounters& b) {
  EXPECT_EQ(a.casts, b.casts);
  EXPECT_EQ(a.volumes_visited, b.volumes_visited);
  EXPECT_EQ(a.orientation_tests, b.orientation_tests);
  EXPECT_EQ(a.exact_fallbacks, b.exact_fallbacks);
  EXPECT_EQ(a.ties, b.ties);
}

/** Random points; where ties are wanted, on the lattice of half cells or on a vertex. */
class Points {
 public:
  Points(const SmallMesh& mesh, double scale, uint32_t seed) : mesh_(mesh), scale_(scale), random_(seed) {}
  void next(double (&p)[3], bool tie, double margin) {
    if (tie && random_() % 2 == 0) {
      const size_t vertex = below(static_cast<uint32_t>(mesh_.points.size() / 3));
      std::copy_n(mesh_.points.begin() + static_cast<std::ptrdiff_t>(3 * vertex), 3, p);
      return;
    }
    for (double& x : p) {
      const double low = -margin, high = kSize + margin;
      const double at = low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
      x = (tie ? std::round(2 * at) / 2 : at) * scale_;
    }
  }
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }

 private:
  const SmallMesh& mesh_;
  double scale_;
  std::mt19937 random_;
};

SmallMesh mixed_lattice() {
  SmallMesh mesh = lattice(kSize, kHexahedron);
  SmallMesh mixed = mesh;
  mixed.name = "pyramids, polyhedra and hexahedra";
  mixed.types.clear();
  mixed.offsets = {0};
  mixed.connectivity.clear();
  for (size_t i = 0; i < mesh.types.size(); ++i) {
    const std::vector<int64_t> c(mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * i),
                                 mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * i + 8));
    switch (i % 3) {
      case 0:
        mixed.cell(kHexahedron, c);
        break;
      case 1:
        mixed.polyhedron(box_faces(c));
        break;
      default:
        add_pyramids(mixed, c);
        break;
    }
  }
  return mixed;
}

/** Columns of wedges: every cell of a lattice cut along a vertical diagonal. */
SmallMesh wedge_lattice() {
  return divided_lattice(kSize, "wedges", [](SmallMesh& wedges, const std::vector<int64_t>& c) {
    wedges.cell(kWedge, {c[0], c[3], c[1], c[4], c[7], c[5]});
    wedges.cell(kWedge, {c[1], c[3], c[2], c[5], c[7], c[6]});
  });
}

/** A cast and what the portable walk said of it, alone. */
struct Flown {
  double from[3], to[3], apex[3];
  bool contained;
  CastResult expected;
  std::vector<Crossing> expected_crossings, crossings;
};

struct Group {
  uint32_t count = 0;
  Flown casts[kPacket];
  CastRequest requests[kPacket];
  CastCounters counters;  // of all together
};

/** Casts a group side by side, counted and not. */
void compare(const Environment<3>& env, Group& group, const Walk<3>& walk) {
  CastResult results[kPacket];
  CastCounters counters;
  for (uint32_t i = 0; i < group.count; ++i) {
    group.casts[i].crossings.clear();
    group.requests[i].crossing_user = &group.casts[i].crossings;
  }
  walk_counted(env, group.requests, group.count, results, &counters);
  expect_same(group.counters, counters);
  for (uint32_t i = 0; i < group.count; ++i) {
    const Flown& cast = group.casts[i];
    SCOPED_TRACE(testing::Message() << i << " of " << group.count << std::hexfloat << " from " << cast.from[0] << " "
                                    << cast.from[1] << " " << cast.from[2] << " to " << cast.to[0] << " " << cast.to[1]
                                    << " " << cast.to[2]);
    expect_same(cast.expected, results[i]);
    EXPECT_EQ(cast.crossings, cast.expected_crossings);
    EXPECT_EQ(walk.contains(env, cast.expected.cell, cast.apex, cast.to), cast.contained);
    EXPECT_EQ(walk.sees_all(env, cast.expected.cell, cast.to),
              kPortableWalk.sees_all(env, cast.expected.cell, cast.to));
    group.requests[i].crossing = nullptr;
  }
  walk.plain(env, group.requests, group.count, results);
  for (uint32_t i = 0; i < group.count; ++i) {
    expect_same(group.casts[i].expected, results[i]);
    group.requests[i].crossing = note;
  }
}

class InstructionSetTest : public testing::TestWithParam<double> {};

TEST_P(InstructionSetTest, SameResultsAndCountersAloneAndSideBySide) {
  const std::vector<NamedWalk> all = walks();
  const double scale = GetParam();
  const std::vector<SmallMesh> meshes = {lattice(kSize, kHexahedron),
                                         lattice(kSize, kHexahedron, 0.12),
                                         lattice(kSize, kTetra),
                                         lattice(kSize, kTetra, 0.03),
                                         lattice(kSize, kPolyhedron),
                                         lattice(kSize, kPolyhedron, 0.12),
                                         wedge_lattice(),
                                         mixed_lattice(),
                                         pyramid_lattice(kSize)};
  const int casts = std::max(effort_of(kCasts), kCasts / 2);
  uint32_t seed = 17;
  // Then tetrahedra that are merged, and flat cells of which some bend.
  const size_t all_meshes = meshes.size(), others[5] = {2, 3, 0, 7, 8};
  for (size_t m = 0; m < all_meshes + 5; ++m) {
    const bool is_merged = m >= all_meshes && m < all_meshes + 2, bends = m >= all_meshes + 2;
    SmallMesh mesh = meshes[m < all_meshes ? m : others[m - all_meshes]];
    SCOPED_TRACE(mesh.name + (is_merged ? ", merged" : bends ? ", bent" : ""));
    for (double& x : mesh.points) x *= scale;
    Environment<3> built(nullptr), merged(nullptr);
    build_mesh(built, mesh);
    if (is_merged) {
      Array<uint32_t> new_index;
      CoarsenReport report;
      coarsen(built, {m % 2 == 0 ? 16u : 28u, 0}, merged, new_index, report);
    }
    Environment<3>& env = is_merged ? merged : built;
    const Map<3>& map = env.map;
    Points points(mesh, scale, ++seed);
    for (uint32_t i = 0; i < map.cell_count; ++i) {
      const Cell c = map.cell(i);
      if (points.below(30) == 0) set_cell_mark(env, c, true);
      if (points.below(20) == 0) set_facet_mark(env, map.half_facet(c, points.below(map.facets_of(c))), true);
    }
    std::vector<double> moved(env.points, env.points + 3 * size_t{map.vertex_count});
    if (bends) {
      let_points_move(env);
      for (size_t x = 0; x < moved.size(); x += 12) moved[x] += 0.05 * scale;
      env.points = moved.data();
      env.note_move();
    }
    CastCounters total;
    uint32_t hits = 0, wanted = 1, full = 0;
    std::mt19937 sizes(static_cast<uint32_t>(seed_of(seed)));
    Group group;
    for (int n = 0; n < casts; ++n) {
      Flown& cast = group.casts[group.count];
      points.next(cast.from, n % 2 == 0, 0);
      points.next(cast.to, n % 4 < 2, n % 3 == 0 ? 1 : 0);
      const Cell start = locate(env, cast.from, Cell{}, nullptr).cell;
      if (!start.valid()) continue;  // on the far boundary, shifted out
      CastRequest& request = group.requests[group.count] = CastRequest{};
      request.from = cast.from;
      request.to = cast.to;
      request.start = start;
      request.max_volumes = n % 7 == 0 ? 1 + points.below(6) : 0;
      request.forecast = n % 5 == 0 ? points.below(map.facets_of(start)) : kNoFacet;
      request.through_walls = n % 6 == 0;
      request.crossing = note;
      cast.expected_crossings.clear();
      request.crossing_user = &cast.expected_crossings;
      const CastCounters before = group.counters;
      walk_counted(env, &request, 1, &cast.expected, &group.counters);
      EXPECT_EQ(group.counters.casts, before.casts + 1);
      centre(env, cast.expected.cell, cast.apex);
      cast.contained = all[0].walk.contains(env, cast.expected.cell, cast.apex, cast.to);
      const bool reached = cast.expected.end == CastEnd::kReached;
      // A merged cell that is not convex can be left through a wall on the way to a target in it.
      const bool can_be_left = is_merged && !env.map.convex(cast.expected.cell);
      EXPECT_TRUE(cast.contained == reached || (can_be_left && cast.contained));
      hits += cast.expected.end == CastEnd::kHit ? 1u : 0u;
      if (++group.count < wanted && n + 1 < casts) continue;
      full += group.count == kPacket ? 1u : 0u;
      wanted = n % 2 == 0 ? kPacket : 1 + static_cast<uint32_t>(sizes() % kPacket);  // groups of all sizes
      for (const NamedWalk& other : all) {
        SCOPED_TRACE(testing::Message() << other.name << ", cast " << n);
        compare(env, group, other.walk);
        if (HasFailure()) return;
      }
      total.add(group.counters);
      group.count = 0;
      group.counters = {};
    }
    EXPECT_GT(total.casts, static_cast<uint32_t>(casts) * 4u / 5u);
    EXPECT_GT(total.volumes_visited, 2 * total.casts);
    EXPECT_GT(total.ties, total.casts / 5);
    EXPECT_GT(hits, static_cast<uint32_t>(casts) / 10u);
    EXPECT_GT(full, 3u);
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, InstructionSetTest, testing::Values(1.0, 0x1p-3, 1e100, 1e-100, 1e-300));

TEST(InstructionSets, TrianglesAreMissedWithTheSameBits) {
#if DSW_X86_64
  if (!DSW_CPU_HAS("avx2")) GTEST_SKIP();
  std::vector<MissedTriangles> sets{missed_triangles_avx2};
  std::vector<PassesTriangles> pass_sets{passes_triangles_avx2};
  if (DSW_CPU_HAS("avx512f") && DSW_CPU_HAS("avx512dq") && DSW_CPU_HAS("avx512vl")) {
    sets.push_back(missed_triangles_avx512);
    pass_sets.push_back(passes_triangles_avx512);
  }
  std::mt19937_64 random(seed_of(5));
  std::uniform_real_distribution<double> coordinate(-1, 1), distance(0.5, 1);
  size_t passed = 0, missed = 0, many_passed = 0;
  for (int round = 0; round < at_least(6000); ++round) {
    const double scale = std::ldexp(1.0, round % 7 * 180 - 540);
    const bool in_range = round % 7 != 0 && round % 7 != 6;
    // The line of an axis, either way, and nearly so.
    double line[2][3];
    const int axis = round % 3;
    for (double& x : line[0]) x = scale * coordinate(random);
    for (int k = 0; k < 3; ++k) line[1][k] = line[0][k] + 0.01 * scale * coordinate(random);
    line[1][axis] += round % 2 == 0 ? scale : -scale;
    FacetRows<3> triangles{Allocator<double>(nullptr)};
    const size_t count = static_cast<size_t>(round % 150), some = std::min(count, kMostMissed);
    triangles.reserve(count);
    triangles.replace(0, 0, count);
    for (size_t n = 0; n < count; ++n) {
      // Round the line, and one in fifty the other way round.
      const bool reversed = (round % 2 == 1) != (random() % 200 == 0);
      for (int i = 0; i < 3; ++i) {
        const double angle = 2.0943951 * (reversed ? -i : i), away = scale * distance(random);
        double corner[3];
        corner[axis] = line[0][axis] + scale * coordinate(random);
        corner[(axis + 1) % 3] = line[0][(axis + 1) % 3] + away * std::cos(angle);
        corner[(axis + 2) % 3] = line[0][(axis + 2) % 3] + away * std::sin(angle);
        triangles.set(n, i, corner);
      }
    }
    Shear portable(line[0], line[1]);
    const uint64_t by_one = missed_triangles(portable, triangles.span(0, some));
    ++(by_one == 0 ? passed : missed);
    const bool passes_some = by_one == 0 && portable.passed_all();
    ASSERT_EQ(passes_triangles(line[0], line[1], triangles.span(0, some)), passes_some);
    const bool passes_all = passes_triangles(line[0], line[1], triangles.span(0, count));
    many_passed += count > kMostMissed && passes_all ? 1 : 0;
    for (const PassesTriangles passes_by : pass_sets) {
      ASSERT_EQ(passes_by(line[0], line[1], triangles.span(0, some)), passes_some) << some;
      ASSERT_EQ(passes_by(line[0], line[1], triangles.span(0, count)), passes_all) << count;
      ASSERT_FALSE(passes_by(line[0], line[0], triangles.span(0, count))) << "a line of no length";
    }
    for (const MissedTriangles missed_by : sets) {
      if (!in_range) break;
      Shear shear(line[0], line[1]);
      ASSERT_EQ(by_one, missed_by(shear, triangles.span(0, some)));
      ASSERT_EQ(portable.lowest(), shear.lowest());
      ASSERT_EQ(portable.largest(), shear.largest());
    }
  }
  EXPECT_GT(passed, 1000u);
  EXPECT_GT(missed, 1000u);
  EXPECT_GT(many_passed, 100u);
#else
  GTEST_SKIP();
#endif
}

}  // namespace
