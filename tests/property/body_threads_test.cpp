// Many bodies in one call: the same bits as one after the other, for any number of threads and any order of tasks.
#include "body_scenes.h"
#include "sweep_scenes.h"
#include "threads.h"

#include <cstring>

namespace dsw::oracle {
namespace {

constexpr size_t kRounds = 6;
const auto kBodies = static_cast<size_t>(std::max(16, effort_of(40)));

dsw_move_options round_options(size_t round) {
  dsw_move_options options = defaults(dsw_move_options_init);
  options.vertex_response = round % 2 == 0 ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
  options.edge_response = static_cast<dsw_response>(round % 6);
  options.noise_share = round % 3 == 0 ? 0.05 : 0;
  return options;
}

std::string report_bits(const dsw_move_report& report) {
  return std::string(reinterpret_cast<const char*>(&report), sizeof report);
}

/// Bits of every contact, position and report of some rounds of moves; one by one or together.
std::vector<std::string> answers(const std::string& name, dsw_context* context, bool together, uint64_t* contacts) {
  std::vector<std::string> lines;
  Rng rng(91);
  Mesh mesh = kind_named(name).make(rng);
  SweepReport faults;
  faults.begin(name, name);
  Stage stage(mesh, create_environment(mesh, {}, 0, context));
  stage.mark(rng, faults);
  stage.mark_vertices(rng, faults);
  EXPECT_EQ(faults.total.faults(), 0u);
  SpaceArena arena(stage.world, stage.marked_edges, stage.marked_vertices);
  StagePlaces places(stage, rng);
  const ScenePtr scene = make_scene(stage.environment.get());
  std::vector<dsw_body_id> bodies;
  std::vector<dsw_level> levels;
  for (size_t tries = 0; tries < 8 * kBodies && bodies.size() < kBodies; ++tries) {
    const auto level = static_cast<dsw_level>(1 + tries % 4);
    Bodies source(arena, places, rng, level);
    dsw_body_id body;
    const uint32_t flags = tries % 3 == 0 ? DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_CLEARANCE : 0;
    if (create_body(scene.get(), source.next(), level, flags, {}, &body) != DSW_STATUS_OK) continue;
    bodies.push_back(body);
    levels.push_back(level);
  }
  EXPECT_GT(bodies.size(), kBodies / 2);
  for (size_t round = 0; round < kRounds; ++round) {
    const dsw_move_options options = round_options(round);
    std::vector<double> targets;
    std::vector<size_t> first;
    Rng own(100 + round);
    for (size_t i = 0; i < bodies.size(); ++i) {
      BodyState state;
      EXPECT_EQ(read_body(scene.get(), bodies[i], state), "");
      first.push_back(targets.size() / 3);
      Motions motions(stage.world, own);
      for (const Vec& p : state.at) {
        const Vec to = motions.target(p);
        targets.insert(targets.end(), to.begin(), to.end());
      }
    }
    first.push_back(targets.size() / 3);
    std::vector<dsw_move_report> reports(bodies.size());
    std::memset(reports.data(), 0xee, reports.size() * sizeof reports[0]);
    if (together) {
      EXPECT_EQ(dsw_scene_move_bodies(scene.get(), bodies.data(), bodies.size(), targets.data(), targets.size() / 3, 0,
                                      &options, reports.data()),
                DSW_STATUS_OK)
          << dsw_last_error_message();
    }
    for (size_t i = 0; i < bodies.size(); ++i) {
      if (!together) {
        EXPECT_EQ(dsw_body_move(scene.get(), bodies[i], targets.data() + 3 * first[i], first[i + 1] - first[i], 0,
                                &options, &reports[i]),
                  DSW_STATUS_OK)
            << dsw_last_error_message();
      }
      const dsw_body_contact* list = nullptr;
      size_t count = 0;
      BodyAnswer answer;
      EXPECT_EQ(dsw_body_get_contacts(scene.get(), bodies[i], &list, &count), DSW_STATUS_OK);
      answer.contacts.assign(list, list + count);
      EXPECT_EQ(read_body(scene.get(), bodies[i], answer.after), "");
      lines.push_back(bits_of(answer) + report_bits(reports[i]));
      *contacts += count;
    }
  }
  return lines;
}

class BodyThreadsTest : public SceneTest {};
INSTANTIATE_TEST_SUITE_P(Some, BodyThreadsTest,
                         testing::ValuesIn(drawn_for("BodyThreadsTest",
                                                     std::vector<std::string>{"hex", "hex_warped", "tet_lattice",
                                                                              "mixed", "polyhedra"})),
                         [](const testing::TestParamInfo<std::string>& i) { return i.param; });

TEST_P(BodyThreadsTest, TogetherIsTheSameAsOneByOneForAnyThreads) {
  uint64_t contacts = 0;
  const ContextPtr one = context_with(1, nullptr);
  const std::vector<std::string> want = answers(GetParam(), one.get(), false, &contacts);
  EXPECT_GT(contacts, 50u);
  for (uint32_t threads : {1u, 2u, 3u, 8u}) {
    SCOPED_TRACE(threads);
    const ContextPtr context = context_with(threads, nullptr);
    EXPECT_TRUE(answers(GetParam(), context.get(), true, &contacts) == want);
  }
  const auto seeds = static_cast<uint64_t>(std::max(1, effort_of(3)));
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    Shuffler shuffler;
    shuffler.seed = seed;
    shuffler.threads = 4;
    const ContextPtr context = context_with(0, &shuffler);
    EXPECT_TRUE(answers(GetParam(), context.get(), true, &contacts) == want);
    EXPECT_GT(shuffler.calls.load(), 0u);
  }
}

TEST(BodyBatchTest, WhatIsRefusedMovesNothing) {
  const Mesh mesh = hex_grid(axis(3, 1), axis(3, 1), axis(3, 1));
  const EnvironmentPtr environment = create_environment(mesh);
  const ScenePtr scene = make_scene(environment.get());
  const BodyPlan plan = {{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, {{0, 1}}, {}};
  dsw_body_id bodies[2];
  for (dsw_body_id& b : bodies) ASSERT_EQ(create_body(scene.get(), plan, DSW_LEVEL_EDGES, 0, {}, &b), DSW_STATUS_OK);
  double targets[12];
  for (double& x : targets) x = 1.25;
  const auto refuse = [&](dsw_status status, const dsw_body_id* list, size_t count, size_t target_count,
                          const dsw_move_options* options) {
    EXPECT_EQ(dsw_scene_move_bodies(scene.get(), list, count, targets, target_count, 0, options, nullptr), status)
        << dsw_last_error_message();
    for (dsw_body_id b : bodies) {
      BodyState state;
      EXPECT_EQ(read_body(scene.get(), b, state), "");
      EXPECT_EQ(state.at, plan.at);
    }
  };
  const dsw_body_id twice[2] = {bodies[0], bodies[0]}, stale[2] = {bodies[0], {1, 9}};
  refuse(DSW_STATUS_DUPLICATE_ID, twice, 2, 4, nullptr);
  refuse(DSW_STATUS_STALE_ID, stale, 2, 4, nullptr);
  refuse(DSW_STATUS_WRONG_SIZE, bodies, 2, 3, nullptr);
  dsw_move_options options = defaults(dsw_move_options_init);
  const uint32_t order[] = {0};
  options.order = order;
  options.order_count = 1;
  refuse(DSW_STATUS_UNSUPPORTED, bodies, 2, 4, &options);
  targets[10] = NAN;
  refuse(DSW_STATUS_NON_FINITE, bodies, 2, 4, nullptr);
  targets[10] = 1.25;
  EXPECT_EQ(dsw_scene_move_bodies(scene.get(), bodies, 2, targets, 4, 0, nullptr, nullptr), DSW_STATUS_OK);
}

}  // namespace
}  // namespace dsw::oracle
