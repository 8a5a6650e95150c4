// What an environment costs to make and to keep.
#include "parts.h"

#include "ours.h"
#include "timing.h"

#include "scenes/delaunay.h"
#include "scenes/hex_grid.h"
#include "scenes/random.h"

#include <algorithm>

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
}

}  // namespace dsw::bench
