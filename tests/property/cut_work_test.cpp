// What cuts look at: the trees find what looking at everything finds, a blade that misses needs no more memory in a
// larger environment, and memory that runs out changes nothing.
#include <cmath>
#include <queue>
#include <set>

#include "cutting/inside.h"
#include "cutting/start.h"
#include "environment/marking.h"
#include "host_memory.h"
#include "locate/locate.h"
#include "random_edits.h"
#include "snapshot_support.h"

namespace dsw::oracle {
namespace {

/// Points of a grid of rows and columns with steps of every kind: even, uneven, of no length, far from each other.
std::vector<double> some_blade(uint32_t rows, uint32_t columns, int dimension, double size, Rng& rng) {
  const double scale = size * std::pow(10.0, rng.range(-2, rng.chance(0.1) ? 9 : 1));
  const double thin = rng.chance(0.5) ? 1 : std::pow(10.0, rng.range(-12, 0));
  const bool is_even = rng.chance(0.3), has_equal = rng.chance(0.3);
  std::vector<double> points;
  double at[3];
  for (int k = 0; k < dimension; ++k) at[k] = size * rng.range(-1, 2);
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const double steps[3] = {double(row), thin * column, is_even ? 0 : thin * rng.range(-1, 1)};
      for (int k = 0; k < dimension; ++k) points.push_back(at[k] + scale * steps[has_equal && row == 0 ? 2 : k]);
    }
  }
  return points;
}

template <int D>
void check_distances() {
  Rng rng(11);
  for (int round = 0; round < effort_of(400); ++round) {
    const uint32_t rows = 2 + rng.below(30u), columns = D == 3 ? 2 + rng.below(6u) : 1;
    const std::vector<double> points = some_blade(rows, columns, D, 1, rng);
    const auto blade = Blade<D>::of_grid(nullptr, {points.data(), D}, rows, columns);
    const BladeTree<D> tree(nullptr, blade);
    uint32_t nearest = 0;
    for (int tries = 0; tries < 50; ++tries) {
      double from[D], least = HUGE_VAL;
      const double* const near = blade.point(rng.below(blade.point_count()));
      const double far = std::pow(10.0, rng.range(-15, 3));
      for (int k = 0; k < D; ++k) from[k] = near[k] + far * rng.range(-1, 1);
      std::vector<double> all;
      for (uint32_t s = 0; s < blade.simplex_count(); ++s) {
        const double* corners[D];
        blade.corners(s, corners);
        all.push_back(distance_to_simplex<D>(from, corners));
        least = std::min(least, all.back());
      }
      ASSERT_EQ(tree.distance(from, &nearest), least) << "round " << round;
      ASSERT_EQ(all[nearest], least);
    }
  }
}

TEST(BladeTreeTest, TheNearestSimplexIsThatOfAll) {
  check_distances<2>();
  check_distances<3>();
}

/// The search for the first cell, with every cell measured against all simplices.
dsw::Cell searched(const Environment<3>& env, const Blade<3>& blade, dsw::Cell hint, uint32_t* visited) {
  struct Entry {
    double distance;
    size_t number;
    bool operator<(const Entry& o) const { return distance != o.distance ? distance > o.distance : number > o.number; }
  };
  Crossings<3> crossings(env, blade);
  std::vector<dsw::Cell> cells;
  std::set<uint32_t> seen;
  std::priority_queue<Entry> queue;
  const auto push = [&](dsw::Cell c) {
    if (!seen.insert(c.unit).second) return;
    double from[3], least = HUGE_VAL;
    centre(env, c, from);
    for (uint32_t s = 0; s < blade.simplex_count(); ++s) {
      const double* corners[3];
      blade.corners(s, corners);
      least = std::min(least, distance_to_simplex<3>(from, corners));
    }
    queue.push({least, cells.size()});
    cells.push_back(c);
  };
  push(hint);
  for (uint32_t in_vain = 0; !queue.empty(); ++in_vain) {
    const dsw::Cell c = cells[queue.top().number];
    queue.pop();
    if (crossings.is_met(c)) {
      *visited += in_vain;
      return c;
    }
    for (uint32_t f = 0; f < env.map.facets_of(c); ++f) {
      const HalfFacet o = env.map.opposite(env.map.half_facet(c, f));
      if (o.valid()) push(env.map.cell_of(o));
    }
  }
  return {};
}

class CutWorkTest : public SceneTest {};
DSW_FOR_ALL_SCENES(CutWorkTest);

