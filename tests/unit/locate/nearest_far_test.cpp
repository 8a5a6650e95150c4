// The tree of obstacles and the flood find the same bits, whatever is marked, moved or changed, and the tree is kept
// right. Changes of the topology are looked at in tests/property/edits_check.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "environment/moving.h"
#include "environment/test_mesh.h"
#include "locate/locate.h"
#include "locate/nearest_search.h"

namespace {

using namespace dsw;
using namespace dsw::test;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct Tally {
  int found = 0, unknown = 0, nothing = 0;
};

template <int D>
void expect_same(const Environment<D>& env, const NearestResult& a, const NearestResult& b) {
  ASSERT_EQ(std::memcmp(&a.distance, &b.distance, sizeof a.distance), 0) << a.distance << " " << b.distance;
  ASSERT_EQ(std::memcmp(a.point, b.point, sizeof a.point), 0);
  ASSERT_EQ(std::memcmp(a.normal, b.normal, sizeof a.normal), 0);
  ASSERT_EQ(a.feature.dimension, b.feature.dimension);
  ASSERT_EQ(a.feature.cell.valid(), b.feature.cell.valid());
  if (!a.feature.cell.valid()) return;
  if (a.feature.dimension == 0) {
    ASSERT_EQ(env.map.vertex(a.feature.cell, a.feature.local), env.map.vertex(b.feature.cell, b.feature.local));
  } else {
    ASSERT_EQ(a.feature.cell, b.feature.cell);
    ASSERT_EQ(a.feature.local, b.feature.local);
  }
}

/** The search by the tree alone, and what a host gets, against the flood. */
template <int D>
void expect_agreement(const Environment<D>& env, const double* point, double radius, Tally& tally) {
  const Cell start = locate(env, point, Cell{}, nullptr).cell;
  if (!start.valid() || is_closed(env, start)) return;
  NearestResult flooded, searched, either;
  const bool found = find_nearest(env, point, start, radius, flooded);
  ASSERT_EQ(find_nearest_far(env, point, start, radius, either), found);
  ASSERT_NO_FATAL_FAILURE(expect_same(env, flooded, either));
  const CellTree<D>* const tree = env.obstacles.find(env);
  ASSERT_NE(tree, nullptr);
  const Distances<D> distances(env, point);
  const SearchEnd end = NearestSearch<D>(distances, *tree, point, start, radius).run(searched);
  ++(end == SearchEnd::kFound ? tally.found : end == SearchEnd::kNothing ? tally.nothing : tally.unknown);
  if (end == SearchEnd::kUnknown) return;
  ASSERT_EQ(end == SearchEnd::kFound, found);
  if (found) expect_same(env, flooded, searched);
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

/** A lattice of cubes, each cut into six tetrahedra alike. */
void add_tetrahedra(Mesh3& mesh, int n) {
  for (int z = 0; z <= n; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) mesh.point({x * 1.0, y * 1.0, z * 1.0});
    }
  }
  const int64_t step[3] = {1, n + 1, int64_t{n + 1} * (n + 1)};
  const int ways[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  for (int i = 0; i < n * n * n; ++i) {
    const int64_t a = i % n + step[1] * (i / n % n) + step[2] * (i / n / n);
    for (int w = 0; w < 6; ++w) {
      const int64_t b = a + step[ways[w][0]], c = b + step[ways[w][1]], d = c + step[ways[w][2]];
      if (w < 3) {
        mesh.cell(kTetra, {a, b, c, d});
      } else {
        mesh.cell(kTetra, {a, c, b, d});
      }
    }
  }
}

template <class Mesh>
void shake(Mesh& mesh, double by, Random& random) {
  for (double& x : mesh.points) x += by * (random.unit() - 0.5);
}

/** Makes a few cells, facets, edges and vertices impassable, or passable again. */
template <int D>
void mark_some(Environment<D>& env, Random& random, int count, bool marked) {
  const auto some = [&] {
    return env.map.cell(static_cast<uint32_t>(random.below(static_cast<int>(env.map.cell_count))));
  };
  reserve_edge_marks(env, static_cast<size_t>(count));
  reserve_vertex_marks(env);
  for (int i = 0; i < count; ++i) {
    const Cell c = some();
    const Shape shape = env.map.shape(c);
    const auto f = static_cast<uint32_t>(random.below(static_cast<int>(shape.facet_count())));
    const uint32_t v = env.map.vertex(c, static_cast<uint32_t>(random.below(static_cast<int>(shape.vertex_count()))));
    switch (random.below(4)) {
      case 0:
        set_cell_mark(env, c, marked);
        break;
      case 1:
        set_facet_mark(env, env.map.half_facet(c, f), marked);
        break;
      case 2:
        if constexpr (D == 3) {
          const uint32_t d = shape.facet_first(f);
          set_edge_mark(env, env.map.vertex(c, shape.dart_vertex(d)),
                        env.map.vertex(c, shape.dart_vertex(shape.beta1(d))), marked);
        }
        break;
      default:
        set_vertex_mark(env, v, marked);
    }
  }
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
    ASSERT_NO_FATAL_FAILURE(expect_agreement(env, p, radius, tally)) << "point " << i;
  }
}

template <int D, class Mesh>
void agrees(Mesh& mesh, uint64_t seed, int marks, Tally& tally) {
  Random random(seed);
  const auto env = mesh.build();
  mark_some(*env, random, marks, true);
  env->obstacles.build(*env);
  for (int round = 0; round < 8; ++round) {
    ASSERT_NO_FATAL_FAILURE(ask_everywhere(*env, random, 60, tally)) << "seed " << seed << " round " << round;
    mark_some(*env, random, 1 + marks / 4, round % 2 == 0);
    ASSERT_NO_FATAL_FAILURE(expect_every_obstacle_known(*env)) << "seed " << seed << " round " << round;
  }
}

void expect_few_unknown(const Tally& tally) {
  EXPECT_GT(tally.found, 1000);
  EXPECT_LT(tally.unknown, (tally.found + tally.nothing) / 50) << "found " << tally.found;
  std::printf("found %d nothing %d unknown %d\n", tally.found, tally.nothing, tally.unknown);
}

TEST(NearestFar, InTetrahedra) {
  Tally tally;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
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
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    Mesh3 mesh;
    add_boxes(mesh, 9, 8, 7, -3, 0, 0, seed % 2 == 0 ? 0.5 : 0.3);
    ASSERT_NO_FATAL_FAILURE(agrees<3>(mesh, seed, static_cast<int>(seed % 4) * 20, tally));
  }
  expect_few_unknown(tally);
}

TEST(NearestFar, InMixedCells) {
  Tally tally;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Mesh3 mesh = mixed_mesh();
    ASSERT_NO_FATAL_FAILURE(agrees<3>(mesh, seed, static_cast<int>(seed % 4), tally));
  }
  expect_few_unknown(tally);
}

TEST(NearestFar, InThePlane) {
  Tally tally;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    Mesh2 mesh;
    Random random(seed);
    add_squares(mesh, 14, 12, seed % 2 == 0);
    if (seed % 3 != 0) shake(mesh, 0.2, random);
    ASSERT_NO_FATAL_FAILURE(agrees<2>(mesh, seed, static_cast<int>(seed % 4) * 12, tally));
  }
  expect_few_unknown(tally);
}

}  // namespace
