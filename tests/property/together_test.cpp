// All vertices of bodies move at once: nothing is missed, nothing is passed, all is free afterwards. Figures are
// printed.
#include "together_support.h"

#include <cmath>

namespace dsw::oracle {
namespace {

struct Kind {
  const char* name;
  int dimension;
  dsw_level level;
  double marked;
  bool thin;
  double reach;  // of moves
};
std::ostream& operator<<(std::ostream& out, const Kind& each) { return out << each.name; }

class TogetherTest : public WaysTest<Kind> {
 protected:
  TogetherTest() : WaysTest(11) {}

  std::vector<Walker> make_walkers(dsw_scene* scene, size_t count) {
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 200 && walkers.size() < count; ++tries) {
      Walker walker{};
      walker.level = GetParam().level;
      walker.self = rng_.chance(0.7);
      const uint32_t flags = walker.self ? DSW_BODY_SELF_CONTACTS : 0;
      if (create_body(scene, plan(0.6), walker.level, flags, {}, &walker.id) != DSW_STATUS_OK) continue;
      EXPECT_EQ(read_body(scene, walker.id, walker.state), "");
      walkers.push_back(walker);
    }
    return walkers;
  }
  void choose_ends(std::vector<Walker>& walkers) {
    for (Walker& each : walkers) {
      each.end = each.state.at;
      const Vec way = beside({0, 0, 0}, GetParam().reach);
      for (Vec& p : each.end) {
        if (rng_.chance(0.1)) continue;
        for (size_t k = 0; k < 3; ++k) p[k] += way[k];
        p = beside(p, GetParam().reach * 0.3);
      }
    }
  }
  double first_time(const Ground& ground, const std::vector<Walker>& walkers, bool exact) {
    return dimension() == 2 ? oracle::first_time<2>(ground, walkers, exact)
                            : oracle::first_time<3>(ground, walkers, exact);
  }
  static std::vector<Walker> gone(std::vector<Walker> walkers, const TogetherAnswer& answer) {
    for (size_t i = 0; i < walkers.size(); ++i) walkers[i].end = answer.after[i].at;
    return walkers;
  }
  static std::vector<Walker> resting(std::vector<Walker> walkers, const TogetherAnswer& answer) {
    for (size_t i = 0; i < walkers.size(); ++i) walkers[i].state = answer.after[i], walkers[i].end = answer.after[i].at;
    return walkers;
  }
};

TEST_P(TogetherTest, StopAllMissesNothingAndPassesNothing) {
  size_t moves = 0, touches = 0, missed = 0, made_up = 0, wrong_time = 0, passed = 0, not_free = 0, short_of = 0;
  const int rounds = at_least(60);
  const auto touch_enough = [&] { return touches > moves / 20; };
  for (int round = 0; round < rounds || (!touch_enough() && round < 10 * rounds); ++round) {
    const Ground ground = make_ground(dimension(), 3, 0.15, GetParam().marked, GetParam().thin, rng_);
    ASSERT_NE(ground.environment, nullptr);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = make_walkers(scene.get(), 1 + rng_.below(3));
    for (int step = 0; step < 4 && !walkers.empty(); ++step) {
      choose_ends(walkers);
      const double truth = first_time(ground, walkers, round % 4 == 0);
      const TogetherAnswer answer = move_together(scene.get(), walkers, DSW_TOGETHER_STOP_ALL);
      ++moves;
      size_t contacts = 0;
      double told = 2;
      for (const auto& each : answer.contacts) {
        contacts += each.size();
        for (const dsw_body_contact& contact : each) told = std::min(told, contact.time);
      }
      const double fraction = answer.reports[0].fraction;
      if (truth <= 1) {
        ++touches;
        missed += contacts == 0 ? 1 : 0;
        wrong_time += contacts != 0 && told != truth ? 1 : 0;
        short_of += fraction < truth - 1e-9 ? 1 : 0;
        passed += fraction > truth ? 1 : 0;
      } else {
        made_up += contacts != 0 || fraction != 1 ? 1 : 0;
      }
      passed += first_time(ground, gone(walkers, answer), round % 4 == 0) <= 1 ? 1 : 0;
      walkers = resting(walkers, answer);
      not_free += first_time(ground, walkers, false) <= 1 ? 1 : 0;
    }
  }
  std::printf(
      "%s: %zu moves, %zu with a touch; missed %zu, made up %zu, wrong time %zu, passed %zu, not free %zu, "
      "short %zu\n",
      GetParam().name, moves, touches, missed, made_up, wrong_time, passed, not_free, short_of);
  record_moves(moves, missed + passed, not_free, 0);
  EXPECT_EQ(missed + made_up + wrong_time + passed + not_free + short_of, 0u);
  EXPECT_TRUE(touch_enough());
}

TEST_P(TogetherTest, WhatGoesOnIsFreeToo) {
  size_t moves = 0, contacts = 0, passed = 0, not_free = 0, reached = 0;
  const int rounds = effort_of(60);
  for (int round = 0; round < rounds; ++round) {
    const Ground ground = make_ground(dimension(), 3, 0.15, GetParam().marked, GetParam().thin, rng_);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = make_walkers(scene.get(), 1 + rng_.below(4));
    for (int step = 0; step < 4 && !walkers.empty(); ++step) {
      choose_ends(walkers);
      const dsw_together_stop stop = round % 2 == 0 ? DSW_TOGETHER_STOP_FEATURE : DSW_TOGETHER_STOP_ISLAND;
      const TogetherAnswer answer = move_together(scene.get(), walkers, stop, 0, rng_.below(3u));
      ++moves;
      for (size_t i = 0; i < walkers.size(); ++i) {
        contacts += answer.contacts[i].size();
        reached += answer.reports[i].vertices_stopped == 0 ? 1 : 0;
      }
      passed += first_time(ground, gone(walkers, answer), round % 4 == 0) <= 1 ? 1 : 0;
      walkers = resting(walkers, answer);
      not_free += first_time(ground, walkers, round % 4 == 0) <= 1 ? 1 : 0;
    }
  }
  std::printf("%s: %zu moves, %zu contacts, %zu bodies arrived; passed %zu, not free %zu\n", GetParam().name, moves,
              contacts, reached, passed, not_free);
  record_moves(moves, passed, not_free, 0);
  EXPECT_EQ(passed + not_free, 0u);
}

/// Puts the vertices, edges and faces of a body into another order; new_of[v] is what becomes of vertex v.
BodyPlan renumbered(const BodyPlan& plan, Rng& rng, std::vector<uint32_t>& new_of) {
  const auto shuffle = [&](auto& all) {
    for (size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[rng.below(i)]);
  };
  new_of.resize(plan.at.size());
  std::iota(new_of.begin(), new_of.end(), 0u);
  shuffle(new_of);
  BodyPlan other = plan;
  for (size_t v = 0; v < plan.at.size(); ++v) other.at[new_of[v]] = plan.at[v];
  for (auto& edge : other.edges) {
    for (uint32_t& v : edge) v = new_of[v];
    if (rng.chance(0.5)) std::swap(edge[0], edge[1]);
  }
  for (auto& face : other.faces) {
    for (uint32_t& v : face) v = new_of[v];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(rng.below(3u)), face.end());
  }
  shuffle(other.edges);
  shuffle(other.faces);
  return other;
}

