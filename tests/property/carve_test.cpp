// Shapes carved out of environments of every kind: what is inside, in exact integers, and nothing else.
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/vec.h"
#include "environment/validity.h"
#include "map/integrity.h"
#include "random_edits.h"
#include "random_shapes.h"
#include "walk/cast.h"

namespace dsw::oracle {
namespace {

/// How often a surface turns round a point: crossings of a ray in a generic direction. The infinitesimal shift of the
/// surface is a number, too small to matter but where a sign is 0 without it.
class Turns {
 public:
  Turns(const ClosedSurface& surface, Rng& rng) : surface_(surface), rng_(rng) {
    for (size_t i = 0; i < surface.points.size(); ++i) {
      points_.push_back(to_big(surface.points[i], kScale));
      points_.back() += Big(1) << static_cast<unsigned>(kScale - kShift * (1 + static_cast<int>(i % 3)));
      reach_ = std::max(reach_, std::fabs(surface.points[i]));
    }
  }

  int round(const double* p) {
    for (;;) {
      int sum = 0;
      if (try_ray(p, sum)) return sum;
    }
  }

  /// Whether the surface meets a cell: an edge of one passes through a triangle of the other, or all of it is inside.
  bool meets(const Environment<3>& env, dsw::Cell c) const {
    const auto shape = env.map.shape(c);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      const double* at[3];
      Point of_cell[3];
      simplex_points(env, c, shape, s, at);
      for (size_t k = 0; k < 3; ++k) of_cell[k] = big(at[k]);
      for (size_t t = 0; t < surface_.triangles.size(); t += 3) {
        if (are_apart(at, &surface_.triangles[t])) continue;
        const Point of_surface[3] = {shifted(surface_.triangles[t]), shifted(surface_.triangles[t + 1]),
                                     shifted(surface_.triangles[t + 2])};
        if (passes(of_cell, of_surface) || passes(of_surface, of_cell)) return true;
      }
    }
    return contains(env, c, surface_.points.data());
  }

 private:
  static constexpr int kShift = 300, kScale = 1000;
  using Point = std::array<Big, 3>;

  static int side(const Point& a, const Point& b, const Point& c, const Point& d) {
    Point u, v, w;
    for (size_t k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k];
      v[k] = c[k] - a[k];
      w[k] = d[k] - a[k];
    }
    return sgn(Big(w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                   w[2] * (u[0] * v[1] - u[1] * v[0])));
  }

  /// Whether an edge of one triangle passes through another one.
  static bool passes(const Point* edges, const Point* triangle) {
    for (size_t k = 0; k < 3; ++k) {
      const Point &p = edges[k], &q = edges[(k + 1) % 3];
      if (side(triangle[0], triangle[1], triangle[2], p) * side(triangle[0], triangle[1], triangle[2], q) >= 0)
        continue;
      const int first = side(p, q, triangle[0], triangle[1]);
      if (first != 0 && first == side(p, q, triangle[1], triangle[2]) && first == side(p, q, triangle[2], triangle[0]))
        return true;
    }
    return false;
  }
  bool are_apart(const double* const* at, const uint32_t* corners) const {
    for (size_t k = 0; k < 3; ++k) {
      const double* const p = surface_.points.data() + k;
      const double x[3] = {p[3 * corners[0]], p[3 * corners[1]], p[3 * corners[2]]};
      const double slack = 1e-9 * reach_;
      if (std::max({x[0], x[1], x[2]}) < std::min({at[0][k], at[1][k], at[2][k]}) - slack) return true;
      if (std::min({x[0], x[1], x[2]}) > std::max({at[0][k], at[1][k], at[2][k]}) + slack) return true;
    }
    return false;
  }

