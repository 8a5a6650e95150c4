#include "fig11_bodies.h"

#include "sweep_truth_hex.h"
#include "timing.h"

#include <map>

namespace dsw::bench {

namespace {

/** Bodies with faces at every level, step by step in turns. Times are divided by the casts of the method. */
void compare_levels(const Fig11Case& scene, const Script& script, Report& report) {
  constexpr double kCasts = 8 + 2 * 18;  // of a body whose diagonals are edges
  const std::vector<Variant> variants = {
      {"points", DSW_LEVEL_POINTS, 0},
      {"edges", DSW_LEVEL_EDGES, 0},
      {"edges_environment", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_ENVIRONMENT},
      {"swept", DSW_LEVEL_EDGES_SWEPT, 0},
      {"swept_sequences", DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SEQUENCES},
      {"faces", DSW_LEVEL_FACES, 0},
      {"faces_sequences", DSW_LEVEL_FACES, DSW_BODY_SEQUENCES},
  };
  std::vector<std::unique_ptr<Flock>> flocks;
  for (const Variant& variant : variants) {
    flocks.push_back(std::make_unique<Flock>(scene.world.environment(), variant, scene.skin, script.starts));
  }
  std::map<std::string, std::vector<double>> times;
  for (std::size_t step = 0; step < script.steps; ++step) {
    for (std::size_t i = 0; i < flocks.size(); ++i) {
      Flock& flock = *flocks[(step + i) % flocks.size()];
      times[flock.variant().name].push_back(cpu_time_ns([&] { flock.move(script.targets[step].data()); }) /
                                            (kCasts * kBodies));
    }
  }
  for (const auto& [name, ns] : times) report.set("edges.fig11.body_ns." + name, median(ns));
  report.set("edges.swept_over_edges", median_ratio(times["swept"], times["edges"]));
  report.set("edges.swept_over_edges.sequences", median_ratio(times["swept_sequences"], times["edges"]));
  report.set("edges.faces_over_edges", median_ratio(times["faces"], times["edges"]));
  report.set("edges.faces_over_edges.sequences", median_ratio(times["faces_sequences"], times["edges"]));
  report.set("edges.fig11.body_overhead", median_ratio(times["edges"], times["points"]));
}

void count_tests(const Fig11Case& scene, const Script& script, const std::string& key, std::uint32_t flags,
                 Report& report) {
  Flock flock(scene.world.environment(), {"", DSW_LEVEL_EDGES, flags}, scene.shape, script.starts,
              DSW_FEATURE_STATISTICS);
  check(dsw_scene_reset_statistics(flock.scene()));
  double asked = 0, skipped = 0;
  for (const auto& targets : script.targets) {
    flock.move(targets.data());
    asked += static_cast<double>(script.particles + flock.swept());
    skipped += static_cast<double>(flock.skipped());
  }
  dsw_statistics statistics{};
  statistics.struct_size = sizeof statistics;
  check(dsw_scene_get_statistics(flock.scene(), &statistics));
  report.set("edges.fig11.orientation_tests_per_cast" + key, double(statistics.orientation_tests) / asked);
  report.set("edges.fig11.orientation_tests_per_made_cast" + key,
             double(statistics.orientation_tests) / double(statistics.casts));
  report.set("edges.fig11.skipped_share" + key, skipped / asked);
}

/** Sweeps of the script at both levels, and what is true about some of those that differ or are free. */
void compare_sweeps(const Fig11Case& scene, const Segments& segments, std::size_t checked_most, Report& report) {
  std::vector<double> from, to, fixed;
  std::vector<dsw_volume_id> starts;
  for (std::size_t path = 0; path < segments.count(); path += kCastsPerParticle) {
    for (std::size_t i = path + 1; i < path + kCastsPerParticle; ++i) {
      from.insert(from.end(), &segments.from[3 * path], &segments.from[3 * path] + 3);
      to.insert(to.end(), &segments.to[3 * path], &segments.to[3 * path] + 3);
      fixed.insert(fixed.end(), &segments.from[3 * i], &segments.from[3 * i] + 3);
      starts.push_back(segments.starts[path]);
    }
  }
  std::vector<dsw_sweep> casts(starts.size()), swept(starts.size());
  dsw_sweep_options options;
  dsw_sweep_options_init(&options, sizeof options);
  options.flags = DSW_SWEEP_START_KNOWN | DSW_SWEEP_START_FREE;
  for (const dsw_level level : {DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
    options.level = level;
    check(dsw_environment_sweep_edges(scene.world.environment(), starts.size(), starts.data(), from.data(), to.data(),
                                      fixed.data(), 0, &options, (level == DSW_LEVEL_EDGES ? casts : swept).data()));
  }
  std::size_t hits = 0, extra = 0, lost = 0, wrong = 0, checked = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const bool by_casts = casts[i].outcome == DSW_OUTCOME_CONTACT, by_sweep = swept[i].outcome == DSW_OUTCOME_CONTACT;
    hits += by_sweep ? 1 : 0;
    extra += by_sweep && !by_casts ? 1 : 0;
    lost += by_casts && !by_sweep ? 1 : 0;
    if (by_casts == by_sweep && (by_sweep || i % 7 != 0 || checked >= checked_most)) continue;
    ++checked;
    wrong += triangle_meets_obstacle(scene.grid, &from[3 * i], &to[3 * i], &fixed[3 * i]) == by_sweep ? 0 : 1;
  }
  report.set("edges.swept_hits", static_cast<double>(hits));
  report.set("edges.swept_extra_hits",
             static_cast<double>(extra) / static_cast<double>(std::max<std::size_t>(hits, 1)));
  report.set("edges.swept_lost_hits", static_cast<double>(lost));
  report.set("edges.swept_checked", static_cast<double>(checked));
  report.set("edges.swept_wrong", static_cast<double>(wrong));
}

}  // namespace

void measure_fig11_bodies(Fig11Case& scene, const Script& script, std::size_t checked_most, Report& report) {
  compare_levels(scene, script, report);
  count_tests(scene, script, "", 0, report);
  count_tests(scene, script, ".environment", DSW_BODY_SKIP_BY_ENVIRONMENT, report);
  const Segments segments = script.casts(0, script.steps);
  const Work work = count_work(scene.world, segments, 10);
  report.set("edges.fig11.orientation_tests_per_cast.casts_alone", work.orientation_tests / work.casts);
  report.set("edges.fig11.cells_per_cast", work.cells / work.casts);
  compare_sweeps(scene, segments, checked_most, report);
}

}  // namespace dsw::bench
