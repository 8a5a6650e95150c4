// Near rows of wires in tetrahedra: the first time, while the wires move a little, and where nothing is near; beside
// Embree's point query and, where it is installed, FCL's distance on the same edges and walls. The peers find the
// nearest wall of an edge, the rows are all that are near.
#include "parts.h"

#include "near_peers.h"
#include "ours.h"
#include "timing.h"

#include "scenes/delaunay.h"
#include "scenes/random.h"
#include "scenes/tets.h"

#include <algorithm>
#include <cmath>

namespace dsw::bench {
namespace {

constexpr std::size_t kWires = 40, kEdges = 50;
constexpr double kStep = 0.01;  // of a mean edge, in one step

/** A free wire in a cube. Its straight edges are as long as a mean edge of the mesh. It turns where something is in its
 * way. */
std::vector<double> make_wire(const dsw_environment* environment, double length, double lower, double upper,
                              scenes::Random& random) {
  std::vector<double> at;
  double way[3];
  const auto any = [&](double* v, double least, double most) {
    for (int k = 0; k < 3; ++k) v[k] = random.uniform(least, most);
  };
  at.resize(3);
  any(at.data(), lower, upper);
  any(way, -1, 1);
  for (int tries = 0; tries < 2000 && at.size() < 3 * (kEdges + 1); ++tries) {
    const double* const p = at.data() + at.size() - 3;
    double turn[3], q[3];
    any(turn, -1, 1);
    for (int k = 0; k < 3; ++k) way[k] += (tries % 8 == 7 ? 2 : 0.3) * turn[k];
    const double size = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    for (int k = 0; k < 3; ++k) {
      way[k] /= size;
      q[k] = p[k] + length * way[k];
    }
    dsw_flight flight;
    const auto is_inside = [&](double x) { return x >= lower && x <= upper; };
    if (!std::all_of(q, q + 3, is_inside)) continue;
    check(dsw_environment_cast(environment, {0, 0}, p, q, nullptr, &flight));
    if (flight.outcome == DSW_OUTCOME_REACHED) at.insert(at.end(), q, q + 3);
  }
  return at;
}

struct Wire {
  dsw_body_id body;
  std::vector<double> at;
};

class Wires {
 public:
  Wires(World& world, double length, double lower = 0.05, double upper = 0.95)
      : scene_(world.scene()), step_(kStep * length), random_(31) {
    for (std::size_t w = 0; w < kWires; ++w) {
      Wire wire{{0, 0}, make_wire(world.environment(), length, lower, upper, random_)};
      std::vector<std::uint32_t> edges;
      const std::size_t vertices = wire.at.size() / 3;
      for (std::uint32_t i = 0; i + 1 < vertices; ++i) edges.insert(edges.end(), {i, i + 1});
      dsw_body_desc desc;
      dsw_body_desc_init(&desc, sizeof desc);
      desc.positions = wire.at.data();
      desc.vertex_count = vertices;
      desc.edges = edges.data();
      desc.edge_count = edges.size() / 2;
      check(dsw_body_create(scene_, &desc, &wire.body));
      edges_ += desc.edge_count;
      wires_.push_back(wire);
    }
  }

  std::size_t edge_count() const { return edges_; }
  /** Shakes all vertices a little. */
  void move() {
    for (Wire& wire : wires_) {
      std::vector<double> targets = wire.at;
      for (double& x : targets) x += random_.uniform(-step_, step_);
      check(dsw_body_move(scene_, wire.body, targets.data(), targets.size() / 3, 0, nullptr, nullptr));
    }
  }
  /** How many rows there are. */
  std::size_t find(double margin) {
    dsw_near_options options;
    dsw_near_options_init(&options, sizeof options);
    options.margin = margin;
    std::size_t all = 0;
    for (const Wire& wire : wires_) {
      std::size_t count = 0;
      check(dsw_body_find_near_rows(scene_, wire.body, &options, &count));
      all += count;
    }
    return all;
  }
  /** The nearest wall of each edge by a peer. */
  double ask(NearPeer& peer, double radius) {
    double least = HUGE_VAL;
    for (const Wire& wire : wires_) {
      for (std::size_t i = 0; i + 6 <= wire.at.size(); i += 3) {
        least = std::min(least, peer.distance(&wire.at[i], &wire.at[i + 3], radius));
      }
    }
    return least;
  }

