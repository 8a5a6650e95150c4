// Figure 11 of [JCD10]: 225 deformable hexahedra of 8 particles, simulated by shape matching in lattices of 1e3 to 1e6
// cells while obstacles come and go; casts and bodies against Bullet, GIMPACT, Embree and a uniform grid. No
// elimination (section 6) is used.
#include "parts.h"

#include "bullet.h"
#include "bullet_change.h"
#include "embree.h"
#include "fig11_bodies.h"
#include "gimpact.h"
#include "grid.h"
#include "timing.h"

#include "scenes/soft_hexahedra.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>

namespace dsw::bench {

namespace {

using Make = std::function<std::unique_ptr<Engine>(const WallMesh&)>;

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
    for (const auto& item : change.removed) grid_.remove(item.id, item.wall);
    for (const auto& item : change.added) grid_.insert(item.id, item.wall);
  }

 private:
  Grid grid_;
};

/** Every way in which the peers' static structures answer. */
std::map<std::string, std::vector<Make>> peers() {
  std::map<std::string, std::vector<Make>> made;
  for (const BulletKind kind : {BulletKind::kQuantizedRay, BulletKind::kPlainRay, BulletKind::kTreeRay}) {
    made["bullet_ns"].push_back([kind](const WallMesh& walls) { return make_bullet(kind, walls); });
  }
  for (const BulletKind kind : {BulletKind::kQuantizedBox, BulletKind::kTreeBox}) {
    made["bullet_box_ns"].push_back([kind](const WallMesh& walls) { return make_bullet(kind, walls); });
  }
  for (std::uint32_t bits = 0; bits < 8; ++bits) {
    const EmbreeSetting setting = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, false, false};
    made["embree_ns"].push_back([setting](const WallMesh& walls) { return make_embree(setting, walls); });
  }
  for (const double bucket : {0.5, 1.0, 1.5, 2.0}) {
    made["grid_ns"].push_back([bucket](const WallMesh& walls) { return std::make_unique<Grid>(walls, bucket); });
  }
  made["gimpact_ns"] = {[](const WallMesh& walls) {
    return make_gimpact_meshes(walls, walls.walls.size(), kCastsPerParticle, scenes::kBodyVertices);
  }};
  made["gimpact_box_ns"] = {
      [](const WallMesh& walls) { return make_gimpact_triangles(walls, walls.walls.size(), kCastsPerParticle); }};
  return made;
}

/** Measures the time of a cast in the median step. */
double time_steps(Engine& engine, const Segments& segments) {
  std::vector<double> ns;
  for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
    ns.push_back(cpu_time_ns([&] { engine.run(first, segments.batch); }) / static_cast<double>(segments.batch));
  }
  return median(std::move(ns));
}

/** The fastest of some ways, each tried alone. */
Make choose(const std::vector<Make>& ways, const WallMesh& walls, const Segments& segments) {
  std::size_t best = 0;
  std::vector<double> ns;
  for (const Make& make : ways) {
    const std::unique_ptr<Engine> engine = make(walls);
    engine->prepare(segments);
    time_steps(*engine, segments);
    ns.push_back(time_steps(*engine, segments));
    std::printf("    %-40s %.1f ns\n", engine->name().c_str(), ns.back());
    best = ns.back() < ns[best] ? ns.size() - 1 : best;
  }
  return ways[best];
}

/** A period: the change of walls before it, then its steps. @return ns a cast. */
double time_period(const Script& script, std::size_t period, ChangingEngine& engine, const Segments& segments) {
  engine.prepare(segments);
  return cpu_time_ns([&] {
           for (const WallChange& change : script.changes[period]) engine.apply(change);
           for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
             engine.run(first, segments.batch);
           }
         }) /
         static_cast<double>(segments.count());
}

/** How many casts two engines answer differently: one is met and the other not, or at another time. */
std::size_t count_different(const Segments& segments, ChangingEngine& ours, ChangingEngine& theirs) {
  std::size_t different = 0;
  for (std::size_t first = 0; first < segments.count(); first += segments.batch) {
    ours.run(first, segments.batch);
    theirs.run(first, segments.batch);
    for (std::size_t i = 0; i < segments.batch; ++i) {
      const Answer a = ours.answer(i), b = theirs.answer(i);
      different += (a.wall == kNone) != (b.wall == kNone) || std::fabs(a.time - b.time) > 1e-3 ? 1 : 0;
    }
  }
  return different;
}