TEST_P(TogetherTest, NumbersDoNotMatter) {
  size_t moves = 0, contacts = 0, different = 0, stopped = 0;
  const int rounds = std::max(effort_of(dimension() == 2 ? 600 : 60), 6);  // vertices that meet in the plane are rare
  for (int round = 0; round < rounds; ++round) {
    // Half of them on a lattice, where many things happen at the same time.
    const bool ties = round % 2 == 1;
    const Ground ground = make_ground(dimension(), 3, ties ? 0 : 0.15, GetParam().marked, GetParam().thin, rng_);
    ScenePtr scenes[2] = {make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS),
                          make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS)};
    std::vector<BodyPlan> plans;
    std::vector<bool> selves;
    std::vector<double> radii;
    std::vector<Walker> walkers[2];
    for (int tries = 0; tries < 100 && plans.size() < 3; ++tries) {
      BodyPlan made = plan(0.6);
      for (Vec& p : made.at) {
        for (double& x : p) x = ties ? std::round(4 * x) / 4 : x;
      }
      const bool self = rng_.chance(0.7);
      const double radius = rng_.chance(0.6) ? 0 : ties ? 0.125 : rng_.range(0.01, 0.1);
      dsw_body_id id;
      const uint32_t flags = self ? DSW_BODY_SELF_CONTACTS : 0;
      if (create_body(scenes[0].get(), made, GetParam().level, flags, {}, &id, radius) != DSW_STATUS_OK) continue;
      plans.push_back(made);
      radii.push_back(radius);
      selves.push_back(self);
      walkers[0].push_back({id, GetParam().level, self, {}, made.at});
      for (Vec& p : walkers[0].back().end) {
        p = beside(p, GetParam().reach);
        for (double& x : p) x = ties ? std::round(4 * x) / 4 : x;
      }
    }
    if (plans.empty()) continue;
    std::vector<std::vector<uint32_t>> new_of(plans.size());
    for (size_t i = plans.size(); i-- > 0;) {
      const BodyPlan other = renumbered(plans[i], rng_, new_of[i]);
      dsw_body_id id;
      ASSERT_EQ(create_body(scenes[1].get(), other, GetParam().level, selves[i] ? DSW_BODY_SELF_CONTACTS : 0, {}, &id,
                            radii[i]),
                DSW_STATUS_OK);
      walkers[1].push_back({id, GetParam().level, selves[i], {}, other.at});
      for (size_t v = 0; v < other.at.size(); ++v) walkers[1].back().end[new_of[i][v]] = walkers[0][i].end[v];
    }
    const auto stop = static_cast<dsw_together_stop>(round / 2 % 3);
    const uint32_t response = rng_.below(3u);
    const TogetherAnswer answers[2] = {move_together(scenes[0].get(), walkers[0], stop, 0, response),
                                       move_together(scenes[1].get(), walkers[1], stop, 0, response)};
    ++moves;
    for (size_t i = 0; i < plans.size(); ++i) {
      const size_t k = plans.size() - 1 - i;
      bool same = answers[0].contacts[i].size() == answers[1].contacts[k].size() &&
                  answers[0].reports[i].fraction == answers[1].reports[k].fraction;
      for (size_t v = 0; v < plans[i].at.size(); ++v) {
        same = same && hex(answers[0].after[i].at[v]) == hex(answers[1].after[k].at[new_of[i][v]]);
      }
      different += same ? 0 : 1;
      contacts += answers[0].contacts[i].size();
      stopped += answers[0].reports[i].fraction == 0 ? 1 : 0;
      // It is free where it is: a body in its place can be made.
      BodyPlan there = plans[i];
      there.at = answers[0].after[i].at;
      ScenePtr empty = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
      dsw_body_id copy;
      // What is joined along a body follows from lengths at its creation.
      const uint32_t flags = selves[i] && radii[i] == 0 ? DSW_BODY_SELF_CONTACTS : 0;
      EXPECT_EQ(create_body(empty.get(), there, GetParam().level, flags, {}, &copy, radii[i]), DSW_STATUS_OK)
          << dsw_last_error_message();
    }
  }
  std::printf("%s: %zu moves, %zu contacts, %zu bodies stop at once; different %zu\n", GetParam().name, moves, contacts,
              stopped, different);
  record_moves(moves, 0, 0, different);
  EXPECT_EQ(different, 0u);
}

