// Random obstacles while bodies move, [JCD10] 7.4: at every step 16 cells that were obstacles for a step become
// passable and 16 others become obstacles, then the step's casts are made.
#include "parts.h"

#include "change_list.h"
#include "embree_change.h"
#include "grid.h"
#include "hex_case.h"
#include "timing.h"

#include <algorithm>
#include <cstdio>

namespace dsw::bench {

namespace {

constexpr std::size_t kObstacles = 16;

/** What happens in every step, recorded: the same for all. */
struct Script {
  Segments segments;  // of a step a batch
  std::vector<double> starts;
  std::vector<std::vector<double>> targets;
  std::vector<std::vector<WallChange>> changes;
  WallChange undo;  // after the last step
  std::size_t slots = 0;
};

void mark(dsw_environment* environment, const WallChange& change, std::uint32_t flags) {
  check(dsw_environment_mark_volumes(environment, change.volumes.data(), change.volumes.size(),
                                     change.impassable ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE, flags, nullptr));
}

/** Passable cells without a vertex, of which none is another's neighbour: between neighbours no wall would stay. */
std::vector<std::uint32_t> choose_obstacles(const scenes::HexGrid& grid, const ChangeList& list,
                                            const std::vector<std::uint8_t>& occupied, scenes::Random& random) {
  std::vector<std::uint32_t> set;
  for (int tries = 0; tries < 10000 && set.size() < kObstacles; ++tries) {
    const auto cell = static_cast<std::uint32_t>(random.index(grid.obstacle.size()));
    const bool near = std::any_of(set.begin(), set.end(), [&](std::uint32_t other) {
      for (std::uint32_t side = 0; side < 6; ++side) {
        if (scenes::neighbour(grid, cell, side) == other) return true;
      }
      return cell == other;
    });
    if (list.passable(cell) && occupied[cell] == 0 && !near) set.push_back(cell);
  }
  return set;
}

Script record(HexCase& scene, std::size_t steps) {
  Script script;
  script.starts = scene.motion.starts();
  script.segments.batch = scene.motion.body_count() * scenes::kBodySegments;
  ChangeList list(scene.grid, scene.world, scene.walls);
  scenes::Random random(22);
  std::vector<std::uint32_t> cells, last;
  for (std::size_t step = 0; step < steps; ++step) {
    std::vector<std::uint8_t> occupied(scene.grid.obstacle.size());
    // The particles of our scene stay where they were first.
    const std::vector<double>& now = scene.motion.starts();
    for (const std::vector<double>* at : {&now, static_cast<const std::vector<double>*>(&script.starts)}) {
      for (std::size_t i = 0; i < at->size(); i += 3) occupied[scene.grid.cell_at(&(*at)[i])] = 1;
    }
    std::vector<WallChange> changes;
    if (!last.empty()) changes.push_back(list.turn(last, false));
    last = choose_obstacles(scene.grid, list, occupied, random);
    changes.push_back(list.turn(last, true));
    script.changes.push_back(std::move(changes));
    script.targets.push_back(scene.motion.targets());
    scenes::append_step_segments(scene.grid, scene.motion, script.segments.from, script.segments.to, cells);
    scene.motion.advance();
  }
  script.undo = list.turn(last, false);
  script.slots = list.slots();
  locate_starts(scene.world, cells, script.segments);
  return script;
}

/** Times of the first steps, each with its changes. */
template <typename Change, typename Step>
std::vector<double> time_steps(const Script& script, std::size_t steps, Change&& change, Step&& run) {
  std::vector<double> ns;
  for (std::size_t step = 0; step < steps; ++step) {
    ns.push_back(cpu_time_ns([&] {
      for (const WallChange& each : script.changes[step]) change(each);
      run(step);
    }));
  }
  change(steps < script.changes.size() ? script.changes[steps][0] : script.undo);
  return ns;
}

std::vector<double> time_steps(const Script& script, std::size_t steps, ChangingEngine& engine) {
  return time_steps(
      script, steps, [&](const WallChange& change) { engine.apply(change); },
      [&](std::size_t step) { engine.run(step * script.segments.batch, script.segments.batch); });
}

/** The fastest of Embree's ways, on the first steps. */
std::unique_ptr<ChangingEngine> fastest_embree(const HexCase& scene, const Script& script) {
  std::unique_ptr<ChangingEngine> best;
  double best_ns = 0;
  const auto try_out = [&](std::unique_ptr<ChangingEngine> engine) {
    engine->prepare(script.segments);
    time_steps(script, 1, *engine);
    const double ns = median(time_steps(script, 2, *engine));
    std::printf("    %-36s %.0f ns\n", engine->name().c_str(), ns);
    if (!best || ns < best_ns) {
      best = std::move(engine);
      best_ns = ns;
    }
  };
  for (const bool refit : {false, true}) try_out(make_embree_single(scene.walls, script.slots, refit));
  for (const bool instances : {false, true}) {
    for (const double chunk : {8.0, 13.0}) try_out(make_embree_chunks(scene.walls, chunk, instances));
  }
  return best;
}

class ChangingGrid final : public ChangingEngine {
 public:
  explicit ChangingGrid(const WallMesh& walls) : ChangingEngine("grid"), grid_(walls, 1.0) {}
  void apply(const WallChange& change) override {
    for (const auto& item : change.removed) grid_.remove(item.id, item.wall);
    for (const auto& item : change.added) grid_.insert(item.id, item.wall);
  }
  void prepare(const Segments& segments) override { grid_.prepare(segments); }
  void run(std::size_t first, std::size_t count) override { grid_.run(first, count); }
  Answer answer(std::size_t i) const override { return grid_.answer(i); }

