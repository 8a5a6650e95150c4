// An environment bends while bodies move, all at once: nothing is missed, nothing is passed, all is free afterwards.
// Figures are printed.
#include "together_deform_kinds.h"

namespace dsw::oracle {
namespace {

class TogetherDeformTest : public BendingTest {
 protected:
  TogetherDeformTest() : BendingTest(5) {}
};

TEST_P(TogetherDeformTest, MissesNothingAndPassesNothing) {
  size_t moves = 0, stops = 0, missed = 0, made_up = 0, wrong_time = 0, passed = 0, occupied = 0, short_of = 0,
         short_if_rounded = 0, halvings = 0, halved_for_nothing = 0, misplaced_vertices = 0, faults = 0, refused = 0,
         folded = 0, after = 0, turned = 0;
  double worst = 0;  // of what nobody has gone although nothing was in the way
  const int rounds = effort_of(40);
  for (int round = 0; round < rounds; ++round) {
    std::deque<std::vector<double>> arrays;
    Ground ground = make(rng_);
    ASSERT_NE(ground.environment, nullptr);
    const bool exact = round % 4 == 0;
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS |
                                                              (round % 2 == 0 ? DSW_FEATURE_LIVE_CHANGES : 0));
    std::vector<Walker> walkers = make_walkers(scene.get(), rng_.below(4u), rng_.below(4u));
    for (int step = 0; step < kSteps; ++step) {
      const std::string where = "round " + std::to_string(round) + " step " + std::to_string(step);
      choose_ends(ground, walkers);
      const double truth = first_time(ground, walkers, exact);
      const bool valid = all_stay_valid(ground, exact);
      const DeformAnswer answer = deform_together(scene.get(), ground, walkers, arrays.emplace_back());
      ASSERT_EQ(answer.status, DSW_STATUS_OK);
      const double fraction = answer.report.fraction;
      const bool halved = answer.report.invalid_count != 0, touched = answer.told <= 1;
      ++moves;
      stops += touched ? 1 : 0;
      halvings += halved ? 1 : 0;
      halved_for_nothing += valid && halved ? 1 : 0;
      refused += fraction == 0 ? 1 : 0;
      faults += answer.faults;
      if (valid && !halved) {
        if (truth <= 1) {
          missed += touched ? 0 : 1;
          wrong_time += touched && answer.told != truth ? 1 : 0;
          passed += fraction > truth ? 1 : 0;
          const double left = (truth - fraction) * std::min(speed_, way_of_touching(ground, walkers, answer));
          // Where something moves by a few roundings only, what rests on it is in the way of rounded places.
          (is_coarse_ ? short_of : short_if_rounded) += left > 1e-9 ? 1 : 0;
          worst = std::max(worst, left);
        } else {
          made_up += touched || fraction != 1 ? 1 : 0;
        }
      }
      const bool bad_before = answer.faults + missed + made_up + wrong_time + passed + short_of != 0;
      EXPECT_FALSE(bad_before) << where << " truth " << truth << " told " << answer.told << " fraction " << fraction
                               << " speed " << speed_ << " valid " << valid << " invalid "
                               << answer.report.invalid_count << " faults " << answer.faults;
      // On the way that was made.
      ground.next = answer.points;
      for (size_t i = 0; i < walkers.size(); ++i) walkers[i].end = answer.after[i].at;
      const bool is_folded = !all_stay_valid(ground, exact);
      std::vector<BodyState> held = answer.after;
      for (const Walker& each : walkers) held.push_back(each.state);
      turned += occupied_stay_valid(ground, held, exact) ? 0 : 1;
      folded += is_folded ? 1 : 0;
      if (!is_folded) {
        const bool passes = first_time(ground, walkers, exact) <= 1;
        EXPECT_FALSE(passes) << where << " passed something";
        passed += passes ? 1 : 0;
      }
      misplaced_vertices += misplaced(ground, answer.after, !is_folded);
      ground.points = answer.points;
      ground.next.clear();
      for (size_t i = 0; i < walkers.size(); ++i)
        walkers[i].state = answer.after[i], walkers[i].end = answer.after[i].at;
      if (!is_folded) occupied += first_time(ground, walkers, false) <= 1 ? 1 : 0;
      if (rng_.chance(0.3)) occupied += not_free(scene.get(), walkers);
      if (HasFailure()) break;
      // Bodies go on alone.
      if (is_folded || !rng_.chance(0.3)) continue;
      std::vector<Walker> alone;
      for (Walker& each : walkers) {
        if (each.alone || each.stands) continue;
        for (Vec& p : each.end) p = beside(p, GetParam().reach * 0.3);
        alone.push_back(each);
      }
      if (alone.empty()) continue;
      const TogetherAnswer on = move_together(scene.get(), alone, DSW_TOGETHER_STOP_FEATURE);
      ++after;
      size_t at = 0;
      for (Walker& each : walkers) {
        if (each.alone || each.stands) continue;
        each.state = on.after[at];
        each.end = on.after[at++].at;
      }
      occupied += first_time(ground, walkers, false) <= 1 ? 1 : 0;
      misplaced_vertices += misplaced(ground, on.after, true);
    }
    if (HasFailure()) break;
    occupied += not_free(scene.get(), walkers);
  }
  std::printf(
      "%s: %zu moves, %zu stops by a touch, %zu halved, %zu refused, %zu folded, %zu go on; missed %zu, false stops "
      "%zu, wrong time %zu, passed %zu, short %zu, by rounding %zu (at most %.1e), not free %zu, misplaced %zu, halved "
      "for nothing %zu, turned over %zu, faults %zu\n",
      GetParam().name, moves, stops, halvings, refused, folded, after, missed, made_up, wrong_time, passed, short_of,
      short_if_rounded, worst, occupied, misplaced_vertices, halved_for_nothing, turned, faults);
  record_moves(moves, missed + passed, occupied + misplaced_vertices, 0);
  EXPECT_EQ(turned, 0u);
  EXPECT_EQ(
      missed + made_up + wrong_time + passed + short_of + occupied + misplaced_vertices + halved_for_nothing + faults,
      0u);
  EXPECT_TRUE(moves < 100 || stops > moves / 20);
}

TEST_P(TogetherDeformTest, ACommonMotionNeverStops) {
  size_t moves = 0, stopped = 0, faults = 0, misplaced_vertices = 0, occupied = 0;
  const int rounds = effort_of(60);
  for (int round = 0; round < rounds; ++round) {
    std::deque<std::vector<double>> arrays;
    Ground ground = make(rng_);
    ASSERT_NE(ground.environment, nullptr);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = make_walkers(scene.get(), 1 + rng_.below(4u), 0);
    for (int step = 0; step < 3; ++step) {
      const Affine carry = rng_.chance(0.5) ? rigid() : affine(0.2);
      ground.next = ground.points;
      for (Vec& p : ground.next) p = carry(p);
      for (Walker& each : walkers) {
        for (Vec& p : each.end = each.state.at) p = carry(p);
      }
      const DeformAnswer answer = deform_together(scene.get(), ground, walkers, arrays.emplace_back());
      ++moves;
      stopped += answer.report.fraction != 1 || answer.told <= 1 || answer.report.invalid_count != 0 ? 1 : 0;
      faults += answer.faults;
      ground.points = answer.points;
      misplaced_vertices += misplaced(ground, answer.after, true);
      for (size_t i = 0; i < walkers.size(); ++i) walkers[i].state = answer.after[i];
    }
    occupied += not_free(scene.get(), walkers);
  }
  std::printf("%s: %zu moves; stopped %zu, faults %zu, misplaced %zu, not free %zu\n", GetParam().name, moves, stopped,
              faults, misplaced_vertices, occupied);
  EXPECT_EQ(stopped + faults + misplaced_vertices + occupied, 0u);
}

TEST_P(TogetherDeformTest, NumbersDoNotMatter) {
  size_t moves = 0, contacts = 0, different = 0, refused = 0, faults = 0, occupied = 0;
  const int rounds = effort_of(30);
  for (int round = 0; round < rounds; ++round) {
    // Half of them on a lattice, where many things happen at the same time.
    const bool ties = round % 2 == 1;
    const auto rounded = [&](Vec p) {
      for (double& x : p) x = ties ? std::round(8 * x) / 8 : x;
      return p;
    };
    std::deque<std::vector<double>> arrays;
    Rng again = rng_;
    Ground grounds[2] = {make(rng_, ties), make(again, ties)};
    ScenePtr scenes[2] = {make_scene(grounds[0].environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS),
                          make_scene(grounds[1].environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS)};
    std::vector<BodyPlan> plans;
    std::vector<double> radii;
    std::vector<Walker> walkers[2];
    for (int tries = 0; tries < 100 && plans.size() < 3; ++tries) {
      BodyPlan made = plan(0.5);
      for (Vec& p : made.at) p = rounded(p);
      Walker walker{};
      walker.level = GetParam().level;
      walker.self = rng_.chance(0.7);
      const double radius = rng_.chance(0.6) ? 0 : ties ? 0.125 : rng_.range(0.01, 0.1);
      if (create_body(scenes[0].get(), made, walker.level, flags(walker.self), {}, &walker.id, radius) != DSW_STATUS_OK)
        continue;
      plans.push_back(made);
      radii.push_back(radius);
      walkers[0].push_back(walker);
    }
    std::vector<std::vector<uint32_t>> new_of(plans.size());
    for (size_t i = plans.size(); i-- > 0;) {
      std::vector<uint32_t>& to = new_of[i];
      to.resize(plans[i].at.size());
      std::iota(to.begin(), to.end(), 0u);
      for (size_t k = to.size(); k > 1; --k) std::swap(to[k - 1], to[rng_.below(k)]);
      BodyPlan other = plans[i];
      for (size_t v = 0; v < to.size(); ++v) other.at[to[v]] = plans[i].at[v];
      for (auto& edge : other.edges) edge = {to[edge[1]], to[edge[0]]};
      for (auto& face : other.faces) face = {to[face[1]], to[face[2]], to[face[0]]};
      std::reverse(other.edges.begin(), other.edges.end());
      std::reverse(other.faces.begin(), other.faces.end());
      Walker walker = walkers[0][i];
      ASSERT_EQ(create_body(scenes[1].get(), other, walker.level, flags(walker.self), {}, &walker.id, radii[i]),
                DSW_STATUS_OK);
      walkers[1].push_back(walker);
    }
    for (int side = 0; side < 2; ++side) {
      for (Walker& each : walkers[side]) ASSERT_EQ(read_body(scenes[side].get(), each.id, each.state), "");
    }
    for (int step = 0; step < 2; ++step) {
      choose_ends(grounds[0], walkers[0]);
      for (Vec& p : grounds[0].next) p = rounded(p);
      grounds[1].next = grounds[0].next;
      for (size_t i = 0; i < plans.size(); ++i) {
        Walker &of = walkers[0][i], &other = walkers[1][plans.size() - 1 - i];
        other.stands = of.stands;
        other.end = other.state.at;
        for (Vec& p : of.end) p = of.stands ? p : rounded(p);
        // No edge gets the length 0.
        if (std::set<Vec>(of.end.begin(), of.end.end()).size() != of.end.size()) of.end = of.state.at;
        for (size_t v = 0; v < of.end.size(); ++v) other.end[new_of[i][v]] = of.end[v];
      }
      dsw_scene_deform_options options = defaults(dsw_scene_deform_options_init);
      options.stop = rng_.chance(0.5) ? DSW_TOGETHER_STOP_ALL : DSW_TOGETHER_STOP_FEATURE;
      if (options.stop == DSW_TOGETHER_STOP_FEATURE)
        options.response = static_cast<dsw_together_response>(rng_.below(3u));
      const DeformAnswer answers[2] = {
          deform_together(scenes[0].get(), grounds[0], walkers[0], arrays.emplace_back(), options),
          deform_together(scenes[1].get(), grounds[1], walkers[1], arrays.emplace_back(), options)};
      ++moves;
      bool same = answers[0].report.fraction == answers[1].report.fraction && answers[0].points == answers[1].points &&
                  answers[0].walls.size() == answers[1].walls.size() && answers[0].told == answers[1].told &&
                  answers[0].report.invalid_count == answers[1].report.invalid_count &&
                  answers[0].report.held_count == answers[1].report.held_count;
      for (size_t i = 0; i < plans.size(); ++i) {
        const BodyState &of = answers[0].after[i], &other = answers[1].after[plans.size() - 1 - i];
        for (size_t v = 0; v < of.at.size(); ++v) same = same && hex(of.at[v]) == hex(other.at[new_of[i][v]]);
      }
      different += same ? 0 : 1;
      contacts += answers[0].walls.size();
      refused += answers[0].report.fraction == 0 ? 1 : 0;
      for (int side = 0; side < 2; ++side) {
        faults += answers[side].faults;
        grounds[side].points = answers[side].points;
        const size_t wrong = misplaced(grounds[side], answers[side].after, false),
                     kept = not_free(scenes[side].get(), walkers[side]);
        occupied += wrong + kept;
        EXPECT_EQ(wrong + kept, 0u) << "round " << round << " step " << step << ": misplaced " << wrong << ", not free "
                                    << kept << ", fraction " << answers[side].report.fraction;
        for (size_t i = 0; i < plans.size(); ++i) walkers[side][i].state = answers[side].after[i];
      }
      EXPECT_TRUE(same) << "round " << round << " step " << step << " stop " << options.stop << " response "
                        << options.response << ": fractions " << answers[0].report.fraction << " "
                        << answers[1].report.fraction << ", told " << answers[0].told << " " << answers[1].told
                        << ", walls " << answers[0].walls.size() << " " << answers[1].walls.size() << ", invalid "
                        << answers[0].report.invalid_count << " " << answers[1].report.invalid_count;
      if (HasFailure()) break;
    }
    if (HasFailure()) break;
  }
  std::printf("%s: %zu moves, %zu contacts with walls, %zu refused; different %zu, not free %zu, faults %zu\n",
              GetParam().name, moves, contacts, refused, different, occupied, faults);
  record_moves(moves, 0, occupied, different);
  EXPECT_EQ(different + faults + occupied, 0u);
}

TEST_P(TogetherDeformTest, WhatRestsOnWallsIsCarried) {
  size_t moves = 0, stopped = 0, faults = 0, occupied = 0, resting = 0, carried = 0, stopped_again = 0;
  const int rounds = effort_of(60);
  for (int round = 0; round < rounds; ++round) {
    std::deque<std::vector<double>> arrays;
    // On a lattice: exactly on walls, and carried exactly.
    const bool ties = round % 2 == 0;
    Ground ground = make(rng_, ties);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING);
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 100 && walkers.size() < 3; ++tries) {
      BodyPlan made = plan(0.5);
      for (Vec& p : made.at) {
        for (double& x : p) x = ties ? std::round(2 * x) / 2 : x;
      }
      Walker walker{};
      walker.level = GetParam().level;
      if (create_body(scene.get(), made, walker.level, flags(false), {}, &walker.id) != DSW_STATUS_OK) continue;
      EXPECT_EQ(read_body(scene.get(), walker.id, walker.state), "");
      walkers.push_back(walker);
    }
    const auto go = [&](const auto& place, bool walls_go) {
      ground.next = ground.points;
      for (Vec& p : ground.next) p = walls_go ? place(p) : p;
      for (Walker& each : walkers) {
        for (Vec& p : each.end = each.state.at) p = place(p);
      }
      const DeformAnswer answer = deform_together(scene.get(), ground, walkers, arrays.emplace_back());
      ground.points = answer.points;
      faults += answer.faults;
      occupied += misplaced(ground, answer.after, false) + not_free(scene.get(), walkers);
      for (size_t i = 0; i < walkers.size(); ++i) walkers[i].state = answer.after[i];
      return answer;
    };
    if (ties) {
      for (int step = 0; step < 3; ++step) {
        Vec way = beside({0, 0, 0}, 2);
        for (double& x : way) x = std::round(8 * x) / 8;
        const DeformAnswer answer = go(
            [&](const Vec& p) {
              return Vec{p[0] + way[0], p[1] + way[1], p[2] + way[2]};
            },
            true);
        ++moves;
        stopped += answer.report.fraction != 1 || answer.told <= 1 ? 1 : 0;
      }
      continue;
    }
    // Against a wall first, and then with it: ends are rounded, so what is very near can come nearer.
    const Vec way = beside({0, 0, 0}, 2);
    const DeformAnswer first = go(
        [&](const Vec& p) {
          return Vec{p[0] + way[0], p[1] + way[1], p[2] + way[2]};
        },
        false);
    if (first.told > 1) continue;
    ++resting;
    for (int step = 0; step < 2; ++step) {
      const Affine carry = rigid();
      const DeformAnswer answer = go(carry, true);
      ++carried;
      stopped_again += answer.report.fraction != 1 ? 1 : 0;
    }
  }
  std::printf(
      "%s: %zu moves on a lattice; stopped %zu, not free %zu, faults %zu; of %zu that rest after a stop and are "
      "carried "
      "twice %zu of %zu stop\n",
      GetParam().name, moves, stopped, occupied, faults, resting, stopped_again, carried);
  EXPECT_EQ(stopped + faults + occupied, 0u);
}

