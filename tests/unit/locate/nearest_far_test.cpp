// The tree of obstacles and the flood find the same bits, whatever is marked, moved or changed, and the tree is kept
// right. Changes of the topology are looked at in tests/property/edits_check.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "../../effort.h"
#include "environment/moving.h"
#include "environment/test_mesh.h"
#include "locate/bounded_flood.h"
#include "locate/locate.h"
#include "locate/nearest_search.h"
#include "obstacle_meshes.h"

namespace {

using namespace dsw;
using namespace dsw::test;

struct Tally {
  int found = 0, unknown = 0, nothing = 0;
};

template <int D>
bool find_far(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result) {
  BoundedNotes notes(env.memory);
  return find_nearest_far(env, point, start, radius, notes, result);
}

/** The search by the tree alone, and what a host gets, against the flood. `start`: the cell of the point, or, as a host
 * may name it wrongly, another one. */
template <int D>
void expect_agreement(const Environment<D>& env, const double* point, Cell start, double radius, Tally& tally) {
  if (!start.valid() || is_closed(env, start)) return;
  NearestResult flooded, searched, either;
  const bool found = find_nearest(env, point, start, radius, flooded);
  ASSERT_EQ(find_far(env, point, start, radius, either), found);
  ASSERT_NO_FATAL_FAILURE(expect_same_nearest(env, flooded, either));
  const CellTree<D>* const tree = env.obstacles.find(env);
  ASSERT_NE(tree, nullptr);
  const Distances<D> distances(env, point);
  const SearchEnd end = NearestSearch<D>(distances, *tree, point, start, radius).run(searched);
  ++(end == SearchEnd::kFound ? tally.found : end == SearchEnd::kNothing ? tally.nothing : tally.unknown);
  if (end == SearchEnd::kUnknown) return;
  ASSERT_EQ(end == SearchEnd::kFound, found);
  if (found) expect_same_nearest(env, flooded, searched);
}

template <int D>
Cell cell_of(const Environment<D>& env, const double* point) {
  return locate(env, point, Cell{}, nullptr).cell;
}

/** Every passable cell with an obstacle is in the tree or beside it. */
template <int D>
void expect_every_obstacle_known(const Environment<D>& env) {
  const CellTree<D>* const tree = env.obstacles.find(env);
  ASSERT_NE(tree, nullptr);
  std::vector<uint32_t> known(tree->cells().begin(), tree->cells().end());
  env.obstacles.for_each_beside(*tree, [&](uint32_t index) { known.push_back(index); });
  std::sort(known.begin(), known.end());
  for_each_cell(env.map, [&](Cell c) {
    const uint32_t index = env.map.index(c);
    EXPECT_TRUE(!has_obstacle(env, c) || std::binary_search(known.begin(), known.end(), index)) << "cell " << index;
  });
}

/** Points anywhere, on vertices, and halfway between them, where much is equally far. */
template <int D>
void ask_everywhere(const Environment<D>& env, Random& random, int count, Tally& tally) {
  for (int i = 0; i < count; ++i) {
    const auto vertex = [&] {
      return env.point(static_cast<uint32_t>(random.below(static_cast<int>(env.map.vertex_count))));
    };
    const double *const a = vertex(), *const b = vertex();
    const double share = random.below(4) * 0.25;
    double p[D];
    for (int k = 0; k < D; ++k) {
      p[k] = i % 3 == 0 ? a[k] + share * (b[k] - a[k]) : env.lower[k] + random.unit() * (env.upper[k] - env.lower[k]);
    }
    const double radius = random.below(3) != 0 ? kNoLimit : 3 * random.unit();
    ASSERT_NO_FATAL_FAILURE(expect_agreement(env, p, cell_of(env, p), radius, tally)) << "point " << i;
    Tally lost;
    const Cell other = env.map.cell(static_cast<uint32_t>(random.below(static_cast<int>(env.map.cell_count))));
    ASSERT_NO_FATAL_FAILURE(expect_agreement(env, p, other, radius, lost)) << "point " << i << " from elsewhere";
  }
}

template <int D, class Mesh>
void agrees(Mesh& mesh, uint64_t seed, int marks, Tally& tally) {
  Random random(seed);
  const auto env = mesh.build();
  mark_some(*env, random, marks, true);
  env->obstacles.build(*env);
  for (int round = 0; round < 8; ++round) {
    ASSERT_NO_FATAL_FAILURE(ask_everywhere(*env, random, std::clamp(effort_of(60), 20, 60), tally))
        << "seed " << seed << " round " << round;
    mark_some(*env, random, 1 + marks / 4, round % 2 == 0);
    ASSERT_NO_FATAL_FAILURE(expect_every_obstacle_known(*env)) << "seed " << seed << " round " << round;
  }
}

void expect_few_unknown(const Tally& tally) {
  EXPECT_GT(tally.found, effort_of(1000));
  EXPECT_LT(tally.unknown, (tally.found + tally.nothing) / 50) << "found " << tally.found;
}

TEST(NearestFar, InTetrahedra) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(12); ++seed) {
    Mesh3 mesh;
    Random random(seed);
    add_tetrahedra(mesh, 7);
    if (seed % 3 != 0) shake(mesh, 0.2, random);
    ASSERT_NO_FATAL_FAILURE(agrees<3>(mesh, seed, static_cast<int>(seed % 4) * 40, tally));
  }
  expect_few_unknown(tally);
}