TEST_P(CutWorkTest, TheSearchAndTheTreesFindWhatLookingAtAllFinds) {
  size_t met = 0, missed = 0;
  for (uint64_t seed = 1; seed <= seeds_of(6); ++seed) {
    const uint32_t flags[3] = {0, DSW_ENVIRONMENT_LOCATE_TREE, DSW_ENVIRONMENT_NO_LOCATE_TREE};
    const Place place = make_place(GetParam(), seed, flags[seed % 3]);
    if (place.environment == nullptr) continue;
    const Environment<3>& env = dsw::capi::space(*place.get());
    Rng rng(seed);
    for (int round = 0; round < 20; ++round) {
      const uint32_t rows = 2 + rng.below(8u), columns = 2 + rng.below(4u);
      const std::vector<double> points = some_blade(rows, columns, 3, place.world->size, rng);
      const auto blade = Blade<3>::of_grid(nullptr, {points.data(), 3}, rows, columns);
      const BladeTree<3> tree(nullptr, blade);
      const dsw::Cell hint = env.map.cell(rng.below(env.map.index_count()));
      uint32_t visited = 0, wanted = 0;
      const dsw::Cell found = find_start(env, blade, tree, hint, &visited);
      const dsw::Cell other = searched(env, blade, hint, &wanted);
      EXPECT_TRUE(found == other);
      EXPECT_EQ(visited, wanted);
      ++(found.valid() ? met : missed);
      const dsw::Cell first = find_start(env, blade, tree, {}, &visited);
      dsw::Cell of_points;
      for (uint32_t i = 0; i < blade.point_count() && !of_points.valid(); ++i) {
        of_points = locate(env, blade.point(i), {}, nullptr).cell;
      }
      EXPECT_TRUE(!of_points.valid() || first == of_points);
      std::set<std::pair<uint32_t, uint32_t>> pairs;
      EXPECT_TRUE(for_each_near(env, tree, [&](dsw::Cell c, uint32_t s) {
        pairs.insert({env.map.index(c), s});
        return true;
      }));
      Crossings<3> crossings(env, blade), all(env, blade);
      find_all(env, tree, crossings);
      for_each_cell(env.map, [&](dsw::Cell c) {
        const BladeTree<3>::Box box(env, c);
        for (uint32_t s = 0; s < blade.simplex_count(); ++s) {
          EXPECT_LE(tree.box(s).overlaps(box) ? 1u : 0u, pairs.count({env.map.index(c), s}));
        }
        tree.for_each_in(box, [&](uint32_t s) { all.seed(c, s); });
      });
      all.run();
      ASSERT_EQ(crossings.cell_count(), all.cell_count());
      for (uint32_t i = 0; i < all.cell_count(); ++i) EXPECT_TRUE(crossings.cell(i).cell == all.cell(i).cell);
      ASSERT_EQ(crossings.count(), all.count());
      for (uint32_t i = 0; i < all.count(); ++i) EXPECT_EQ(crossings[i].share, all[i].share);
    }
  }
  RecordProperty("met", static_cast<int>(met));
  RecordProperty("missed", static_cast<int>(missed));
}

