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

  double first_touch(const Ground& ground, const Step& step) {
    const auto d = static_cast<size_t>(dimension());
    const std::vector<Walker>& walkers = step.walkers;
    AllPairs all{d};
    for (const dsw_rigid_motion& each : step.motions) {
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
            all.add(side(i, part), {&step.from, &step.to, feature, UINT32_MAX});
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
  Told told(const Stage& stage, const Step& step) {
    const dsw_deform_report& report = step.report;
    Told told;
    const auto check = [&](bool ok) { told.faults += ok ? 0 : 1; };
    const auto add = [&](double time) {
      check(told.first == 2 || told.first == time);
      told.first = time;
    };
    const auto d = static_cast<size_t>(dimension());
    size_t at = 0;
    for (const Walker& each : step.walkers) {
      if (each.stands) continue;
      const dsw_body_contact* contacts = nullptr;
      size_t count = 0;
      EXPECT_EQ(dsw_body_get_contacts(stage.scene.get(), each.id, &contacts, &count), DSW_STATUS_OK);
      check(step.reports[at].fraction == report.fraction && step.reports[at].contact_count == count);
      ++at;
      for (size_t k = 0; k < count; ++k) add(contacts[k].time);
    }
    const dsw_wall_contact* walls = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_environment_get_wall_contacts(stage.ground.environment.get(), &walls, &count), DSW_STATUS_OK);
    check(count == report.contact_count && report.held_count == 0);
    for (size_t k = 0; k < count; ++k) {
      add(walls[k].time);
      check(walls[k].response == DSW_WALL_STOP &&
            (walls[k].body.generation != 0) != (walls[k].particle.generation != 0));
      check(std::equal(walls[k].from, walls[k].from + d, step.from[walls[k].moving.index].begin()));
      check(std::equal(walls[k].to, walls[k].to + d, step.to[walls[k].moving.index].begin()));
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
    Stage stage(make(rng_), DSW_FEATURE_BODY_CONTACTS | (round % 2 == 0 ? DSW_FEATURE_LIVE_CHANGES : 0));
    ASSERT_NE(stage.ground.environment, nullptr);
    stage.walkers = make_walkers(stage.scene.get(), 1 + rng_.below(3u), rng_.below(3u));
    for (int i = 0; i < kSteps && !HasFailure(); ++i) {
      const Step step = make_step(stage, round % 4 == 0);
      const double truth = first_touch(stage.ground, step);
      const Told answer = told(stage, step);
      const dsw_deform_report& report = step.report;
      const bool valid = step.valid;  // what is not is not entered: it is a wall that the pairs do not know
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
          << "round " << round << " step " << i << " truth " << truth << " told " << answer.first << " fraction "
          << report.fraction << " outcome " << report.outcome << " invalid " << report.invalid_count;
      for (size_t k = 0; k < step.walkers.size(); ++k) {
        faults += step.walkers[k].stands && step.after[k].at != step.walkers[k].state.at ? 1 : 0;
      }
      occupied += misplaced(stage.ground, step.after, !halved) +
                  (rng_.chance(0.5) ? not_free(stage.scene.get(), stage.walkers) : 0);
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