  /// Nearly along an axis, so that most triangles are seen to be out of the way. False: something is in line.
  bool try_ray(const double* p, int& sum) {
    const double reach = 4 * (reach_ + std::fabs(p[0]) + std::fabs(p[1]) + std::fabs(p[2]));
    const double q[3] = {p[0] + reach, p[1] + rng_.range(-1, 1) * 1e-7 * reach,
                         p[2] + rng_.range(-1, 1) * 1e-7 * reach};
    const Point from = big(p), to = big(q);
    for (size_t t = 0; t < surface_.triangles.size(); t += 3) {
      const uint32_t* const c = &surface_.triangles[t];
      bool apart = false;
      for (uint32_t k = 0; k < 3; ++k) {
        const double x[3] = {surface_.points[3 * c[0] + k], surface_.points[3 * c[1] + k],
                             surface_.points[3 * c[2] + k]};
        const double slack = 1e-6 * reach;
        apart = apart || std::max({x[0], x[1], x[2]}) < std::min(p[k], q[k]) - slack ||
                std::min({x[0], x[1], x[2]}) > std::max(p[k], q[k]) + slack;
      }
      if (apart) continue;
      const Point corner[3] = {shifted(c[0]), shifted(c[1]), shifted(c[2])};
      const int before = side(corner[0], corner[1], corner[2], from), after = side(corner[0], corner[1], corner[2], to);
      if (before == 0 && after == 0) continue;  // a flat triangle
      if (before == 0 || after == 0) return false;
      if (before == after) continue;
      int signs = 0;
      for (size_t k = 0; k < 3; ++k) {
        const int sign = side(from, to, corner[k], corner[(k + 1) % 3]);
        if (sign == 0) return false;
        signs += sign;
      }
      if (signs == 3 || signs == -3) sum += after;
    }
    return true;
  }
  static Point big(const double* p) { return {to_big(p[0], kScale), to_big(p[1], kScale), to_big(p[2], kScale)}; }
  Point shifted(uint32_t i) const { return {points_[3 * i], points_[3 * i + 1], points_[3 * i + 2]}; }

  const ClosedSurface& surface_;
  Rng& rng_;
  std::vector<Big> points_;
  double reach_ = 0;
};

dsw_carve_desc carve_along(const ClosedSurface& surface) {
  dsw_carve_desc desc = defaults(dsw_carve_desc_init);
  desc.points = surface.points.data();
  desc.point_count = surface.points.size() / 3;
  desc.triangles = surface.triangles.data();
  desc.triangle_count = surface.triangles.size() / 3;
  return desc;
}

class CarveTest : public SceneTest {
 protected:
  const Environment<3>& env() const { return dsw::capi::space(*place_.get()); }

  void mark_most(Rng& rng) {
    for_each_cell(env().map, [&](dsw::Cell c) {
      if (rng.chance(0.2)) return;
      const dsw_volume_id id = volume_id(env().map, c);
      dsw_environment_mark_volumes(place_.get(), &id, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    });
  }
  std::map<uint32_t, bool> marks() const {
    std::map<uint32_t, bool> marks;
    for_each_cell(env().map, [&](dsw::Cell c) { marks[env().map.index(c)] = env().map.marked(c); });
    return marks;
  }
  /// What volumes that changed come from.
  std::map<uint32_t, uint32_t> origins() const {
    const dsw_volume_change* changes = change_of(place_.get()).volumes;
    const size_t count = change_of(place_.get()).volume_count;
    std::map<uint32_t, uint32_t> origins;
    for (size_t i = 0; i < count; ++i) origins[changes[i].after.index] = changes[i].before.index;
    return origins;
  }
  std::set<uint32_t> carved(size_t wanted) const {
    const dsw_volume_id* ids = change_of(place_.get()).carved;
    const size_t count = change_of(place_.get()).carved_count;
    EXPECT_EQ(count, wanted);
    std::set<uint32_t> carved;
    for (size_t i = 0; i < count; ++i) {
      EXPECT_TRUE(env().map.is_alive(ids[i].index, ids[i].generation));
      EXPECT_TRUE(carved.insert(ids[i].index).second);
    }
    return carved;
  }

  /// The volume of all cells, and the area of the outer boundary.
  std::array<double, 2> sizes() const {
    std::array<double, 2> sum{};
    for_each_cell(env().map, [&](dsw::Cell c) {
      const auto shape = env().map.shape(c);
      double at[3];
      centre(env(), c, at);
      for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
        const double* corners[3];
        simplex_points(env(), c, shape, s, corners);
        const dsw::Vec a = difference<3>(corners[0], at), b = difference<3>(corners[1], at),
                       d = difference<3>(corners[2], at);
        sum[0] += dot(a, b.cross(d)) / 6;
        if (env().map.opposite(env().map.half_facet(c, shape.simplex_facets(3)[s])).valid()) continue;
        sum[1] += length((b - a).cross(d - a)) / 2;
      }
    });
    return sum;
  }
  double diameter(dsw::Cell c) const {
    double most = 0;
    for (uint32_t i = 0; i < env().map.vertices_of(c); ++i) {
      for (uint32_t k = 0; k < i; ++k) {
        most = std::max(
            most, length(difference<3>(env().point(env().map.vertex(c, i)), env().point(env().map.vertex(c, k)))));
      }
    }
    return most;
  }