/** All walls of a script by id: those of the lattice, then those that come. */
WallMesh all_walls(const Fig11Case& scene, const Script& script) {
  auto walls = scene.walls.walls;
  walls.resize(script.slots);
  for (const auto& changes : script.changes) {
    for (const WallChange& change : changes) {
      for (const auto& item : change.added) walls[item.id] = item.wall;
    }
  }
  return {*scene.walls.points, std::move(walls)};
}

/** One size: its scene, what happens in it, and all engines. Engines keep pointers into it. */
class Contest {
 public:
  Contest(std::string label, std::size_t cells, std::size_t steps, Report& report)
      : label_(std::move(label)),
        scene_(cells),
        script_(scene_.record(steps, true)),
        all_(all_walls(scene_, script_)),
        present_(script_.slots, 0),
        ours_(scene_.world),
        bodies_world_(scene_.grid.mesh, 1),
        flock_(ready_for_bodies(), {"edges", DSW_LEVEL_EDGES, 0}, scene_.shape, script_.starts) {
    std::fill_n(present_.begin(), scene_.walls.walls.size(), 1);
    report.set("edges.fig11.mean_step" + label_, script_.mean_step);
    report.set("edges.fig11.deformation" + label_, script_.deformation);
    report.set("edges.fig11.stopped_share" + label_, script_.stopped_share);
    if (!std::isfinite(script_.deformation)) throw std::runtime_error("the bodies of figure 11 fell apart");
    const Segments segments = script_.casts(0, kStepsPerChange);
    choose_changing("bullet_total_ns", segments,
                    {[&] { return make_bullet_tree(all_, script_.slots, false); },
                     [&] { return make_bullet_tree(all_, script_.slots, true); },
                     [&] { return make_bullet_rebuilt(all_, script_.slots); }});
    choose_changing(
        "embree_total_ns", segments,
        {[&] { return make_embree_single(all_, script_.slots, false); },
         [&] { return make_embree_single(all_, script_.slots, true); },
         [&] { return make_embree_chunks(all_, 8.0, false); }, [&] { return make_embree_chunks(all_, 13.0, false); },
         [&] { return make_embree_chunks(all_, 20.0, false); }});
    choose_changing(
        "gimpact_total_ns", segments,
        {[&] { return make_gimpact_triangles(all_, script_.slots, kCastsPerParticle); },
         [&] { return make_gimpact_meshes(all_, script_.slots, kCastsPerParticle, scenes::kBodyVertices); }});
    choose_changing("grid_total_ns", segments, {[&] { return std::make_unique<GridChanging>(all_); }});
  }

  const std::string& label() const { return label_; }
  const Script& script() const { return script_; }
  const scenes::HexGrid& grid() const { return scene_.grid; }
  Fig11Case& scene() { return scene_; }
  const std::vector<double>& times(const std::string& key) { return times_[key]; }
  const std::map<std::string, std::vector<double>>& times() const { return times_; }

  /** Some periods in a row, engine by engine, so that all but the first period of each find their data in the caches.
   * @param compared the peers' answers in the last period as well. */
  void time_periods(std::size_t first, std::size_t count, bool compared, Report& report) {
    std::vector<Segments> segments;
    for (std::size_t period = first; period < first + count; ++period) {
      segments.push_back(script_.casts(period * kStepsPerChange, kStepsPerChange));
    }
    for (std::size_t i = 0; i < count; ++i) {
      times_["total_ns"].push_back(time_period(script_, first + i, ours_, segments[i]));
    }
    for (std::size_t i = 0; i < count; ++i) times_["body_total_ns"].push_back(time_bodies(first + i));
    for (const auto& [key, engine] : changing_) {
      for (std::size_t i = 0; i < count; ++i) {
        times_[key].push_back(time_period(script_, first + i, *engine, segments[i]));
      }
      if (compared && key != "gimpact_total_ns") {
        report.add("edges.fig11.total_different." + engine->name().substr(0, engine->name().find(',')),
                   static_cast<double>(count_different(segments.back(), ours_, *engine)));
      }
    }
    for (std::size_t period = first; period < first + count; ++period) {
      for (const WallChange& change : script_.changes[period]) {
        for (const auto& item : change.removed) present_[item.id] = 0;
        for (const auto& item : change.added) present_[item.id] = 1;
      }
    }
  }