 private:
  dsw_scene* scene_;
  double step_;
  scenes::Random random_;
  std::vector<Wire> wires_;
  std::size_t edges_ = 0;
};

/** Lets the library forget what is near: marks an edge, and takes the mark back. */
void change_environment(World& world) {
  const dsw_edge_id edge = [&] {
    dsw_volume_id volume;
    check(dsw_environment_get_volume_id(world.environment(), 0, &volume));
    return dsw_edge_id{volume.index, volume.generation, 0};
  }();
  for (const dsw_mark mark : {DSW_MARK_IMPASSABLE, DSW_MARK_PASSABLE}) {
    check(dsw_environment_mark_edges(world.environment(), &edge, 1, mark));
  }
}

struct Figures {
  double first = 0, moving = 0;
};

Figures run_size(std::size_t cells, const std::string& suffix, const Options& options, Report& report) {
  const scenes::VolumeMesh mesh = scenes::make_delaunay(cells, 3);
  const auto neighbours = scenes::tet_neighbours(mesh);
  const scenes::TetWalls walls = scenes::random_tet_walls(mesh, neighbours, 0.05, 5);
  World world(mesh, 1);
  mark_triangles(world, walls.marked);
  const WallMesh wall_mesh(mesh.points, walls.all);
  const double edge = scenes::mean_edge(mesh), margin = 0.5 * edge;
  Wires wires(world, edge);
  std::vector<std::unique_ptr<NearPeer>> peers;
  peers.push_back(make_near_embree(wall_mesh));
  if (auto fcl = make_near_fcl(wall_mesh)) peers.push_back(std::move(fcl));

  std::size_t rows = 0;
  wires.find(margin);
  const auto time_of = [&](const auto& call) {
    return 1e-3 * cpu_time_ns(call) / static_cast<double>(wires.edge_count());
  };
  /** Medians of our times, with the ratios to the peers' in the report. */
  const auto run_rounds = [&](const std::string& key, bool forgets) {
    std::vector<double> ours;
    std::vector<std::vector<double>> theirs(peers.size());
    for (int round = 0; round < (options.quick ? 9 : 25); ++round) {
      wires.move();
      if (forgets) change_environment(world);
      ours.push_back(time_of([&] { rows = wires.find(margin); }));
      for (std::size_t p = 0; p < peers.size(); ++p) {
        theirs[p].push_back(time_of([&] { wires.ask(*peers[p], margin); }));
      }
    }
    for (std::size_t p = 0; p < peers.size(); ++p) {
      report.set("near." + key + "_vs_" + peers[p]->name() + suffix, median_ratio(theirs[p], ours));
    }
    return median(ours);
  };
  // One after the other: in a simulation the environment does not change between most calls.
  const double moving = run_rounds("rows", false), first = run_rounds("first_rows", true);
  const Figures figures{first, moving};
  report.set("near.us_per_edge" + suffix, figures.moving);
  report.set("near.first_us_per_edge" + suffix, figures.first);
  report.set("near.rows_per_edge" + suffix, static_cast<double>(rows) / static_cast<double>(wires.edge_count()));
  return figures;
}

/** Wires in the middle of an environment without walls but its outer boundary. */
void run_far(const Options& options, Report& report) {
  const scenes::VolumeMesh mesh = scenes::make_delaunay(100000, 3);
  World world(mesh, 1);
  const double edge = scenes::mean_edge(mesh), margin = 0.25 * edge;
  Wires wires(world, edge, 0.2, 0.8);
  std::vector<double> rounds;
  wires.find(margin);
  std::size_t rows = 0;
  for (int round = 0; round < (options.quick ? 9 : 25); ++round) {
    wires.move();
    rounds.push_back(1e-3 * cpu_time_ns([&] { rows = wires.find(margin); }) / static_cast<double>(wires.edge_count()));
  }
  report.set("near.skipped_us_per_edge", median(rounds));
  report.set("near.skipped_rows_per_edge", static_cast<double>(rows) / static_cast<double>(wires.edge_count()));
}

}  // namespace

void run_near_rows(const Options& options, Report& report) {
  const Figures small = run_size(10000, ".n1e4", options, report);
  const Figures large = run_size(1000000, ".n1e6", options, report);
  report.set("near.flatness", large.moving / small.moving);
  report.set("near.first_flatness", large.first / small.first);
  run_far(options, report);
}

}  // namespace dsw::bench
