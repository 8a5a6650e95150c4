// An environment bends while bodies move, all at once, and only the parts that touch stop, slide or are carried: nothing is missed, nothing is
// passed, all is free afterwards, and numbers do not matter. Figures are printed.
#include "together_deform_kinds.h"

namespace dsw::oracle {
namespace {

class TogetherDeformPartsTest : public BendingTest {
 protected:
  TogetherDeformPartsTest() : BendingTest(7) {}

  static dsw_scene_deform_options options(uint32_t rounds, uint32_t response) {
    dsw_scene_deform_options made = defaults(dsw_scene_deform_options_init);
    made.stop = DSW_TOGETHER_STOP_FEATURE;
    made.max_rounds = rounds;
    made.response = static_cast<dsw_together_response>(response);
    return made;
  }
  /// What the call did to vertices of bodies, and to points of the environment.
  struct Arrivals {
    size_t there = 0, stopped = 0;
    void count(const Ground& ground, const std::vector<Walker>& walkers, const DeformAnswer& answer) {
      for (size_t v = 0; v < ground.next.size(); ++v) ++(answer.points[v] == ground.next[v] ? there : stopped);
      for (size_t i = 0; i < walkers.size(); ++i) {
        for (size_t v = 0; v < walkers[i].end.size(); ++v)
          ++(answer.after[i].at[v] == walkers[i].end[v] ? there : stopped);
      }
    }
  };
};

TEST_P(TogetherDeformPartsTest, MissesNothingAndPassesNothing) {
  size_t moves = 0, touches = 0, missed = 0, made_up = 0, wrong_time = 0, passed = 0, occupied = 0, halvings = 0,
         halved_for_nothing = 0, misplaced_vertices = 0, faults = 0, folded = 0, held = 0, all_stopped = 0;
  Arrivals arrivals[3];
  for (int round = 0; round < effort_of(40); ++round) {
    std::deque<std::vector<double>> arrays;
    Ground ground = make(rng_);
    ASSERT_NE(ground.environment, nullptr);
    const bool exact = round % 8 == 0;
    ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
    std::vector<Walker> walkers = make_walkers(scene.get(), rng_.below(4u), rng_.below(4u));
    for (int step = 0; step < kSteps; ++step) {
      std::string where = "round " + std::to_string(round) + " step " + std::to_string(step);
      choose_ends(ground, walkers);
      const double truth = first_time(ground, walkers, exact);
      const bool valid = all_stay_valid(ground, exact);
      const uint32_t limits[] = {0, 0, 1, 3};
      const uint32_t response = rng_.below(3u);
      const DeformAnswer answer = deform_together(scene.get(), ground, walkers, arrays.emplace_back(),
                                                  options(limits[rng_.below(4u)], response));
      ASSERT_EQ(answer.status, DSW_STATUS_OK);
      where += " response " + std::to_string(response);
      const bool halved = answer.report.invalid_count != 0, touched = answer.told <= 1;
      ++moves;
      touches += touched ? 1 : 0;
      halvings += halved ? 1 : 0;
      held += answer.report.held_count;
      faults += answer.faults;
      halved_for_nothing += valid && halved ? 1 : 0;
      arrivals[response].count(ground, walkers, answer);
      if (valid && !halved) {
        all_stopped += answer.report.fraction < 1 ? 1 : 0;
        missed += truth <= 1 && !touched ? 1 : 0;
        made_up += truth > 1 && (touched || answer.report.outcome != DSW_DEFORM_DONE) ? 1 : 0;
        for (const dsw_move_report& each : answer.reports) {
          if (answer.report.fraction == 1) wrong_time += each.fraction != std::min(truth, 1.0) ? 1 : 0;
        }
      }
      EXPECT_EQ(answer.faults + missed + made_up + wrong_time + halved_for_nothing, 0u)
          << where << " truth " << truth << " told " << answer.told << " fraction " << answer.report.fraction
          << " valid " << valid << " invalid " << answer.report.invalid_count << " faults " << answer.faults;
      // On the ways that were made.
      ground.next = answer.points;
      for (size_t i = 0; i < walkers.size(); ++i) walkers[i].end = answer.after[i].at;
      const bool is_folded = !all_stay_valid(ground, exact);
      folded += is_folded ? 1 : 0;
      if (!is_folded) {
        const bool passes = first_time(ground, walkers, exact) <= 1;
        EXPECT_FALSE(passes) << where << " passed something";
        passed += passes ? 1 : 0;
      }
      misplaced_vertices += misplaced(ground, answer.after, !is_folded);
      ground.points = answer.points;
      ground.next.clear();
      for (size_t i = 0; i < walkers.size(); ++i) walkers[i].state = answer.after[i];
      occupied += not_free(scene.get(), walkers);
      EXPECT_EQ(misplaced_vertices + occupied, 0u) << where;
      if (HasFailure()) break;
    }
    if (HasFailure()) break;
  }
  std::printf(
      "%s: %zu moves, %zu with touches, %zu halved, %zu folded, %zu points held, places where wanted and not "
      "%zu %zu (stop), %zu %zu (slide), %zu %zu (carry), all stopped %zu; missed %zu, false stops %zu, wrong time %zu, "
      "passed %zu, not free %zu, misplaced %zu, halved for "
      "nothing %zu, faults %zu\n",
      GetParam().name, moves, touches, halvings, folded, held, arrivals[0].there, arrivals[0].stopped,
      arrivals[1].there, arrivals[1].stopped, arrivals[2].there, arrivals[2].stopped, all_stopped, missed, made_up,
      wrong_time, passed, occupied, misplaced_vertices, halved_for_nothing, faults);
  record_moves(moves, missed + passed, occupied + misplaced_vertices, 0);
  EXPECT_EQ(missed + made_up + wrong_time + passed + occupied + misplaced_vertices + halved_for_nothing + faults, 0u);
  EXPECT_TRUE(moves < 100 || touches > moves / 20);
}

INSTANTIATE_TEST_SUITE_P(All, TogetherDeformPartsTest, testing::ValuesIn(kAllKinds),
                         [](const testing::TestParamInfo<Kind>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dsw::oracle
