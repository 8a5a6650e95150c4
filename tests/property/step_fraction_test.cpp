// The largest free fraction of steps, beside rational numbers: the ways to the rounded places touch nothing, those of the next
// double do, and nothing has moved. Figures are printed.
#include "together_support.h"

#include <cmath>

namespace dsw::oracle {
namespace {

struct StepKind {
  const char* name;
  int dimension;
  dsw_level level;
  bool walls_move;
};
std::ostream& operator<<(std::ostream& out, const StepKind& each) { return out << each.name; }

struct StepAnswer {
  double fraction;
  std::vector<double> fractions, places, environment_places;
};

class StepFractionTest : public WaysTest<StepKind> {
 protected:
  StepFractionTest() : WaysTest(23) {}

  size_t width() const { return static_cast<size_t>(dimension()); }

  std::vector<Walker> make_walkers(dsw_scene* scene, size_t count) {
    std::vector<Walker> walkers;
    for (int tries = 0; tries < 200 && walkers.size() < count; ++tries) {
      Walker walker{};
      walker.level = GetParam().level;
      walker.self = rng_.chance(0.7);
      const uint32_t flags = (walker.self ? DSW_BODY_SELF_CONTACTS : 0) | (rng_.chance(0.3) ? DSW_BODY_SEQUENCES : 0);
      if (create_body(scene, plan(0.5), walker.level, flags, {}, &walker.id) != DSW_STATUS_OK) continue;
      EXPECT_EQ(read_body(scene, walker.id, walker.state), "");
      walkers.push_back(walker);
    }
    return walkers;
  }
  /// Steps of some size, small ones too: rounding then matters for the fraction.
  std::vector<Vec> choose_steps(const std::vector<Vec>& points, double size, double share) {
    std::vector<Vec> steps(points.size(), Vec{0, 0, 0});
    const Vec way = beside({0, 0, 0}, size);
    for (Vec& step : steps) {
      if (rng_.chance(share)) continue;
      for (size_t k = 0; k < 3; ++k) step[k] += way[k];
      step = beside(step, size * 0.3);
    }
    return steps;
  }
  static Vec at(const Vec& from, const Vec& step, double fraction) {
    Vec to = from;
    for (size_t k = 0; k < 3; ++k) {
      const volatile double part = fraction * step[k];
      to[k] = from[k] + part;
    }
    return to;
  }
  double first_time(const Ground& ground, const std::vector<Walker>& walkers, bool exact) {
    return dimension() == 2 ? oracle::first_time<2>(ground, walkers, exact)
                            : oracle::first_time<3>(ground, walkers, exact);
  }
  /// When something is touched on the ways to the places at fractions.
  double time_to(Ground& ground, std::vector<Walker> walkers, const std::vector<double>& fractions, bool exact) {
    for (size_t i = 0; i < walkers.size(); ++i) {
      for (size_t v = 0; v < walkers[i].end.size(); ++v) {
        walkers[i].end[v] = at(walkers[i].state.at[v], steps_[i][v], fractions[i]);
      }
    }
    if (GetParam().walls_move) {
      ground.next = ground.points;
      for (size_t v = 0; v < ground.points.size(); ++v) {
        ground.next[v] = at(ground.points[v], of_ground_[v], fractions.empty() ? 1 : fractions[0]);
      }
    }
    const double time = first_time(ground, walkers, exact);
    ground.next.clear();
    return time;
  }
  std::vector<double> flat(const std::vector<Vec>& points) const {
    std::vector<double> all;
    for (const Vec& p : points) all.insert(all.end(), p.begin(), p.begin() + dimension());
    return all;
  }
  StepAnswer ask(dsw_scene* scene, const std::vector<Walker>& walkers, size_t points, dsw_together_stop stop) {
    StepAnswer answer{};
    dsw_together_options options = defaults(dsw_together_options_init);
    options.stop = stop;
    std::vector<dsw_body_id> ids;
    std::vector<double> steps;
    for (size_t i = 0; i < walkers.size(); ++i) {
      ids.push_back(walkers[i].id);
      const std::vector<double> own = flat(steps_[i]);
      steps.insert(steps.end(), own.begin(), own.end());
    }
    const std::vector<double> of_ground = GetParam().walls_move ? flat(of_ground_) : std::vector<double>();
    answer.fractions.resize(walkers.size());
    answer.places.resize(steps.size());
    answer.environment_places.resize(of_ground.size());
    EXPECT_EQ(dsw_scene_step_fraction(scene, ids.data(), ids.size(), steps.data(), steps.size() / width(), 0,
                                      of_ground.empty() ? nullptr : of_ground.data(), of_ground.empty() ? 0 : points,
                                      &options, &answer.fraction, answer.fractions.data(), answer.places.data(),
                                      answer.environment_places.data()),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    return answer;
  }

  std::vector<std::vector<Vec>> steps_;
  std::vector<Vec> of_ground_;
};

TEST_P(StepFractionTest, TheLargestFreeFraction) {
  size_t asked = 0, stops = 0, crossed = 0, not_largest = 0, short_of = 0, misplaced = 0, moved = 0, differ = 0,
         tiny = 0;
  const int rounds = at_least(dimension() == 2 ? 240 : 24);  // what only rounding touches is rare
  for (int round = 0; round < rounds; ++round) {
    Ground ground = make_ground(dimension(), 3, 0.15, 0.2, round % 3 == 0, rng_);
    ASSERT_NE(ground.environment, nullptr);
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = make_walkers(scene.get(), 1 + rng_.below(3));
    for (int step = 0; step < 4 && !walkers.empty(); ++step) {
      const double size = std::pow(10.0, rng_.range(-1, 0.2)), wall = 0.03;
      const std::string where = "round " + std::to_string(round) + " step " + std::to_string(step);
      const bool exact = round % 4 == 0;
      steps_.clear();
      of_ground_ = choose_steps(ground.points, wall, 0.3);
      for (Walker& each : walkers) {
        each.end = each.state.at;
        steps_.push_back(choose_steps(each.state.at, size, 0.1));
      }
      const double truth = time_to(ground, walkers, std::vector<double>(walkers.size(), 1), exact);
      for (const dsw_together_stop stop : {DSW_TOGETHER_STOP_ALL, DSW_TOGETHER_STOP_ISLAND}) {
        const StepAnswer answer = ask(scene.get(), walkers, ground.points.size(), stop);
        const bool by_island = stop == DSW_TOGETHER_STOP_ISLAND;
        ++asked;
        stops += answer.fraction < 1 ? 1 : 0;
        tiny += answer.fraction < 1e-6 ? 1 : 0;
        std::vector<double> fractions = answer.fractions;
        if (!by_island) fractions.assign(walkers.size(), answer.fraction);
        const bool crosses = time_to(ground, walkers, fractions, exact) <= 1;
        EXPECT_FALSE(crosses) << where << " fraction " << answer.fraction << " truth " << truth;
        crossed += crosses ? 1 : 0;
        const std::vector<double> next(walkers.size(), std::nextafter(answer.fraction, 2));
        const bool is_largest = answer.fraction == 1 || time_to(ground, walkers, next, exact) <= 1;
        EXPECT_TRUE(is_largest) << where << " fraction " << answer.fraction << " truth " << truth;
        not_largest += is_largest ? 0 : 1;
        short_of += answer.fraction < std::min(truth, 1.0) - 1e-11 / size ? 1 : 0;
        if (*std::min_element(answer.fractions.begin(), answer.fractions.end()) < answer.fraction) ++differ;
        std::vector<double> places;
        for (size_t i = 0; i < walkers.size(); ++i) {
          for (size_t v = 0; v < walkers[i].state.at.size(); ++v) {
            const Vec p = at(walkers[i].state.at[v], steps_[i][v], fractions[i]);
            places.insert(places.end(), p.begin(), p.begin() + dimension());
          }
          BodyState now;
          EXPECT_EQ(read_body(scene.get(), walkers[i].id, now), "");
          moved += now.at == walkers[i].state.at ? 0 : 1;
        }
        misplaced += places == answer.places ? 0 : 1;
        if (GetParam().walls_move) {
          for (size_t v = 0; v < ground.points.size(); ++v) {
            const Vec p = at(ground.points[v], of_ground_[v], answer.fraction);
            misplaced +=
                std::equal(p.begin(), p.begin() + dimension(), &answer.environment_places[v * width()]) ? 0 : 1;
          }
        } else if (by_island) {
          // A move to these places makes its whole way.
          for (size_t i = 0, at = 0; i < walkers.size(); ++i) {
            for (Vec& p : walkers[i].end) {
              std::copy_n(&places[at], width(), p.begin());
              at += width();
            }
          }
          const TogetherAnswer made = move_together(scene.get(), walkers, stop);
          for (size_t i = 0; i < walkers.size(); ++i) {
            misplaced += made.after[i].at == walkers[i].end && made.reports[i].fraction == 1 ? 0 : 1;
            walkers[i].state = made.after[i];
          }
        }
      }
    }
  }
  std::printf(
      "%s: %zu asked, %zu stop, %zu below 1e-6; crossed %zu, not largest %zu, short %zu, misplaced %zu, moved %zu\n",
      GetParam().name, asked, stops, tiny, crossed, not_largest, short_of, misplaced, moved);
  record_moves(asked, crossed, moved, not_largest);
  EXPECT_EQ(crossed + not_largest + short_of + misplaced + moved + differ, 0u);
  EXPECT_GT(stops, asked / 20);
}

const std::vector<StepKind> kStepKinds = {
    {"points_in_the_plane", 2, DSW_LEVEL_POINTS, false},
    {"edges_in_the_plane", 2, DSW_LEVEL_EDGES_SWEPT, false},
    {"edges", 3, DSW_LEVEL_EDGES, false},
    {"faces", 3, DSW_LEVEL_FACES, false},
    {"walls_in_the_plane", 2, DSW_LEVEL_EDGES, true},
    {"walls", 3, DSW_LEVEL_FACES, true},
};

INSTANTIATE_TEST_SUITE_P(Kinds, StepFractionTest, testing::ValuesIn(drawn_for("StepFractionTest", kStepKinds, 8)),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace dsw::oracle