  std::set<uint32_t> met_by(const ClosedSurface& surface, Rng& rng) const {
    const Turns turns(surface, rng);
    std::set<uint32_t> met;
    for_each_cell(env().map, [&](dsw::Cell c) {
      if (turns.meets(env(), c)) met.insert(env().map.index(c));
    });
    return met;
  }

  Place place_;
};
DSW_FOR_ALL_SCENES(CarveTest);

TEST_P(CarveTest, CellsAreHalvedUntilTheyAreShort) {
  size_t carved_volumes = 0, covered = 0, split = 0, left = 0;
  // Faces of the outer boundary that are warped can be cut into other triangles.
  const double may_change = std::string(GetParam()).find("warped") == std::string::npos ? 1e-9 : 0.1;
  for (uint64_t seed = 1; seed <= seeds_of(3); ++seed) {
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    Rng rng(seed ^ 0xf17e57);
    mark_most(rng);
    for (int round = 0; round < 2; ++round) {
      const ClosedSurface surface = some_surface(env(), place_.world->size, rng);
      dsw_carve_desc desc = carve_along(surface);
      const bool covers = rng.chance(0.5), is_whole = covers && rng.chance(0.2);
      desc.flags = covers ? uint32_t{DSW_CARVE_COVER} : 0;
      desc.finest = is_whole ? 0 : place_.world->size * rng.range(0.06, 0.2);
      const dsw::Cell any = env().map.cell(rng.below(env().map.index_count()));
      if (any.valid() && rng.chance(0.3)) desc.start = volume_id(env().map, any);
      const auto before = marks();
      const auto sizes_before = sizes();
      const std::set<uint32_t> was_met = met_by(surface, rng);
      dsw_change report = empty_change();
      ASSERT_EQ(dsw_environment_carve(place_.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
      ASSERT_EQ(check_integrity(env().map), nullptr);
      for (size_t k = 0; k < 2; ++k) EXPECT_NEAR(sizes()[k], sizes_before[k], may_change * sizes_before[k]) << seed;
      const auto origin = origins();
      const std::set<uint32_t> is_carved = carved(report.carved_count);
      Turns turns(surface, rng);
      for_each_cell(env().map, [&](dsw::Cell c) {
        EXPECT_TRUE(check_cell(env(), c) == CellState::kValid || check_cell(env(), c) == CellState::kValidConvex);
        double at[3];
        centre(env(), c, at);
        const uint32_t index = env().map.index(c);
        const bool was_marked = before.at(origin.count(index) != 0 ? origin.at(index) : index);
        const bool is_new = is_carved.count(index) != 0, is_met = turns.meets(env(), c);
        EXPECT_EQ(env().map.marked(c), was_marked && !is_new);
        EXPECT_LE(is_new, was_marked && (turns.round(at) != 0 || (covers && is_met))) << "seed " << seed;
        left += was_marked && !is_new ? 1u : 0u;
        covered += is_new && is_met ? 1u : 0u;
        if (desc.start.generation != 0) return;
        EXPECT_EQ(is_new, was_marked && (turns.round(at) != 0 || (covers && is_met)))
            << "seed " << seed << ", round " << round << ", volume " << index;
        // A face that gets vertices can move by their rounding, or if it is warped, so that a cell behind it is met.
        const bool met_before = was_met.count(origin.count(index) != 0 ? origin.at(index) : index) != 0;
        if (!was_marked || !is_met || !met_before || is_whole || report.whole_count != 0) return;
        EXPECT_LE(diameter(c), 1.7321 * desc.finest) << "seed " << seed << ", round " << round << ", volume " << index;
      });
      carved_volumes += is_carved.size();
      split += report.volumes_split;
      if (HasFailure()) return;
    }
  }
  RecordProperty("carved", static_cast<int>(carved_volumes));
  if (kind_named(GetParam()).integer) {
    EXPECT_GT(carved_volumes, 0u);
    EXPECT_GT(covered, 0u);
    EXPECT_GT(split, 0u);
    EXPECT_GT(left, 0u);
  }
}

TEST_P(CarveTest, WhatIsInsideIsCarvedAndNothingElse) {
  size_t carved_volumes = 0, split = 0, kept = 0;
  for (uint64_t seed = 1; seed <= seeds_of(6); ++seed) {
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    Rng rng(seed ^ 0xca47e);
    mark_most(rng);
    for (int round = 0; round < 3; ++round) {
      const ClosedSurface surface = some_surface(env(), place_.world->size, rng);
      dsw_carve_desc desc = carve_along(surface);
      desc.flags = rng.chance(0.3) ? uint32_t{DSW_CARVE_WHOLE} : 0;
      const dsw::Cell any = env().map.cell(rng.below(env().map.index_count()));
      if (any.valid() && rng.chance(0.5)) desc.start = volume_id(env().map, any);
      const auto before = marks();
      dsw_change report = empty_change();
      ASSERT_EQ(dsw_environment_carve(place_.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
      const auto origin = origins();
      const std::set<uint32_t> is_carved = carved(report.carved_count);
      Turns turns(surface, rng);
      std::map<uint32_t, bool> is_inside;
      ASSERT_EQ(check_integrity(env().map), nullptr);
      for_each_cell(env().map, [&](dsw::Cell c) {
        EXPECT_TRUE(check_cell(env(), c) == CellState::kValid || check_cell(env(), c) == CellState::kValidConvex);
        double at[3];
        centre(env(), c, at);
        const uint32_t index = env().map.index(c);
        const bool inside = is_inside[index] = turns.round(at) != 0;
        const bool was_marked = before.at(origin.count(index) != 0 ? origin.at(index) : index);
        const bool is_new = is_carved.count(index) != 0;
        EXPECT_TRUE(!is_new || (was_marked && inside))
            << "seed " << seed << ", round " << round << ", volume " << index;
        EXPECT_EQ(env().map.marked(c), was_marked && !is_new);
        kept += was_marked && !inside ? 1u : 0u;
        if (desc.start.generation != 0) return;
        EXPECT_EQ(is_new, was_marked && inside) << "seed " << seed << ", round " << round << ", volume " << index;
      });
      // Carving from one place on stops nowhere inside.
      for_each_cell(env().map, [&](dsw::Cell c) {
        if (is_carved.count(env().map.index(c)) == 0) return;
        for (uint32_t f = 0; f < env().map.facets_of(c); ++f) {
          const HalfFacet o = env().map.opposite(env().map.half_facet(c, f));
          if (!o.valid() || !is_inside[env().map.index(env().map.cell_of(o))]) continue;
          EXPECT_FALSE(env().map.marked(env().map.cell_of(o))) << "seed " << seed << ", round " << round;
        }
      });
      carved_volumes += is_carved.size();
      split += report.volumes_split;
      if (HasFailure()) return;
    }
  }
  RecordProperty("carved", static_cast<int>(carved_volumes));
  RecordProperty("split", static_cast<int>(split));
  if (kind_named(GetParam()).integer) {  // others can be few and flat
    EXPECT_GT(carved_volumes, 0u);
    EXPECT_GT(split, 0u);
    EXPECT_GT(kept, 0u);
  }
}

}  // namespace
}  // namespace dsw::oracle
