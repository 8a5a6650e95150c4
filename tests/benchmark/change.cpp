// 16 obstacles appear or vanish in the largest lattice: what it costs until the next cast sees them.
#include "parts.h"

#include "change_list.h"
#include "embree_change.h"
#include "grid.h"
#include "hex_case.h"
#include "timing.h"

#include <algorithm>
#include <cstdio>

namespace dsw::bench {

namespace {

constexpr std::size_t kObstacles = 16;

template <typename Apply>
double time_changes(const std::vector<WallChange>& changes, Apply&& apply) {
  return time_ns([&] {
           for (const WallChange& change : changes) apply(change);
         }) /
         static_cast<double>(changes.size());
}

}  // namespace

void run_change(const Options& options, Report& report) {
  scenes::HexGridOptions grid_options;
  grid_options.size = scenes::hex_grid_size(1000000);
  HexCase scene("change", grid_options, {}, 1);

  // The scene holds its 1800 particles, which a change has to respect.
  std::vector<dsw_particle_id> particles(scene.motion.vertex_count());
  dsw_scene* handle = scene.world.scene();
  check(dsw_scene_create_particles(handle, scene.motion.starts().data(), particles.size(), 0, nullptr, particles.data(),
                                   nullptr));
  std::vector<std::uint8_t> occupied(scene.grid.obstacle.size());
  for (std::size_t i = 0; i < particles.size(); ++i) occupied[scene.grid.cell_at(&scene.motion.starts()[3 * i])] = 1;

  ChangeList list(scene.grid, scene.world, scene.walls);
  scenes::Random random(21);
  std::vector<std::vector<std::uint32_t>> sets(options.quick ? 32 : 128);
  std::vector<WallChange> changes;
  for (auto& set : sets) {
    while (set.size() < kObstacles) {
      const auto cell = static_cast<std::uint32_t>(random.index(scene.grid.obstacle.size()));
      // Neighbours in one change would bring a wall and take it away.
      const bool near_listed = std::any_of(set.begin(), set.end(), [&](std::uint32_t other) {
        for (std::uint32_t side = 0; side < 6; ++side) {
          if (scenes::neighbour(scene.grid, cell, side) == other) return true;
        }
        return cell == other;
      });
      if (list.passable(cell) && occupied[cell] == 0 && !near_listed) set.push_back(cell);
    }
    changes.push_back(list.turn(set, true));
  }
  for (auto set = sets.rbegin(); set != sets.rend(); ++set) changes.push_back(list.turn(*set, false));

  const auto ours = [&](const WallChange& change) {
    check(dsw_environment_mark_volumes(scene.world.environment(), change.volumes.data(), change.volumes.size(),
                                       change.impassable ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE, 0, nullptr));
  };
  const auto with_grid = [&](Grid& grid) {
    return [&grid](const WallChange& change) {
      for (const auto& item : change.removed) grid.remove(item.id, item.wall);
      for (const auto& item : change.added) grid.insert(item.id, item.wall);
    };
  };

  // Embree: the fastest way of several, on a few changes that also end where they began.
  std::vector<WallChange> few(changes.begin(), changes.begin() + 4);
  few.insert(few.end(), changes.end() - 4, changes.end());
  std::unique_ptr<EmbreeUpdater> best;
  double best_ns = 0.0;
  const auto try_out = [&](std::unique_ptr<EmbreeUpdater> updater) {
    std::vector<double> ns;
    for (int round = 0; round < 3; ++round) {
      ns.push_back(time_changes(few, [&](const WallChange& change) { updater->apply(change); }));
    }
    std::printf("    %-36s %.0f ns\n", updater->name().c_str(), median(ns));
    if (!best || median(ns) < best_ns) {
      best = std::move(updater);
      best_ns = median(ns);
    }
  };
  for (const bool refit : {false, true}) try_out(make_embree_single(scene.walls, list.slots(), refit));
  for (const bool instances : {false, true}) {
    for (const double chunk : {5.0, 8.0, 10.0, 13.0, 20.0}) try_out(make_embree_chunks(scene.walls, chunk, instances));
  }

  Grid grid(scene.walls, 1.0);
  std::vector<double> ours_ns, grid_ns, embree_ns;
  for (int round = 0; round < 7; ++round) {
    ours_ns.push_back(time_changes(changes, ours));
    grid_ns.push_back(time_changes(changes, with_grid(grid)));
    if (round < 5) {
      embree_ns.push_back(
          time_changes(round == 0 ? changes : few, [&](const WallChange& change) { best->apply(change); }));
    }
  }
  report.set("walk.change.ns.n1e6", median(ours_ns));
  report.set("walk.change.grid_ns.n1e6", median(grid_ns));
  report.set("walk.change.embree_ns.n1e6", median(embree_ns));
  report.set("walk.change.vs_grid.n1e6", median_ratio(grid_ns, ours_ns));
  report.set("walk.change.vs_embree.n1e6", median_ratio(embree_ns, ours_ns));
}

}  // namespace dsw::bench
