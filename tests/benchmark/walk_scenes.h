// Scenes of casts: for the part that compares kernels, and for the program that valgrind counts.
#ifndef DARTSWEEP_TESTS_BENCHMARK_WALK_SCENES_H
#define DARTSWEEP_TESTS_BENCHMARK_WALK_SCENES_H

#include "ours.h"

#include "scenes/bodies.h"
#include "scenes/delaunay.h"
#include "scenes/hex_grid.h"
#include "scenes/tets.h"

#include <stdexcept>

namespace dsw::bench {

/** A mesh, what is impassable there, and casts. */
struct WalkScene {
  scenes::VolumeMesh mesh;
  std::vector<std::uint8_t> obstacles;              // by cell, or none
  std::vector<std::array<std::uint32_t, 3>> walls;  // triangles
  std::vector<double> from, to;                     // 3 a cast
  std::vector<std::uint32_t> cells;                 // where they start, or near by
  std::size_t batch = 4500;

  /** Marks what is impassable, and finds where casts start. */
  Segments prepare(World& world) const {
    if (!obstacles.empty()) mark_cells(world, obstacles);
    if (!walls.empty()) mark_triangles(world, walls);
    Segments segments;
    segments.batch = batch;
    segments.from = from;
    segments.to = to;
    locate_starts(world, cells, segments);
    return segments;
  }
};

/** `name`: hex, hex_warped, tet_short or tet_long. */
inline WalkScene make_walk_scene(const std::string& name, std::size_t casts) {
  WalkScene scene;
  if (name == "hex" || name == "hex_warped") {
    scenes::HexGridOptions options;
    options.size = scenes::hex_grid_size(100000);
    options.jitter = name == "hex" ? 0.0 : 0.1;
    scenes::HexGrid grid = scenes::make_hex_grid(options);
    scenes::BodyMotion motion(grid, {});
    while (scene.cells.size() < casts) {
      scenes::append_step_segments(grid, motion, scene.from, scene.to, scene.cells);
      motion.advance();
    }
    scene.obstacles = grid.obstacle;
    scene.mesh = std::move(grid.mesh);
    return scene;
  }
  if (name != "tet_short" && name != "tet_long") throw std::runtime_error("there is no walk scene " + name);
  scene.mesh = scenes::make_delaunay(100000, 11);
  const auto neighbours = scenes::tet_neighbours(scene.mesh);
  scene.walls = scenes::random_tet_walls(scene.mesh, neighbours, 0.01, 12).marked;
  const auto made = name == "tet_short"
                        ? scenes::short_tet_casts(scene.mesh, neighbours, casts, 13)
                        : scenes::long_tet_casts(scene.mesh, casts, 15 * scenes::mean_edge(scene.mesh), 0, true, 14);
  scene.from = made.from;
  scene.to = made.to;
  scene.cells = made.cells;
  return scene;
}

}  // namespace dsw::bench

#endif
