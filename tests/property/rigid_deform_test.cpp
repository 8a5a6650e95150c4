// An environment bends while rigid bodies turn, all at once: beside the exact first touch of every pair (dsw_sweep_rigid_pairs).
// Figures are printed.
#include "rigid_motions_support.h"

#include "dartsweep/pairs.h"

namespace dsw::oracle {
namespace {

/// All pairs of a call, with the motions of those that turn.
struct AllPairs {
  size_t dimension;
  std::vector<uint8_t> kinds = {};
  std::vector<double> from = {}, to = {}, motions = {};
  std::vector<uint32_t> indices = {};

  struct Side {
    const std::vector<Vec>*from, *to;
    std::vector<uint32_t> corners;
    uint32_t motion;
  };
  void add(const Side& a, const Side& b) {
    if (a.corners.size() + b.corners.size() != dimension + 1) return;
    if (a.corners.size() > b.corners.size()) return add(b, a);
    kinds.push_back(static_cast<uint8_t>(dimension == 2          ? DSW_PAIR_VERTEX_EDGE
                                         : a.corners.size() == 1 ? DSW_PAIR_VERTEX_FACE
                                                                 : DSW_PAIR_EDGE_EDGE));
    for (const Side* side : {&a, &b}) {
      for (const uint32_t v : side->corners) {
        const auto end = static_cast<std::ptrdiff_t>(dimension);
        from.insert(from.end(), (*side->from)[v].begin(), (*side->from)[v].begin() + end);
        to.insert(to.end(), (*side->to)[v].begin(), (*side->to)[v].begin() + end);
      }
      indices.push_back(side->motion);
    }
  }
  /// The time of the first touch, or 2.
  double first_time() const {
    std::vector<dsw_pair_touch> touches(kinds.size());
    EXPECT_EQ(
        dsw_sweep_rigid_pairs(nullptr, static_cast<uint32_t>(dimension), kinds.size(), kinds.data(), from.data(),
                              to.data(), 0, motions.data(), motions.size() / 17, indices.data(), 0, touches.data()),
        DSW_STATUS_OK)
        << dsw_last_error_message();
    double first = 2;
    for (const dsw_pair_touch& each : touches) first = each.touches != 0 ? std::min(first, each.time) : first;
    return first;
  }
};

class RigidDeformTest : public RigidMotionsTest {
 protected:
  RigidDeformTest() : RigidMotionsTest(71) {}

