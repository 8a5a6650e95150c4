// What grows with the number of cells: a lattice of cubes, each cut into six tetrahedra, made, cast in, walked through
// by a wire and bent. All but the size is the same from 1e5 to 1e7 tetrahedra; 1e8 with --long.
#include "parts.h"

#include "ours.h"
#include "timing.h"

#include "scenes/random.h"

#include <cmath>
#include <memory>

namespace dsw::bench {
namespace {

constexpr std::size_t kCasts = 200000, kPoints = 1000, kEdges = 200;
constexpr double kWire = 12;  // cubes; it begins 4 cubes from a side

/** Cubes of edge 1. All six tetrahedra of one have its diagonal, so neighbours fit. */
scenes::VolumeMesh make_lattice(std::size_t cells) {
  const auto n = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(cells) / 6)));
  scenes::VolumeMesh mesh;
  mesh.points_per_cell = 4;
  mesh.points.reserve(3 * (n + 1) * (n + 1) * (n + 1));
  for (std::size_t i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
    for (const std::size_t x : {i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1) / (n + 1)}) {
      mesh.points.push_back(static_cast<double>(x));
    }
  }
  constexpr std::size_t kTurns[6][2] = {{0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}};  // axes, one after the other
  const std::size_t steps[3] = {1, n + 1, (n + 1) * (n + 1)};
  mesh.connectivity.reserve(24 * n * n * n);
  for (std::size_t i = 0; i < n * n * n; ++i) {
    const std::size_t low = i % n + (i / n % n) * steps[1] + (i / n / n) * steps[2];
    for (std::size_t t = 0; t < 6; ++t) {
      const std::size_t a = low + steps[kTurns[t][0]], b = a + steps[kTurns[t][1]];
      const std::size_t high = low + steps[0] + steps[1] + steps[2];
      for (const std::size_t v : {low, t < 3 ? a : b, t < 3 ? b : a, high}) {
        mesh.connectivity.push_back(static_cast<std::int32_t>(v));
      }
    }
  }
  return mesh;
}

struct Figures {
  double cast_ns = 0, locate_ms = 0;
};

/** Casts of about one cube from the middles of random cells. */
double cast_ns(const World& world, const scenes::VolumeMesh& mesh, std::size_t rounds) {
  scenes::Random random(3);
  std::vector<dsw_volume_id> starts(kCasts);
  std::vector<double> from(3 * kCasts), to(3 * kCasts);
  for (std::size_t i = 0; i < kCasts; ++i) {
    const std::size_t cell = random.index(mesh.cell_count());
    check(dsw_environment_get_volume_id(world.environment(), static_cast<std::uint32_t>(cell), &starts[i]));
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t v = 0; v < 4; ++v) {
        from[3 * i + k] += 0.25 * mesh.point(static_cast<std::size_t>(mesh.cell(cell)[v]))[k];
      }
      to[3 * i + k] = from[3 * i + k] + random.uniform(-0.6, 0.6);
    }
  }
  dsw_cast_options options;
  dsw_cast_options_init(&options, sizeof options);
  options.flags = DSW_CAST_START_KNOWN;
  std::vector<dsw_flight> flights(kCasts);
  std::vector<double> taken;
  for (std::size_t round = 0; round < rounds; ++round) {
    taken.push_back(cpu_time_ns([&] {
      check(dsw_environment_cast_segments(world.environment(), kCasts, starts.data(), from.data(), to.data(), 0,
                                          &options, flights.data()));
    }));
  }
  return median(taken) / static_cast<double>(kCasts);
}

/** The first points without a hint: scans, and then the tree of cells is made. */
double first_locate_ns(const World& world, const scenes::VolumeMesh& mesh) {
  const double size = mesh.points.back();
  scenes::Random random(5);
  std::vector<double> points(3 * kPoints);
  for (double& x : points) x = random.uniform(0, size);
  std::vector<dsw_volume_id> volumes(kPoints);
  return time_ns([&] {
    check(dsw_environment_locate_points(world.environment(), points.data(), kPoints, 0, nullptr, volumes.data(),
                                        nullptr));
  });
}

