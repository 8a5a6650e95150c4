// Figure 11 of [JCD10] in full: particles with six neighbours each in lattices of 1e3 to 1e6 cells, queries alone and with
// obstacles that come and go, against Bullet, GIMPACT, Embree and a uniform grid; and what the levels of a body cost.
#include "parts.h"

#include "bullet.h"
#include "bullet_change.h"
#include "embree.h"
#include "fig11_case.h"
#include "grid.h"
#include "sweep_truth_hex.h"
#include "timing.h"

#include <cmath>
#include <cstdio>
#include <map>

namespace dsw::bench {

namespace {

using Times = std::map<std::string, std::vector<double>>;

/** Ours as a host would cast by itself: known starts, marks for changes. */
class OursChanging final : public ChangingEngine {
 public:
  explicit OursChanging(const World& world) : ChangingEngine("dartsweep, casts"), world_(world) {
    dsw_cast_options_init(&options_, sizeof options_);
    options_.flags = DSW_CAST_START_KNOWN;
  }
  void prepare(const Segments& segments) override {
    segments_ = &segments;
    flights_.resize(segments.batch);
  }
  void run(std::size_t first, std::size_t count) override {
    check(dsw_environment_cast_segments(world_.environment(), count, &segments_->starts[first],
                                        &segments_->from[3 * first], &segments_->to[3 * first], 0, &options_,
                                        flights_.data()));
  }
  Answer answer(std::size_t i) const override {
    return flights_[i].outcome == DSW_OUTCOME_REACHED ? Answer{} : Answer{0, flights_[i].time};
  }
  void apply(const WallChange& change) override { mark(world_, change); }

 private:
  const World& world_;
  dsw_cast_options options_{};
  const Segments* segments_ = nullptr;
  std::vector<dsw_flight> flights_;
};

class GridChanging final : public ChangingEngine {
 public:
  explicit GridChanging(const WallMesh& walls) : ChangingEngine("grid"), grid_(walls, 1.0) {}
  void prepare(const Segments& segments) override { grid_.prepare(segments); }
  void run(std::size_t first, std::size_t count) override { grid_.run(first, count); }
  Answer answer(std::size_t i) const override { return grid_.answer(i); }
  void apply(const WallChange& change) override {
    for (const auto& item : change.removed) {
      grid_.remove(item.id, item.wall);
    }
    for (const auto& item : change.added) {
      grid_.insert(item.id, item.wall);
    }
  }

 private:
  Grid grid_;
};

/** Runs the first steps of a script with its changes, each period timed as a whole, and puts the walls back.
 * @return ns a cast, changes included, of the median period. */
template <typename Change, typename Step>
double time_script(const Script& script, std::size_t periods, Change&& change, Step&& run) {
  std::vector<double> ns;
  for (std::size_t period = 0; period < periods; ++period) {
    ns.push_back(cpu_time_ns([&] {
                   for (const WallChange& each : script.changes[period]) {
                     if (!each.volumes.empty()) {
                       change(each);
                     }
                   }
                   for (std::size_t step = period * kStepsPerChange; step < (period + 1) * kStepsPerChange; ++step) {
                     run(step);
                   }
                 }) /
                 static_cast<double>(kStepsPerChange * script.segments.batch));
  }
  // What the next period would take away first.
  change(periods < script.changes.size() ? script.changes[periods][0] : script.undo[0]);
  return median(ns);
}

double time_script(const Script& script, std::size_t periods, ChangingEngine& engine) {
  return time_script(
      script, periods, [&](const WallChange& change) { engine.apply(change); },
      [&](std::size_t step) { engine.run(step * script.segments.batch, script.segments.batch); });
}

/** Prepares engines, tries each on the first periods and keeps the fastest. */
std::unique_ptr<ChangingEngine> keep_fastest(std::vector<std::unique_ptr<ChangingEngine>> engines,
                                             const Script& script) {
  std::size_t best = 0;
  std::vector<double> least(engines.size(), 1e300);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < engines.size(); ++i) {
      engines[i]->prepare(script.segments);
      least[i] = std::min(least[i], time_script(script, 1, *engines[i]));
    }
  }
  for (std::size_t i = 0; i < engines.size(); ++i) {
    std::printf("    %-40s %.1f ns\n", engines[i]->name().c_str(), least[i]);
    best = least[i] < least[best] ? i : best;
  }
  return std::move(engines[best]);
}

