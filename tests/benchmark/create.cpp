// What an environment costs to make and to keep.
#include "parts.h"

#include "ours.h"
#include "timing.h"

#include "scenes/delaunay.h"
#include "scenes/hex_grid.h"
#include "scenes/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace dsw::bench {

namespace {

/** All memory a cell costs: the larger of what the library says and what its allocator handed out. */
void report_memory(const scenes::VolumeMesh& mesh, const std::string& what, Report& report) {
  const World world(mesh, 1, true);
  const double cells = static_cast<double>(mesh.cell_count());
  const double said = static_cast<double>(world.info().memory_bytes);
  const double counted = static_cast<double>(world.memory().now);
  report.set("memory.bytes_per_" + what, std::max(said, counted) / cells);
  report.set("memory.reported_bytes_per_" + what, said / cells);
  report.set("memory.allocated_bytes_per_" + what, counted / cells);
  report.set("memory.peak_bytes_per_" + what, static_cast<double>(world.memory().most) / cells);
}

/** About 1e5 cells: cubes of a grid, a share of them divided into so many along each axis. Points are shared. */
scenes::VolumeMesh divided_grid(double share, std::uint64_t parts, std::uint64_t seed) {
  scenes::Random random(seed);
  scenes::VolumeMesh mesh;
  std::unordered_map<std::uint64_t, std::int32_t> known;
  const auto point = [&](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    const auto [at, is_new] = known.emplace(x << 42 | y << 21 | z, static_cast<std::int32_t>(mesh.point_count()));
    for (const std::uint64_t c : {x, y, z}) {
      if (is_new) mesh.points.push_back(static_cast<double>(c) / static_cast<double>(parts));
    }
    return at->second;
  };
  const auto add = [&](const std::array<std::uint64_t, 3>& low, std::uint64_t width) {
    for (unsigned k = 0; k < 8; ++k) {
      const bool right = k % 4 == 1 || k % 4 == 2, back = k % 4 >= 2, up = k >= 4;
      mesh.connectivity.push_back(
          point(low[0] + (right ? width : 0), low[1] + (back ? width : 0), low[2] + (up ? width : 0)));
    }
  };
  const double cells = 1 - share + share * static_cast<double>(parts * parts * parts);
  const auto n = static_cast<std::uint64_t>(std::lround(std::cbrt(1e5 / cells)));
  for (std::uint64_t i = 0; i < n * n * n; ++i) {
    const std::array<std::uint64_t, 3> low{i % n * parts, i / n % n * parts, i / n / n * parts};
    if (static_cast<double>(random.bits() >> 11) * 0x1p-53 >= share) {
      add(low, parts);
      continue;
    }
    for (std::uint64_t k = 0; k < parts * parts * parts; ++k) {
      add({low[0] + k % parts, low[1] + k / parts % parts, low[2] + k / parts / parts}, 1);
    }
  }
  return mesh;
}

double creation_ns(const scenes::VolumeMesh& mesh, std::uint32_t flags, dsw_build_report& report) {
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  desc.index_bytes = 4;
  desc.points = mesh.points.data();
  desc.point_count = mesh.point_count();
  desc.connectivity = mesh.connectivity.data();
  desc.connectivity_count = mesh.connectivity.size();
  desc.volume_count = mesh.cell_count();
  dsw_environment* made = nullptr;
  report = {};
  report.struct_size = sizeof report;
  const double taken = cpu_time_ns([&] { check(dsw_environment_create(nullptr, &desc, &made, &report)); });
  dsw_environment_destroy(made);
  return taken;
}

/** Creation with CONFORM and FIND_TOUCHING over that of as many hexahedra, and the share of cells that change. */
void report_conforming(double share, std::uint64_t parts, const std::string& name, const Options& options,
                       Report& report) {
  const scenes::VolumeMesh mesh = divided_grid(share, parts, 7);
  scenes::HexGridOptions grid;
  grid.size = scenes::hex_grid_size(100000);
  const scenes::VolumeMesh hexes = scenes::make_hex_grid(grid).mesh;
  std::vector<double> conforming, plain;
  dsw_build_report found;
  for (int round = 0; round < (options.quick ? 5 : 15); ++round) {
    plain.push_back(creation_ns(hexes, 0, found) / static_cast<double>(hexes.cell_count()));
    conforming.push_back(creation_ns(mesh, DSW_ENVIRONMENT_CONFORM | DSW_ENVIRONMENT_FIND_TOUCHING, found) /
                         static_cast<double>(mesh.cell_count()));
  }
  report.set("create.conforming_" + name, median_ratio(conforming, plain));
  report.set("create.changed_" + name, found.changed_count / static_cast<double>(mesh.cell_count()));
}

/** Creation with SPLIT of a lattice in which corners are pushed into cells, over that of the lattice itself. */
void report_splitting(const Options& options, Report& report) {
  scenes::HexGridOptions grid;
  grid.size = scenes::hex_grid_size(100000);
  const scenes::VolumeMesh hexes = scenes::make_hex_grid(grid).mesh;
  scenes::VolumeMesh pushed = hexes;
  const std::uint32_t n = grid.size[0] + 1;
  for (std::uint32_t z = 2; z + 2 < grid.size[2]; z += 5) {
    for (std::uint32_t y = 2; y + 2 < grid.size[1]; y += 5) {
      for (std::uint32_t x = 2; x + 2 < grid.size[0]; x += 5) {
        double* const p = &pushed.points[3 * (x + std::size_t{n} * (y + std::size_t{grid.size[1] + 1} * z))];
        for (int k = 0; k < 3; ++k) p[k] -= 0.75;
      }
    }
  }
  std::vector<double> splitting, plain;
  dsw_build_report found;
  for (int round = 0; round < (options.quick ? 5 : 15); ++round) {
    plain.push_back(creation_ns(hexes, 0, found));
    splitting.push_back(creation_ns(pushed, DSW_ENVIRONMENT_SPLIT, found));
  }
  report.set("create.splitting", median_ratio(splitting, plain));
  report.set("create.split_share", found.split_count / static_cast<double>(hexes.cell_count()));
}

}  // namespace

