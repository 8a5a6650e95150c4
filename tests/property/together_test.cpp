// All vertices of bodies move at once: nothing is missed, nothing is passed, all is free afterwards. Figures are printed.
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

class TogetherTest : public testing::TestWithParam<Kind> {
 protected:
  int dimension() const { return GetParam().dimension; }
  Vec random_point(double low, double high) {
    Vec p = {0, 0, 0};
    for (int k = 0; k < dimension(); ++k) p[static_cast<size_t>(k)] = rng_.range(low, high);
    return p;
  }
  Vec beside(Vec p, double reach) {
    for (int k = 0; k < dimension(); ++k) p[static_cast<size_t>(k)] += rng_.range(-reach, reach);
    return p;
  }
  /// A walk, a tree, a strip of triangles or lone vertices.
  BodyPlan plan() {
    BodyPlan made;
    const uint32_t kind = rng_.below(4);
    const auto count = static_cast<uint32_t>(rng_.between(2, 8));
    made.at.push_back(sheared(random_point(0.2, 2.8), dimension()));
    for (uint32_t i = 1; i < count; ++i) {
      const uint32_t from = kind == 1 ? rng_.below(i) : i - 1;
      made.at.push_back(beside(made.at[from], 0.6));
      if (kind == 0 || kind == 1) made.edges.push_back({from, i});
      if (kind == 2 && dimension() == 2) made.edges.push_back({from, i});
      if (kind == 2 && i >= 2 && dimension() == 3) {
        made.faces.push_back(i % 2 == 0 ? std::vector<uint32_t>{i - 2, i - 1, i}
                                        : std::vector<uint32_t>{i - 1, i - 2, i});
      }
    }
    return made;
  }
  std::vector<Walker> make_walkers(dsw_scene* scene, size_t count) {
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 200 && walkers.size() < count; ++tries) {
      Walker walker{};
      walker.level = GetParam().level;
      walker.self = rng_.chance(0.7);
      const uint32_t flags = walker.self ? DSW_BODY_SELF_CONTACTS : 0;
      if (create_body(scene, plan(), walker.level, flags, {}, &walker.id) != DSW_STATUS_OK) continue;
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

  Rng rng_{11};
};

TEST_P(TogetherTest, StopAllMissesNothingAndPassesNothing) {
  size_t moves = 0, touches = 0, missed = 0, made_up = 0, wrong_time = 0, passed = 0, not_free = 0, short_of = 0;
  const int rounds = share_of(60);
  for (int round = 0; round < rounds; ++round) {
    const Ground ground = make_ground(dimension(), 3, 0.25, GetParam().marked, GetParam().thin, rng_);
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
  std::printf("%s: %zu moves, %zu with a touch; missed %zu, made up %zu, wrong time %zu, passed %zu, not free %zu, "
              "short %zu\n",
              GetParam().name, moves, touches, missed, made_up, wrong_time, passed, not_free, short_of);
  EXPECT_EQ(missed + made_up + wrong_time + passed + not_free + short_of, 0u);
  EXPECT_GT(touches, moves / 20);
}

TEST_P(TogetherTest, WhatGoesOnIsFreeToo) {
  size_t moves = 0, contacts = 0, not_free = 0, reached = 0;
  const int rounds = share_of(60);
  for (int round = 0; round < rounds; ++round) {
    const Ground ground = make_ground(dimension(), 3, 0.25, GetParam().marked, GetParam().thin, rng_);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = make_walkers(scene.get(), 1 + rng_.below(4));
    for (int step = 0; step < 4 && !walkers.empty(); ++step) {
      choose_ends(walkers);
      const dsw_together_stop stop = round % 2 == 0 ? DSW_TOGETHER_STOP_FEATURE : DSW_TOGETHER_STOP_ISLAND;
      const TogetherAnswer answer = move_together(scene.get(), walkers, stop);
      ++moves;
      for (size_t i = 0; i < walkers.size(); ++i) {
        contacts += answer.contacts[i].size();
        reached += answer.reports[i].vertices_stopped == 0 ? 1 : 0;
      }
      walkers = resting(walkers, answer);
      not_free += first_time(ground, walkers, round % 4 == 0) <= 1 ? 1 : 0;
    }
  }
  std::printf("%s: %zu moves, %zu contacts, %zu bodies arrived; not free %zu\n", GetParam().name, moves, contacts,
              reached, not_free);
  EXPECT_EQ(not_free, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    All, TogetherTest,
    testing::Values(Kind{"Points", 3, DSW_LEVEL_POINTS, 0.1, false, 0.8},
                    Kind{"Edges", 3, DSW_LEVEL_EDGES, 0.1, false, 0.5},
                    Kind{"EdgesSwept", 3, DSW_LEVEL_EDGES_SWEPT, 0.1, true, 0.3},
                    Kind{"EdgesShort", 3, DSW_LEVEL_EDGES_SWEPT, 0.02, false, 0.05},
                    Kind{"Faces", 3, DSW_LEVEL_FACES, 0.05, true, 0.3},
                    Kind{"FacesFar", 3, DSW_LEVEL_FACES, 0.05, false, 1.5},
                    Kind{"PlanePoints", 2, DSW_LEVEL_POINTS, 0.1, false, 0.8},
                    Kind{"PlaneEdges", 2, DSW_LEVEL_EDGES, 0.1, true, 0.5},
                    Kind{"PlaneEdgesSwept", 2, DSW_LEVEL_EDGES_SWEPT, 0.05, true, 0.15}),
    [](const testing::TestParamInfo<Kind>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dsw::oracle