  /// @param motions of the walkers in their order; those that stand have one that does not count.
  double first_touch(const Ground& ground, const std::vector<Walker>& walkers,
                     const std::vector<dsw_rigid_motion>& motions) {
    const auto d = static_cast<size_t>(dimension());
    AllPairs all{d};
    for (const dsw_rigid_motion& each : motions) {
      const std::vector<double> numbers = numbers_of(each);
      all.motions.insert(all.motions.end(), numbers.begin(), numbers.end());
    }
    const auto side = [&](size_t i, const std::vector<uint32_t>& part) {
      const std::vector<Vec>& at = walkers[i].state.at;
      return AllPairs::Side{&at, &at, part, walkers[i].stands ? UINT32_MAX : static_cast<uint32_t>(i)};
    };
    for (size_t i = 0; i < walkers.size(); ++i) {
      for (size_t corners = 1; corners <= d; ++corners) {
        const auto features = ground.features(d + 1 - corners), parts = walkers[i].parts(corners);
        for (const auto& part : parts) {
          for (const auto& feature : features) {
            all.add(side(i, part), {&ground.points, &ground.next, feature, UINT32_MAX});
          }
        }
        for (size_t j = 0; j < i; ++j) {
          if (walkers[i].alone || walkers[j].alone || (walkers[i].stands && walkers[j].stands)) continue;
          for (const auto& part : parts) {
            for (const auto& other : walkers[j].parts(d + 1 - corners)) all.add(side(i, part), side(j, other));
          }
        }
      }
    }
    return all.first_time();
  }
  struct Told {
    double first = 2;
    size_t faults = 0;
  };
  /// What the call tells: the time, one for all contacts, and how many things are wrong.
  Told told(const Ground& ground, dsw_scene* scene, const std::vector<Walker>& walkers,
            const std::vector<dsw_move_report>& reports, const dsw_deform_report& report) {
    Told told;
    const auto check = [&](bool ok) { told.faults += ok ? 0 : 1; };
    const auto add = [&](double time) {
      check(told.first == 2 || told.first == time);
      told.first = time;
    };
    const auto d = static_cast<size_t>(dimension());
    size_t at = 0;
    for (const Walker& each : walkers) {
      if (each.stands) continue;
      const dsw_body_contact* contacts = nullptr;
      size_t count = 0;
      EXPECT_EQ(dsw_body_get_contacts(scene, each.id, &contacts, &count), DSW_STATUS_OK);
      check(reports[at].fraction == report.fraction && reports[at].contact_count == count);
      ++at;
      for (size_t k = 0; k < count; ++k) add(contacts[k].time);
    }
    const dsw_wall_contact* walls = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_environment_get_wall_contacts(ground.environment.get(), &walls, &count), DSW_STATUS_OK);
    check(count == report.contact_count && report.held_count == 0);
    for (size_t k = 0; k < count; ++k) {
      add(walls[k].time);
      check(walls[k].response == DSW_WALL_STOP &&
            (walls[k].body.generation != 0) != (walls[k].particle.generation != 0));
      check(std::equal(walls[k].from, walls[k].from + d, ground.points[walls[k].moving.index].begin()));
      check(std::equal(walls[k].to, walls[k].to + d, ground.next[walls[k].moving.index].begin()));
    }
    check(report.outcome == (report.fraction == 1   ? DSW_DEFORM_DONE
                             : report.fraction == 0 ? DSW_DEFORM_REFUSED
                                                    : DSW_DEFORM_FRACTION));
    return told;
  }
};

TEST_P(RigidDeformTest, MissesNothingAndPassesNothing) {
  size_t moves = 0, stops = 0, missed = 0, false_stops = 0, wrong_time = 0, passed = 0, short_of = 0, halvings = 0,
         occupied = 0, faults = 0, silent = 0, halved_for_nothing = 0;
  double worst = 0;
  const int rounds = effort_of(30);
  for (int round = 0; round < rounds && !HasFailure(); ++round) {
    std::deque<std::vector<double>> arrays;
    Ground ground = make(rng_);
    ASSERT_NE(ground.environment, nullptr);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS |
                                                              (round % 2 == 0 ? DSW_FEATURE_LIVE_CHANGES : 0));
    std::vector<Walker> walkers = make_walkers(scene.get(), 1 + rng_.below(3u), rng_.below(3u));
    for (int step = 0; step < kSteps && !HasFailure(); ++step) {
      choose_ends(ground, walkers);
      std::vector<dsw_rigid_motion> motions, called;
      std::vector<dsw_body_id> ids;
      for (Walker& each : walkers) {
        each.stands = each.stands || each.alone;
        motions.push_back(motion_of(each));
        if (each.stands) continue;
        ids.push_back(each.id);
        called.push_back(motions.back());
      }
      const double truth = first_touch(ground, walkers, motions);
      // What is not valid is not entered: it is a wall that the pairs do not know.
      const bool valid = all_stay_valid(ground, round % 4 == 0);
      std::vector<double>& array = arrays.emplace_back();
      for (const Vec& p : ground.next) array.insert(array.end(), p.begin(), p.begin() + dimension());
      std::vector<dsw_move_report> reports(ids.size());
      dsw_deform_report report = {};
      ASSERT_EQ(dsw_scene_deform_rigid(scene.get(), array.data(), ground.next.size(), ids.data(), ids.size(),
                                       called.data(), nullptr, &report, reports.data()),
                DSW_STATUS_OK)
          << dsw_last_error_message();
      const Told answer = told(ground, scene.get(), walkers, reports, report);
      const bool halved = report.invalid_count != 0, touched = answer.first <= 1;
      ++moves;
      stops += touched ? 1 : 0;
      halvings += halved ? 1 : 0;
      faults += answer.faults;
      passed += report.fraction > truth ? 1 : 0;
      wrong_time += valid && touched && answer.first != truth ? 1 : 0;
      silent += valid && report.fraction < 1 && !touched && !halved ? 1 : 0;
      halved_for_nothing += valid && halved ? 1 : 0;
      if (!halved && truth <= 1) {
        missed += touched ? 0 : 1;
        // Something that moves by a few roundings alone can be in the way of rounded places that rest on it.
        const double left = is_coarse_ && valid ? truth - report.fraction : 0;
        worst = std::max(worst, left);
        short_of += left > 1e-6 ? 1 : 0;
      } else if (valid) {
        false_stops += touched || (!halved && report.fraction != 1) ? 1 : 0;
      }
      EXPECT_EQ(answer.faults + missed + false_stops + wrong_time + passed + silent, 0u)
          << "round " << round << " step " << step << " truth " << truth << " told " << answer.first << " fraction "
          << report.fraction << " outcome " << report.outcome << " invalid " << report.invalid_count;
      ground.points = points_read(ground.environment.get(), dimension());
      std::vector<BodyState> after;
      for (Walker& each : walkers) {
        const std::vector<Vec> before = each.state.at;
        read_walker(scene.get(), each, each.state);
        faults += each.stands && each.state.at != before ? 1 : 0;
        each.end = each.state.at;
        after.push_back(each.state);
      }
      ground.next.clear();
      occupied += misplaced(ground, after, !halved) + (rng_.chance(0.5) ? not_free(scene.get(), walkers) : 0);
      if (!valid) break;  // what has turned over stays so
    }
  }
  std::printf(
      "%s: %zu moves, %zu stops by a touch, %zu halved; missed %zu, false stops %zu, wrong time %zu, passed %zu, not "
      "free %zu, faults %zu, without a contact %zu, stopped short %zu (at most %.1e of the motion), halved for nothing "
      "%zu\n",
      GetParam().name, moves, stops, halvings, missed, false_stops, wrong_time, passed, occupied, faults, silent,
      short_of, worst, halved_for_nothing);
  EXPECT_EQ(missed + false_stops + wrong_time + passed + occupied + faults + silent + short_of + halved_for_nothing,
            0u);
  EXPECT_TRUE(moves < 60 || stops > moves / 20);
}

INSTANTIATE_TEST_SUITE_P(Kinds, RigidDeformTest, testing::ValuesIn(kAllKinds),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace dsw::oracle
