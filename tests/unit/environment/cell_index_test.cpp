// Which cells may contain a point: no cell whose box holds the point is left out, whatever has moved or changed,
// and few others are named.

#include "environment/cell_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "environment/curve.h"
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

constexpr Parallel kThreeThreads{nullptr, nullptr, 3};

/** The cells of a mesh of hexahedra in another order. */
void shuffle_boxes(Mesh3& mesh, uint64_t seed) {
  Random random(seed);
  for (size_t i = mesh.types.size(); i > 1; --i) {
    const auto j = static_cast<size_t>(random.below(static_cast<int>(i)));
    for (size_t k = 0; k < 8; ++k) std::swap(mesh.connectivity[8 * (i - 1) + k], mesh.connectivity[8 * j + k]);
  }
}

TEST(CellIndex, NamesFewCellsInWhateverOrderTheyAreOnHoweverManyThreads) {
  constexpr int kSide = 29;
  for (const bool shuffled : {false, true}) {
    Mesh3 mesh;
    add_boxes(mesh, kSide, kSide, kSide);
    if (shuffled) shuffle_boxes(mesh, 4);
    const auto env = mesh.build(), shared = mesh.build();
    env->index.build(*env);
    shared->index.build(*shared, kThreeThreads);
    Random random(6);
    for (int i = 0; i < at_least(2000); ++i) {
      const double p[3] = {kSide * random.unit(), kSide * random.unit(), kSide * random.unit()};
      const std::vector<uint32_t> named = named_at(*env, p);
      EXPECT_EQ(named, named_at(*shared, p));
      EXPECT_LE(named.size(), 8u) << "boxes are rounded to the next two of 65,536 steps";
      const auto holds = [&](uint32_t cell) {
        const double* const low = env->point(env->map.cell(cell), 0);
        return p[0] >= low[0] && p[0] < low[0] + 1 && p[1] >= low[1] && p[1] < low[1] + 1 && p[2] >= low[2] &&
               p[2] < low[2] + 1;
      };
      EXPECT_EQ(std::count_if(named.begin(), named.end(), holds), 1);
    }
  }
}

/** Orders in which some eight neighbours lie side by side, and others don't. */
TEST(CellIndex, NamesEveryCellAlsoWhereNeighboursLieApart) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    Mesh3 mesh;
    add_boxes(mesh, 9, 3, 5);
    Mesh3 apart;
    add_boxes(apart, 7, 4, 2, 1e3, -5, 40, 0.25);
    shuffle_boxes(apart, seed);
    for (int64_t& v : apart.connectivity) v += static_cast<int64_t>(mesh.points.size() / 3);
    mesh.points.insert(mesh.points.end(), apart.points.begin(), apart.points.end());
    for (size_t i = 0; i < apart.types.size(); ++i) {
      mesh.cell(kHexahedron, {apart.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * i),
                              apart.connectivity.begin() + static_cast<std::ptrdiff_t>(8 * i + 8)});
    }
    const auto env = mesh.build();
    env->index.build(*env, kThreeThreads);
    expect_every_cell_named(*env);
    let_points_move(*env);
    for (double& x : mesh.points) x = 3 - 2 * x;
    env->points = mesh.points.data();
    env->note_move();
    expect_every_cell_named(*env);
  }
}

TEST(CellIndex, SortsAlongTheCurve) {
  for (const size_t count : {size_t{0}, size_t{1}, size_t{1000}, (size_t{1} << 18) + 777}) {
    std::mt19937_64 random(seed_of(7));
    Array<uint64_t> keys(count, 0, Allocator<uint64_t>(nullptr));
    const Curve<3> curve;
    for (size_t i = 0; i < count; ++i) {
      uint32_t place[3];
      for (uint32_t& x : place) x = static_cast<uint32_t>(random() % 64);
      keys[i] = curve.key(place, static_cast<uint32_t>(i));
    }
    Array<uint64_t> sorted = keys;
    std::sort(sorted.begin(), sorted.end());  // items grow with the place in the list
    sort_along_curve<3>(keys, kThreeThreads);
    EXPECT_TRUE(std::equal(keys.begin(), keys.end(), sorted.begin(), sorted.end())) << count;
  }
  // The curve goes from each place to one beside it, and to each once.
  std::vector<uint64_t> all;
  const Curve<2> curve;
  for (uint32_t x = 0; x < 64; ++x) {
    for (uint32_t y = 0; y < 64; ++y) {
      uint32_t place[2] = {64 * x, 64 * y};  // the corners of squares of 64 places
      all.push_back(curve.key(place, 64 * x + y));
    }
  }
  std::sort(all.begin(), all.end());
  for (size_t i = 1; i < all.size(); ++i) {
    const uint32_t a = Curve<2>::item(all[i - 1]), b = Curve<2>::item(all[i]);
    const int dx = static_cast<int>(b / 64) - static_cast<int>(a / 64);
    const int dy = static_cast<int>(b % 64) - static_cast<int>(a % 64);
    EXPECT_EQ(std::abs(dx) + std::abs(dy), 1) << i;
  }
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

TEST(CellIndex, IsMadeAtOnceForWhoAsksForManyPoints) {
  const double p[3] = {0.5, 0.5, 0.5};
  const auto has_tree = [&](const Environment<3>& env) { return env.index.visit(env, p, [](uint32_t) {}); };
  Mesh3 mesh;
  add_boxes(mesh, 4, 4, 4);
  int tasks = 0;
  const Parallel pool{&tasks,
                      [](void* user, dsw_task_fn task, void* data, size_t count) {
                        for (size_t i = 0; i < count; ++i, ++*static_cast<int*>(user)) task(data, i);
                      },
                      0};
  const auto many = mesh.build(), few = mesh.build(), without = mesh.build();
  many->index.prepare(*many, pool, 1000);
  EXPECT_TRUE(has_tree(*many));
  EXPECT_EQ(named_at(*many, p), std::vector<uint32_t>{0});
  many->index.prepare(*many, pool, 1000);
  few->index.prepare(*few, pool, 2);
  EXPECT_FALSE(has_tree(*few));
  without->index.set_use(TreeUse::kLeftOut);
  without->index.prepare(*without, pool, 1000);
  EXPECT_FALSE(has_tree(*without));
  EXPECT_EQ(tasks, 0) << "so few cells are not shared out";
  Mesh3 large;
  add_boxes(large, 30, 30, 30);
  const auto shared = large.build();
  shared->index.prepare(*shared, pool, 1000);
  EXPECT_GT(tasks, 1);
  EXPECT_EQ(named_at(*shared, p), std::vector<uint32_t>{0});
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
  env->index.prepare(*env, kThreeThreads, 1000);
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
