#include "lattice.h"

namespace dsw::rigid {

namespace {

scenes::HexGrid make_grid(std::uint64_t seed) {
  scenes::HexGridOptions options;
  options.size = {21, 21, 21};
  options.seed = seed;
  return scenes::make_hex_grid(options);
}

}  // namespace

Lattice::Lattice(std::uint64_t seed) : grid_(make_grid(seed)), world_(grid_.mesh, 1) {
  bench::mark_cells(world_, grid_.obstacle);
  for (std::size_t i = 0; i < grid_.mesh.point_count(); ++i) {
    const double* const p = grid_.mesh.point(i);
    walls_.points.push_back({p[0], p[1], p[2]});
  }
  // Triangles alone: those who ask have no use for their edges.
  for (const scenes::Wall& wall : scenes::hex_grid_walls(grid_)) {
    for (std::uint32_t i = 0; i < wall.triangle_count(); ++i) walls_.faces.push_back({wall.triangle(i), 3});
  }
}

Point Lattice::draw_middle(scenes::Random& random) const {
  while (true) {
    const std::size_t cell = random.index(grid_.obstacle.size());
    if (grid_.obstacle[cell] != 0) continue;
    const std::uint32_t n = grid_.options.size[0], at = static_cast<std::uint32_t>(cell);
    return {at % n + 0.5, at / n % n + 0.5, at / (n * n) + 0.5};
  }
}

}  // namespace dsw::rigid