/** How many casts of a step two engines answer differently: one is met and the other not, or at another time. */
std::size_t count_different(const Script& script, ChangingEngine& ours, ChangingEngine& theirs) {
  std::size_t different = 0;
  const std::size_t batch = script.segments.batch;
  for (std::size_t step = 0; step < kStepsPerChange; ++step) {
    ours.run(step * batch, batch);
    theirs.run(step * batch, batch);
    for (std::size_t i = 0; i < batch; ++i) {
      const Answer a = ours.answer(i), b = theirs.answer(i);
      different += (a.wall == kNone) != (b.wall == kNone) || std::fabs(a.time - b.time) > 1e-3 ? 1 : 0;
    }
  }
  return different;
}

struct Contest {
  std::string label;
  std::unique_ptr<Fig11Case> scene;
  Script still, changing;
  std::unique_ptr<Engine> ours, bullet, bullet_box, embree, grid;
  std::unique_ptr<ChangingEngine> ours_total, bullet_total, embree_total, grid_total;
  std::unique_ptr<Gimpact> gimpact;
  std::vector<std::vector<float>> positions;  // GIMPACT's, of each step
  Times times;
};

/** On the heap: engines keep pointers to the scripts. */
std::unique_ptr<Contest> make_contest(const std::string& label, std::size_t cells, std::size_t steps,
                                      Agreement& agreement, Report& report) {
  std::printf("  %s\n", label.c_str());
  auto made = std::make_unique<Contest>();
  Contest& contest = *made;
  contest.label = label;
  contest.scene = std::make_unique<Fig11Case>(cells);
  Fig11Case& scene = *contest.scene;
  contest.still = scene.record(steps, false);
  contest.changing = scene.record(steps, true);
  const Segments& segments = contest.still.segments;
  contest.ours = std::make_unique<Ours>(scene.world, scene.walls);
  contest.bullet = keep_fastest(make_bullets(scene.walls, false), segments);
  contest.bullet_box = keep_fastest(make_bullets(scene.walls, true), segments);
  contest.embree = keep_fastest(make_embrees(scene.walls), segments);
  contest.grid = keep_fastest(make_grids(scene.walls, {0.5, 1.0, 1.5, 2.0}), segments);
  std::vector<Engine*> engines = {contest.ours.get(), contest.bullet.get(), contest.bullet_box.get(),
                                  contest.embree.get(), contest.grid.get()};
  for (Engine* engine : engines) {
    engine->prepare(segments);
  }
  agreement.compare(segments, engines, scene.walls, 200);

  const Script& script = contest.changing;
  const std::size_t slots = script.slots;
  contest.ours_total = std::make_unique<OursChanging>(scene.world);
  contest.ours_total->prepare(script.segments);
  contest.grid_total = std::make_unique<GridChanging>(scene.walls);
  contest.grid_total->prepare(script.segments);
  std::vector<std::unique_ptr<ChangingEngine>> bullets, embrees;
  bullets.push_back(make_bullet_tree(scene.walls, slots, false));
  bullets.push_back(make_bullet_tree(scene.walls, slots, true));
  bullets.push_back(make_bullet_rebuilt(scene.walls, slots));
  contest.bullet_total = keep_fastest(std::move(bullets), script);
  for (const bool refit : {false, true}) {
    embrees.push_back(make_embree_single(scene.walls, slots, refit));
  }
  for (const double chunk : {8.0, 13.0, 20.0}) {
    embrees.push_back(make_embree_chunks(scene.walls, chunk, false));
  }
  contest.embree_total = keep_fastest(std::move(embrees), script);
  for (ChangingEngine* peer : {contest.bullet_total.get(), contest.embree_total.get(), contest.grid_total.get()}) {
    for (const WallChange& change : script.changes[0]) {
      contest.ours_total->apply(change);
      peer->apply(change);
    }
    const std::string name = peer->name().substr(0, peer->name().find(','));
    report.add("edges.fig11.total_different." + name,
               static_cast<double>(count_different(script, *contest.ours_total, *peer)));
    const WallChange& back = script.changes.size() > 1 ? script.changes[1][0] : script.undo[0];
    contest.ours_total->apply(back);
    peer->apply(back);
  }
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (const auto& face : scenes::torus_faces()) {
    faces.push_back(face);
  }
  contest.gimpact = std::make_unique<Gimpact>(scene.walls, slots, script.particles / scene.shape.vertices,
                                              scene.shape.vertices, faces, script.starts);
  for (const auto& targets : script.targets) {
    contest.positions.emplace_back(targets.begin(), targets.end());
  }
  return made;
}

