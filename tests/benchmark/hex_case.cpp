#include "hex_case.h"

namespace dsw::bench {

namespace {

WallMesh marked_walls(const scenes::HexGrid& grid, World& world) {
  mark_cells(world, grid.obstacle);
  auto walls = scenes::hex_grid_walls(grid);
  adopt_triangulation(world, grid.mesh, walls);
  return {grid.mesh.points, std::move(walls)};
}

}  // namespace

HexCase::HexCase(std::string case_label, const scenes::HexGridOptions& grid_options,
                 const scenes::BodyOptions& body_options, std::uint32_t threads)
    : label(std::move(case_label)),
      grid(scenes::make_hex_grid(grid_options)),
      world(grid.mesh, threads),
      motion(grid, body_options),
      walls(marked_walls(grid, world)) {
  // Until as many bodies press against something as will ever do.
  for (int step = 0; step < 200; ++step) motion.advance();
}

std::size_t HexCase::next_block(std::size_t steps, Segments& segments) {
  segments = {};
  segments.batch = motion.vertex_count() / scenes::kBodyVertices * scenes::kBodySegments;
  std::vector<std::uint32_t> cells;
  for (std::size_t step = 0; step < steps; ++step) {
    scenes::append_step_segments(grid, motion, segments.from, segments.to, cells);
    motion.advance();
  }
  return locate_starts(world, cells, segments);
}

}  // namespace dsw::bench
