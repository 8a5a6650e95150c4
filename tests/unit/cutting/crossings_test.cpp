// What a blade meets, against every edge of it asked of every facet and every edge of the cells asked of it. Many
// blades lie on vertices, edges and facets, some are flat, and some are so small or large that no filter is used.
#include "cutting/crossings.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "environment/test_mesh.h"
#include "predicates/filtered.h"
#include "walk/cast.h"

namespace dsw::test {
namespace {

/** What one triangle does in one cell. */
struct Meeting {
  bool met = false, sides[3] = {};
};

/** Whether p q passes through a triangle, q on side `side_of_q` and p on the other. */
bool pierces(const double* p, const double* q, const double* const* triangle, int side_of_q) {
  for (int k = 0; k < 3; ++k) {
    const double* const ridge[2] = {triangle[k], triangle[(k + 1) % 3]};
    if (line_side<3>(p, q, ridge, NoTally{}).sign != side_of_q) return false;
  }
  return true;
}

class Truth {
 public:
  Truth(const Environment<3>& env, const Blade<3>& blade) : env_(env), blade_(blade) {}

  Meeting meet(Cell c, uint32_t simplex, std::set<uint64_t>& crossed) const {
    Meeting found;
    const BladeSimplex<3> blade = blade_.simplex(simplex);
    const double* at[3];
    blade_.corners(simplex, at);
    const Shape shape = env_.map.shape(c);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      const double* of_cell[3];
      simplex_points(env_, c, shape, s, of_cell);
      int of_blade[3];
      for (int k = 0; k < 3; ++k) of_blade[k] = plane_side<3>(of_cell, at[k], NoTally{}).sign;
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        found.met = found.met || passes(blade, of_cell[k], of_cell[next]);
        if (of_blade[k] == of_blade[next] || !pierces(at[k], at[next], of_cell, of_blade[next])) continue;
        found.met = found.sides[k] = true;
      }
    }
    for (int k = 0; k < 3; ++k) {
      if (contains(env_, c, at[k])) found.met = found.sides[k] = found.sides[(k + 2) % 3] = true;
    }
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      const uint32_t a = env_.map.vertex(c, shape.dart_vertex(d)),
                     b = env_.map.vertex(c, shape.dart_vertex(shape.beta1(d)));
      if (passes(blade, env_.point(a), env_.point(b))) crossed.insert(pair_key(a, b));
    }
    return found;
  }

 private:
  static bool passes(const BladeSimplex<3>& blade, const double* a, const double* b) {
    return blade.side(a) != blade.side(b) && blade.is_passed(a, b, blade.side(b));
  }

  const Environment<3>& env_;
  const Blade<3>& blade_;
};

/** A lattice, and blades in it. */
class Lattice {
 public:
  Lattice(double scale, bool jittered, uint64_t seed) : scale_(scale), random_(seed) {
    Mesh3 mesh;
    add_boxes(mesh, 3, 3, 3);
    for (double& x : mesh.points) x = scale * (x + (jittered ? 0.2 * random_.unit() : 0));
    env_ = mesh.build();
  }
  const Environment<3>& env() const { return *env_; }

  /** Four triangles round a point. */
  std::vector<double> points(bool coarse) {
    std::vector<double> points;
    for (int i = 0; i < 15; ++i) points.push_back(scale_ * (coarse ? random_.below(7) / 2.0 : 3.2 * random_.unit()));
    return points;
  }

 private:
  double scale_;
  Random random_;
  std::unique_ptr<Environment<3>> env_;
};

TEST(Crossings, AreThoseOfEveryEdgeAskedAlone) {
  const uint32_t corners[12] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  size_t meetings = 0, rims = 0, edges = 0;
  for (const double scale : {1.0, 0x1p-400, 0x1p+345}) {
    for (int round = 0; round < at_least(60); ++round) {
      Lattice lattice(scale, round % 2 == 1, static_cast<uint64_t>(round));
      const std::vector<double> points = lattice.points(round % 4 < 2);
      const auto blade = Blade<3>::of_simplices(nullptr, {points.data(), 3}, 5, corners, 4);
      const Truth truth(lattice.env(), blade);
      Crossings<3> crossings(lattice.env(), blade);
      std::set<uint64_t> crossed;
      std::set<std::pair<uint32_t, uint32_t>> met;
      for_each_cell(lattice.env().map, [&](Cell c) {
        bool holds_rim = false;
        for (uint32_t s = 0; s < 4; ++s) {
          const Meeting expected = truth.meet(c, s, crossed);
          ASSERT_EQ(crossings.seed(c, s), expected.met) << scale << ", " << round << ": " << c.unit << ", " << s;
          if (expected.met) met.insert({c.unit, s});
          for (int k = 0; k < 3; ++k) {
            holds_rim = holds_rim || (expected.sides[k] && blade.neighbour(s, k) == Blade<3>::kNone);
          }
        }
        rims += holds_rim ? 1u : 0u;
        crossings.run();
        const uint32_t number = crossings.number(c);
        ASSERT_EQ(number != KeyTable::kNone && crossings.cell(number).holds_rim, holds_rim) << round;
      });
      // A flood comes to nothing that is not met.
      size_t count = 0;
      for (uint32_t i = 0; i < crossings.cell_count(); ++i) {
        crossings.for_each_simplex(i, [&](uint32_t s) {
          ++count;
          EXPECT_EQ(met.count({crossings.cell(i).cell.unit, s}), 1u);
        });
      }
      EXPECT_EQ(count, met.size());
      ASSERT_EQ(crossings.count(), crossed.size());
      for (uint32_t i = 0; i < crossings.count(); ++i) {
        EXPECT_EQ(crossed.count(pair_key(crossings[i].a, crossings[i].b)), 1u);
      }
      meetings += met.size();
      edges += crossed.size();
    }
  }
  EXPECT_GT(meetings, 2000u);
  EXPECT_GT(rims, 500u);
  EXPECT_GT(edges, 1000u);
}

}  // namespace
}  // namespace dsw::test
