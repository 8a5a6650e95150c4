// What is nearest to the edges of wires, and to their vertices, in tetrahedra; beside Embree's point query and, where it
// is installed, FCL's distance on the same edges and walls.
#include "parts.h"

#include "near_peers.h"
#include "ours.h"
#include "timing.h"

#include "scenes/delaunay.h"
#include "scenes/random.h"
#include "scenes/tets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace dsw::bench {

namespace {

constexpr std::size_t kEdges = 50;  // of a wire

/** Wires of straight edges as long as a mean edge of the mesh, which turn a little from edge to edge. */
Segments make_wires(std::size_t wires, double length) {
  scenes::Random random(21);
  Segments segments;
  const auto any = [&](double* v) {
    for (int k = 0; k < 3; ++k) v[k] = random.uniform(-1, 1);
  };
  for (std::size_t w = 0; w < wires; ++w) {
    double p[3], way[3];
    for (double& x : p) x = random.uniform(0.1, 0.9);
    any(way);
    for (std::size_t i = 0; i < kEdges; ++i) {
      double turn[3], q[3];
      any(turn);
      for (int k = 0; k < 3; ++k) way[k] += 0.3 * turn[k];
      const double size = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
      for (int k = 0; k < 3; ++k) {
        way[k] /= size;
        q[k] = p[k] + length * way[k];
        if (q[k] < 0.05 || q[k] > 0.95) way[k] = -way[k];
        q[k] = p[k] + length * way[k];
      }
      segments.from.insert(segments.from.end(), p, p + 3);
      segments.to.insert(segments.to.end(), q, q + 3);
      std::copy(q, q + 3, p);
    }
  }
  return segments;
}

void run_size(std::size_t cells, const std::string& suffix, const Options& options, Report& report,
              std::vector<double> (&times)[2]) {
  const scenes::VolumeMesh mesh = scenes::make_delaunay(cells, 3);
  const auto neighbours = scenes::tet_neighbours(mesh);
  const scenes::TetWalls walls = scenes::random_tet_walls(mesh, neighbours, 0.05, 5);
  World world(mesh, 1);
  mark_triangles(world, walls.marked);
  const WallMesh wall_mesh(mesh.points, walls.all);
  const double edge = scenes::mean_edge(mesh), radius = 0.5 * edge;
  const Segments segments = make_wires(40, edge);
  const std::size_t count = segments.count();

  std::vector<dsw_volume_id> hints(count);
  std::vector<dsw_segment_nearest> ours(count);
  std::vector<dsw_nearest> ours_points(count);
  check(dsw_environment_locate_points(world.environment(), segments.from.data(), count, 0, nullptr, hints.data(),
                                      nullptr));
  std::vector<std::pair<std::string, std::function<void()>>> runs;
  runs.emplace_back("us_per_segment", [&] {
    check(dsw_environment_find_nearest_to_segments(world.environment(), count, hints.data(), segments.from.data(),
                                                   segments.to.data(), 0, radius, ours.data(), nullptr, nullptr));
  });
  runs.emplace_back("us_per_point", [&] {
    check(dsw_environment_find_nearest_to_points(world.environment(), segments.from.data(), count, 0, hints.data(),
                                                 radius, ours_points.data(), nullptr, nullptr));
  });
  std::vector<std::unique_ptr<NearPeer>> peers;
  peers.push_back(make_near_embree(wall_mesh));
  if (auto fcl = make_near_fcl(wall_mesh)) peers.push_back(std::move(fcl));
  std::vector<std::vector<double>> found(peers.size(), std::vector<double>(count));
  for (std::size_t p = 0; p < peers.size(); ++p) {
    runs.emplace_back(peers[p]->name() + "_us_per_segment", [&, p] {
      for (std::size_t i = 0; i < count; ++i)
        found[p][i] = peers[p]->distance(&segments.from[3 * i], &segments.to[3 * i], radius);
    });
  }
  runs.emplace_back("embree_us_per_point", [&] {
    for (std::size_t i = 0; i < count; ++i)
      found[0][i] = peers[0]->distance(&segments.from[3 * i], &segments.from[3 * i], radius);
  });

  std::vector<std::vector<double>> rounds(runs.size());
  double differ = 0, passing = 0, near = 0, visited = 0;
  for (int round = 0; round < (options.quick ? 7 : 21); ++round) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      rounds[r].push_back(1e-3 * cpu_time_ns(runs[r].second) / static_cast<double>(count));
      if (round != 0) continue;
      // Peers see what lies behind a wall, too; floats are coarser.
      if (r == 2) {
        for (std::size_t i = 0; i < count; ++i) {
          const double d = ours[i].nearest.distance, peer = found[0][i];
          if (std::fabs(std::min(d, radius) - std::min(peer, radius)) > 1e-5 * edge) ++differ;
          passing += d == 0 ? 1 : 0;
          near += d <= radius ? 1 : 0;
          visited += ours[i].nearest.volumes_visited;
        }
      }
    }
  }
  const auto share = [&](double x) { return x / static_cast<double>(count); };
  for (std::size_t r = 0; r < runs.size(); ++r) report.set("near." + runs[r].first + suffix, median(rounds[r]));
  for (std::size_t p = 0; p < peers.size(); ++p)
    report.set("near.vs_" + peers[p]->name() + suffix, median_ratio(rounds[2 + p], rounds[0]));
  report.set("near.point_vs_embree" + suffix, median_ratio(rounds.back(), rounds[1]));
  report.set("near.differ" + suffix, differ);
  report.set("near.passing_share" + suffix, share(passing));
  report.set("near.near_share" + suffix, share(near));
  report.set("near.volumes_per_segment" + suffix, share(visited));
  times[0].push_back(median(rounds[0]));
  times[1].push_back(median(rounds[1]));
}

}  // namespace

void run_near(const Options& options, Report& report) {
  std::vector<double> times[2];
  run_size(10000, ".n1e4", options, report, times);
  run_size(1000000, ".n1e6", options, report, times);
  report.set("near.segment_flatness", times[0][1] / times[0][0]);
  report.set("near.point_flatness", times[1][1] / times[1][0]);
}

}  // namespace dsw::bench