void run_create(const Options& options, Report& report) {
  scenes::HexGridOptions grid;
  grid.size = scenes::hex_grid_size(1000000);
  const auto hexes = scenes::make_hex_grid(grid).mesh;
  report_memory(hexes, "hex", report);
  const auto tets = scenes::make_delaunay(200000, 11);
  report_memory(tets, "tet", report);

  std::vector<std::uint64_t> keys(6 * hexes.cell_count()), sorted;
  scenes::Random random(31);
  for (std::uint64_t& key : keys) key = random.bits();
  std::vector<double> create_ns, sort_ns, tets_ns;
  for (int round = 0; round < (options.quick ? 5 : 9); ++round) {
    std::unique_ptr<World> world;
    create_ns.push_back(time_ns([&] { world = std::make_unique<World>(hexes, 1); }));
    world.reset();
    tets_ns.push_back(time_ns([&] { world = std::make_unique<World>(tets, 1); }));
    sorted = keys;
    sort_ns.push_back(time_ns([&] { std::sort(sorted.begin(), sorted.end()); }));
  }
  report.set("create.hex_ns_per_cell", median(create_ns) / static_cast<double>(hexes.cell_count()));
  report.set("create.tet_ns_per_cell", median(tets_ns) / static_cast<double>(tets.cell_count()));
  report.set("create.sort_ns_per_key", median(sort_ns) / static_cast<double>(keys.size()));
  report.set("create.vs_sort", median_ratio(create_ns, sort_ns));
  report_conforming(0.003, 2, "2_to_1_few", options, report);
  report_conforming(0.01, 2, "2_to_1", options, report);
  report_conforming(0.04, 2, "2_to_1_many", options, report);
  report_conforming(0.003, 4, "4_to_1", options, report);
  report_splitting(options, report);
}

}  // namespace dsw::bench
