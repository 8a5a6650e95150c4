// Few large cells out of tetrahedra: what becomes of a vessel, and of casts that cross about 20 of its tetrahedra.
#include "parts.h"

#include "embree.h"
#include "ours.h"
#include "timing.h"
#include "vessel_case.h"

#include "scenes/tets.h"

#include <stdexcept>

namespace dsw::bench {

namespace {

constexpr std::uint32_t kLeastCells = 15, kMostCells = 25;

/** Casts in the lumen whose flights entered about 20 cells. */
Segments about_twenty_cells(const World& world, const scenes::TetCasts& casts) {
  Segments all;
  all.batch = 4500;
  all.from = casts.from;
  all.to = casts.to;
  locate_starts(world, casts.cells, all);
  std::vector<dsw_flight> flights(all.count());
  check(dsw_environment_cast_segments(world.environment(), all.count(), all.starts.data(), all.from.data(),
                                      all.to.data(), 0, nullptr, flights.data()));
  Segments chosen;
  chosen.batch = all.batch;
  for (std::size_t i = 0; i < all.count(); ++i) {
    if (flights[i].volumes_visited < kLeastCells || flights[i].volumes_visited > kMostCells) continue;
    chosen.from.insert(chosen.from.end(), &all.from[3 * i], &all.from[3 * i] + 3);
    chosen.to.insert(chosen.to.end(), &all.to[3 * i], &all.to[3 * i] + 3);
    chosen.starts.push_back(all.starts[i]);
  }
  return chosen;
}

double crossings(const std::vector<dsw_flight>& flights) {
  double sum = 0.0;
  for (const dsw_flight& flight : flights) sum += flight.volumes_visited - 1;
  return sum;
}

std::vector<dsw_flight> cast_all(const World& world, const Segments& segments) {
  std::vector<dsw_flight> flights(segments.count());
  check(dsw_environment_cast_segments(world.environment(), segments.count(), segments.starts.data(),
                                      segments.from.data(), segments.to.data(), 0, nullptr, flights.data()));
  return flights;
}

void compare(const std::string& suffix, const scenes::VolumeMesh& mesh, bool quick, Report& report,
             Agreement& agreement) {
  World fine(mesh, 1);
  check(dsw_environment_mark_between(fine.environment(), 1, 2, DSW_MARK_IMPASSABLE, nullptr));
  const WallMesh walls(mesh.points, scenes::region_walls(mesh, scenes::tet_neighbours(mesh)).all);
  std::vector<std::uint32_t> map(mesh.cell_count());
  dsw_coarsen_report found{};
  found.struct_size = sizeof found;
  std::unique_ptr<World> coarse;
  const double ns = time_ns([&] { coarse = std::make_unique<World>(fine, map, found); });
  report.set("coarsen.cells_ratio" + suffix, static_cast<double>(found.volume_count[1]) / found.volume_count[0]);
  report.set("coarsen.memory_ratio" + suffix,
             static_cast<double>(found.memory_bytes[1]) / static_cast<double>(found.memory_bytes[0]));
  report.set("coarsen.area_ratio" + suffix, found.passable_area[1] / found.passable_area[0]);
  report.set("coarsen.seconds" + suffix, ns * 1e-9);

  const double edge = scenes::mean_edge(mesh, 1);
  Segments segments =
      about_twenty_cells(fine, scenes::long_tet_casts(mesh, quick ? 200000 : 1000000, 8 * edge, 1, false, 41));
  Segments in_coarse = segments;
  for (dsw_volume_id& start : in_coarse.starts) {
    check(dsw_environment_get_volume_id(coarse->environment(), map[start.index], &start));
  }
  const auto before = cast_all(fine, segments), after = cast_all(*coarse, in_coarse);
  double different = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    different += before[i].outcome != after[i].outcome || before[i].time != after[i].time ? 1.0 : 0.0;
  }
  report.set("coarsen.casts" + suffix, static_cast<double>(before.size()));
  report.set("coarsen.different" + suffix, different);
  report.set("coarsen.crossings_before" + suffix, crossings(before) / static_cast<double>(before.size()));
  report.set("coarsen.crossings_ratio" + suffix, crossings(after) / crossings(before));

  Ours uncoarsened(fine, walls), ours(*coarse, walls);
  const auto embree = keep_fastest(make_embrees(walls), segments);
  uncoarsened.prepare(segments);
  ours.prepare(in_coarse);
  embree->prepare(segments);
  agreement.compare(in_coarse, {&ours, embree.get()}, walls, 1000);
  std::vector<double> times[3];
  for (int round = 0; round < (quick ? 7 : 11); ++round) {
    times[0].push_back(time_casts(uncoarsened, segments));
    times[1].push_back(time_casts(ours, in_coarse));
    times[2].push_back(time_casts(*embree, segments));
  }
  report.set("walk.long.ns" + suffix, median(times[1]));
  report.set("walk.long.vs_uncoarsened" + suffix, median_ratio(times[0], times[1]));
  report.set("walk.long.vs_embree" + suffix, median_ratio(times[2], times[1]));
}

}  // namespace

void run_coarsen(const Options& options, Report& report, Agreement& agreement) {
  compare(options.vessel.empty() ? "" : ".generated", make_vessel(), options.quick, report, agreement);
  if (!options.vessel.empty()) compare("", read_vessel(options.vessel), options.quick, report, agreement);
}

}  // namespace dsw::bench