 private:
  Grid grid_;
};

/** Share of the casts of the last step before the undo that two engines see alike: met or not. */
double agreement_of(const Script& script, const Ours& ours, const ChangingEngine& peer) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < script.segments.batch; ++i) {
    same += (ours.flights()[i].outcome == DSW_OUTCOME_CONTACT) == (peer.answer(i).wall != kNone) ? 1u : 0u;
  }
  return static_cast<double>(same) / static_cast<double>(script.segments.batch);
}

/** Bodies of a scene, and which of those that were to be made they are. */
struct Bodies {
  std::vector<dsw_body_id> ids;
  std::vector<std::size_t> numbers;
};

/** Makes bodies of eight vertices and twelve edges. */
Bodies make_bodies(const HexCase& at, dsw_scene* scene, const std::vector<double>& starts) {
  std::vector<std::uint32_t> edges;
  for (const auto& edge : scenes::kEdgeVertices) edges.insert(edges.end(), {edge[0], edge[1]});
  Bodies bodies;
  for (std::size_t i = 0; i < starts.size(); i += 3 * scenes::kBodyVertices) {
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    desc.positions = &starts[i];
    std::vector<std::uint32_t> cells;
    for (std::size_t k = 0; k < scenes::kBodyVertices; ++k) cells.push_back(at.grid.cell_at(&starts[i + 3 * k]));
    const std::vector<dsw_volume_id> hints = volume_ids(at.world, cells);
    desc.hints = hints.data();
    desc.vertex_count = scenes::kBodyVertices;
    desc.edges = edges.data();
    desc.edge_count = scenes::kBodyEdges;
    desc.level = DSW_LEVEL_EDGES;
    dsw_body_id body;
    if (dsw_body_create(scene, &desc, &body) != DSW_STATUS_OK) continue;  // an edge of it crosses an obstacle
    bodies.ids.push_back(body);
    bodies.numbers.push_back(i / (3 * scenes::kBodyVertices));
  }
  return bodies;
}

/** The changes alone, with bodies that stand still; microseconds a step. */
double time_marks(HexCase& scene, const Script& script, const std::vector<double>& starts, std::uint32_t features) {
  scene.world.close_scene();
  make_bodies(scene, scene.world.scene(features), starts);
  dsw_environment* const environment = scene.world.environment();
  std::vector<double> ns;
  for (int round = 0; round < 5; ++round) {
    ns.push_back(median(time_steps(
        script, script.changes.size(),
        [&](const WallChange& change) { mark(environment, change, DSW_MARK_SKIP_OCCUPIED); }, [](std::size_t) {})));
  }
  scene.world.close_scene();
  return 1e-3 * median(ns);
}

