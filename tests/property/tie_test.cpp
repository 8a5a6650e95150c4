// Vessels tied in environments of every kind: nothing gets through what the loop spans.
#include <cmath>
#include <map>
#include <set>

#include "cutting/crossings.h"
#include "locate/locate.h"
#include "map/integrity.h"
#include "random_edits.h"
#include "random_shapes.h"
#include "walk/cast.h"

namespace dsw::oracle {
namespace {

class TieTest : public SceneTest {
 protected:
  const Environment<3>& env() const { return dsw::capi::space(*place_.get()); }

  /// Passable if `keeps(centre)`.
  template <class Keeps>
  void mark_unless(Keeps keeps) {
    for_each_cell(env().map, [&](dsw::Cell c) {
      double at[3];
      centre(env(), c, at);
      const dsw_volume_id id = volume_id(env().map, c);
      if (!keeps(at)) dsw_environment_mark_volumes(place_.get(), &id, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    });
  }
  /// With the loop's centre as its last point.
  Blade<3> disc(const std::vector<double>& loop) {
    points_ = loop;
    const auto count = static_cast<uint32_t>(loop.size() / 3);
    points_.resize(loop.size() + 3);
    mean_point<3>(
        count, [&](uint32_t i) { return &loop[size_t{3} * i]; }, &points_[loop.size()]);
    return Blade<3>::fan(nullptr, {points_.data(), 3}, count + 1);
  }
  dsw_status tie(const std::vector<double>& loop, dsw_volume_id start, double snap) {
    dsw_tie_desc desc = defaults(dsw_tie_desc_init);
    desc.points = loop.data();
    desc.point_count = loop.size() / 3;
    desc.start = start;
    desc.snap = snap;
    return dsw_environment_tie(place_.get(), &desc, &report_);
  }
  /// How often a segment crosses the blade.
  static int crossings(const Blade<3>& blade, const double* a, const double* b) {
    int count = 0;
    for (uint32_t t = 0; t < blade.simplex_count(); ++t) {
      const BladeSimplex<3> triangle = blade.simplex(t);
      const int side = triangle.side(b);
      if (side == 0 || triangle.side(a) == side || !triangle.is_passed(a, b, side)) continue;
      ++count;
    }
    return count;
  }
  void undo() {
    const dsw_change last = change_of(place_.get());
    ASSERT_EQ(last.whole_count, report_.whole_count);
    ASSERT_EQ(dsw_environment_mark_volumes(place_.get(), last.whole, last.whole_count, DSW_MARK_PASSABLE, 0, nullptr),
              DSW_STATUS_OK);
    const size_t count = last.face_count;
    std::vector<dsw_face_id> fronts, backs;
    for (size_t i = 0; i < count; ++i) {
      fronts.push_back(last.faces[i].front);
      backs.push_back(last.faces[i].back);
    }
    ASSERT_EQ(dsw_environment_sew_faces(place_.get(), fronts.data(), backs.data(), count), DSW_STATUS_OK)
        << dsw_last_error_message();
  }

  Place place_;
  std::vector<double> points_;
  dsw_change report_ = empty_change();
};
DSW_FOR_ALL_SCENES(TieTest);

/// A segment that crosses what the loop spans once.
struct Flight {
  double from[3], to[3];
};

TEST_P(TieTest, NothingGetsThrough) {
  size_t flights = 0, free_before = 0;
  for (uint64_t seed = 1; seed <= seeds_of(6); ++seed) {
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    Rng rng(seed ^ 0x71e);
    mark_unless([&](const double*) { return rng.chance(0.95); });
    for (int round = 0; round < 3; ++round) {
      const std::vector<double> loop = some_loop(env(), place_.world->size, rng);
      const Blade<3> blade = disc(loop);
      Crossings<3> search(env(), blade);
      std::map<uint32_t, bool> met;
      const auto is_met = [&](dsw::Cell c) {
        if (met.count(c.unit) == 0) met[c.unit] = search.is_met(c);
        return met[c.unit];
      };
      std::vector<Flight> through;
      for (int tries = 0; tries < 400 && through.size() < 60; ++tries) {
        const double* at[3];
        blade.corners(rng.below(blade.simplex_count()), at);
        double weights[3] = {rng.unit(), rng.unit(), rng.unit()}, sum = weights[0] + weights[1] + weights[2];
        Flight flight;
        const double reach = rng.range(0.02, 0.5) * place_.world->size;
        for (int k = 0; k < 3; ++k) {
          const double on = (weights[0] * at[0][k] + weights[1] * at[1][k] + weights[2] * at[2][k]) / sum;
          const double way = rng.range(-reach, reach);
          flight.from[k] = on - rng.unit() * way;
          flight.to[k] = on + rng.unit() * way;
        }
        if (crossings(blade, flight.from, flight.to) != 1) continue;
        const dsw::Cell from = locate(env(), flight.from, {}, nullptr).cell,
                        to = locate(env(), flight.to, {}, nullptr).cell;
        if (!from.valid() || !to.valid() || env().map.marked(from) || is_met(from) || is_met(to)) continue;
        free_before += cast(env(), flight.from, flight.to, from).end == CastEnd::kReached ? 1u : 0u;
        through.push_back(flight);
      }
      const double snaps[] = {0, 1e-12, 0.25};
      ASSERT_EQ(tie(loop, {0, 0}, snaps[rng.below(3)]), DSW_STATUS_OK) << dsw_last_error_message();
      ASSERT_EQ(check_integrity(env().map), nullptr);
      for (const Flight& flight : through) {
        const dsw::Cell from = locate(env(), flight.from, {}, nullptr).cell;
        ASSERT_TRUE(from.valid());
        EXPECT_NE(cast(env(), flight.from, flight.to, from).end, CastEnd::kReached)
            << "seed " << seed << ", round " << round;
      }
      flights += through.size();
      if (HasFailure()) return;
      if (rng.chance(0.5)) undo();
      if (HasFatalFailure()) return;
    }
  }
  RecordProperty("flights", static_cast<int>(flights));
  RecordProperty("free before", static_cast<int>(free_before));
  if (kind_named(GetParam()).integer) {
    EXPECT_GT(free_before, 0u);
  }
}

/// A tube round a line, and a loop round the tube: what hangs together afterwards is on one side, and together again
/// when that is undone.
TEST_P(TieTest, ATubeIsClosed) {
  size_t closed = 0;
  for (uint64_t seed = 1; seed <= seeds_of(6); ++seed) {
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    Rng rng(seed ^ 0x7b3);
    const double size = place_.world->size, reach = rng.range(0.05, 0.2) * size;
    double on[3], along[3], u[3], v[3];
    centre(env(), env().map.cell(rng.below(env().map.index_count())), on);
    const bool of_axes = rng.chance(0.3);
    for (int k = 0; k < 3; ++k) along[k] = of_axes ? (k == 0 ? 1 : 0) : rng.range(-1, 1);
    const double norm = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (double& x : along) x /= norm;
    const int least = std::fabs(along[0]) < 0.5 ? 0 : 1;
    for (int k = 0; k < 3; ++k) u[k] = (k == least ? 1 : 0) - along[least] * along[k];
    for (int k = 0; k < 3; ++k) v[k] = along[(k + 1) % 3] * u[(k + 2) % 3] - along[(k + 2) % 3] * u[(k + 1) % 3];
    const auto height = [&](const double* p) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += along[k] * (p[k] - on[k]);
      return sum;
    };
    mark_unless([&](const double* p) {
      double distance = 0;
      for (int k = 0; k < 3; ++k) distance += (p[k] - on[k]) * (p[k] - on[k]);
      return distance - height(p) * height(p) < reach * reach;
    });
    std::vector<double> loop;
    const double radius = reach + rng.range(0.1, 3) * size;
    for (int i = 0; i < 7; ++i) {
      const double angle = 2 * kPi * i / 7;
      for (int k = 0; k < 3; ++k) {
        loop.push_back(on[k] + 2 * radius * (std::cos(angle) * u[k] + std::sin(angle) * v[k]));
      }
    }
    const Blade<3> blade = disc(loop);
    Crossings<3> search(env(), blade);
    std::map<uint32_t, int> sides;  // of volumes that the surface does not meet
    for_each_cell(env().map, [&](dsw::Cell c) {
      if (env().map.marked(c) || search.is_met(c)) return;
      double at[3];
      centre(env(), c, at);
      sides[env().map.index(c)] = height(at) > 0 ? 1 : -1;
    });
    const dsw::Cell start = env().map.cell(rng.below(env().map.index_count()));
    const bool anywhere = rng.chance(0.5);
    ASSERT_EQ(tie(loop, anywhere ? dsw_volume_id{0, 0} : volume_id(env().map, start), 0), DSW_STATUS_OK);
    if (!report_.is_closed) continue;
    // What hangs together.
    std::set<uint32_t> seen;
    for_each_cell(env().map, [&](dsw::Cell first) {
      if (env().map.marked(first) || !seen.insert(first.unit).second) return;
      std::set<int> both;
      std::vector<dsw::Cell> stack{first};
      while (!stack.empty()) {
        const dsw::Cell c = stack.back();
        stack.pop_back();
        const auto side = sides.find(env().map.index(c));
        if (side != sides.end()) both.insert(side->second);
        for (uint32_t f = 0; f < env().map.facets_of(c); ++f) {
          const HalfFacet h = env().map.half_facet(c, f), o = env().map.opposite(h);
          if (!o.valid() || is_impassable(env().map, h)) continue;
          if (seen.insert(env().map.cell_of(o).unit).second) stack.push_back(env().map.cell_of(o));
        }
      }
      if (anywhere) {
        EXPECT_LE(both.size(), 1u) << "seed " << seed;
      }
    });
    closed += anywhere ? 1u : 0u;
    undo();
    if (HasFailure()) return;
  }
  RecordProperty("closed", static_cast<int>(closed));
}

}  // namespace
}  // namespace dsw::oracle