TEST(NearestFar, InTheLatticeWhereMuchIsEquallyFar) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(12); ++seed) {
    Mesh3 mesh;
    add_boxes(mesh, 9, 8, 7, -3, 0, 0, seed % 2 == 0 ? 0.5 : 0.3);
    ASSERT_NO_FATAL_FAILURE(agrees<3>(mesh, seed, static_cast<int>(seed % 4) * 20, tally));
  }
  expect_few_unknown(tally);
}

TEST(NearestFar, InMixedCells) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(40); ++seed) {
    Mesh3 mesh = mixed_mesh();
    ASSERT_NO_FATAL_FAILURE(agrees<3>(mesh, seed, static_cast<int>(seed % 4), tally));
  }
  expect_few_unknown(tally);
}

TEST(NearestFar, InThePlane) {
  Tally tally;
  for (uint64_t seed = 1; seed <= seeds(24); ++seed) {
    Mesh2 mesh;
    Random random(seed);
    add_squares(mesh, 14, 12, seed % 2 == 0);
    if (seed % 3 != 0) shake(mesh, 0.2, random);
    ASSERT_NO_FATAL_FAILURE(agrees<2>(mesh, seed, static_cast<int>(seed % 4) * 12, tally));
  }
  expect_few_unknown(tally);
}

TEST(NearestFar, WhatIsNearerInAPartThatOverlapsIsNotReached) {
  Tally tally;
  Mesh3 mesh;
  add_boxes(mesh, 8, 8, 8);
  add_boxes(mesh, 3, 3, 3, 2.25, 2.5, 2.125);
  const auto env = mesh.build();
  env->obstacles.build(*env);
  Random random(4);
  for (int i = 0; i < at_least(300); ++i) {
    const double p[3] = {8 * random.unit(), 8 * random.unit(), 8 * random.unit()};
    const Cell start = cell_of(*env, p);  // the first part has the lower indices
    ASSERT_LT(env->map.index(start), 512u);
    ASSERT_NO_FATAL_FAILURE(expect_agreement(*env, p, start, kNoLimit, tally));
  }
  EXPECT_GT(tally.unknown, 50);
  EXPECT_GT(tally.found, 50);
}

TEST(NearestFar, AtAnyScale) {
  for (const int exponent : {-1060, -1000, -400, -200, 0, 200, 400, 1000, 1018}) {
    Mesh3 mesh;
    add_boxes(mesh, 5, 5, 5);
    for (double& x : mesh.points) x = std::ldexp(x, exponent);
    const auto env = mesh.build();
    env->obstacles.build(*env);
    Random random(7);
    for (int i = 0; i < 50; ++i) {
      double p[3];
      for (double& x : p) x = std::ldexp(5 * random.unit(), exponent);
      const Cell start = cell_of(*env, p);
      NearestResult flooded, either;
      ASSERT_EQ(find_far(*env, p, start, kNoLimit, either), find_nearest(*env, p, start, kNoLimit, flooded));
      ASSERT_NO_FATAL_FAILURE(expect_same_nearest(*env, flooded, either)) << exponent;
    }
  }
}

TEST(NearestFar, FollowsPointsThatMoveAndCellsThatTurnInsideOut) {
  Tally tally;
  Mesh3 mesh;
  add_tetrahedra(mesh, 6);
  const auto env = mesh.build();
  env->obstacles.build(*env);
  let_points_move(*env);
  Random random(9);
  for (int round = 1; round <= 12; ++round) {
    std::vector<double> moved = mesh.points;
    for (size_t i = 0; i < moved.size(); ++i)
      moved[i] += 0.1 * std::sin(round + 3 * mesh.points[(i + 1) % moved.size()]);
    for (int k = 0; k < round % 3; ++k) moved[static_cast<size_t>(random.below(900))] += 1.5;
    env->points = moved.data();
    env->note_move();
    env->checked.forget_all();
    EXPECT_EQ(env->obstacles.find(*env), nullptr) << "a tree for where points were";
    env->obstacles.build(*env);
    ASSERT_NO_FATAL_FAILURE(expect_every_obstacle_known(*env));
    ASSERT_NO_FATAL_FAILURE(ask_everywhere(*env, random, 80, tally)) << "round " << round;
    mark_some(*env, random, 10, round % 2 == 0);
    ASSERT_NO_FATAL_FAILURE(expect_every_obstacle_known(*env));
    ASSERT_NO_FATAL_FAILURE(ask_everywhere(*env, random, 40, tally)) << "round " << round;
  }
  EXPECT_GT(tally.found, 500);
  EXPECT_LT(tally.unknown, tally.found / 20);
}