/// Points of a lattice moved by what is small beside it, and large beside rounding: so ties are decided as by the shift.
Vec shifted(const Vec& p, int dimension) {
  return {p[0] + 0x1p-12, p[1] + 0x1p-24, dimension == 3 ? p[2] + 0x1p-36 : 0};
}

TEST_P(TogetherDeformTest, TiesAreThoseOfTheShift) {
  size_t moves = 0, touches = 0, missed = 0, made_up = 0, early = 0, halved = 0, faults = 0, occupied = 0;
  const int rounds = effort_of(200);
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> array;
    Ground ground = make(rng_, true);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING);
    const auto rounded = [](Vec p) {
      for (double& x : p) x = std::round(4 * x) / 4;
      return p;
    };
    BodyPlan made = plan(0.5);
    for (Vec& p : made.at) p = rounded(p);
    std::vector<Walker> walkers(1);
    walkers[0].level = GetParam().level;
    if (create_body(scene.get(), made, GetParam().level, flags(false), {}, &walkers[0].id) != DSW_STATUS_OK) continue;
    ASSERT_EQ(read_body(scene.get(), walkers[0].id, walkers[0].state), "");
    walkers[0].end = made.at;
    const Vec way = beside({0, 0, 0}, 1), way_of_walls = beside({0, 0, 0}, 1);
    for (Vec& p : walkers[0].end) {
      for (size_t k = 0; k < 3; ++k) p[k] += way[k];
      if (round % 3 == 0) p = beside(p, 0.5);
      p = rounded(p);
    }
    ground.next = ground.points;
    for (Vec& p : ground.next) {
      if (round % 2 == 0) {
        for (size_t k = 0; k < 3; ++k) p[k] += way_of_walls[k];
      }
      if (rng_.chance(0.1)) p = beside(p, 0.3);
      p = rounded(p);
    }
    if (!all_stay_valid(ground, false)) continue;
    const DeformAnswer answer = deform_together(scene.get(), ground, walkers, array);
    occupied += not_free(scene.get(), walkers);
    faults += answer.faults;
    halved += answer.report.invalid_count != 0 ? 1 : 0;
    for (Vec& p : walkers[0].state.at) p = shifted(p, dimension());
    for (Vec& p : walkers[0].end) p = shifted(p, dimension());
    const double truth = first_time(ground, walkers, false), fraction = answer.report.fraction;
    ++moves;
    touches += truth <= 1 ? 1 : 0;
    missed += truth <= 1 && fraction == 1 ? 1 : 0;
    made_up += truth > 1 && fraction != 1 ? 1 : 0;
    early += truth <= 1 && fraction < truth - 0.01 ? 1 : 0;
    scene.reset();
    ground.environment.reset();  // before what it reads
  }
  std::printf(
      "%s: %zu moves, %zu with a touch; missed %zu, not free %zu, halved %zu, faults %zu; touched without passing: "
      "made up %zu, early %zu\n",
      GetParam().name, moves, touches, missed, occupied, halved, faults, made_up, early);
  record_moves(moves, missed, occupied, 0);
  EXPECT_EQ(missed + occupied + halved + faults, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, TogetherDeformTest, testing::ValuesIn(kAllKinds),
                         [](const testing::TestParamInfo<Kind>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dsw::oracle
