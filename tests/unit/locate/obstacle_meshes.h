#pragma once
// Meshes, marks and comparisons for questions about what is nearest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "../../effort.h"
#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "locate/nearest.h"

namespace dsw::test {

/** A lattice of cubes, each cut into six tetrahedra alike. */
inline void add_tetrahedra(Mesh3& mesh, int n) {
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

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/** At least four: how much is marked goes by that. */
inline uint64_t seeds(int count) { return static_cast<uint64_t>(std::max(4, effort_of(count))); }

/** Expects the same bits. */
template <int D>
void expect_same_nearest(const Environment<D>& env, const NearestResult& a, const NearestResult& b) {
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

}  // namespace dsw::test
