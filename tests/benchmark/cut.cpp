// A small blade is swept through the lattice at one place after the other, with particles and bodies inside: what a cut
// looks at and changes, beside what the blade crosses, and what it costs. Then cuts of ever more volumes, and blades
// that meet nothing.
#include "parts.h"

#include "hex_case.h"
#include "timing.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dsw::bench {

namespace {

constexpr std::uint32_t kRows = 3;  // of the blade, and points in a row
constexpr double kReach = 6;        // of the blade, in cells

/** A bent blade round a point. */
std::array<double, 27> random_blade(scenes::Random& random, const double* at) {
  double across[3], along[3];
  for (int k = 0; k < 3; ++k) {
    across[k] = random.uniform(-kReach / 2, kReach / 2);
    along[k] = random.uniform(-kReach / 2, kReach / 2);
  }
  std::array<double, 27> blade;
  for (std::uint32_t i = 0; i < 9; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double u = static_cast<double>(i / kRows) - 1, v = static_cast<double>(i % kRows) - 1;
      blade[3 * i + k] = at[k] + u * across[k] + v * along[k] + random.uniform(-0.2, 0.2);
    }
  }
  return blade;
}

/** Particles and edges at the places of the moving bodies' vertices. */
void fill(HexCase& scene, std::uint32_t features) {
  dsw_scene* const handle = scene.world.scene(features);
  const std::vector<double>& starts = scene.motion.starts();
  std::vector<dsw_particle_id> particles(scene.motion.vertex_count());
  check(dsw_scene_create_particles(handle, starts.data(), particles.size(), 0, nullptr, particles.data(), nullptr));
  std::size_t made = 0;
  for (std::size_t i = 0; i + 1 < particles.size(); i += 8) {
    const std::uint32_t ends[2] = {0, 1};
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    desc.positions = &starts[3 * i];
    desc.vertex_count = 2;
    desc.edges = ends;
    desc.edge_count = 1;
    desc.level = DSW_LEVEL_EDGES_SWEPT;
    dsw_body_id body;
    made += dsw_body_create(handle, &desc, &body) == DSW_STATUS_OK ? 1u : 0u;  // some cross an obstacle
  }
  std::printf("  %zu particles, %zu bodies of one edge\n", particles.size(), made);
}

void cut_lattice(std::size_t cells, const std::string& label, std::size_t bodies, std::uint32_t features,
                 const Options& options, Report& report) {
  scenes::HexGridOptions grid_options;
  grid_options.size = scenes::hex_grid_size(cells);
  scenes::BodyOptions body_options;
  body_options.bodies = bodies;
  HexCase scene("cut." + label, grid_options, body_options, 1);
  fill(scene, features);
  dsw_environment* const environment = scene.world.environment();
  scenes::Random random(5);
  const std::size_t cuts = options.quick ? 100 : 400;
  std::vector<double> times;
  double crossed = 0, touched = 0, split = 0, whole = 0, distance = 0;
  for (std::size_t i = 0; i < cuts + 1; ++i) {
    double at[3];
    for (std::uint32_t k = 0; k < 3; ++k) at[k] = random.uniform(0, grid_options.size[k]);
    const std::array<double, 27> blade = random_blade(random, at);
    dsw_cut_desc desc;
    dsw_cut_desc_init(&desc, sizeof desc);
    desc.points = blade.data();
    desc.rows = desc.columns = kRows;
    check(dsw_environment_get_volume_id(environment, scene.grid.cell_at(at), &desc.start));
    dsw_change cut;
    cut.struct_size = sizeof cut;
    const double time = time_ns([&] { check(dsw_environment_cut(environment, &desc, &cut)); });
    if (i == 0) continue;  // makes the tables of the first change
    times.push_back(time);
    crossed += cut.volumes_crossed;
    touched += cut.volumes_visited + cut.volumes_changed;  // what is both counts twice
    split += cut.volumes_split;
    whole += static_cast<double>(cut.whole_count);
    distance = std::max(distance, cut.distance);
  }
  double sum = 0;
  for (const double time : times) sum += time;
  report.set("cut.per_second." + label, 1e9 * static_cast<double>(times.size()) / sum);
  report.set("cut.us_per_split_cell." + label, 1e-3 * sum / split);
  if (label.find('.') != std::string::npos) return;  // the same cuts with other bodies
  report.set("cut.cells_touched_ratio." + label, touched / crossed);
  report.set("cut.cells_crossed." + label, crossed / static_cast<double>(cuts));
  report.set("cut.cells_split_share." + label, split / crossed);
  report.set("cut.cells_whole_share." + label, whole / crossed);
  report.set("cut.distance." + label, distance);
}

/** A slab of cubes with `width` of them on a side, ready to be changed. */
scenes::HexGrid slab(std::uint32_t width) {
  scenes::HexGridOptions grid_options;
  grid_options.size = {width, width, 3};
  grid_options.obstacle_share = 0;
  return scenes::make_hex_grid(grid_options);
}

