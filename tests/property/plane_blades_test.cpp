// What a path in the plane crosses, what closed lines hold, and what a line ties, against exact integers.
#include "path_truth.h"
#include "plane_cuts.h"

#include "cutting/inside.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dsw::oracle {
namespace {

using Path = std::vector<plane::Vec>;

class BladeTest : public testing::Test {
 protected:
  /// Calls use() with each kind of world in each size, that of the environment.
  template <class Use>
  void for_each_world(uint64_t rounds, const Use& use) {
    for_each_turn(rounds, [&](const plane::Turn& turn, uint64_t seed) {
      rng_ = Rng(seed);
      world_ = plane::make_world(turn, rng_);
      environment_ = plane::make_environment(turn, world_, rng_);
      if (environment_ != nullptr) use();
    });
  }
  const Environment<2>& env() const { return std::get<Environment<2>>(environment_->engine); }

  /// In cells, on sides, at vertices.
  plane::Vec some_point() {
    const std::vector<int>& cell = world_.cells[rng_.below(world_.cells.size())];
    const auto vertex = [&] { return world_.points[static_cast<size_t>(cell[rng_.below(cell.size())])]; };
    const plane::Vec p = vertex(), q = vertex(), r = vertex();
    if (rng_.chance(0.2)) return p;
    if (rng_.chance(0.2)) return mix(p, q, 0.5);
    const double across = rng_.unit(), along = rng_.unit();
    return mix(mix(p, q, along), r, across);
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
    const PathTruth truth(world_, path);
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
  EXPECT_GT(crossed, static_cast<size_t>(effort_of(2000)));
  EXPECT_GT(twice, static_cast<size_t>(effort_of(300)));
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
    const PathTruth truth(world_, all);
    Crossings<2> crossings(env(), blade);
    Inside<2> shape(env(), blade, false, crossings);
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
    // After carving, exactly the chosen cells that are inside are passable.
    std::vector<dsw_volume_id> volumes;
    for (uint32_t i = 0; i < centres.size(); ++i) {
      if (rng_.chance(0.8)) volumes.push_back({i, 1});
    }
    ASSERT_EQ(dsw_environment_mark_volumes(environment_.get(), volumes.data(), volumes.size(), DSW_MARK_IMPASSABLE, 0,
                                           nullptr),
              DSW_STATUS_OK);
    dsw_carve_desc desc = defaults(dsw_carve_desc_init);
    desc.points = points[0].data();
    desc.point_count = points.size();
    desc.triangles = ends.data();
    desc.triangle_count = ends.size() / 2;
    dsw_change report = empty_change();
    ASSERT_EQ(dsw_environment_carve(environment_.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
    const dsw_volume_id* carved = change_of(environment_.get()).carved;
    const size_t count = change_of(environment_.get()).carved_count;
    ASSERT_EQ(count, report.carved_count);
    std::set<uint32_t> was_carved;
    for (size_t i = 0; i < count; ++i) was_carved.insert(carved[i].index);
    carved_cells += count;
    for_each_cell(env().map, [&](dsw::Cell c) {
      plane::Vec at;
      centre(env(), c, at.data());
      all = points;
      all.push_back(at);
      const bool holds = PathTruth(world_, all).turns(at, ends) != 0;
      EXPECT_FALSE(env().map.marked(c) && holds);
      EXPECT_TRUE(was_carved.count(env().map.index(c)) == 0 || (holds && !env().map.marked(c)));
    });
  });
  RecordProperty("inside", static_cast<int>(inside));
  RecordProperty("carved", static_cast<int>(carved_cells));
  EXPECT_GT(inside, static_cast<size_t>(effort_of(1000)));
  EXPECT_GT(carved_cells, static_cast<size_t>(effort_of(500)));
}

/// A way that begins and ends in cells that the line did not meet, and crosses it once, is stopped.
TEST_F(BladeTest, NothingGetsPastATie) {
  size_t flights = 0, free_before = 0;
  for_each_world(3, [&] {
    Path path{some_point(), some_point()};
    while (path.size() < 7 && rng_.chance(0.5)) path.push_back(some_point());
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
    dsw_tie_desc desc = defaults(dsw_tie_desc_init);
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
  EXPECT_GT(free_before, static_cast<size_t>(effort_of(200)));
}

TEST_F(BladeTest, TheTreeFindsWhatOverlaps) {
  Rng rng(5);
  for (int round = 0; round < at_least(50); ++round) {
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
