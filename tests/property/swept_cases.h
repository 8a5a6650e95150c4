// Environments below the public interface, what is impassable in them, and moves of body points.
#pragma once

#include "swept_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "../effort.h"
#include "base/error.h"
#include "environment/builder.h"
#include "environment/marking.h"
#include "sweep_scenes.h"

namespace dsw::swept {

using oracle::Rng;
using oracle::SceneKind;
using oracle::Vec;

/// Null where creation may refuse the mesh, and does.
inline std::unique_ptr<Environment<3>> environment_of(oracle::Mesh mesh) {
  mesh.loose.clear();  // the cells that conforming makes, as they are
  const oracle::DescArrays arrays(mesh, {});
  const dsw_environment_desc& desc = arrays.desc;
  auto env = std::make_unique<Environment<3>>(nullptr);
  BuildReport report;
  try {
    build(*env, check_description<3>(desc), report);
  } catch (const Error&) {
    EXPECT_TRUE(oracle::may_be_refused(mesh));
    return nullptr;
  }
  return env;
}

struct Shares {
  double cells, facets, edges, vertices;
};

template <int D>
void mark(Environment<D>& env, Rng& rng, const Shares& shares) {
  const Map<D>& map = env.map;
  reserve_vertex_marks(env);
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    if (rng.chance(shares.cells)) set_cell_mark(env, c, true);
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      if (rng.chance(shares.facets)) set_facet_mark(env, map.half_facet(c, f), true);
    }
    for (uint32_t d = 0; D == 3 && d < shape.dart_count(); ++d) {
      if (!rng.chance(shares.edges)) continue;
      reserve_edge_marks(env, 1);
      set_edge_mark(env, map.vertex(c, shape.dart_vertex(d)), map.vertex(c, shape.dart_vertex(shape.beta1(d))), true);
    }
  }
  std::vector<bool> is_used(map.vertex_count);  // a point that no cell has is no obstacle
  for_each_cell(map, [&](Cell c) {
    for (uint32_t i = 0; i < map.vertices_of(c); ++i) is_used[map.vertex(c, i)] = true;
  });
  for (uint32_t v = 0; v < map.vertex_count; ++v) {
    if (rng.chance(shares.vertices) && is_used[v]) set_vertex_mark(env, v, true);
  }
}

/// Body points: near each other, round an impassable vertex, on vertices, in planes of the environment.
class Bodies {
 public:
  Bodies(const Environment<3>& env, const SweptTruth& truth, Rng& rng)
      : env_(env), vertices_(truth.vertices.begin(), truth.vertices.end()), rng_(rng) {
    for (size_t k = 0; k < 3; ++k) size_[k] = env.upper[k] - env.lower[k];
  }

  /// p, p', q, r. Whether nothing lies exactly on something, but for scenes that are lattices themselves.
  bool draw(Vec (&x)[4]) {
    static const double steps[] = {0.02, 0.1, 0.3, 1};
    const double step = steps[rng_.below(4)];
    if (rng_.chance(0.6) && !vertices_.empty()) {  // a vertex with positive weights, about
      const double* v = env_.point(vertices_[rng_.below(vertices_.size())]);
      double w[4];
      for (double& each : w) each = rng_.range(0.1, 1);
      for (size_t k = 0; k < 3; ++k) {
        double rest = 0;
        for (size_t i = 0; i < 3; ++i) {
          const double off = rng_.range(-step, step) * size_[k];
          rest += w[i] * off;
          x[i][k] = v[k] + off;
        }
        x[3][k] = v[k] - rest / w[3];
      }
      std::swap(x[3], x[rng_.below(4)]);
    } else {
      for (Vec& each : x) {
        for (size_t k = 0; k < 3; ++k) each[k] = rng_.range(env_.lower[k], env_.upper[k]);
      }
      for (size_t i = 1; i < 4; ++i) {
        for (size_t k = 0; k < 3; ++k) x[i][k] = x[0][k] + rng_.range(-step, step) * size_[k];
      }
    }
    if (rng_.chance(0.5)) return true;
    round(x);
    // Parallel to edges of the environment, so that these are met all at once.
    if (rng_.chance(0.3)) along_axis(x[2], x[3]);
    if (rng_.chance(0.3)) std::copy_n(env_.point(rng_.below(env_.map.vertex_count)), 3, x[rng_.below(4)].data());
    return false;
  }

 private:
  void along_axis(const Vec& q, Vec& r) {
    const size_t axis = rng_.below(3);
    for (size_t k = 0; k < 3; ++k) r[k] = k == axis ? r[k] : q[k];
  }

  /// To a coarse lattice, so that much is exactly on something.
  void round(Vec (&x)[4]) {
    const int fine = rng_.between(2, 5);
    for (size_t k = 0; k < 3; ++k) {
      const double unit = std::ldexp(1, std::ilogb(size_[k]) - fine);
      for (Vec& each : x) each[k] = unit * std::round(each[k] / unit);
    }
  }

  const Environment<3>& env_;
  std::vector<uint32_t> vertices_;
  Rng& rng_;
  double size_[3];
};

/// An environment in which much is impassable.
struct Ground {
  Ground(const char* kind_name, uint64_t number, const Environment<3>& environment, Rng& random)
      : kind(kind_name), seed(number), env(environment), truth(environment), rng(random), bodies(env, truth, rng) {}

  /// Calls visit(points, generic) with so many draws of body points.
  template <class Visit>
  void draw(int count, const Visit& visit) {
    for (int i = 0; i < effort_of(count) && !testing::Test::HasFatalFailure(); ++i) {
      Vec x[4];
      const bool generic = bodies.draw(x);
      SCOPED_TRACE(kind + " " + std::to_string(seed) + " " + std::to_string(i));
      visit(x, generic);
    }
  }

  std::string kind;
  uint64_t seed;
  const Environment<3>& env;
  SweptTruth truth;
  Rng& rng;
  Bodies bodies;
};

/// Calls use(ground) for scenes of all kinds, each with all of these shares.
template <class Use>
void for_each_ground(const std::vector<Shares>& shares, const Use& use) {
  for (const SceneKind& kind : oracle::sweep_scenes()) {
    for (uint64_t seed = 1; seed <= shares.size(); ++seed) {
      Rng rng(seed);
      const auto env = environment_of(kind.make(rng));
      if (env == nullptr) continue;
      mark(*env, rng, shares[seed - 1]);
      Ground ground(kind.name, seed, *env, rng);
      use(ground);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace dsw::swept
