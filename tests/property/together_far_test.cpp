// Bodies of many edges that keep no sequences: which edges are far from all obstacles is read from a tree, once there is one. The
// results have to be those without a tree, in each number of a report: recordings keep no tree.

#include "together_support.h"

#include <dartsweep/record.h>

namespace dsw::oracle {
namespace {

/// Chains of edges in cubes along each axis.
struct FarKind {
  int cubes;
  double marked;        // the least share of cells
  double edge, margin;  // the longest along each axis; from the sides of the ground
  double ways[2];       // of most steps, and of each third
  int steps;
};
constexpr FarKind kShort = {4, 0.01, 0.3, 0.1, {0.03, 0.2}, 60};
/// Ways through many cells, of which a box of few cells tells nothing.
constexpr FarKind kLong = {8, 0.002, 0.8, 0.5, {0.5, 1.5}, 12};

Ground ground_of(const FarKind& kind, int round) {
  const auto seed = static_cast<uint64_t>(100 + round);
  Rng rng(seed);
  return make_ground(3, kind.cubes, 0.15, round % 4 < 2 ? kind.marked : 5 * kind.marked, round % 2 == 1, rng);
}

/// Chains of short edges that are free where they start, as one body.
BodyPlan chains(dsw_environment* environment, const FarKind& kind, Rng& rng) {
  constexpr size_t kChains = 60, kEdges = 3;
  const ScenePtr scratch = make_scene(environment, 0);
  BodyPlan all;
  for (int tries = 0; tries < 2000 && all.at.size() < kChains * (kEdges + 1); ++tries) {
    BodyPlan chain;
    const auto place = [&] { return rng.range(kind.margin, kind.cubes - kind.margin); };
    const double x0 = place(), y0 = place(), z0 = place();
    chain.at.push_back(sheared({x0, y0, z0}, 3));
    for (uint32_t i = 1; i <= kEdges; ++i) {
      Vec p = chain.at.back();
      for (double& x : p) x += rng.range(-kind.edge, kind.edge);
      chain.at.push_back(p);
      chain.edges.push_back({i - 1, i});
    }
    dsw_body_id id;
    if (create_body(scratch.get(), chain, DSW_LEVEL_EDGES, 0, {}, &id) != DSW_STATUS_OK) continue;
    const auto first = static_cast<uint32_t>(all.at.size());
    all.at.insert(all.at.end(), chain.at.begin(), chain.at.end());
    for (const auto& e : chain.edges) all.edges.push_back({first + e[0], first + e[1]});
  }
  return all;
}

Walker add_body(dsw_scene* scene, const BodyPlan& plan) {
  Walker walker{};
  walker.level = DSW_LEVEL_EDGES;
  EXPECT_EQ(create_body(scene, plan, DSW_LEVEL_EDGES, 0, {}, &walker.id), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(read_body(scene, walker.id, walker.state), "");
  return walker;
}

size_t casts_of(const dsw_scene* scene) {
  dsw_statistics statistics;
  statistics.struct_size = sizeof statistics;
  EXPECT_EQ(dsw_scene_get_statistics(scene, &statistics), DSW_STATUS_OK);
  return statistics.casts;
}

bool are_same(const TogetherAnswer& a, const TogetherAnswer& b) {
  const dsw_move_report &one = a.reports[0], &other = b.reports[0];
  bool same = a.contacts[0].size() == b.contacts[0].size() && one.fraction == other.fraction &&
              one.vertices_moved == other.vertices_moved && one.vertices_stopped == other.vertices_stopped &&
              one.edges_swept == other.edges_swept && one.edges_skipped == other.edges_skipped;
  for (size_t v = 0; v < a.after[0].at.size(); ++v) {
    same = same && hex(a.after[0].at[v]) == hex(b.after[0].at[v]) &&
           a.after[0].volumes[v].index == b.after[0].volumes[v].index;
  }
  return same;
}

void record(dsw_scene* scene, std::string* recording) {
  dsw_recording_desc desc = defaults(dsw_recording_desc_init);
  desc.user = recording;
  desc.write = [](void* user, const void* bytes, size_t size) {
    static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
    return 0;
  };
  EXPECT_EQ(dsw_scene_start_recording(scene, &desc), DSW_STATUS_OK) << dsw_last_error_message();
}

/// Makes all calls again, where there is no tree yet; how many there were with the same results.
size_t replay_all(const std::string& recording) {
  dsw_replay* replay = nullptr;
  EXPECT_EQ(dsw_replay_create(nullptr, recording.data(), recording.size(), &replay), DSW_STATUS_OK)
      << dsw_last_error_message();
  size_t calls = 0;
  dsw_replay_report report = {};
  while (dsw_replay_step(replay, &report) == DSW_STATUS_OK && report.outcome == DSW_REPLAY_SAME) ++calls;
  EXPECT_EQ(report.outcome, DSW_REPLAY_END) << "call " << report.call << ", " << report.function;
  dsw_replay_destroy(replay);
  return calls;
}

/// Moves a body where there is a tree by and by, and a copy of it where there never is one.
void compare(const FarKind& kind) {
  Rng rng(5);
  size_t moves = 0, different = 0, contacts = 0, replayed = 0, casts[2] = {0, 0};
  for (int round = 0; round < std::max(effort_of(8), 4); ++round) {
    const Ground ground = ground_of(kind, round);
    const ScenePtr old = make_scene(ground.environment.get(), DSW_FEATURE_STATISTICS);
    BodyPlan plan = chains(ground.environment.get(), kind, rng);
    Walker walker = add_body(old.get(), plan);
    std::string recording;
    for (int step = 0; step < kind.steps; ++step) {
      if (step == kind.steps / 2) record(old.get(), &recording);
      // An environment of which nobody has asked anything has no tree.
      const Ground other = ground_of(kind, round);
      const ScenePtr fresh = make_scene(other.environment.get(), DSW_FEATURE_STATISTICS);
      plan.at = walker.state.at;
      Walker copy = add_body(fresh.get(), plan);
      walker.end = walker.state.at;
      const double way = kind.ways[step % 3 == 0 ? 1 : 0];
      for (Vec& p : walker.end) {
        for (double& x : p) x += rng.range(-way, way);
      }
      copy.end = walker.end;
      const auto stop =
          static_cast<dsw_together_stop>(step % 3 == 1 ? DSW_TOGETHER_STOP_ALL : DSW_TOGETHER_STOP_FEATURE);
      const uint32_t response = rng.below(3u);
      const size_t before = casts_of(old.get());
      const TogetherAnswer answers[2] = {move_together(old.get(), {walker}, stop, 0, response),
                                         move_together(fresh.get(), {copy}, stop, 0, response)};
      ++moves;
      contacts += answers[0].contacts[0].size();
      different += are_same(answers[0], answers[1]) ? 0 : 1;
      casts[0] += casts_of(old.get()) - before;
      casts[1] += casts_of(fresh.get());
      walker.state = answers[0].after[0];
    }
    EXPECT_EQ(dsw_scene_stop_recording(old.get()), DSW_STATUS_OK);
    replayed += replay_all(recording);
  }
  std::printf("%zu moves, %zu contacts; different %zu; casts %zu, without a tree %zu; replayed %zu\n", moves, contacts,
              different, casts[0], casts[1], replayed);
  EXPECT_EQ(different, 0u);
  EXPECT_GT(contacts, 0u);
  EXPECT_GE(replayed, moves / 2);
  EXPECT_LT(casts[0], casts[1]) << "no tree was asked";
}

TEST(TogetherFarTest, ATreeOfObstaclesChangesNoResult) { compare(kShort); }

TEST(TogetherFarTest, ATreeOfObstaclesChangesNoResultOfLongWays) { compare(kLong); }

}  // namespace
}  // namespace dsw::oracle
