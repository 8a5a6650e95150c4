// What is seen of ways without a cast is what casts find.

#include "walk/short_way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "environment/marking.h"
#include "environment/moving.h"
#include "flown.h"
#include "locate/locate.h"
#include "predicates/tally.h"
#include "pyramid_lattice.h"
#include "walks.h"

#include "../../effort.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;
using namespace dsw::testing_walk;

constexpr uint32_t kWays = kPacket;

struct Seen {
  size_t one = 0, two = 0, open = 0, led = 0;
  size_t far = 0;               // led on behind the next cell
  size_t apart = 0;             // from two starts, of which one is led
  size_t ended = 0, walls = 0;  // at once, of which at a wall
};

uint32_t facets_outside(const Environment<3>& env, Cell cell, const double* point) {
  uint32_t facets = 0;
  const Shape shape = env.map.shape(cell);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const double* simplex[3];
    boundary_points(env, cell, shape.simplex_first(f), simplex);
    facets |= (plane_side<3>(simplex, point, NoTally{}).sign > 0 ? 1u : 0u) << f;
  }
  return facets;
}

/** The cells that a cast comes into behind its first, in order. `reached`: whether it gets to its end, which the last of them
 * then holds. */
std::vector<Cell> cells_of_cast(const Environment<3>& env, Cell cell, const double* from, const double* to,
                                bool* reached) {
  std::vector<Crossing> crossings;
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = cell;
  request.crossing = note;
  request.crossing_user = &crossings;
  *reached = cast(env, request, nullptr).end == CastEnd::kReached;
  std::vector<Cell> cells;
  for (const Crossing& each : crossings) cells.push_back(Cell{each.to});
  return cells;
}

/** The mirror image of a point of a convex cell through the mean of its facets, a quarter as far from it. */
void put_behind_mean(const Environment<3>& env, Cell cell, const double* in, double* at) {
  const Shape shape = env.map.shape(cell);
  const double corners = 3 * shape.facet_count();
  for (int k = 0; k < 3; ++k) at[k] = -0.25 * in[k];
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const double* simplex[3];
    boundary_points(env, cell, shape.simplex_first(f), simplex);
    for (int k = 0; k < 3; ++k) at[k] += 1.25 * (simplex[0][k] + simplex[1][k] + simplex[2][k]) / corners;
  }
}

/** Two ways to an end outside of two facets of their cell. */
void check_two(const Environment<3>& env, Cell cell, uint32_t facets, const double* from, const double* to,
               Seen& seen) {
  double other[3];
  put_behind_mean(env, cell, from, other);
  EXPECT_EQ(facets_outside(env, cell, other), 0u);
  const double* const ways[2] = {from, other};
  std::vector<Cell> cells[2];
  bool reached[2];
  for (int i = 0; i < 2; ++i) cells[i] = cells_of_cast(env, cell, ways[i], to, &reached[i]);
  if (!reached[0] || cells[0].empty()) return;
  const Cell last = cells[0].back();
  // Both ways together, and each alone.
  TwoWays pairs[3];
  for (uint32_t i = 0; i < 3; ++i) pairs[i] = {{ways[0], ways[1]}, to, cell, last, facets, i + 1, 0};
  follow_ways(env, pairs, 3);
  const uint32_t both = pairs[2].leads;
  const double* ridge[2];
  const bool share = shared_ridge(env, env.map.record(cell), lowest_bit(facets), highest_bit(facets), ridge);
  for (uint32_t i = 0; i < 2; ++i) {
    const bool leads = (both >> i & 1) != 0;
    const uint32_t alone = pairs[i].leads;
    EXPECT_EQ(alone & ~(1u << i), 0u);
    EXPECT_TRUE(alone != 0 || !leads);
    if (alone != 0) {
      EXPECT_TRUE(reached[i] && cells[i].back() == last);
      EXPECT_LE(cells[i].size(), 1 + kMostFurtherLooks);
      seen.far += cells[i].size() > 1 ? 1 : 0;
    } else if (share && !env.has_moved()) {
      EXPECT_FALSE(reached[i] && cells[i].size() == 1 && cells[i].back() == last);
    }
  }
  seen.led += (both & 1) != 0 ? 1 : 0;
  seen.apart += (both & 1) != both >> 1 ? 1 : 0;
}

void check_way(const Environment<3>& env, Cell cell, uint32_t facets, const double* from, const double* to,
               Seen& seen) {
  if (facets == 0) return;
  EXPECT_EQ(facets, facets_outside(env, cell, to));
  const uint32_t rest = facets & (facets - 1);
  if (rest == 0) {
    bool reached;
    const std::vector<Cell> cells = cells_of_cast(env, cell, from, to, &reached);
    const Cell next = open_neighbour(env, cell, lowest_bit(facets));
    ++seen.one;
    seen.open += next.valid() ? 1 : 0;
    // Where points have moved, a cell of which nothing is known counts as closed.
    if (next.valid() || !env.has_moved()) {
      EXPECT_EQ(next, cells.empty() ? Cell{} : cells[0]);
    }
  } else if ((rest & (rest - 1)) == 0) {
    ++seen.two;
    check_two(env, cell, facets, from, to, seen);
  }
}