/// Points of a lattice moved by what is small beside it, and large beside rounding: so ties are decided as by the shift.
Vec shifted(const Vec& p, int dimension) {
  return {p[0] + 0x1p-12, p[1] + 0x1p-24, dimension == 3 ? p[2] + 0x1p-36 : 0};
}

TEST_P(TogetherTest, TiesAreThoseOfTheShift) {
  size_t moves = 0, touches = 0, missed = 0, made_up = 0, stopped_at_once = 0, early = 0;
  const int rounds = effort_of(300);
  for (int round = 0; round < rounds; ++round) {
    const Ground ground = make_ground(dimension(), 3, 0, GetParam().marked, GetParam().thin, rng_);
    ScenePtr scene = make_scene(ground.environment.get());  // bodies do not meet: among them the shift cancels
    BodyPlan made = plan(0.6);
    for (Vec& p : made.at) {
      for (double& x : p) x = std::round(2 * x) / 2;
    }
    std::vector<Walker> walkers(1);
    walkers[0].level = GetParam().level;
    if (create_body(scene.get(), made, GetParam().level, 0, {}, &walkers[0].id) != DSW_STATUS_OK) continue;
    ASSERT_EQ(read_body(scene.get(), walkers[0].id, walkers[0].state), "");
    walkers[0].end = made.at;
    const Vec way = beside({0, 0, 0}, 1);
    for (Vec& p : walkers[0].end) {
      if (round % 2 == 0) {
        for (size_t k = 0; k < 3; ++k) p[k] += way[k];
      } else {
        p = beside(p, 1);
      }
      for (double& x : p) x = std::round(2 * x) / 2;
    }
    const TogetherAnswer answer = move_together(scene.get(), walkers, DSW_TOGETHER_STOP_ALL);
    for (Vec& p : walkers[0].state.at) p = shifted(p, dimension());
    for (Vec& p : walkers[0].end) p = shifted(p, dimension());
    const double truth = first_time(ground, walkers, false);
    const double fraction = answer.reports[0].fraction;
    ++moves;
    touches += truth <= 1 ? 1 : 0;
    missed += truth <= 1 && fraction == 1 ? 1 : 0;
    made_up += truth > 1 && fraction != 1 ? 1 : 0;
    early += truth <= 1 && fraction < truth - 0.01 ? 1 : 0;
    stopped_at_once += fraction == 0 && truth > 0.01 ? 1 : 0;
  }
  std::printf(
      "%s: %zu moves, %zu with a touch; missed %zu; touched without passing: made up %zu, early %zu, of both at the "
      "start %zu\n",
      GetParam().name, moves, touches, missed, made_up, early, stopped_at_once);
  record_moves(moves, missed, 0, 0);
  EXPECT_EQ(missed, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    All, TogetherTest,
    testing::ValuesIn(drawn_for("TogetherTest",
                                std::vector<Kind>{{"Points", 3, DSW_LEVEL_POINTS, 0.1, false, 0.8},
                                                  {"Edges", 3, DSW_LEVEL_EDGES, 0.1, false, 0.5},
                                                  {"EdgesSwept", 3, DSW_LEVEL_EDGES_SWEPT, 0.1, true, 0.3},
                                                  {"EdgesShort", 3, DSW_LEVEL_EDGES_SWEPT, 0.02, false, 0.05},
                                                  {"Faces", 3, DSW_LEVEL_FACES, 0.05, true, 0.3},
                                                  {"FacesFar", 3, DSW_LEVEL_FACES, 0.05, false, 1.5},
                                                  {"PlanePoints", 2, DSW_LEVEL_POINTS, 0.1, false, 0.8},
                                                  {"PlaneEdges", 2, DSW_LEVEL_EDGES, 0.1, true, 0.5},
                                                  {"PlaneEdgesSwept", 2, DSW_LEVEL_EDGES_SWEPT, 0.05, true, 0.15}},
                                8)),
    [](const testing::TestParamInfo<Kind>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dsw::oracle
