// Which cells may contain a point: no cell whose box holds the point is left out, whatever has moved or changed,
// and few others are named.

#include "environment/cell_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "environment/moving.h"
#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

/** What is named at a point, ascending. */
template <int D>
std::vector<uint32_t> named_at(const Environment<D>& env, const double* point) {
  std::vector<uint32_t> named;
  EXPECT_TRUE(env.index.visit(env, point, [&](uint32_t index) { named.push_back(index); }));
  std::sort(named.begin(), named.end());
  EXPECT_EQ(std::adjacent_find(named.begin(), named.end()), named.end()) << "a cell is named twice";
  return named;
}

/** Points of the box of every cell name the cell, its corners and middles included. */
template <int D>
void expect_every_cell_named(const Environment<D>& env) {
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    double low[D], high[D];
    for (int k = 0; k < D; ++k) low[k] = high[k] = env.point(c, 0)[k];
    for (uint32_t v = 1; v < env.map.vertices_of(c); ++v) {
      for (int k = 0; k < D; ++k) {
        low[k] = std::min(low[k], env.point(c, v)[k]);
        high[k] = std::max(high[k], env.point(c, v)[k]);
      }
    }
    for (int code = 0; code < (D == 3 ? 27 : 9); ++code) {
      double p[D];
      int digits = code;
      for (int k = 0; k < D; ++k, digits /= 3) {
        p[k] = digits % 3 == 0 ? low[k] : digits % 3 == 1 ? high[k] : low[k] / 2 + high[k] / 2;
      }
      const std::vector<uint32_t> named = named_at(env, p);
      ASSERT_TRUE(std::binary_search(named.begin(), named.end(), i)) << "cell " << i;
    }
  }
}

TEST(CellIndex, NamesEveryCellWhereItLies) {
  for (const double scale : {1.0, 1e-320, 1e-100, 1e100, 1e307}) {
    Mesh3 mesh = mixed_mesh();
    for (double& x : mesh.points) x *= 4 * scale;
    const auto env = mesh.build();
    env->index.build(*env);
    expect_every_cell_named(*env);
  }
  Mesh3 mesh;
  add_boxes(mesh, 20, 3, 1, -7, 1e3, 0, 0.3);
  const auto env = mesh.build();
  env->index.build(*env);
  expect_every_cell_named(*env);
}

TEST(CellIndex, InThePlane) {
  for (const bool cut : {false, true}) {
    Mesh2 mesh;
    add_squares(mesh, 30, 9, cut);
    const auto env = mesh.build();
    env->index.build(*env);
    expect_every_cell_named(*env);
  }
}

TEST(CellIndex, NamesFewCellsAlsoWhereCellsDiffer) {
  Mesh3 mesh;  // a fine block under one huge box
  add_boxes(mesh, 16, 16, 16, 0, 0, 0, 1);
  const double lower[3] = {-500, -500, 17}, upper[3] = {500, 500, 900};
  add_box(mesh, lower, upper);
  const auto env = mesh.build();
  env->index.build(*env);
  expect_every_cell_named(*env);
  Random random(3);
  for (int i = 0; i < at_least(1000); ++i) {
    const double p[3] = {16 * random.unit(), 16 * random.unit(), 16 * random.unit()};
    EXPECT_LE(named_at(*env, p).size(), 8u);
    const double high[3] = {p[0], p[1], 20 + p[2]};
    EXPECT_EQ(named_at(*env, high).size(), 1u);
  }
  EXPECT_LE(env->index.memory_bytes(), 19u * env->map.cell_count);
}

TEST(CellIndex, PointsBeyondTheBoxNameNothing) {
  Mesh3 mesh;
  add_boxes(mesh, 4, 4, 4, 0, 0, 0, 0.5);
  const auto env = mesh.build();
  env->index.build(*env);
  const double inside[3] = {2, 2, 2};
  EXPECT_FALSE(named_at(*env, inside).empty());
  for (int k = 0; k < 3; ++k) {
    for (const double beyond : {-0x1p-1074, 0x1.0000000000001p1, -1e308, 1e308}) {
      double p[3] = {1, 1, 1};
      p[k] = beyond;
      EXPECT_TRUE(named_at(*env, p).empty());
    }
  }
}