/** Our bodies through a script with its changes; ns a cast that the paper would make, of the median period. */
double time_bodies(Contest& contest, std::size_t periods) {
  const Script& script = contest.changing;
  Flock flock(contest.scene->world.environment(), {"edges", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_ENVIRONMENT},
              contest.scene->shape, script.starts);
  return time_script(
      script, periods, [&](const WallChange& change) { mark(contest.scene->world, change); },
      [&](std::size_t step) { flock.move(script.targets[step].data()); });
}

void time_totals(Contest& contest, std::size_t periods, bool with_gimpact) {
  const Script& script = contest.changing;
  contest.times["total_ns"].push_back(time_script(script, periods, *contest.ours_total));
  contest.times["grid_total_ns"].push_back(time_script(script, periods, *contest.grid_total));
  contest.times["embree_total_ns"].push_back(time_script(script, periods, *contest.embree_total));
  contest.times["bullet_total_ns"].push_back(time_script(script, periods, *contest.bullet_total));
  contest.times["body_total_ns"].push_back(time_bodies(contest, periods));
  contest.times["mark_ns"].push_back(cpu_time_ns([&] {
    for (const WallChange& change : script.changes[0]) {
      mark(contest.scene->world, change);
    }
  }));
  mark(contest.scene->world, script.changes[1][0]);
  if (with_gimpact) {
    contest.times["gimpact_total_ns"].push_back(time_script(
        script, 1, [&](const WallChange& change) { contest.gimpact->apply(change); },
        [&](std::size_t step) { contest.gimpact->step(contest.positions[step].data()); }));
  }
}

/** Of the median step, a cast. */
double time_steps(Engine& engine, const Segments& segments) {
  std::vector<double> ns;
  for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
    ns.push_back(cpu_time_ns([&] { engine.run(first, segments.batch); }) / static_cast<double>(segments.batch));
  }
  return median(std::move(ns));
}

void time_queries(Contest& contest) {
  const std::pair<const char*, Engine*> engines[] = {{"ns", contest.ours.get()},
                                                     {"bullet_ns", contest.bullet.get()},
                                                     {"bullet_box_ns", contest.bullet_box.get()},
                                                     {"embree_ns", contest.embree.get()},
                                                     {"grid_ns", contest.grid.get()}};
  for (const auto& [key, engine] : engines) {
    contest.times[key].push_back(time_steps(*engine, contest.still.segments));
  }
}

/** Bodies at every level, step by step in turns. */
void compare_levels(Contest& contest, Report& report) {
  const Script& script = contest.still;
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
    flocks.push_back(
        std::make_unique<Flock>(contest.scene->world.environment(), variant, contest.scene->shape, script.starts));
  }
  std::map<std::string, std::vector<double>> times;
  for (std::size_t step = 0; step < script.steps; ++step) {
    for (std::size_t i = 0; i < flocks.size(); ++i) {
      Flock& flock = *flocks[(step + i) % flocks.size()];
      times[flock.variant().name].push_back(cpu_time_ns([&] { flock.move(script.targets[step].data()); }) /
                                            static_cast<double>(script.segments.batch));
    }
  }
  for (const auto& [name, ns] : times) {
    report.set("edges.fig11.body_ns." + name, median(ns));
  }
  report.set("edges.fig11.stopped_share", static_cast<double>(flocks[1]->stopped()) / double(script.particles));
  report.set("edges.swept_over_edges", median_ratio(times["swept"], times["edges"]));
  report.set("edges.swept_over_edges.sequences", median_ratio(times["swept_sequences"], times["edges"]));
  report.set("edges.faces_over_edges", median_ratio(times["faces"], times["edges"]));
  report.set("edges.faces_over_edges.sequences", median_ratio(times["faces_sequences"], times["edges"]));
  report.set("edges.fig11.body_over_casts", median(times["edges"]) / median(contest.times.at("ns")));
  report.set("edges.fig11.body_overhead", median_ratio(times["edges"], times["points"]));
}