  /** Queries alone, in the walls as they are now, every peer with a structure made for these. */
  void time_queries(std::size_t period, int rounds, Agreement& agreement) {
    const Segments segments = script_.casts(period * kStepsPerChange, kStepsPerChange);
    std::vector<scenes::Wall> now;
    for (std::size_t id = 0; id < present_.size(); ++id) {
      if (present_[id] != 0) now.push_back(all_.walls[id]);
    }
    const WallMesh walls(*all_.points, std::move(now));
    if (chosen_.empty()) {
      for (const auto& [key, ways] : peers()) chosen_[key] = choose(ways, walls, segments);
    }
    std::vector<std::pair<std::string, std::unique_ptr<Engine>>> engines;
    engines.emplace_back("ns", std::make_unique<Ours>(scene_.world, walls));
    std::vector<Engine*> compared = {engines.front().second.get()};
    for (const auto& [key, make] : chosen_) {
      engines.emplace_back(key, make(walls));
      if (key.rfind("gimpact", 0) != 0) compared.push_back(engines.back().second.get());
    }
    for (const auto& engine : engines) engine.second->prepare(segments);
    for (int round = 0; round < rounds; ++round) {
      for (const auto& [key, engine] : engines) times_[key].push_back(time_steps(*engine, segments));
    }
    agreement.compare(segments, compared, walls, 40);
  }

  /** Bodies have done what was recorded, and the lattice is as it was. */
  void finish() {
    std::vector<double> positions;
    std::vector<dsw_volume_id> volumes;
    flock_.places(positions, volumes);
    if (positions != script_.positions.back()) {
      throw std::runtime_error("bodies of figure 11 went elsewhere than recorded");
    }
    for (const WallChange& change : script_.undo) ours_.apply(change);
    changing_.clear();
  }

 private:
  using MakeChanging = std::function<std::unique_ptr<ChangingEngine>()>;

  dsw_environment* ready_for_bodies() {
    mark_cells(bodies_world_, scene_.grid.obstacle);
    return bodies_world_.environment();
  }

  /** Measures one period, as time_period does, of our bodies. They have an environment of their own: a mark costs more
   * beside bodies. */
  double time_bodies(std::size_t period) {
    return cpu_time_ns([&] {
             for (const WallChange& change : script_.changes[period]) mark(bodies_world_, change);
             for (std::size_t step = 0; step < kStepsPerChange; ++step) {
               flock_.move(script_.targets[period * kStepsPerChange + step].data());
             }
           }) /
           static_cast<double>(kStepsPerChange * script_.batch());
  }

  /** Tries each way on the first period. The structures are made of all walls, then those that are to come vanish. */
  void choose_changing(const std::string& key, const Segments& segments, const std::vector<MakeChanging>& ways) {
    WallChange later;
    for (auto id = static_cast<std::uint32_t>(scene_.walls.walls.size()); id < script_.slots; ++id) {
      later.removed.push_back({id, all_.walls[id]});
    }
    const auto make_ready = [&](const MakeChanging& make) {
      auto engine = make();
      engine->apply(later);
      return engine;
    };
    std::size_t best = 0;
    std::vector<double> ns;
    for (const MakeChanging& make : ways) {
      const auto engine = make_ready(make);
      ns.push_back(time_period(script_, 0, *engine, segments));
      std::printf("    %-40s %.1f ns\n", engine->name().c_str(), ns.back());
      best = ns.back() < ns[best] ? ns.size() - 1 : best;
    }
    changing_.emplace_back(key, make_ready(ways[best]));
  }

  std::string label_;
  Fig11Case scene_;
  Script script_;
  WallMesh all_;               // by id, whether present or not
  std::vector<char> present_;  // by id
  OursChanging ours_;
  World bodies_world_;
  Flock flock_;
  std::vector<std::pair<std::string, std::unique_ptr<ChangingEngine>>> changing_;
  std::map<std::string, Make> chosen_;
  std::map<std::string, std::vector<double>> times_;
};

void report_ratios(Contest& contest, Report& report) {
  for (const auto& [key, values] : contest.times()) report.set("edges.fig11." + key + contest.label(), median(values));
  const auto over = [&](const char* key, const char* theirs, const char* ours) {
    report.set("edges.fig11." + (key + contest.label()), median_ratio(contest.times(theirs), contest.times(ours)));
  };
  over("vs_bullet_segment", "bullet_ns", "ns");
  over("vs_bullet_box", "bullet_box_ns", "ns");
  over("vs_gimpact", "gimpact_ns", "ns");
  over("vs_gimpact_box", "gimpact_box_ns", "ns");
  over("vs_embree", "embree_ns", "ns");
  over("vs_grid", "grid_ns", "ns");
  over("total_vs_bullet", "bullet_total_ns", "total_ns");
  over("total_vs_gimpact", "gimpact_total_ns", "total_ns");
  over("total_vs_embree", "embree_total_ns", "total_ns");
  over("total_vs_grid", "grid_total_ns", "total_ns");
  const char* best = "bullet_total_ns";
  for (const char* key : {"embree_total_ns", "gimpact_total_ns"}) {
    best = median(contest.times(key)) < median(contest.times(best)) ? key : best;
  }
  over("total_vs_best_peer", best, "total_ns");
  over("body_total_vs_best_peer", best, "body_total_ns");
  over("body_total_vs_grid", "grid_total_ns", "body_total_ns");
  report.set("edges.fig11.ms_per_step" + contest.label(),
             1e-6 * median(contest.times("total_ns")) * static_cast<double>(contest.script().batch()));
}