/** A sheet of so many rows and columns. */
std::vector<double> sheet(std::uint32_t rows, const double* corner, const double* along, const double* across) {
  std::vector<double> points;
  for (std::uint32_t i = 0; i < rows * rows; ++i) {
    const double u = static_cast<double>(i / rows) / (rows - 1), v = static_cast<double>(i % rows) / (rows - 1);
    for (int k = 0; k < 3; ++k) points.push_back(corner[k] + u * along[k] + v * across[k]);
  }
  return points;
}

dsw_cut_desc describe(const std::vector<double>& points, std::uint32_t rows) {
  dsw_cut_desc desc;
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = points.data();
  desc.rows = desc.columns = rows;
  return desc;
}

/** Processor time of a cut right through a slab, over the volumes that it changes. */
double cut_slab(std::uint32_t width, std::uint32_t rounds) {
  const scenes::HexGrid grid = slab(width);
  const double size = width, corner[3] = {-1, -1, 1.3}, along[3] = {size + 2, 0, 0.2}, across[3] = {0, size + 2, 0.2};
  const std::vector<double> points = sheet(2, corner, along, across);
  dsw_cut_desc desc = describe(points, 2);
  std::vector<double> times;
  dsw_change cut;
  cut.struct_size = sizeof cut;
  for (std::uint32_t i = 0; i < rounds; ++i) {
    World world(grid.mesh, 1);
    const double before[9] = {-9, -9, -9, -8, -9, -9, -9, -8, -9};  // a cut of nothing makes the tables
    const std::vector<double> nothing = sheet(2, before, before + 3, before + 6);
    dsw_cut_desc first = describe(nothing, 2);
    check(dsw_environment_get_volume_id(world.environment(), grid.cell(width / 2, width / 2, 1), &desc.start));
    first.start = desc.start;
    check(dsw_environment_cut(world.environment(), &first, nullptr));
    times.push_back(cpu_time_ns([&] { check(dsw_environment_cut(world.environment(), &desc, &cut)); }));
  }
  return 1e-3 * median(times) / cut.volumes_changed;
}

void cut_slabs(Report& report) {
  const std::uint32_t widths[] = {10, 32, 100, 316}, rounds[] = {31, 11, 5, 3};
  double x = 0, y = 0, xx = 0, xy = 0;
  for (int i = 0; i < 4; ++i) {
    const double time = cut_slab(widths[i], rounds[i]), log = 2 * std::log10(widths[i]),
                 of_all = log + std::log10(time);
    report.set("cut.us_per_volume.c1e" + std::to_string(i + 2), time);
    x += log / 4, y += of_all / 4, xx += log * log / 4, xy += log * of_all / 4;
  }
  report.set("cut.slope", (xy - x * y) / (xx - x * x));
}

/** Blades beside a lattice, looked for from a volume of it. */
void miss_lattice(std::size_t cells, const std::string& label, Report& report) {
  scenes::HexGridOptions grid_options;
  grid_options.size = scenes::hex_grid_size(cells);
  const scenes::HexGrid grid = scenes::make_hex_grid(grid_options);
  World world(grid.mesh, 1);
  for (const std::uint32_t rows : {3u, 33u}) {
    const double size = grid_options.size[0], corner[3] = {size + 1, 0, 0}, along[3] = {1, size, 0},
                 across[3] = {0, 1, size};
    const std::vector<double> points = sheet(rows, corner, along, across);
    dsw_cut_desc desc = describe(points, rows);
    check(dsw_environment_get_volume_id(world.environment(), 0, &desc.start));
    std::vector<double> times;
    for (int i = 0; i < 41; ++i) {  // the first ones make the tables and the tree
      times.push_back(cpu_time_ns([&] { check(dsw_environment_cut(world.environment(), &desc, nullptr)); }));
    }
    report.set("cut.miss_us." + label + ".t" + std::to_string(2 * (rows - 1) * (rows - 1)), 1e-3 * median(times));
  }
}

}  // namespace

void run_cut(const Options& options, Report& report) {
  constexpr std::size_t kBodies = 225, kFew = 9, kMany = 2250;
  cut_slabs(report);
  miss_lattice(10000, "n1e4", report);
  miss_lattice(1000000, "n1e6", report);
  cut_lattice(10000, "n1e4", kBodies, 0, options, report);
  cut_lattice(1000000, "n1e6", kBodies, 0, options, report);
  const std::uint32_t live = DSW_FEATURE_LIVE_CHANGES;
  cut_lattice(10000, "n1e4.register", kBodies, live, options, report);
  cut_lattice(10000, "n1e4.few", kFew, 0, options, report);
  cut_lattice(10000, "n1e4.few.register", kFew, live, options, report);
  cut_lattice(10000, "n1e4.many", kMany, 0, options, report);
  cut_lattice(10000, "n1e4.many.register", kMany, live, options, report);
}

}  // namespace dsw::bench