TEST(CellIndex, FollowsPointsThatMove) {
  Mesh3 mesh;
  add_boxes(mesh, 6, 5, 4);
  const auto env = mesh.build();
  env->index.build(*env);
  let_points_move(*env);
  Random random(9);
  for (int round = 0; round < at_least(10); ++round) {
    std::vector<double> moved = mesh.points;  // by as much as the mesh is large, so that cells turn inside out
    for (double& x : moved) x += 100 * round + (random.unit() - 0.5) * round;
    env->points = moved.data();
    env->note_move();
    expect_every_cell_named(*env);
    moved[3 * static_cast<size_t>(random.below(100))] = std::numeric_limits<double>::quiet_NaN();
    env->note_move();
    const double p[3] = {100.0 * round, 100.0 * round, 100.0 * round};
    named_at(*env, p);
  }
}

TEST(CellIndex, IsMadeAtNeed) {
  const double p[3] = {0.5, 0.5, 0.5};
  const auto answers = [&](const Environment<3>& env) { return env.index.visit(env, p, [](uint32_t) {}); };
  Mesh3 mesh;
  add_boxes(mesh, 4, 4, 4);
  const auto env = mesh.build();
  const uint64_t before = env->memory_bytes();
  int scans = 0;
  while (scans < 100 && !answers(*env)) ++scans;
  EXPECT_GT(scans, 0);
  EXPECT_LT(scans, 20);
  EXPECT_GT(env->memory_bytes(), before);

  const auto without = mesh.build();
  without->index.set_use(TreeUse::kLeftOut);
  Mesh3 few;
  add_boxes(few, 2, 2, 2);
  const auto small = few.build();
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(answers(*without));
    EXPECT_FALSE(answers(*small)) << "eight cells are looked at faster";
  }
}

TEST(CellIndex, WithoutMemoryThereIsNoTree) {
  struct Host {
    bool refuses = false;
  } host;
  Memory memory;
  memory.user = &host;
  memory.allocate = [](void* user, size_t size, size_t) -> void* {
    return static_cast<Host*>(user)->refuses ? nullptr : ::operator new(size);
  };
  memory.release = [](void*, void* block, size_t, size_t) { ::operator delete(block); };
  Mesh3 mesh;
  add_boxes(mesh, 4, 4, 4);
  const auto env = mesh.build(nullptr, &memory);
  const double p[3] = {0.5, 0.5, 0.5};
  host.refuses = true;
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(env->index.visit(*env, p, [](uint32_t) {}));
  EXPECT_THROW(env->index.build(*env), std::bad_alloc);
  host.refuses = false;
  EXPECT_EQ(named_at(*env, p), std::vector<uint32_t>{0});
}

TEST(CellIndex, CellsThatAreMadeAreNamedUntilANewTreeHasThem) {
  Mesh3 mesh;
  add_boxes(mesh, 5, 5, 5);
  const auto env = mesh.build();
  env->index.build(*env);
  const double p[3] = {0.5, 0.5, 0.5};
  for (int round = 0; round < 20; ++round) {
    const auto made = static_cast<uint32_t>(40 + round);
    env->index.make_room(1);
    env->index.add(made);
    bool named = false;
    uint32_t asked = 0;
    for (size_t count = 2; asked < 100000 && count != 1; ++asked) {
      const std::vector<uint32_t> at = named_at(*env, p);
      count = at.size();
      named = named || std::binary_search(at.begin(), at.end(), made);
    }
    EXPECT_TRUE(named);
    EXPECT_GT(asked, 1000u) << "a tree is made too soon";
    EXPECT_LT(asked, 3000u) << "the cell is looked at for ever";
  }
  env->index.make_room(1000);  // as many cells as there are: another tree is better
  for (uint32_t i = 0; i < 1000; ++i) env->index.add(i % 125);
  env->index.make_room(1);
  EXPECT_EQ(named_at(*env, p), std::vector<uint32_t>{0});
}

}  // namespace
