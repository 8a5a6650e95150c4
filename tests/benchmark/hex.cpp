// The paper's scene at four sizes, with jittered and with sheared cells at the largest: casts of known start against
// Bullet, Embree and a uniform grid, and particles that move.
#include "parts.h"

#include "bullet.h"
#include "embree.h"
#include "grid.h"
#include "hex_case.h"
#include "timing.h"

#include <cstdio>
#include <map>

namespace dsw::bench {

namespace {

/** A lattice and the engines that cast in it. */
struct Contest {
  std::unique_ptr<HexCase> scene;
  Segments segments;
  std::unique_ptr<World> bending;  // the same lattice, with a scene that may deform it
  std::unique_ptr<World> bent;     // one that has, although its points are where they were
  std::vector<double> bent_points;
  std::unique_ptr<Ours> ours, plain, in_bending, in_bent;
  std::unique_ptr<Engine> bullet, bullet_box, embree, grid, packets, occluded;
  std::map<std::string, std::vector<double>> times;  // by key, one a round

  /** Engines by the keys of their times. */
  std::vector<std::pair<std::string, Engine*>> engines() const {
    std::vector<std::pair<std::string, Engine*>> all = {{"ns", ours.get()},
                                                        {"bullet_ns", bullet.get()},
                                                        {"bullet_box_ns", bullet_box.get()},
                                                        {"embree_ns", embree.get()},
                                                        {"grid_ns", grid.get()}};
    if (packets) {
      all.insert(all.end(), {{"embree8_ns", packets.get()},
                             {"embree_occluded_ns", occluded.get()},
                             {"no_detail_ns", plain.get()},
                             {"deforming_ns", in_bending.get()},
                             {"deformed_ns", in_bent.get()}});
    }
    return all;
  }
};

Contest make_contest(const std::string& label, std::size_t cells, double jitter, bool sheared, bool extras) {
  std::printf("  %s\n", label.c_str());
  scenes::HexGridOptions grid;
  grid.size = scenes::hex_grid_size(cells);
  grid.jitter = jitter;
  grid.sheared = sheared;
  Contest contest;
  contest.scene = std::make_unique<HexCase>(label, grid, scenes::BodyOptions{}, 1);
  HexCase& scene = *contest.scene;
  contest.ours = std::make_unique<Ours>(scene.world, scene.walls);
  Segments pilot;
  {
    scenes::BodyMotion motion(scene.grid, {});  // the same motion; the case's own has not started
    pilot.batch = motion.vertex_count() / scenes::kBodyVertices * scenes::kBodySegments;
    std::vector<std::uint32_t> at;
    for (int step = 0; step < 10; ++step) {
      scenes::append_step_segments(scene.grid, motion, pilot.from, pilot.to, at);
      motion.advance();
    }
  }
  contest.bullet = keep_fastest(make_bullets(scene.walls, false), pilot);
  contest.bullet_box = keep_fastest(make_bullets(scene.walls, true), pilot);
  contest.embree = keep_fastest(make_embrees(scene.walls), pilot);
  contest.grid = keep_fastest(make_grids(scene.walls, {0.5, 1.0, 1.5, 2.0}), pilot);
  if (extras) {
    contest.plain = std::make_unique<Ours>(scene.world, scene.walls, DSW_CAST_START_KNOWN | DSW_CAST_NO_DETAIL);
    for (auto* const world : {&contest.bending, &contest.bent}) {
      *world = std::make_unique<World>(scene.grid.mesh, 1);
      mark_cells(**world, scene.grid.obstacle);
      (*world)->scene(DSW_FEATURE_DEFORMING);
    }
    contest.in_bending = std::make_unique<Ours>(*contest.bending, scene.walls);
    contest.bent_points = scene.grid.mesh.points;
    check(dsw_environment_deform(contest.bent->environment(), contest.bent_points.data(),
                                 contest.bent_points.size() / 3, nullptr, nullptr));
    contest.in_bent = std::make_unique<Ours>(*contest.bent, scene.walls);
    contest.packets = make_embree({false, false, false, true, false}, scene.walls);
    contest.occluded = make_embree({false, false, false, false, true}, scene.walls);
  }
  return contest;
}

/** Particles that really move and stop: 8 a body, then casts along the edges. */
void run_particles(Contest& contest, std::size_t steps, Report& report) {
  HexCase& scene = *contest.scene;
  scenes::BodyMotion motion(scene.grid, {});
  const std::size_t vertices = motion.vertex_count();
  const std::size_t bodies = vertices / scenes::kBodyVertices;
  scene.world.close_scene();
  dsw_scene* handle = scene.world.scene();
  const auto to_space = [&](const std::vector<double>& lattice) {
    std::vector<double> space(lattice.size());
    for (std::size_t i = 0; i < lattice.size(); i += 3) {
      scenes::lattice_to_space(scene.grid.options, &lattice[i], &space[i]);
    }
    return space;
  };
  std::vector<dsw_particle_id> particles(vertices), edge_starts;
  check(dsw_scene_create_particles(handle, to_space(motion.starts()).data(), vertices, 0, nullptr, particles.data(),
                                   nullptr));
  for (std::size_t body = 0; body < bodies; ++body) {
    for (const auto& edge : scenes::kEdgeVertices) {
      edge_starts.push_back(particles[body * scenes::kBodyVertices + edge[0]]);
    }
  }
  std::vector<dsw_flight> flights(edge_starts.size());
  std::vector<double> edge_ends(3 * edge_starts.size());
  std::vector<double> move_ns, edge_ns;
  for (std::size_t step = 0; step < steps; ++step) {
    const auto targets = to_space(motion.targets());
    move_ns.push_back(time_ns([&] {
                        check(dsw_scene_move_particles(handle, particles.data(), vertices, targets.data(), 0, nullptr,
                                                       flights.data()));
                      }) /
                      static_cast<double>(vertices));
    for (std::size_t body = 0, out = 0; body < bodies; ++body) {
      for (const auto& edge : scenes::kEdgeVertices) {
        const double* end = &targets[3 * (body * scenes::kBodyVertices + edge[1])];
        std::copy_n(end, 3, &edge_ends[3 * out++]);
      }
    }
    edge_ns.push_back(time_ns([&] {
                        check(dsw_scene_cast_from_particles(handle, edge_starts.data(), edge_starts.size(),
                                                            edge_ends.data(), 0, nullptr, flights.data()));
                      }) /
                      static_cast<double>(edge_starts.size()));
    motion.advance();
  }
  scene.world.close_scene();
  report.set("walk.hex.particle_move_ns.n1e6", median(move_ns));
  report.set("walk.hex.particle_edge_ns.n1e6", median(edge_ns));
}

void report_work(const std::string& prefix, const Work& work, Report& report) {
  report.set(prefix + "orientation_tests_per_cast", work.orientation_tests / work.casts);
  report.set(prefix + "cells_per_cast", work.cells / work.casts);
  report.set(prefix + "hit_share", work.contacts / work.casts);
  report.set(prefix + "exact_fallbacks_per_cast", work.exact_fallbacks / work.casts);
  report.set(prefix + "ties_per_cast", work.ties / work.casts);
}

}  // namespace

void run_hex(const Options& options, Report& report, Agreement& agreement) {
  const std::size_t steps = options.quick ? 60 : 1000, block = 60;
  const int rounds = options.quick ? 9 : 5;
  std::vector<Contest> contests;
  contests.push_back(make_contest("hex.n1e3", 1000, 0.0, false, false));
  contests.push_back(make_contest("hex.n1e4", 10000, 0.0, false, false));
  contests.push_back(make_contest("hex.n1e5", 100000, 0.0, false, false));
  contests.push_back(make_contest("hex.n1e6", 1000000, 0.0, false, true));
  contests.push_back(make_contest("hex_warped.n1e6", 1000000, 0.1, false, false));
  contests.push_back(make_contest("hex_sheared.n1e6", 1000000, 0.0, true, false));

  std::size_t dropped = 0;
  for (std::size_t done = 0; done < steps; done += block) {
    const std::size_t now = std::min(block, steps - done);
    std::printf("  steps %zu to %zu of %zu\n", done + 1, done + now, steps);
    for (Contest& contest : contests) {
      dropped += contest.scene->next_block(now, contest.segments);
      std::vector<Engine*> compared;
      for (const auto& [key, engine] : contest.engines()) {
        engine->prepare(contest.segments);
        if (engine != contest.plain.get() && engine != contest.occluded.get()) compared.push_back(engine);
      }
      agreement.compare(contest.segments, compared, contest.scene->walls, done == 0 ? 2000 : 200);
      if (done == 0) {
        const std::string name = contest.scene->label;
        const std::string prefix = name == "hex.n1e6"           ? "walk.hex."
                                   : name == "hex_warped.n1e6"  ? "walk.hex_warped."
                                   : name == "hex_sheared.n1e6" ? "walk.hex_sheared."
                                                                : "";
        if (!prefix.empty()) report_work(prefix, count_work(contest.scene->world, contest.segments, 20), report);
      }
    }
    for (int round = 0; round < rounds; ++round) {
      for (Contest& contest : contests) {
        for (const auto& [key, engine] : contest.engines()) {
          auto& times = contest.times[key];
          times.resize(static_cast<std::size_t>(rounds), 0.0);
          const double share = static_cast<double>(now) / static_cast<double>(steps);
          times[static_cast<std::size_t>(round)] += share * time_casts(*engine, contest.segments);
        }
      }
    }
  }

  for (const Contest& contest : contests) {
    const std::string& label = contest.scene->label;
    const std::string family = label.substr(0, label.find('.')), size = label.substr(label.find('.'));
    for (const auto& [key, times] : contest.times) report.set("walk." + family + "." + key + size, median(times));
    const auto& ours = contest.times.at("ns");
    report.set("walk." + family + ".vs_bullet_segment" + size, median_ratio(contest.times.at("bullet_ns"), ours));
    report.set("walk." + family + ".vs_bullet_box" + size, median_ratio(contest.times.at("bullet_box_ns"), ours));
    report.set("walk." + family + ".vs_embree" + size, median_ratio(contest.times.at("embree_ns"), ours));
    report.set("walk." + family + ".vs_grid" + size, median_ratio(contest.times.at("grid_ns"), ours));
  }
  report.set("walk.hex.flatness", median_ratio(contests[3].times.at("ns"), contests[0].times.at("ns")));
  report.set("walk.hex_warped.over_hex", median_ratio(contests[4].times.at("ns"), contests[3].times.at("ns")));
  report.set("walk.no_detail_over_detail",
             median_ratio(contests[3].times.at("no_detail_ns"), contests[3].times.at("ns")));
  report.set("walk.deforming_over_static",
             median_ratio(contests[3].times.at("deforming_ns"), contests[3].times.at("ns")));
  report.set("walk.deformed_over_static",
             median_ratio(contests[3].times.at("deformed_ns"), contests[3].times.at("ns")));
  report.set("walk.hex.steps", static_cast<double>(steps));
  report.set("walk.hex.casts_per_step", static_cast<double>(contests[3].segments.batch));
  report.set("walk.hex.casts_left_out", static_cast<double>(dropped));
  run_particles(contests[3], options.quick ? 60 : 300, report);
}

}  // namespace dsw::bench