class CutMemoryTest : public MemoryTest {
 protected:
  dsw_environment* env() { return place_.get(); }
  dsw_volume_id volume(uint32_t index) {
    dsw_volume_id id{};
    EXPECT_EQ(dsw_environment_get_volume_id(env(), index, &id), DSW_STATUS_OK);
    return id;
  }
  /// A sheet of rows x rows points over a square from (x, x) on.
  void make_blade(uint32_t rows, double x, double size, double z) {
    points_.clear();
    for (uint32_t i = 0; i < rows * rows; ++i) {
      const double u = i / rows, v = i % rows;
      points_.insert(points_.end(), {x + size * u / (rows - 1), x + size * v / (rows - 1), z + 0.01 * u});
    }
    cut_ = defaults(dsw_cut_desc_init);
    cut_.points = points_.data();
    cut_.rows = cut_.columns = rows;
  }
  /// The most bytes that a cut needs at a time.
  size_t bytes_of_cut() {
    const size_t before = memory_.most = memory_.bytes;
    EXPECT_EQ(dsw_environment_cut(env(), &cut_, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    return memory_.most - before;
  }

  std::vector<double> points_;
  dsw_cut_desc cut_{};
};

TEST_F(CutMemoryTest, ABladeThatMissesNeedsNoMoreInALargerEnvironment) {
  size_t bytes[2] = {};
  for (const int n : {6, 24}) {
    scene_.reset();
    place_ = {};
    place_ = place_of(hex_grid(axis(n, 1), axis(n, 1), axis(n, 1)), DSW_ENVIRONMENT_LOCATE_TREE, context_.get());
    ASSERT_PLACE(place_);
    scene_ = make_scene(env());
    make_blade(9, 1, 4, n + 2);
    cut_.start = volume(0);
    bytes_of_cut();  // makes the tables of the first change
    bytes[n == 6 ? 0 : 1] = bytes_of_cut();
    EXPECT_EQ(change_of(env()).volumes_visited, 0u);
    EXPECT_EQ(change_of(env()).volumes_crossed, 0u);
  }
  EXPECT_LT(bytes[1], 2 * bytes[0]);
}

TEST_F(CutMemoryTest, WhatIsRefusedChangesNothing) {
  std::vector<dsw_edge_id> edges;
  for (uint32_t i = 0; i < 48; ++i) edges.push_back({volume(i).index, volume(i).generation, i % 12});
  ASSERT_EQ(dsw_environment_mark_edges(env(), edges.data(), edges.size(), DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  const double at[3] = {1.5, 1.5, 1.25};
  dsw_particle_id particle;
  ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle), DSW_STATUS_OK);
  make_blade(3, -1, 6, 1.4);
  bytes_of_cut();
  for (const bool misses : {true, false}) {
    make_blade(4, misses ? 9 : -1, 6, 1.8);
    cut_.flags = DSW_CUT_UNSEW;
    cut_.start = volume(0);
    const std::string before = saved_both(scene());
    size_t refusals = 0;
    for (size_t call = 1;; call += 1 + call / 32, ++refusals) {
      memory_.refuse = memory_.calls + call;
      const dsw_status status = dsw_environment_cut(env(), &cut_, nullptr);
      memory_.refuse = 0;
      if (status == DSW_STATUS_OK) break;
      ASSERT_EQ(status, DSW_STATUS_OUT_OF_MEMORY) << dsw_last_error_message();
      ASSERT_EQ(saved_both(scene()), before) << "after refusal " << refusals;
    }
    EXPECT_GT(refusals, 5u);
  }
  EXPECT_GT(change_of(env()).volumes_split, 8u);
}

TEST_F(CutMemoryTest, MemoryIsInProportionToWhatChanges) {
  double bytes[2] = {};
  for (const int n : {8, 40}) {
    scene_.reset();
    place_ = {};
    place_ = place_of(hex_grid(axis(n, 1), axis(n, 1), axis(2, 1)), DSW_ENVIRONMENT_LOCATE_TREE, context_.get());
    ASSERT_PLACE(place_);
    scene_ = make_scene(env());
    make_blade(2, n + 1, 1, 9);
    bytes_of_cut();
    make_blade(2, -1, n + 2, 1.4);
    const size_t most = bytes_of_cut();
    ASSERT_EQ(change_of(env()).volumes_changed, size_t(n * n));
    bytes[n == 8 ? 0 : 1] = double(most) / (n * n);
  }
  EXPECT_LT(bytes[1], 1.5 * bytes[0]);
}

/// Marks of edges are those of the edges that are left, however many go with their volumes.
TEST_F(CutMemoryTest, MarksOfEdgesGoWithTheirLastVolume) {
  std::vector<dsw_edge_id> edges;
  for (uint32_t i = 0; i < 48; ++i) {
    for (uint32_t k = 0; k < 12; ++k) edges.push_back({volume(i).index, volume(i).generation, k});
  }
  ASSERT_EQ(dsw_environment_mark_edges(env(), edges.data(), edges.size(), DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  make_blade(3, -1, 6, 1.4);
  bytes_of_cut();
  const std::vector<dsw_volume_id> gone = {volume(0), volume(5), volume(17), volume(21)};
  ASSERT_EQ(dsw_environment_remove_volumes(env(), gone.data(), gone.size()), DSW_STATUS_OK);
  const Environment<3>& e = dsw::capi::space(*env());
  std::set<uint64_t> left;
  size_t in_the_cut = 0;
  for_each_cell(e.map, [&](dsw::Cell c) {
    for (uint32_t d = 0; d < e.map.shape(c).dart_count(); ++d) {
      const uint32_t a = dart_vertex(e.map, {c, d}), b = dart_target(e.map, {c, d});
      const bool is_cut = e.point(a)[2] != std::floor(e.point(a)[2]) && e.point(b)[2] != std::floor(e.point(b)[2]);
      in_the_cut += is_cut ? 1 : 0;
      EXPECT_EQ(edge_marked(e, a, b), !is_cut);
      if (!is_cut) left.insert(pair_key(a, b));
    }
  });
  EXPECT_GT(in_the_cut, 8u);
  EXPECT_EQ(e.edge_marks.size(), left.size());
}

TEST_F(CutMemoryTest, AllParticlesInTheWayAreNamed) {
  std::vector<dsw_volume_id> gone;
  for (uint32_t i = 0; i < 32; ++i) gone.push_back(volume(i));
  std::set<uint32_t> wanted, named;
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    const double at[3] = {rng.range(0.01, 3.99), rng.range(0.01, 3.99), rng.range(0.01, 2.99)};
    dsw_particle_id particle;
    ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle), DSW_STATUS_OK);
    dsw_volume_id in{};
    ASSERT_EQ(dsw_particle_get_position(scene(), particle, nullptr, &in), DSW_STATUS_OK);
    if (in.index < 32) wanted.insert(particle.index);
  }
  EXPECT_EQ(dsw_environment_remove_volumes(env(), gone.data(), gone.size()), DSW_STATUS_OCCUPIED);
  const dsw_particle_id* particles = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_occupants(scene(), &particles, &count), DSW_STATUS_OK);
  for (size_t i = 0; i < count; ++i) named.insert(particles[i].index);
  EXPECT_EQ(named, wanted);
}

}  // namespace
}  // namespace dsw::oracle
