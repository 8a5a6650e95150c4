#include "body_run.h"

#include "body_course.h"
#include "rounds.h"
#include "sweep_scenes.h"

#include <algorithm>
#include <cstdio>

namespace dsw::oracle {
namespace {

constexpr dsw_level kLevels[] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES};

ScenePtr scene_of(dsw_environment* environment) {
  dsw_scene* scene = nullptr;
  dsw_scene_create(environment, nullptr, &scene);
  return ScenePtr(scene);
}

void one_scene(const SweepTurn& turn, uint64_t seed, uint64_t steps, const BodyRunOptions& options,
               BodyReport& report) {
  Rng rng(seed);
  report.begin(turn.kind->name,
               std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " + std::to_string(seed));
  const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report.levels[0]);
  if (stage == nullptr) return;
  stage->mark_vertices(rng, report.levels[0]);
  SpaceArena arena(stage->world, stage->marked_edges, stage->marked_vertices);
  const auto places_for = [&](Rng& own) { return std::make_unique<StagePlaces>(*stage, own); };
  bodies_in_arena(arena, places_for, stage->environment.get(), seed, steps, options, report);
}

}  // namespace

void bodies_in_arena(Arena& arena, const std::function<std::unique_ptr<Places>(Rng&)>& places_for,
                     dsw_environment* environment, uint64_t seed, uint64_t steps, const BodyRunOptions& options,
                     BodyReport& report) {
  const ScenePtr scene = scene_of(environment);
  for (dsw_level level : kLevels) {
    if ((options.level != 0 && options.level != level) || (arena.dimension == 2 && level == DSW_LEVEL_FACES)) continue;
    // A level's sequence is its own: it can be run alone.
    Rng own(seed ^ static_cast<uint64_t>(level) << 40);
    const std::unique_ptr<Places> places = places_for(own);
    Course course(arena, *places, environment, scene.get(), level, own, report);
    const uint64_t before = report.at(level).total.sweeps;
    for (int bodies = 0; bodies < 40 && report.at(level).total.sweeps < before + steps; ++bodies) course.stopping();
    if (options.responses) {
      course.responding();
      course.editing();
    }
    if (level == DSW_LEVEL_EDGES) course.eliminating();
  }
}

void BodyReport::begin(const std::string& scene, const std::string& reproduce) {
  for (SweepReport& r : levels) r.begin(scene, reproduce);
  similar.begin(scene, reproduce);
}

uint64_t BodyReport::faults() const {
  uint64_t sum = similar.total.faults() + (cross_checks.quantile(0.99) <= CrossChecks::kMostDegrees ? 0 : 1);
  for (const SweepReport& level : levels) sum += level.total.faults();
  return sum;
}

uint64_t least_steps(const BodyRunOptions& options, BodyReport& report, dsw_level last) {
  uint64_t steps = UINT64_MAX;
  for (dsw_level level : kLevels) {
    if (level > last || (options.level != 0 && options.level != level)) continue;
    steps = std::min(steps, report.at(level).total.sweeps);
  }
  return steps;
}

void run_bodies(const BodyRunOptions& options, BodyReport& report) {
  std::vector<SweepTurn> turns;
  for (const SweepTurn& turn : sweep_turns(options.only)) {
    const bool with_ties = turn.kind->integer && turn.transform == Transform::kNone;
    turns.insert(turns.end(), with_ties ? 5 : 1, turn);
  }
  const uint64_t each = std::min<uint64_t>(150, std::max<uint64_t>(20, options.steps / (turns.size() + 1)));
  if (options.scene_seed != 0) {
    for (const SweepTurn& turn : sweep_turns(options.only)) one_scene(turn, options.scene_seed, each, options, report);
    return;
  }
  // Sequences of neighbouring seeds are one step apart.
  run_rounds(
      turns, Rng(options.seed << 20), options.steps, [&] { return least_steps(options, report); },
      [&](const SweepTurn& turn, uint64_t seed) { one_scene(turn, seed, each, options, report); });
  report.bisection_slope = bisection_slope(options.seed, report);
}

std::string to_json(const BodyReport& report) {
  static const char* const names[] = {"points", "edges", "edges_swept", "faces"};
  std::string text;
  const auto add = [&](const std::string& key, double value) {
    char line[128];
    std::snprintf(line, sizeof line, "%s  \"%s\": %.10g", text.empty() ? "{\n" : ",\n", key.c_str(), value);
    text += line;
  };
  const auto share = [](uint64_t part, uint64_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  };
  uint64_t not_free = 0;
  for (size_t i = 0; i < 4; ++i) {
    const SweepTally& t = report.levels[i].total;
    const std::pair<const char*, uint64_t> counts[] = {
        {"steps", t.sweeps},
        {"missed", t.missed},
        {"late", t.late},
        {"early", t.early},
        {"wrong", t.wrong},
        {"not_free_after", t.not_free_after},
        {"contacts", t.contacts},
        {"edge_contacts", t.edge_contacts},
        {"face_contacts", t.face_contacts},
        {"stuck", t.stuck},
    };
    const std::string prefix = std::string("body.oracle.") + names[i] + ".";
    for (const auto& [key, value] : counts) add(prefix + key, static_cast<double>(value));
    add(prefix + "ties_share", share(t.ties, t.sweeps));
    add(prefix + "inside_only_share", share(t.inside_only, t.contacts));  // of the contacts
    not_free += t.not_free_after;
  }
  add("body.oracle.bodies", static_cast<double>(report.bodies));
  add("body.oracle.refused", static_cast<double>(report.refused));
  add("body.oracle.twins", static_cast<double>(report.twins));
  add("body.oracle.responses", static_cast<double>(report.responses));
  add("body.oracle.response_edits", static_cast<double>(report.edits));
  add("body.oracle.body_edits", static_cast<double>(report.body_edits));
  add("sweep.oracle.not_free_after", static_cast<double>(not_free + report.similar.total.not_free_after));
  add("edges.similar_motion_missed_share", share(report.similar_dropped, report.similar_contacts));
  add("edges.similar_motion_contacts", static_cast<double>(report.similar_contacts));
  add("edges.similar_motion_not_free_after", static_cast<double>(report.similar.total.not_free_after));
  // These scenes have marked edges, and ends exactly on edges and corners. The figures of the benchmark are those of
  // cross_check_test.
  add("body.oracle.normal_vs_libccd_deg_p99", report.cross_checks.quantile(0.99));
  add("body.oracle.normal_qualified_share", report.cross_checks.share());
  add("contact.time_error_exact", report.time_error);
  add("contact.bisection_slope", report.bisection_slope);
  return text + "\n}\n";
}

}  // namespace dsw::oracle