/** A wire whose vertices all go a little, and then a wave of all points of the mesh. */
void run_wire(World& world, const scenes::VolumeMesh& mesh, const std::string& suffix, std::size_t rounds,
              Report& report) {
  dsw_scene* const scene = world.scene(DSW_FEATURE_DEFORMING);
  scenes::Random random(7);
  std::vector<double> rest;
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i <= kEdges; ++i) {
    rest.insert(rest.end(), {4 + kWire * i / kEdges, 8.3 + 0.5 * std::sin(0.05 * i), 7.9});
    if (i != 0) edges.insert(edges.end(), {i - 1, i});
  }
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = rest.data();
  desc.vertex_count = kEdges + 1;
  desc.edges = edges.data();
  desc.edge_count = kEdges;
  dsw_body_id wire;
  check(dsw_body_create(scene, &desc, &wire));
  std::vector<double> moving, bending;
  for (std::size_t round = 0; round < 4 * rounds; ++round) {
    std::vector<double> targets = rest;
    for (double& x : targets) x += random.uniform(-0.005, 0.005);
    moving.push_back(
        cpu_time_ns([&] { check(dsw_body_move(scene, wire, targets.data(), kEdges + 1, 0, nullptr, nullptr)); }));
  }
  report.set("scale.move_us" + suffix, 1e-3 * median(moving));

  std::vector<double> lent[2] = {mesh.points, mesh.points};
  dsw_environment* const environment = dsw_scene_get_environment(scene);
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<double>& next = lent[round % 2];
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] = mesh.points[i] + 0.02 * std::sin(0.3 * static_cast<double>(round) + 0.2 * mesh.points[i]);
    }
    const double taken = cpu_time_ns(
        [&] { check(dsw_environment_deform(environment, next.data(), mesh.point_count(), nullptr, nullptr)); });
    if (round != 0) bending.push_back(taken);  // the first call prepares
  }
  report.set("scale.deform_ms" + suffix, 1e-6 * median(bending));
  world.close_scene();
}

Figures run_size(std::size_t cells, const std::string& suffix, const Options& options, Report& report) {
  const scenes::VolumeMesh mesh = make_lattice(cells);
  const auto count = static_cast<double>(mesh.cell_count());
  {
    const World counted(mesh, 1, true);
    report.set("scale.bytes_per_tet" + suffix, static_cast<double>(counted.memory().now) / count);
    report.set("scale.peak_over_stays" + suffix,
               static_cast<double>(counted.memory().most) / static_cast<double>(counted.memory().now));
  }
  const std::size_t rounds = options.quick ? 5 : 9;
  std::unique_ptr<World> world;
  const double on_two = time_ns([&] { world = std::make_unique<World>(mesh, 2); });
  const double locate_on_two = first_locate_ns(*world, mesh);
  world.reset();
  const double on_one = time_ns([&] {
    report.set("scale.create_ns_per_tet" + suffix,
               cpu_time_ns([&] { world = std::make_unique<World>(mesh, 1); }) / count);
  });
  report.set("scale.create_threads2_over_1" + suffix, on_two / on_one);
  Figures figures;
  figures.cast_ns = cast_ns(*world, mesh, rounds);
  report.set("scale.cast_ns" + suffix, figures.cast_ns);
  figures.locate_ms = 1e-6 * first_locate_ns(*world, mesh);
  report.set("scale.first_locate_ms" + suffix, figures.locate_ms);
  report.set("scale.first_locate_ms.threads2" + suffix, 1e-6 * locate_on_two);
  run_wire(*world, mesh, suffix, rounds, report);
  return figures;
}

}  // namespace

void run_scale(const Options& options, Report& report) {
  run_size(100000, ".n1e5", options, report);
  const Figures middle = run_size(1000000, ".n1e6", options, report);
  if (!options.quick) {
    report.set("scale.cast_1e7_over_1e6", run_size(10000000, ".n1e7", options, report).cast_ns / middle.cast_ns);
  }
  if (options.is_long) {
    report.set("scale.cast_1e8_over_1e6", run_size(100000000, ".n1e8", options, report).cast_ns / middle.cast_ns);
  }
}

}  // namespace dsw::bench
