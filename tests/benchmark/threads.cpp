// 22,500 bodies in the largest lattice, with one thread and with two.
#include "parts.h"

#include "hex_case.h"
#include "timing.h"

#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace dsw::bench {

void run_threads(const Options& options, Report& report) {
  scenes::HexGridOptions grid;
  grid.size = scenes::hex_grid_size(1000000);
  scenes::BodyOptions bodies;
  bodies.bodies = 22500;
  HexCase one("one thread", grid, bodies, 1);
  World two(one.grid.mesh, 2);
  mark_cells(two, one.grid.obstacle);
  Segments segments;
  one.next_block(options.quick ? 3 : 10, segments);

  const WallMesh no_walls(one.grid.mesh.points, {});
  Ours single(one.world, no_walls), twin(two, no_walls);
  single.prepare(segments);
  twin.prepare(segments);
  std::vector<double> single_ns, twin_ns;
  for (int round = 0; round < 9; ++round) {
    single_ns.push_back(time_casts(single, segments));
    twin_ns.push_back(time_casts(twin, segments));
  }
  // Both ran the last batch last: the reports must be the same bits.
  const std::size_t last = (segments.count() - 1) % segments.batch + 1;
  if (std::memcmp(single.flights().data(), twin.flights().data(), last * sizeof(dsw_flight)) != 0) {
    throw std::runtime_error("one thread and two give different reports");
  }
  report.set("walk.threads1.ns", median(single_ns));
  report.set("walk.threads2.ns", median(twin_ns));
  report.set("walk.threads2", median_ratio(single_ns, twin_ns));
}

}  // namespace dsw::bench
