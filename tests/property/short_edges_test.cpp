// Edges that are seen to be free without a cast change nothing: a scene that counts its casts makes all of them, and tells
// the same of every move.
#include "body_support.h"
#include "sweep_scenes.h"

#include <deque>

namespace dsw::oracle {
namespace {

constexpr uint32_t kBack = DSW_BODY_SKIP_BACK_EDGES, kCells = DSW_BODY_SKIP_BY_ENVIRONMENT,
                   kLeave = DSW_BODY_LEAVE_BACK_EDGES;
constexpr uint32_t kFlags[] = {0,
                               kCells,
                               kBack,
                               kBack | kCells,
                               kBack | kLeave,
                               kBack | kCells | kLeave,
                               DSW_BODY_SKIP_SIMILAR_MOTION,
                               DSW_BODY_SKIP_BY_CLEARANCE | kBack};
constexpr int kMoves = 6;  // of a body

/// All that a move told.
std::string told(const BodyAnswer& answer) {
  const dsw_move_report& r = answer.report;
  std::string text = bits_of(answer);
  for (const uint64_t n :
       {uint64_t{r.edges_swept}, uint64_t{r.edges_skipped}, uint64_t{r.vertices_stopped}, uint64_t{r.contact_count}}) {
    text += std::to_string(n) + " ";
  }
  for (const uint32_t edge : answer.after.untested) text += "u" + std::to_string(edge);
  return text;
}

class ShortEdgesTest : public testing::Test {
 protected:
  /// One body in both scenes, which goes the same ways.
  void run_body(StagePlaces& places, Rng& rng, double size, dsw_scene* const (&scenes)[2]) {
    const bool large = rng.chance(0.5);  // more edges than a chunk has, and more casts than a packet
    const double radius = size * std::pow(10, large ? -rng.range(0.4, 1) : -rng.range(0.7, 2.5));
    const BodyPlan plan = ball(large || rng.chance(0.5) ? places.near(places.obstacle(0.5), 0.1) : places.start(),
                               radius, large ? 80 : 1 + rng.below(4));
    const uint32_t flags = kFlags[rng.below(large ? 4 : std::size(kFlags))];
    dsw_body_id bodies[2];
    for (int k = 0; k < 2; ++k) {
      if (create_body(scenes[k], plan, DSW_LEVEL_EDGES, flags, {}, &bodies[k]) != DSW_STATUS_OK) return;
    }
    std::vector<Vec> at = plan.at;
    for (int move = 0; move < kMoves; ++move) {
      dsw_move_options options = defaults(dsw_move_options_init);
      static const uint32_t limits[] = {0, 0, 1, 4, 7, 8, 50};
      options.max_volumes = limits[rng.below(std::size(limits))];
      const double way = radius * std::pow(10, -rng.range(0, large ? 1 : 3)), bend = rng.chance(0.3) ? way : 0.01 * way;
      Vec drift;
      for (double& x : drift) x = way * rng.range(-1, 1);
      for (Vec& p : at) {
        for (size_t i = 0; i < 3; ++i) p[i] += drift[i] + bend * rng.range(-1, 1);
      }
      BodyAnswer answers[2];
      for (int k = 0; k < 2; ++k) {
        ASSERT_EQ(move_body(scenes[k], bodies[k], at, &options, answers[k]), "");
      }
      ASSERT_EQ(told(answers[0]), told(answers[1])) << "flags " << flags << " limit " << options.max_volumes;
      ++moves_;
      swept_ += answers[0].report.edges_swept;
      stopped_ += answers[0].report.vertices_stopped;
      at = answers[0].after.at;
    }
    for (int k = 0; k < 2; ++k) ASSERT_EQ(dsw_body_destroy(scenes[k], bodies[k]), DSW_STATUS_OK);
  }

  /// Takes the vertices of both environments to the same places near by.
  void deform(Rng& rng, double reach, dsw_environment* const (&environments)[2]) {
    const double* points = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_environment_get_points(environments[0], &points, &count), DSW_STATUS_OK);
    std::vector<double> next(points, points + 3 * count);
    for (double& x : next) x += reach * rng.range(-1, 1);
    for (dsw_environment* environment : environments) {
      std::vector<double>& lent = lent_.emplace_back(next);
      ASSERT_EQ(dsw_environment_deform(environment, lent.data(), count, nullptr, nullptr), DSW_STATUS_OK)
          << dsw_last_error_message();
    }
    ++deformations_;
  }

  uint64_t moves_ = 0, swept_ = 0, stopped_ = 0, deformations_ = 0;
  std::deque<std::vector<double>> lent_;
};

TEST_F(ShortEdgesTest, ChangeNothing) {
  const uint64_t seeds_wanted = seeds_of(3, 1);
  for (uint64_t seed = 1; seed <= seeds_wanted; ++seed) {
    Rng seeds(seed_of(seed));
    for (const SweepTurn& turn : sweep_turns("")) {
      SCOPED_TRACE(std::string(turn.kind->name) + transform_name(turn.transform) + " seed " + std::to_string(seed));
      Rng rng(seeds.next() >> 1);
      SweepReport report;
      const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report);
      if (stage == nullptr) continue;
      SpaceArena arena(stage->world, stage->marked_edges);
      StagePlaces places(*stage, rng);
      const ScenePtr plain = make_scene(stage->environment.get());
      const ScenePtr counting = make_scene(stage->environment.get(), DSW_FEATURE_STATISTICS);
      for (int body = 0; body < 6; ++body) {
        ASSERT_NO_FATAL_FAILURE(run_body(places, rng, arena.size(), {plain.get(), counting.get()}));
      }
    }
  }
  EXPECT_GE(moves_, 500 * seeds_wanted);
  EXPECT_GE(swept_, 10000 * seeds_wanted);
  EXPECT_GE(stopped_, 100 * seeds_wanted);
}

/// An environment that deforms belongs to one scene, so each scene has its own.
TEST_F(ShortEdgesTest, ChangeNothingWherePointsHaveMoved) {
  const uint64_t seeds_wanted = seeds_of(3, 1);
  for (uint64_t seed = 1; seed <= seeds_wanted; ++seed) {
    Rng seeds(seed_of(seed + 100));
    for (const SweepTurn& turn : sweep_turns("")) {
      if (turn.transform != Transform::kNone) continue;
      SCOPED_TRACE(std::string(turn.kind->name) + " seed " + std::to_string(seed));
      Rng rng(seeds.next() >> 1), again = rng;
      SweepReport report;
      const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report),
                                   twin = make_stage(turn, seed, again, report);
      if (stage == nullptr || twin == nullptr) continue;
      SpaceArena arena(stage->world, stage->marked_edges);
      StagePlaces places(*stage, rng);
      const ScenePtr plain = make_scene(stage->environment.get(), DSW_FEATURE_DEFORMING);
      const ScenePtr counting = make_scene(twin->environment.get(), DSW_FEATURE_DEFORMING | DSW_FEATURE_STATISTICS);
      for (int body = 0; body < 6; ++body) {
        const double reach = arena.size() * std::pow(10, -rng.range(1.5, 4));
        ASSERT_NO_FATAL_FAILURE(deform(rng, reach, {stage->environment.get(), twin->environment.get()}));
        ASSERT_NO_FATAL_FAILURE(run_body(places, rng, arena.size(), {plain.get(), counting.get()}));
      }
    }
  }
  EXPECT_GE(deformations_, 50 * seeds_wanted);
  EXPECT_GE(swept_, 500 * seeds_wanted);
  EXPECT_GE(stopped_, 10 * seeds_wanted);
}

}  // namespace
}  // namespace dsw::oracle