/** Bodies that really move and stop, changes included; microseconds a step. */
double time_moves(HexCase& scene, const Script& script, std::uint32_t features) {
  scene.world.close_scene();
  dsw_scene* const handle = scene.world.scene(features);
  const Bodies bodies = make_bodies(scene, handle, script.starts);
  constexpr std::size_t kDoubles = 3 * scenes::kBodyVertices;
  std::vector<std::vector<double>> targets;
  for (const std::vector<double>& all : script.targets) {
    targets.emplace_back();
    for (const std::size_t number : bodies.numbers) {
      targets.back().insert(targets.back().end(), &all[kDoubles * number], &all[kDoubles * number] + kDoubles);
    }
  }
  std::vector<double> ns = time_steps(
      script, script.changes.size(),
      [&](const WallChange& change) { mark(scene.world.environment(), change, DSW_MARK_SKIP_OCCUPIED); },
      [&](std::size_t step) {
        check(dsw_scene_move_bodies(handle, bodies.ids.data(), bodies.ids.size(), targets[step].data(),
                                    bodies.ids.size() * scenes::kBodyVertices, 0, nullptr, nullptr));
      });
  scene.world.close_scene();
  return 1e-3 * median(std::move(ns));
}

double run_lattice(std::size_t cells, const Options& options, Report& report) {
  scenes::HexGridOptions grid_options;
  grid_options.size = scenes::hex_grid_size(cells);
  const std::string label = cells == 1000 ? "n1e3" : "n1e6";
  HexCase scene("obstacles." + label, grid_options, {}, 1);
  const Script script = record(scene, options.quick ? 30 : 200);
  const std::size_t steps = script.changes.size();

  std::unique_ptr<ChangingEngine> embree = fastest_embree(scene, script);
  ChangingGrid grid(scene.walls);
  Ours ours(scene.world, scene.walls);
  for (Engine* engine : std::initializer_list<Engine*>{embree.get(), &grid, &ours}) engine->prepare(script.segments);
  std::vector<dsw_particle_id> particles(script.starts.size() / 3);
  check(dsw_scene_create_particles(scene.world.scene(DSW_FEATURE_LIVE_CHANGES), script.starts.data(), particles.size(),
                                   0, nullptr, particles.data(), nullptr));
  std::vector<double> ours_ns, grid_ns, embree_ns;
  for (int round = 0; round < 5; ++round) {
    ours_ns.push_back(median(time_steps(
        script, steps, [&](const WallChange& change) { mark(scene.world.environment(), change, 0); },
        [&](std::size_t step) { ours.run(step * script.segments.batch, script.segments.batch); })));
    grid_ns.push_back(median(time_steps(script, steps, grid)));
    embree_ns.push_back(median(time_steps(script, steps, *embree)));
  }
  report.set("obstacles.us." + label, 1e-3 * median(ours_ns));
  report.set("obstacles.vs_embree." + label, median_ratio(embree_ns, ours_ns));
  report.set("obstacles.vs_grid." + label, median_ratio(grid_ns, ours_ns));
  report.set("obstacles.agree_share.embree." + label, agreement_of(script, ours, *embree));
  report.set("obstacles.agree_share.grid." + label, agreement_of(script, ours, grid));
  report.set("obstacles.moves_us." + label, time_moves(scene, script, DSW_FEATURE_LIVE_CHANGES));
  report.set("obstacles.moves_us.no_register." + label, time_moves(scene, script, 0));
  report.set("obstacles.marks_us." + label, time_marks(scene, script, script.starts, DSW_FEATURE_LIVE_CHANGES));
  report.set("obstacles.marks_us.no_register." + label, time_marks(scene, script, script.starts, 0));
  if (cells == 1000000) {
    scenes::BodyOptions many;
    many.bodies = 2250;
    const std::vector<double> starts = scenes::BodyMotion(scene.grid, many).starts();
    report.set("obstacles.marks_us.many_bodies", time_marks(scene, script, starts, DSW_FEATURE_LIVE_CHANGES));
    report.set("obstacles.marks_us.many_bodies.no_register", time_marks(scene, script, starts, 0));
  }
  return median(ours_ns);
}

}  // namespace

void run_obstacles(const Options& options, Report& report) {
  const double small = run_lattice(1000, options, report), large = run_lattice(1000000, options, report);
  report.set("obstacles.flatness", large / small);
}

}  // namespace dsw::bench
