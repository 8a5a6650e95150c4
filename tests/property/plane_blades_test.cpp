// What a path in the plane crosses, what closed lines hold, and what a line ties, against brute force in exact integers.
#include "plane_cuts.h"

#include "cutting/inside.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dsw::oracle {
namespace {

using Path = std::vector<plane::Vec>;
struct Place2 {
  Big x, y;
};

int first_sign(const Big& a, const Big& b, const Big& c) { return a != 0 ? sgn(a) : b != 0 ? sgn(b) : sgn(c); }

/// Segments of a path, shifted by (e, e^2), among the vertices of a world.
class Truth {
 public:
  Truth(const plane::World& world, const Path& path) {
    for (const plane::Vec& p : world.points) see(p);
    for (const plane::Vec& p : path) see(p);
    for (const plane::Vec& p : world.points) vertices_.push_back(to(p));
    for (const plane::Vec& p : path) path_.push_back(to(p));
  }
  Place2 to(const plane::Vec& p) const { return {to_big(p[0], -lowest_), to_big(p[1], -lowest_)}; }

  /// Whether segment k crosses the side from vertex a to b.
  bool crosses(size_t k, int a, int b) const {
    const Place2 &p = path_[k], &q = path_[k + 1];
    if (p.x == q.x && p.y == q.y) return false;
    return left(k, a) != left(k, b) && right_of(at(a), at(b), p) != right_of(at(a), at(b), q);
  }
  /// 1: the vertex is behind segment k, on its left.
  int left(size_t k, int vertex) const {
    const Place2 &p = path_[k], &q = path_[k + 1];
    return first_sign(height(k, vertex), q.y - p.y, p.x - q.x);
  }
  /// The largest double not above the share of the way from a to b at which segment k, not shifted, crosses it.
  double share(size_t k, int a, int b) const {
    const Big from = height(k, a), all = from - height(k, b);
    return from <= 0 || all <= 0 ? 0 : from >= all ? 1 : floor_to_double(from, all);
  }
  /// How often closed lines turn round a point; each of `ends` is that of a segment in the path.
  int turns(const plane::Vec& point, const std::vector<uint32_t>& ends) const {
    const Place2 c = to(point);
    int sum = 0;
    for (size_t i = 0; i < ends.size(); i += 2) {
      const Place2 &p = path_[ends[i]], &q = path_[ends[i + 1]];
      const bool p_above = p.y >= c.y, q_above = q.y >= c.y;  // the shift lifts what is as high
      if (p_above == q_above) continue;
      const Big ux = q.x - p.x, uy = q.y - p.y;
      const Big beside = ux * (c.y - p.y) - uy * (c.x - p.x);  // of the point on the left
      const int side = first_sign(beside, uy, -ux);
      if (q_above && side > 0) ++sum;
      if (p_above && side < 0) --sum;
    }
    return sum;
  }

 private:
  void see(const plane::Vec& p) { lowest_ = std::min({lowest_, lowest_exponent(p[0]), lowest_exponent(p[1])}); }
  const Place2& at(int vertex) const { return vertices_[static_cast<size_t>(vertex)]; }
  Big height(size_t k, int vertex) const {
    const Place2 &p = path_[k], &q = path_[k + 1], &v = at(vertex);
    return (q.x - p.x) * (v.y - p.y) - (q.y - p.y) * (v.x - p.x);
  }
  static int right_of(const Place2& a, const Place2& b, const Place2& x) {
    const Big dx = b.x - a.x, dy = b.y - a.y;
    return first_sign(dy * (x.x - a.x) - dx * (x.y - a.y), dy, -dx);
  }