void check_end(const Environment<3>& env, Cell cell, const double* from, const double* to, Seen& seen) {
  CastResult end;
  if (!ends_at_once(env, cell, to, &end)) return;
  const CastResult whole = cast(env, from, to, cell);
  EXPECT_EQ(end.end, whole.end);
  EXPECT_EQ(end.cell, whole.cell);
  EXPECT_EQ(end.facet, whole.facet);
  EXPECT_EQ(end.simplex, whole.simplex);
  EXPECT_EQ(end.previous, whole.previous);
  EXPECT_EQ(end.volumes_visited, whole.volumes_visited);
  EXPECT_EQ(end.first_facet, whole.first_facet);
  ++seen.ended;
  seen.walls += end.end == CastEnd::kHit ? 1 : 0;
}

/** Draws ways from cells that may be entered, and compares them by all walks. On a lattice some ways meet ridges exactly. */
Seen check_ways(const Environment<3>& env, int rounds, std::mt19937& random, bool on_lattice = false) {
  std::uniform_real_distribution<double> somewhere(0.05, 4.95), beside(-0.8, 0.8);
  Seen seen;
  for (int round = 0; round < rounds; ++round) {
    double from[kWays][3], to[kWays][3];
    Cell cells[kWays];
    const double* points[kWays];
    for (uint32_t i = 0; i < kWays; ++i) {
      do {
        for (double& x : from[i]) x = on_lattice ? std::round(4 * somewhere(random)) / 4 : somewhere(random);
        cells[i] = locate(env, from[i], Cell{}, nullptr).cell;
      } while (!cells[i].valid() || env.map.marked(cells[i]));
      for (int k = 0; k < 3; ++k) {
        to[i][k] = from[i][k] + (on_lattice ? std::round(16 * beside(random)) / 8 : beside(random));
      }
      points[i] = to[i];
    }
    for (uint32_t i = 0; i < kWays; ++i) check_end(env, cells[i], from[i], to[i], seen);
    for (const NamedWalk& walk : walks()) {
      SCOPED_TRACE(walk.name);
      uint8_t facets[kWays];
      walk.walk.find_outside(env, cells, points, kWays, facets);
      for (uint32_t i = 0; i < kWays; ++i) check_way(env, cells[i], facets[i], from[i], to[i], seen);
    }
  }
  return seen;
}

/** Ways from cells that are marked, where a vertex may lie that has not been freed. */
size_t check_ends_of_marked(const Environment<3>& env, int rounds, std::mt19937& random) {
  std::uniform_real_distribution<double> somewhere(0.05, 4.95), beside(-0.8, 0.8);
  Seen seen;
  for (int i = 0; i < 100 * rounds; ++i) {
    double from[3], to[3];
    for (double& x : from) x = somewhere(random);
    const Cell cell = locate(env, from, Cell{}, nullptr).cell;
    if (!cell.valid() || !env.map.marked(cell)) continue;
    for (int k = 0; k < 3; ++k) to[k] = from[k] + beside(random);
    check_end(env, cell, from, to, seen);
  }
  return seen.ended;
}

TEST(ShortWay, IsTheWayOfACast) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(5)));
  const int rounds = at_least(20);
  size_t ended = 0, walls = 0, ended_in_marks = 0;
  for (const SmallMesh& mesh :
       {lattice(5, kTetra), lattice(5, kTetra, 0.03), lattice(5, kHexahedron), pyramid_lattice(5)}) {
    SCOPED_TRACE(mesh.name);
    Environment<3> env(nullptr);
    build_mesh(env, mesh);
    for (uint32_t i = 0; i < env.map.cell_count; i += 11) set_cell_mark(env, env.map.cell(i), true);
    const Seen seen = check_ways(env, rounds, random);
    const auto least = static_cast<size_t>(20 * rounds);
    const Seen on_lattice = check_ways(env, rounds, random, true);
    ended_in_marks += check_ends_of_marked(env, rounds, random);
    EXPECT_GE(on_lattice.led, on_lattice.two / 10);
    EXPECT_GE(on_lattice.two, least);
    EXPECT_GE(seen.one, least);
    EXPECT_GE(seen.two, least);
    EXPECT_GE(seen.open, seen.one / 3);
    EXPECT_GE(seen.led, seen.two / 3);
    EXPECT_GE(seen.far, seen.two / 2);
    EXPECT_GE(seen.apart, seen.two / 20);
    ended += seen.ended;
    walls += seen.walls;
  }
  EXPECT_GE(walls, static_cast<size_t>(10 * rounds));
  EXPECT_GT(ended_in_marks, 0u);
  EXPECT_GE(ended, walls + static_cast<size_t>(4 * rounds));
}

/** Some points go so far that cells become invalid, which are walls then. */
TEST(ShortWay, IsTheWayOfACastWherePointsHaveMoved) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(6)));
  std::uniform_real_distribution<double> far(-0.6, 0.6);
  const int rounds = at_least(20);
  for (const double jitter : {0.0, 0.03}) {
    SCOPED_TRACE(jitter);
    Environment<3> env(nullptr);
    build_mesh(env, lattice(5, kTetra, jitter));
    let_points_move(env);
    std::vector<double> moved(env.points, env.points + 3 * size_t{env.map.vertex_count});
    for (double& x : moved) x += far(random);
    env.points = moved.data();
    env.note_move();
    env.checked.forget_all();
    const Seen seen = check_ways(env, rounds, random);
    const auto least = static_cast<size_t>(20 * rounds);
    EXPECT_GE(seen.one, least);
    EXPECT_GE(seen.two, least);
    EXPECT_GT(seen.open, 0u);
    EXPECT_LT(seen.open, seen.one);
    EXPECT_GT(seen.led, 0u);
    EXPECT_GT(seen.walls, 0u);
  }
}

}  // namespace
