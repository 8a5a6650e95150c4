// Tetrahedra: a Delaunay mesh with some impassable faces, and a real vessel with its wall.
#include "parts.h"

#include "bullet.h"
#include "embree.h"
#include "grid.h"
#include "ours.h"
#include "timing.h"
#include "vessel_case.h"

#include "scenes/delaunay.h"
#include "scenes/tets.h"

#include <cmath>
#include <cstdio>

namespace dsw::bench {

namespace {

Segments to_segments(const World& world, const scenes::TetCasts& casts, std::size_t batch) {
  Segments segments;
  segments.batch = batch;
  segments.from = casts.from;
  segments.to = casts.to;
  locate_starts(world, casts.cells, segments);
  return segments;
}

struct Peers {
  std::unique_ptr<Engine> bullet, bullet_box, embree, grid;
};

Peers best_peers(const WallMesh& walls, double edge, const Segments& segments) {
  return {keep_fastest(make_bullets(walls, false), segments), keep_fastest(make_bullets(walls, true), segments),
          keep_fastest(make_embrees(walls), segments),
          keep_fastest(make_grids(walls, {0.7 * edge, edge, 1.5 * edge, 2.5 * edge}), segments)};
}

/** Compares, then times in turns; keys are prefix + ns + suffix and so on. */
void contest(const std::string& prefix, const std::string& suffix, Ours& ours, const Peers& peers,
             const WallMesh& walls, const Segments& segments, int rounds, Report& report, Agreement& agreement) {
  const std::vector<std::pair<std::string, Engine*>> engines = {{"ns", &ours},
                                                                {"bullet_ns", peers.bullet.get()},
                                                                {"bullet_box_ns", peers.bullet_box.get()},
                                                                {"embree_ns", peers.embree.get()},
                                                                {"grid_ns", peers.grid.get()}};
  std::vector<Engine*> compared;
  for (const auto& [key, engine] : engines) {
    engine->prepare(segments);
    compared.push_back(engine);
  }
  agreement.compare(segments, compared, walls, 1000);
  std::vector<std::vector<double>> times(engines.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < engines.size(); ++i) times[i].push_back(time_casts(*engines[i].second, segments));
  }
  for (std::size_t i = 0; i < engines.size(); ++i) report.set(prefix + engines[i].first + suffix, median(times[i]));
  report.set(prefix + "vs_bullet_segment" + suffix, median_ratio(times[1], times[0]));
  report.set(prefix + "vs_bullet_box" + suffix, median_ratio(times[2], times[0]));
  report.set(prefix + "vs_embree" + suffix, median_ratio(times[3], times[0]));
  report.set(prefix + "vs_grid" + suffix, median_ratio(times[4], times[0]));
}

void report_work(const std::string& prefix, const std::string& suffix, const Work& work, Report& report) {
  report.set(prefix + "orientation_tests_per_cast" + suffix, work.orientation_tests / work.casts);
  report.set(prefix + "cells_per_cast" + suffix, work.cells / work.casts);
  report.set(prefix + "hit_share" + suffix, work.contacts / work.casts);
}

}  // namespace

void run_tet(const Options& options, Report& report, Agreement& agreement) {
  const auto mesh = scenes::make_delaunay(200000, 11);
  const auto neighbours = scenes::tet_neighbours(mesh);
  const auto marks = scenes::random_tet_walls(mesh, neighbours, 0.01, 12);
  World world(mesh, 1);
  mark_triangles(world, marks.marked);
  const WallMesh walls(mesh.points, marks.all);
  const double edge = scenes::mean_edge(mesh);
  Ours ours(world, walls);
  const int rounds = options.quick ? 7 : 11;
  const std::size_t batch = 4500;  // as many as in a step of the paper's scene

  const auto few =
      to_segments(world, scenes::short_tet_casts(mesh, neighbours, options.quick ? 300000 : 1000000, 13), batch);
  const Peers peers = best_peers(walls, edge, few);
  report.set("walk.tet.cells", static_cast<double>(mesh.cell_count()));
  contest("walk.tet.", "_short", ours, peers, walls, few, rounds, report, agreement);
  report_work("walk.tet.", "_short", count_work(world, few, 20), report);

  const auto far =
      to_segments(world, scenes::long_tet_casts(mesh, options.quick ? 30000 : 100000, 15 * edge, 0, true, 14), batch);
  contest("walk.tet.", "_long", ours, peers, walls, far, rounds, report, agreement);
  report_work("walk.tet.", "_long", count_work(world, far, 2), report);
}

void run_vessel(const Options& options, Report& report, Agreement& agreement) {
  const auto mesh = read_vessel(options.vessel);
  const auto neighbours = scenes::tet_neighbours(mesh);
  World world(mesh, 1);
  std::size_t marked = 0;
  check(dsw_environment_mark_between(world.environment(), 1, 2, DSW_MARK_IMPASSABLE, &marked));
  auto all = scenes::region_walls(mesh, neighbours).all;
  const WallMesh walls(mesh.points, std::move(all));
  const double edge = scenes::mean_edge(mesh, 1);
  Ours ours(world, walls);
  report.set("walk.vessel.wall_triangles", static_cast<double>(marked));
  const std::size_t count = options.quick ? 200000 : 1000000;
  const auto segments = to_segments(world, scenes::long_tet_casts(mesh, count, 0.5 * edge, 1, false, 15), 4500);
  const Peers peers = best_peers(walls, edge, segments);
  const int rounds = options.quick ? 7 : 11;
  contest("walk.vessel.", "", ours, peers, walls, segments, rounds, report, agreement);
  report_work("walk.vessel.", "", count_work(world, segments, 20), report);
  const auto far = to_segments(world, scenes::long_tet_casts(mesh, count / 5, 3 * edge, 1, false, 16), 4500);
  contest("walk.vessel.", "_long", ours, peers, walls, far, rounds, report, agreement);
  report_work("walk.vessel.", "_long", count_work(world, far, 5), report);
}

}  // namespace dsw::bench
