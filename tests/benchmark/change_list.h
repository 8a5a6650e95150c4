// Obstacles that appear and vanish in a lattice, as lists of the walls that come and go with them.
#ifndef DARTSWEEP_TESTS_BENCHMARK_CHANGE_LIST_H
#define DARTSWEEP_TESTS_BENCHMARK_CHANGE_LIST_H

#include "embree_change.h"
#include "hex_case.h"

#include <unordered_map>

namespace dsw::bench {

/** Makes changes and remembers which cells are obstacles after them. */
class ChangeList {
 public:
  ChangeList(const scenes::HexGrid& grid, const World& world, const WallMesh& walls)
      : grid_(grid), world_(world), obstacle_(grid.obstacle), slots_(walls.walls.size()) {
    for (std::uint32_t id = 0; id < slots_; ++id) ids_[walls.walls[id].vertices] = id;
  }

  WallChange turn(const std::vector<std::uint32_t>& cells, bool impassable) {
    WallChange change;
    change.impassable = impassable;
    change.volumes = volume_ids(world_, cells);
    for (const std::uint32_t cell : cells) {
      obstacle_[cell] = impassable ? 1 : 0;
      for (std::uint32_t side = 0; side < 6; ++side) {
        const std::uint32_t other = scenes::neighbour(grid_, cell, side);
        const bool beyond_passable = other != kNone && obstacle_[other] == 0;
        const scenes::Wall wall =
            beyond_passable ? scenes::cell_wall(grid_, other, side ^ 1u) : scenes::cell_wall(grid_, cell, side);
        // A wall to a passable neighbour comes with the obstacle; one of the cell's own goes with it.
        (beyond_passable == impassable ? change.added : change.removed).push_back({id_of(wall), wall});
      }
    }
    return change;
  }

  bool passable(std::uint32_t cell) const { return obstacle_[cell] == 0; }
  std::size_t slots() const { return slots_; }

 private:
  struct Hash {
    std::size_t operator()(const std::array<std::uint32_t, 4>& v) const {
      return v[0] * 0x9e3779b97f4a7c15u ^ v[1] * 0xc2b2ae3d27d4eb4fu ^ v[2] * 0x165667b19e3779f9u ^ v[3];
    }
  };

  /** A wall keeps its id when it comes back, so the list can be run again. */
  std::uint32_t id_of(const scenes::Wall& wall) {
    const auto [found, is_new] = ids_.try_emplace(wall.vertices, static_cast<std::uint32_t>(slots_));
    slots_ += is_new ? 1 : 0;
    return found->second;
  }

  const scenes::HexGrid& grid_;
  const World& world_;
  std::vector<std::uint8_t> obstacle_;
  std::unordered_map<std::array<std::uint32_t, 4>, std::uint32_t, Hash> ids_;
  std::size_t slots_;
};

}  // namespace dsw::bench

#endif