  int lowest_ = 0;
  std::vector<Place2> vertices_, path_;
};

class BladeTest : public testing::Test {
 protected:
  /// Calls use() with each kind of world in each size, that of the environment.
  template <class Use>
  void for_each_world(int rounds, const Use& use) {
    uint64_t seed = 0;
    for (int round = 0; round < rounds; ++round) {
      for (const plane::Turn& turn : plane::turns("")) {
        rng_ = Rng(++seed);
        world_ = plane::make_world(turn, rng_);
        environment_ = plane::make_environment(turn, world_, rng_);
        if (environment_ == nullptr) continue;
        SCOPED_TRACE(turn.name() + ", seed " + std::to_string(seed));
        use();
        if (HasFailure()) return;
      }
    }
  }
  const Environment<2>& env() const { return std::get<Environment<2>>(environment_->engine); }

  /// In cells, on sides, at vertices.
  plane::Vec some_point() {
    const std::vector<int>& cell = world_.cells[rng_.below(world_.cells.size())];
    const auto vertex = [&] { return world_.points[static_cast<size_t>(cell[rng_.below(cell.size())])]; };
    const plane::Vec p = vertex(), q = vertex(), r = vertex();
    if (rng_.chance(0.2)) return p;
    if (rng_.chance(0.2)) return mix(p, q, 0.5);
    return mix(mix(p, q, rng_.unit()), r, rng_.unit());
  }

