// Cuts in random environments of the plane: partitions stay partitions, exactly, and nobody gets lost.
#include "plane_cuts.h"

namespace dsw::oracle {
namespace {

template <class Use>
void for_each_world(uint64_t rounds, bool inhabited, const Use& use) {
  for_each_turn(rounds, [&](const plane::Turn& turn, uint64_t seed) {
    PlaneCuts cuts(turn, seed, inhabited);
    EXPECT_TRUE(cuts.is_made() || turn.may_be_refused());
    if (cuts.is_made()) use(cuts, seed);
  });
}

TEST(PlaneCuts, NothingIsOnBothSidesOfALineButWhatStayedWhole) {
  size_t split = 0, whole = 0, sides = 0;
  for_each_world(4, false, [&](PlaneCuts& cuts, uint64_t seed) {
    ASSERT_EQ(cuts.cut_all(seed), "");
    split += cuts.split;
    whole += cuts.whole;
    sides += cuts.sides_checked;
  });
  RecordProperty("split", static_cast<int>(split));
  RecordProperty("whole", static_cast<int>(whole));
  RecordProperty("ends_of_sides", static_cast<int>(sides));
  EXPECT_GT(split, static_cast<size_t>(effort_of(1000)));
}

TEST(PlaneCuts, WhateverIsCutTornOpenedCarvedAndTied) {
  size_t done[PlaneCuts::kOperations] = {}, occupied[PlaneCuts::kOperations] = {};
  size_t split = 0, whole = 0, opened = 0, parted = 0, points = 0, into_space = 0, crossed = 0;
  for_each_world(4, true, [&](PlaneCuts& cuts, uint64_t) {
    for (int i = 0; i < 10; ++i) ASSERT_EQ(cuts.step(), "") << "step " << i;
    for (size_t k = 0; k < PlaneCuts::kOperations; ++k) {
      done[k] += cuts.done[k];
      occupied[k] += cuts.occupied[k];
    }
    split += cuts.split;
    whole += cuts.whole;
    opened += cuts.opened;
    parted += cuts.parted;
    points += cuts.points_checked;
    into_space += cuts.into_space;
    crossed += cuts.crossed;
  });
  for (size_t k = 0; k < PlaneCuts::kOperations; ++k) {
    RecordProperty("done_" + std::to_string(k), static_cast<int>(done[k]));
    RecordProperty("occupied_" + std::to_string(k), static_cast<int>(occupied[k]));
  }
  RecordProperty("split", static_cast<int>(split));
  RecordProperty("whole", static_cast<int>(whole));
  RecordProperty("opened", static_cast<int>(opened));
  RecordProperty("parted", static_cast<int>(parted));
  RecordProperty("points", static_cast<int>(points));
  RecordProperty("into_space", static_cast<int>(into_space));
  RecordProperty("boundary_crosses", static_cast<int>(crossed));
  for (size_t k = 0; k < PlaneCuts::kOperations; ++k) EXPECT_GT(done[k], static_cast<size_t>(effort_of(50))) << k;
  EXPECT_GT(occupied[PlaneCuts::kCut] + occupied[PlaneCuts::kTear], static_cast<size_t>(effort_of(20)));
  EXPECT_GT(split, static_cast<size_t>(effort_of(500)));
  EXPECT_GT(opened, static_cast<size_t>(effort_of(500)));
  EXPECT_GT(into_space, static_cast<size_t>(effort_of(50)));
  EXPECT_GT(points, static_cast<size_t>(effort_of(500)));
}

/// Angles in doubles once said so of a vertex after a tie: its sides are 1e-12 as high as long, too flat for them.
TEST(PlaneCuts, ASliverIsNotTakenForAFold) {
  const std::vector<plane::Turn> turns = plane::turns("");
  const uint64_t seed = 1013;
  PlaneCuts cuts(turns[(seed - 1) % turns.size()], seed, true);
  ASSERT_TRUE(cuts.is_made());
  for (int i = 0; i < 10; ++i) ASSERT_EQ(cuts.step(), "") << "step " << i;
}

}  // namespace
}  // namespace dsw::oracle