void count_tests(const Contest& contest, const std::string& key, std::uint32_t flags, Report& report) {
  const Script& script = contest.still;
  Flock flock(contest.scene->world.environment(), {"", DSW_LEVEL_EDGES, flags}, contest.scene->shape, script.starts,
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
void compare_sweeps(const Contest& contest, std::size_t checked_most, Report& report) {
  const Segments& segments = contest.still.segments;
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
    check(dsw_environment_sweep_edges(contest.scene->world.environment(), starts.size(), starts.data(), from.data(),
                                      to.data(), fixed.data(), 0, &options,
                                      (level == DSW_LEVEL_EDGES ? casts : swept).data()));
  }
  std::size_t hits = 0, extra = 0, lost = 0, wrong = 0, checked = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const bool by_casts = casts[i].outcome == DSW_OUTCOME_CONTACT, by_sweep = swept[i].outcome == DSW_OUTCOME_CONTACT;
    hits += by_sweep ? 1 : 0;
    extra += by_sweep && !by_casts ? 1 : 0;
    lost += by_casts && !by_sweep ? 1 : 0;
    if (by_casts == by_sweep && (by_sweep || i % 7 != 0 || checked >= checked_most)) {
      continue;
    }
    ++checked;
    wrong += triangle_meets_obstacle(contest.scene->grid, &from[3 * i], &to[3 * i], &fixed[3 * i]) == by_sweep ? 0 : 1;
  }
  report.set("edges.swept_hits", static_cast<double>(hits));
  report.set("edges.swept_extra_hits", static_cast<double>(extra) / static_cast<double>(hits));
  report.set("edges.swept_lost_hits", static_cast<double>(lost));
  report.set("edges.swept_checked", static_cast<double>(checked));
  report.set("edges.swept_wrong", static_cast<double>(wrong));
}

}  // namespace

void run_fig11(const Options& options, Report& report, Agreement& agreement) {
  const std::size_t steps = options.quick ? 40 : 100, periods = steps / kStepsPerChange;
  const int rounds = options.quick ? 5 : 9;
  std::vector<std::unique_ptr<Contest>> contests;
  const std::pair<const char*, std::size_t> sizes[] = {
      {".n1e3", 1000}, {".n1e4", 10000}, {".n1e5", 100000}, {".n1e6", 1000000}};
  for (const auto& [label, cells] : sizes) {
    contests.push_back(make_contest(label, cells, steps, agreement, report));
  }
  for (int round = 0; round < rounds; ++round) {
    for (const auto& contest : contests) {
      time_queries(*contest);
      time_totals(*contest, periods, round < 3);
    }
  }
  for (const auto& each : contests) {
    Contest& contest = *each;
    auto& times = contest.times;
    for (const auto& [key, values] : times) {
      report.set("edges.fig11." + key + contest.label, median(values));
    }
    const auto& ours = times["ns"];
    report.set("edges.fig11.vs_bullet_segment" + contest.label, median_ratio(times["bullet_ns"], ours));
    report.set("edges.fig11.vs_bullet_box" + contest.label, median_ratio(times["bullet_box_ns"], ours));
    report.set("edges.fig11.vs_embree" + contest.label, median_ratio(times["embree_ns"], ours));
    report.set("edges.fig11.vs_grid" + contest.label, median_ratio(times["grid_ns"], ours));
    const auto& total = times["total_ns"];
    const auto& body = times["body_total_ns"];
    const auto best = std::min({times["bullet_total_ns"], times["embree_total_ns"], times["gimpact_total_ns"]},
                               [](const auto& a, const auto& b) { return median(a) < median(b); });
    report.set("edges.fig11.total_vs_best_peer" + contest.label, median_ratio(best, total));
    report.set("edges.fig11.total_vs_bullet" + contest.label, median_ratio(times["bullet_total_ns"], total));
    report.set("edges.fig11.total_vs_gimpact" + contest.label, median_ratio(times["gimpact_total_ns"], total));
    report.set("edges.fig11.total_vs_embree" + contest.label, median_ratio(times["embree_total_ns"], total));
    report.set("edges.fig11.total_vs_grid" + contest.label, median_ratio(times["grid_total_ns"], total));
    report.set("edges.fig11.body_total_vs_best_peer" + contest.label, median_ratio(best, body));
    report.set("edges.fig11.body_total_vs_grid" + contest.label, median_ratio(times["grid_total_ns"], body));
  }
  report.set("edges.fig11.flatness", median_ratio(contests[3]->times["total_ns"], contests[0]->times["total_ns"]));
  report.set("edges.fig11.body_flatness",
             median_ratio(contests[3]->times["body_total_ns"], contests[0]->times["body_total_ns"]));
  report.set("edges.fig11.casts_per_step", static_cast<double>(contests[3]->still.segments.batch));
  compare_levels(*contests[3], report);
  count_tests(*contests[3], "", DSW_BODY_SKIP_BY_ENVIRONMENT, report);
  count_tests(*contests[3], ".no_elimination", 0, report);
  const Work work = count_work(contests[3]->scene->world, contests[3]->still.segments, 10);
  report.set("edges.fig11.orientation_tests_per_cast.casts_alone", work.orientation_tests / work.casts);
  report.set("edges.fig11.cells_per_cast", work.cells / work.casts);
  compare_sweeps(*contests[3], options.quick ? 5000 : 50000, report);
}

}  // namespace dsw::bench