  Rng rng_{0};
  plane::World world_;
  EnvironmentPtr environment_;
};

TEST_F(BladeTest, APathMeetsWhatItsSegmentsMeet) {
  size_t crossed = 0, twice = 0, ties = 0;
  for_each_world(4, [&] {
    Path path{some_point()};
    std::set<int> cells;
    const int first = plane::locate(world_, path[0]);
    if (first < 0) return;
    cells.insert(first);
    for (int tries = 0; tries < 12; ++tries) {
      const plane::Vec next = rng_.chance(0.1) ? path.back() : some_point();
      const plane::Flight flight = plane::cast(world_, plane::locate(world_, path.back()), path.back(), next);
      if (flight.outcome != plane::Flight::kReached) continue;
      ties += flight.tie ? 1u : 0u;
      cells.insert(flight.cells.begin(), flight.cells.end());
      path.push_back(next);
    }
    if (path.size() < 2) return;
    const auto blade = Blade<2>::of_grid(nullptr, {path[0].data(), 2}, static_cast<uint32_t>(path.size()), 1);
    Crossings<2> crossings(env(), blade);
    crossings.flood(env().map.cell(static_cast<uint32_t>(first)));
    std::set<int> met;
    for (uint32_t i = 0; i < crossings.cell_count(); ++i) {
      const auto cell = static_cast<int>(env().map.index(crossings.cell(i).cell));
      met.insert(cell);
      const bool has_end = cell == first || cell == plane::locate(world_, path.back());
      EXPECT_EQ(crossings.cell(i).holds_rim, has_end) << cell;
      EXPECT_TRUE(crossings.is_met(crossings.cell(i).cell));
    }
    EXPECT_EQ(met, cells);
    const Truth truth(world_, path);
    size_t count = 0;
    for (const plane::Side& side : world_.sides) {
      std::vector<size_t> by;
      for (size_t k = 0; k + 1 < path.size(); ++k) {
        if (truth.crosses(k, side.a, side.b)) by.push_back(k);
      }
      const uint32_t i = crossings.find(static_cast<uint32_t>(side.a), static_cast<uint32_t>(side.b));
      ASSERT_EQ(i != KeyTable::kNone, !by.empty()) << side.a << " " << side.b;
      if (by.empty()) continue;
      ++count;
      EXPECT_EQ(crossings[i].once, by.size() == 1);
      twice += by.size() == 1 ? 0u : 1u;
      if (by.size() != 1) continue;
      const Crossing& at = crossings[i];
      EXPECT_EQ(at.simplex, by[0]);
      EXPECT_EQ(truth.left(by[0], static_cast<int>(at.a)), 1);
      EXPECT_EQ(truth.left(by[0], static_cast<int>(at.b)), -1);
      EXPECT_EQ(at.share, truth.share(by[0], static_cast<int>(at.a), static_cast<int>(at.b)));
    }
    EXPECT_EQ(count, crossings.count());
    crossed += count;
  });
  RecordProperty("crossed", static_cast<int>(crossed));
  RecordProperty("twice", static_cast<int>(twice));
  RecordProperty("ties", static_cast<int>(ties));
  EXPECT_GT(crossed, 2000u);
  EXPECT_GT(twice, 300u);
}

TEST_F(BladeTest, WhatClosedLinesHold) {
  size_t inside = 0, carved_cells = 0;
  for_each_world(3, [&] {
    Path points;
    std::vector<uint32_t> ends;
    for (uint32_t loops = 1 + rng_.below(3u); loops > 0; --loops) {
      const auto first = static_cast<uint32_t>(points.size()), count = 2 + rng_.below(6u);
      for (uint32_t i = 0; i < count; ++i) {
        points.push_back(some_point());
        ends.insert(ends.end(), {first + i, first + (i + 1) % count});
      }
    }
    const auto point_count = static_cast<uint32_t>(points.size());
    const auto blade = Blade<2>::of_simplices(nullptr, {points[0].data(), 2}, point_count, ends.data(),
                                              static_cast<uint32_t>(ends.size() / 2));
    ASSERT_EQ(blade.find_rim(), Blade<2>::kNone);
    Path all = points;
    std::vector<plane::Vec> centres(world_.cells.size());
    for (uint32_t i = 0; i < centres.size(); ++i) centre(env(), env().map.cell(i), centres[i].data());
    all.insert(all.end(), centres.begin(), centres.end());  // so that they are integers, too
    const Truth truth(world_, all);
    Crossings<2> crossings(env(), blade);
    Inside<2> shape(env(), blade, crossings);
    shape.flood_all();
    std::set<uint32_t> known;
    for (uint32_t i = 0; i < shape.cell_count(); ++i) {
      const uint32_t cell = env().map.index(shape.cell(i));
      known.insert(cell);
      ASSERT_EQ(shape.is_inside(i), truth.turns(centres[cell], ends) != 0) << cell;
    }
    for (uint32_t i = 0; i < centres.size(); ++i) {
      inside += truth.turns(centres[i], ends) != 0 ? 1u : 0u;
      EXPECT_TRUE(known.count(i) != 0 || truth.turns(centres[i], ends) == 0);
      EXPECT_EQ(shape.holds(env().map.cell(i), centres[i].data()), truth.turns(centres[i], ends) != 0);
    }
    // The same of what was carved: exactly what is inside then is passable.
    std::vector<dsw_volume_id> volumes;
    for (uint32_t i = 0; i < centres.size(); ++i) {
      if (rng_.chance(0.8)) volumes.push_back({i, 1});
    }
    ASSERT_EQ(dsw_environment_mark_volumes(environment_.get(), volumes.data(), volumes.size(), DSW_MARK_IMPASSABLE, 0,
                                           nullptr),
              DSW_STATUS_OK);
    dsw_carve_desc desc;
    dsw_carve_desc_init(&desc, sizeof desc);
    desc.points = points[0].data();
    desc.point_count = points.size();
    desc.triangles = ends.data();
    desc.triangle_count = ends.size() / 2;
    dsw_carve_report report;
    ASSERT_EQ(dsw_environment_carve(environment_.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
    const dsw_volume_id* carved = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_environment_get_carved_volumes(environment_.get(), &carved, &count), DSW_STATUS_OK);
    ASSERT_EQ(count, report.volumes_carved);
    std::set<uint32_t> was_carved;
    for (size_t i = 0; i < count; ++i) was_carved.insert(carved[i].index);
    carved_cells += count;
    for_each_cell(env().map, [&](dsw::Cell c) {
      plane::Vec at;
      centre(env(), c, at.data());
      all = points;
      all.push_back(at);
      const bool holds = Truth(world_, all).turns(at, ends) != 0;
      EXPECT_FALSE(env().map.marked(c) && holds);
      EXPECT_TRUE(was_carved.count(env().map.index(c)) == 0 || (holds && !env().map.marked(c)));
    });
  });
  RecordProperty("inside", static_cast<int>(inside));
  RecordProperty("carved", static_cast<int>(carved_cells));
  EXPECT_GT(inside, 1000u);
  EXPECT_GT(carved_cells, 500u);
}

/// A way that begins and ends in cells that the line did not meet, and crosses it once, is stopped.
TEST_F(BladeTest, NothingGetsPastATie) {
  size_t flights = 0, free_before = 0;
  for_each_world(3, [&] {
    Path path{some_point(), some_point()};
    if (rng_.chance(0.5)) path.push_back(some_point());
    if (rng_.chance(0.7)) {
      path[0] = mix(path[1], path[0], 4);
      path.back() = mix(path[path.size() - 2], path.back(), 4);
    }
    for (const plane::Vec& p : path) {
      if (!std::isfinite(p[0]) || !std::isfinite(p[1])) return;
    }
    const auto blade = Blade<2>::of_grid(nullptr, {path[0].data(), 2}, static_cast<uint32_t>(path.size()), 1);
    Crossings<2> search(env(), blade);
    std::vector<std::array<plane::Vec, 2>> through;
    for (int tries = 0; tries < 60 && through.size() < 12; ++tries) {
      const plane::Vec p = some_point(), q = some_point();
      int count = 0;
      for (uint32_t k = 0; k < blade.simplex_count(); ++k) {
        const BladeSimplex<2> segment = blade.simplex(k);
        const int side = segment.side(q.data());
        if (side != 0 && segment.side(p.data()) != side && segment.is_passed(p.data(), q.data(), side)) ++count;
      }
      const int from = plane::locate(world_, p), to = plane::locate(world_, q);
      if (count != 1 || from < 0 || to < 0) continue;
      const auto is_met = [&](int cell) { return search.is_met(env().map.cell(static_cast<uint32_t>(cell))); };
      if (is_met(from) || is_met(to)) continue;
      free_before += plane::cast(world_, from, p, q).outcome == plane::Flight::kReached ? 1u : 0u;
      through.push_back({p, q});
    }
    dsw_tie_desc desc;
    dsw_tie_desc_init(&desc, sizeof desc);
    desc.points = path[0].data();
    desc.point_count = path.size();
    const double snaps[] = {0, 1e-12, 0.25};
    desc.snap = snaps[rng_.below(3u)];
    ASSERT_EQ(dsw_environment_tie(environment_.get(), &desc, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    for (const auto& way : through) {
      dsw_flight flight;
      ASSERT_EQ(dsw_environment_cast(environment_.get(), {0, 0}, way[0].data(), way[1].data(), nullptr, &flight),
                DSW_STATUS_OK);
      EXPECT_EQ(flight.outcome, DSW_OUTCOME_CONTACT);
    }
    flights += through.size();
  });
  RecordProperty("flights", static_cast<int>(flights));
  RecordProperty("free_before", static_cast<int>(free_before));
  EXPECT_GT(free_before, 200u);
}

TEST_F(BladeTest, TheTreeFindsWhatOverlaps) {
  Rng rng(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> points;
    const uint32_t count = 2 + rng.below(60u);
    for (uint32_t i = 0; i < 2 * count; ++i) points.push_back(rng.below(20u));
    const auto blade = Blade<2>::of_grid(nullptr, {points.data(), 2}, count, 1);
    const BladeTree<2> tree(nullptr, blade);
    for (int tries = 0; tries < 20; ++tries) {
      BladeTree<2>::Box box;
      const double a[2] = {rng.range(-2, 22), rng.range(-2, 22)}, b[2] = {double(rng.below(20u)), rng.range(-2, 22)};
      box.add(a);
      box.add(b);
      std::set<uint32_t> found, wanted;
      tree.for_each_in(box, [&](uint32_t simplex) { found.insert(simplex); });
      for (uint32_t k = 0; k + 1 < count; ++k) {
        BladeTree<2>::Box own;
        own.add(&points[2 * k]);
        own.add(&points[2 * k + 2]);
        if (own.overlaps(box)) wanted.insert(k);
      }
      EXPECT_EQ(found, wanted);
    }
  }
}

}  // namespace
}  // namespace dsw::oracle