/** Figure 10: the lattices, and the smallest with its obstacles, those that come first, and the bodies at the start and
 * at the end. */
void write_scene(const std::vector<std::unique_ptr<Contest>>& contests, const std::string& path) {
  nlohmann::ordered_json scene;
  for (const auto& contest : contests) {
    const auto& obstacle = contest->grid().obstacle;
    scene["lattices"].push_back(
        {{"size", contest->grid().options.size}, {"obstacles", std::count(obstacle.begin(), obstacle.end(), 1)}});
  }
  const Script& script = contests.front()->script();
  const scenes::HexGrid& grid = contests.front()->grid();
  for (std::uint32_t cell = 0; cell < grid.obstacle.size(); ++cell) {
    if (grid.obstacle[cell] != 0) scene["obstacles"].push_back(cell);
  }
  for (const dsw_volume_id& volume : script.changes.front()[1].volumes) scene["appearing"].push_back(volume.index);
  const auto write_bodies = [&scene](const char* name, const std::vector<double>& positions) {
    for (std::size_t i = 0; i < positions.size(); i += 3) {
      auto& bodies = scene[name];
      if (i % (3 * scenes::kBodyVertices) == 0) bodies.push_back(nlohmann::ordered_json::array());
      bodies.back().push_back({positions[i], positions[i + 1], positions[i + 2]});
    }
  };
  write_bodies("bodies", script.positions.front());
  write_bodies("bodies_at_the_end", script.positions.back());
  std::ofstream file(path);
  file << scene.dump() << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace

void run_fig11(const Options& options, Report& report, Agreement& agreement) {
  constexpr std::size_t kSteps = 1000, kPeriods = kSteps / kStepsPerChange;
  constexpr std::size_t kTurn = 5;                  // periods
  const std::size_t every = options.quick ? 5 : 2;  // turns, between those after which queries are timed alone
  const int rounds = options.quick ? 3 : 5;
  std::vector<std::unique_ptr<Contest>> contests;
  const std::pair<const char*, std::size_t> sizes[] = {
      {".n1e3", 1000}, {".n1e4", 10000}, {".n1e5", 100000}, {".n1e6", 1000000}};
  for (const auto& [label, cells] : sizes) {
    std::printf("  %s\n", label);
    contests.push_back(std::make_unique<Contest>(label, cells, kSteps, report));
  }
  if (!options.scene.empty()) write_scene(contests, options.scene);
  for (std::size_t turn = 0; turn < kPeriods / kTurn; ++turn) {
    const bool alone = turn % every == every / 2;
    for (const auto& contest : contests) {
      contest->time_periods(turn * kTurn, kTurn, alone, report);
      if (alone) contest->time_queries((turn + 1) * kTurn - 1, rounds, agreement);
    }
  }
  for (const auto& contest : contests) {
    contest->finish();
    report_ratios(*contest, report);
    const Work work = count_work(contest->scene().world, contest->script().casts(0, kStepsPerChange), kStepsPerChange);
    report.set("edges.fig11.cells_per_cast" + contest->label(), work.cells / work.casts);
    report.set("edges.fig11.orientation_tests_per_cast.casts_alone" + contest->label(),
               work.orientation_tests / work.casts);
  }
  Contest &small = *contests.front(), &large = *contests.back();
  report.set("edges.fig11.bodies", static_cast<double>(kBodies));
  report.set("edges.fig11.steps", static_cast<double>(large.script().steps));
  report.set("edges.fig11.shape_matching", 1);
  report.set("edges.fig11.flatness", median_ratio(large.times("total_ns"), small.times("total_ns")));
  report.set("edges.fig11.body_flatness", median_ratio(large.times("body_total_ns"), small.times("body_total_ns")));
  report.set("edges.fig11.casts_per_step", static_cast<double>(large.script().batch()));
  report.set("edges.fig11.body_over_casts", median_ratio(large.times("body_total_ns"), large.times("total_ns")));
  const Script still = large.scene().record(options.quick ? 60 : 200, false);
  measure_fig11_bodies(large.scene(), still, options.quick ? 5000 : 50000, report);
}

}  // namespace dsw::bench