/** Asks until there is a tree, or often. How many cells were visited in all. */
uint64_t ask_until_there_is_a_tree(const Environment<3>& env, const double* p, int most) {
  uint64_t cells = 0;
  const uint64_t before = env.memory_bytes();
  for (int i = 0; i < most && env.memory_bytes() == before; ++i) {
    NearestResult result;
    find_far(env, p, cell_of(env, p), kNoLimit, result);
    cells += result.volumes_visited;
  }
  return cells;
}

TEST(NearestFar, TheTreeIsMadeWhenFloodsHaveTakenAsLong) {
  Mesh3 mesh;
  add_boxes(mesh, 24, 24, 24);
  const auto env = mesh.build(), without = mesh.build();
  for (Environment<3>* const each : {env.get(), without.get()}) each->index.set_use(TreeUse::kLeftOut);
  const double deep[3] = {12.25, 12.5, 12.125}, shallow[3] = {12.25, 0.25, 12.125};
  const uint64_t before = env->memory_bytes();
  ask_until_there_is_a_tree(*without, deep, 50);
  EXPECT_EQ(without->memory_bytes(), before) << "trees are left out";
  env->index.set_use(TreeUse::kAtNeed);
  env->index.build(*env);
  const uint64_t located = env->memory_bytes();
  ask_until_there_is_a_tree(*env, shallow, 2000);
  EXPECT_EQ(env->memory_bytes(), located) << "few cells are visited in no more time";
  const uint64_t cells = ask_until_there_is_a_tree(*env, deep, 50);
  EXPECT_GT(env->memory_bytes(), located);
  EXPECT_GT(cells, env->map.cell_count / 16u);
  EXPECT_LT(cells, env->map.cell_count * 2u);
  NearestResult result;
  ASSERT_TRUE(find_far(*env, deep, cell_of(*env, deep), kNoLimit, result));
  EXPECT_LT(result.volumes_visited, 400u);
  EXPECT_EQ(result.distance, 11.5);
  for (int i = 0; i < 20000; ++i) set_cell_mark(*env, env->map.cell(static_cast<uint32_t>(i % 5000)), i % 2 == 0);
  EXPECT_EQ(env->obstacles.find(*env), nullptr) << "more is noted than a new tree has";
}

TEST(NearestFar, ManyThreadsAskWhileOneMakesTheTree) {
  Mesh3 mesh;
  add_boxes(mesh, 20, 20, 20);
  const auto env = mesh.build();
  env->index.build(*env);
  Random random(3);
  for (int round = 0; round < 6; ++round) {
    std::vector<double> points(3 * 64), expected;
    for (double& x : points) x = 4 + 12 * random.unit();
    const auto ask = [&](size_t i, bool far) {
      NearestResult result;
      const double* const p = &points[3 * i];
      const Cell start = cell_of(*env, p);
      if (is_closed(*env, start)) return -1.0;
      (far ? find_far<3> : find_nearest<3>)(*env, p, start, kNoLimit, result);
      return result.distance;
    };
    for (size_t i = 0; i < 64; ++i) expected.push_back(ask(i, false));
    std::vector<double> found(4 * 64);
    std::vector<std::thread> threads;
    for (size_t t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        for (size_t i = 0; i < 64; ++i) found[64 * t + i] = ask(i, true);
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], expected[i % 64]) << "round " << round;
    EXPECT_NE(env->obstacles.find(*env), nullptr);
    mark_some(*env, random, 40, true);
    if (round % 3 == 2) env->note_move();
  }
}

TEST(NearestFar, WithoutMemoryItFloodsOrFails) {
  struct Host {
    int left = -1;  // allocations until one is refused
  } host;
  Memory memory;
  memory.user = &host;
  memory.allocate = [](void* user, size_t size, size_t) -> void* {
    int& left = static_cast<Host*>(user)->left;
    return left >= 0 && left-- == 0 ? nullptr : ::operator new(size);
  };
  memory.release = [](void*, void* block, size_t, size_t) { ::operator delete(block); };
  Mesh3 mesh;
  add_boxes(mesh, 20, 20, 20);
  const auto env = mesh.build(nullptr, &memory);
  const double p[3] = {10.25, 10.5, 10.125};
  const Cell start = cell_of(*env, p);
  const auto mark = [&](bool marked) { set_cell_mark(*env, env->map.cell(4000), marked); };
  NearestResult flooded, found;
  find_nearest(*env, p, start, kNoLimit, flooded);
  for (const bool again : {false, true}) {
    int refused = 0;
    for (int n = 0; n < 300; ++n) {
      env->obstacles.drop();
      if (again) env->obstacles.build(*env);
      env->obstacles.note_flood(*env, 10000);
      host.left = n;
      try {
        mark(true);
        mark(false);
        ASSERT_TRUE(find_far(*env, p, start, kNoLimit, found));
        host.left = -1;
        ASSERT_NO_FATAL_FAILURE(expect_same_nearest(*env, flooded, found)) << n;
      } catch (const std::bad_alloc&) {
        ++refused;
      }
      host.left = -1;
    }
    EXPECT_GT(refused, 2);
    EXPECT_LT(refused, 100);
  }
}

}  // namespace
