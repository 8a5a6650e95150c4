// Hexahedra that are cuboids after points have moved: which are found, and that casts end in them as they do where
// nobody knows of cuboids.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "environment/marking.h"
#include "environment/moving.h"
#include "flown.h"
#include "locate/locate.h"
#include "small_meshes.h"
#include "walks.h"

#include "../../effort.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;
using namespace dsw::testing_walk;
using Known = CheckedCells::Known;

constexpr int kSize = 6, kCasts = 3000;
constexpr double kUnitCube[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

class Cuboid : public testing::Test {
 protected:
  Cuboid() {
    SmallMesh mesh = lattice(1, kHexahedron);
    build_mesh(env_, mesh);
    let_points_move(env_);
    cell_ = env_.map.cell(0);
    std::copy_n(kUnitCube, 24, points_.begin());
  }
  /** What is found out of the points as they are now. They name the corners in the order of the unit cube. */
  Known find_out() {
    std::array<double, 24> placed;
    for (uint32_t v = 0; v < 8; ++v) {  // the lattice numbers its points by rows
      const double at[3] = {double(v % 2), double(v / 2 % 2), double(v / 4)};
      for (uint32_t i = 0; i < 8; ++i) {
        if (std::equal(at, at + 3, kUnitCube + 3 * i)) std::copy_n(points_.data() + 3 * i, 3, placed.data() + 3 * v);
      }
    }
    now_ = placed;
    env_.points = now_.data();
    env_.note_move();
    env_.checked.forget_all();
    const Known known = find_out_validity(env_, cell_);
    EXPECT_EQ(known == Known::kCuboid, is_cuboid(env_, cell_));
    for (const NamedWalk& each : walks()) {
      env_.checked.forget_all();
      double centre[3];
      EXPECT_EQ(each.walk.admits_with_centre(env_, cell_, centre), CheckedCells::is_valid(known)) << each.name;
      EXPECT_EQ(env_.checked.known(env_.map.index(cell_)), known) << each.name;
    }
    return known;
  }
  Environment<3> env_{nullptr};
  Cell cell_;
  std::array<double, 24> points_, now_;
};

TEST_F(Cuboid, HasFacetsInPlanesOfTheAxes) {
  EXPECT_EQ(find_out(), Known::kCuboid);
  for (size_t i = 0; i < 24; ++i) points_[i] = kUnitCube[i] * (i % 3 == 0 ? 1e-3 : 7) + 0.1;
  EXPECT_EQ(find_out(), Known::kCuboid);
  points_[23] = std::nextafter(points_[23], 100);  // one corner by one unit in the last place
  EXPECT_EQ(find_out(), Known::kValid);
}

TEST_F(Cuboid, MayBeTurnedButNotMirrored) {
  for (const auto& axes : {std::array<size_t, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}) {
    for (uint32_t flips = 0; flips < 8; ++flips) {
      for (size_t v = 0; v < 8; ++v) {
        for (size_t k = 0; k < 3; ++k) {
          points_[3 * v + k] = kUnitCube[3 * v + axes[k]] * ((flips >> k & 1u) != 0 ? -1 : 1);
        }
      }
      const bool is_odd = ((axes[0] + 1) % 3 != axes[1]) != (__builtin_popcount(flips) % 2 != 0);
      EXPECT_EQ(find_out(), is_odd ? Known::kInvalid : Known::kCuboid) << axes[0] << axes[1] << axes[2] << flips;
    }
  }
}

TEST_F(Cuboid, IsNotSheared) {
  for (size_t v = 0; v < 8; ++v) points_[3 * v] += 0.5 * points_[3 * v + 2];
  EXPECT_EQ(find_out(), Known::kValid);
}

TEST_F(Cuboid, HasRoomForItsCentre) {
  for (const double at : {1.0, 1e300, -1.0}) {
    const double next = std::nextafter(at, HUGE_VAL), far = at + std::abs(at) * 0x1p-48;
    for (size_t v = 0; v < 8; ++v) points_[3 * v] = kUnitCube[3 * v] == 0 ? at : far;
    EXPECT_EQ(find_out(), Known::kCuboid);
    for (size_t v = 0; v < 8; ++v) points_[3 * v] = kUnitCube[3 * v] == 0 ? at : next;
    EXPECT_EQ(find_out(), Known::kInvalid);
  }
  for (size_t v = 0; v < 8; ++v) points_[3 * v] = 0;
  EXPECT_EQ(find_out(), Known::kInvalid);
  for (size_t v = 0; v < 8; ++v) points_[3 * v] = kUnitCube[3 * v] == 0 ? 0 : HUGE_VAL;
  EXPECT_EQ(find_out(), Known::kInvalid);
}

struct Flown {
  double from[3], to[3];
  CastRequest request;
  CastResult expected;
  std::vector<Crossing> expected_crossings, crossings;
};

/** A lattice that was stretched along the axes, and bent in one half: some of its cells are invalid. */
std::vector<double> deformed(const Environment<3>& env, double scale, std::mt19937& random) {
  std::vector<double> points(env.points, env.points + 3 * size_t{env.map.vertex_count});
  for (size_t v = 0; v < points.size(); v += 3) {
    const bool bends = points[v] > 0.6 * kSize * scale;
    points[v + 1] *= 1.3;
    points[v + 2] *= 0.7;
    for (size_t k = 0; k < 3 && bends; ++k) {
      points[v + k] += scale * 0.35 * (static_cast<double>(random() % 1001) / 500.0 - 1);
    }
  }
  return points;
}

class CuboidsTest : public testing::TestWithParam<double> {};

TEST_P(CuboidsTest, EndCastsAsBentHexahedraDo) {
  const double scale = GetParam();
  SmallMesh mesh = lattice(kSize, kHexahedron);
  for (double& x : mesh.points) x *= scale;
  Environment<3> env(nullptr);
  build_mesh(env, mesh);
  std::mt19937 random(static_cast<uint32_t>(seed_of(21)));
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    if (below(40) == 0) set_cell_mark(env, c, true);
    if (below(30) == 0) set_facet_mark(env, env.map.half_facet(c, below(6)), true);
  }
  let_points_move(env);
  const std::vector<double> points = deformed(env, scale, random);
  env.points = points.data();
  env.note_move();
  const auto place = [&](double(&p)[3], bool tie, double margin) {
    constexpr double kStretched[3] = {1, 1.3, 0.7};
    for (size_t k = 0; k < 3; ++k) {
      const double at = -margin + (kSize + 2 * margin) * static_cast<double>(random()) / 4294967296.0;
      p[k] = (tie ? std::round(2 * at) / 2 : at) * scale * kStretched[k];
    }
  };

  // Cuboids are noted as other valid cells are.
  uint32_t cuboids = 0, bent = 0;
  env.checked.forget_all();
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Known known = known_of(env, env.map.cell(i));
    cuboids += known == Known::kCuboid ? 1u : 0u;
    bent += known == Known::kValid ? 1u : 0u;
    if (known == Known::kCuboid) env.checked.note(i, Known::kValid);
  }
  EXPECT_GT(cuboids, 60u);
  EXPECT_GT(bent, 30u);
  EXPECT_LT(cuboids + bent, env.map.cell_count);
  std::vector<Flown> casts(kCasts);
  CastCounters bent_counters;
  uint32_t hits = 0;
  for (size_t n = 0; n < casts.size(); ++n) {
    Flown& cast = casts[n];
    Cell start;
    while (!start.valid() || is_closed(env, start)) {
      place(cast.from, n % 2 == 0, 0);
      start = locate(env, cast.from, Cell{}, nullptr).cell;
    }
    place(cast.to, n % 4 < 2, n % 3 == 0 ? 1 : 0);
    CastRequest& request = cast.request;
    request.from = cast.from;
    request.to = cast.to;
    request.start = start;
    request.max_volumes = n % 7 == 0 ? 1 + below(6) : 0;
    request.through_walls = n % 6 == 0;
    request.crossing = n % 3 == 0 ? nullptr : note;
    request.crossing_user = &cast.expected_crossings;
    walk_counted(env, &request, 1, &cast.expected, &bent_counters);
    hits += cast.expected.end == CastEnd::kHit ? 1u : 0u;
  }
  EXPECT_GT(hits, casts.size() / 10);

  CastCounters first;
  for (const NamedWalk& each : walks()) {
    SCOPED_TRACE(each.name);
    env.checked.forget_all();
    CastCounters counters;
    for (size_t begin = 0, wanted = 1, count; begin < casts.size(); begin += count) {
      count = std::min({wanted, casts.size() - begin, size_t{kPacket}});
      wanted = wanted * 3 % 257;
      CastRequest requests[kPacket];
      CastResult results[kPacket];
      for (size_t i = 0; i < count; ++i) {
        Flown& cast = casts[begin + i];
        cast.crossings.clear();
        requests[i] = cast.request;
        if (cast.expected.end == CastEnd::kReached && (begin + i) % 5 == 0) requests[i].end = cast.expected.cell;
        requests[i].crossing_user = &cast.crossings;
      }
      each.walk.plain(env, requests, static_cast<uint32_t>(count), results);
      CastResult same[kPacket];
      for (size_t i = 0; i < count; ++i) requests[i].crossing = nullptr;
      walk_counted(env, requests, static_cast<uint32_t>(count), same, &counters);
      for (size_t i = 0; i < count; ++i) {
        SCOPED_TRACE(begin + i);
        CastResult expected = casts[begin + i].expected;
        if (expected.end != CastEnd::kHit) {  // a flat facet may be named by its first triangle
          expected.simplex /= 2;
          results[i].simplex /= 2;
        }
        expect_same(results[i], expected);
        EXPECT_EQ(casts[begin + i].crossings, casts[begin + i].expected_crossings);
        if (HasFailure()) return;
      }
    }
    EXPECT_LT(counters.orientation_tests, bent_counters.orientation_tests);
    EXPECT_GT(counters.ties, casts.size() / 10);
    if (first.casts == 0) first = counters;
    EXPECT_EQ(counters.orientation_tests, first.orientation_tests);
    EXPECT_EQ(counters.exact_fallbacks, first.exact_fallbacks);
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, CuboidsTest, testing::Values(1.0, 0x1p-3, 1e100, 1e-100, 1e-300));

}  // namespace
