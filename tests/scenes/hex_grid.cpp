#include "scenes/hex_grid.h"

#include "scenes/random.h"

#include <cmath>

namespace dsw::scenes {

std::array<std::uint32_t, 3> hex_grid_size(std::size_t cells) {
  switch (cells) {
    case 1000:
      return {10, 10, 10};
    case 10000:
      return {25, 20, 20};
    case 100000:
      return {50, 50, 40};
    case 1000000:
      return {100, 100, 100};
    default: {
      const auto side = static_cast<std::uint32_t>(std::lround(std::cbrt(static_cast<double>(cells))));
      return {side, side, side};
    }
  }
}

void lattice_to_space(const HexGridOptions& options, const double* lattice, double* space) {
  const double x = lattice[0], y = lattice[1], z = lattice[2];
  if (options.sheared) {
    space[0] = x + 0.375 * y + 0.25 * z;
    space[1] = y + 0.125 * x + 0.5 * z;
    space[2] = z + 0.25 * x;
  } else {
    space[0] = x;
    space[1] = y;
    space[2] = z;
  }
}

std::uint32_t HexGrid::cell_at(const double* lattice_point) const {
  std::array<std::uint32_t, 3> at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double value = lattice_point[axis];
    if (!(value >= 0.0) || value >= static_cast<double>(options.size[axis])) return kNone;
    at[axis] = static_cast<std::uint32_t>(value);
  }
  return cell(at[0], at[1], at[2]);
}

HexGrid make_hex_grid(const HexGridOptions& options) {
  HexGrid grid;
  grid.options = options;
  const auto [nx, ny, nz] = options.size;
  VolumeMesh& mesh = grid.mesh;
  mesh.points_per_cell = 8;
  mesh.points.resize(3 * std::size_t{nx + 1} * (ny + 1) * (nz + 1));
  mesh.connectivity.reserve(8 * std::size_t{nx} * ny * nz);

  Random shifts(options.seed * 2 + 1);
  double* out = mesh.points.data();
  for (std::uint32_t z = 0; z <= nz; ++z) {
    for (std::uint32_t y = 0; y <= ny; ++y) {
      for (std::uint32_t x = 0; x <= nx; ++x, out += 3) {
        double lattice[3] = {double(x), double(y), double(z)};
        const bool interior = x > 0 && x < nx && y > 0 && y < ny && z > 0 && z < nz;
        if (options.jitter > 0.0 && interior) {
          for (double& value : lattice) value += shifts.uniform(-options.jitter, options.jitter);
        }
        lattice_to_space(options, lattice, out);
      }
    }
  }

  const auto row = static_cast<std::int32_t>(nx + 1);
  const auto layer = static_cast<std::int32_t>((nx + 1) * (ny + 1));
  Random marks(options.seed * 2);
  grid.obstacle.reserve(std::size_t{nx} * ny * nz);
  for (std::uint32_t z = 0; z < nz; ++z) {
    for (std::uint32_t y = 0; y < ny; ++y) {
      for (std::uint32_t x = 0; x < nx; ++x) {
        const auto p = static_cast<std::int32_t>(x + (nx + 1) * (y + (ny + 1) * z));
        const std::int32_t cell[8] = {p,         p + 1,         p + 1 + row,         p + row,
                                      p + layer, p + 1 + layer, p + 1 + row + layer, p + row + layer};
        mesh.connectivity.insert(mesh.connectivity.end(), cell, cell + 8);
        grid.obstacle.push_back(marks.uniform() < options.obstacle_share);
      }
    }
  }
  return grid;
}

std::uint32_t neighbour(const HexGrid& grid, std::uint32_t cell, std::uint32_t side) {
  const auto [nx, ny, nz] = grid.options.size;
  const std::array<std::uint32_t, 3> at = {cell % nx, cell / nx % ny, cell / (nx * ny)};
  const std::array<std::uint32_t, 3> step = {1, nx, nx * ny};
  const std::uint32_t axis = side / 2;
  if (side % 2 == 0) return at[axis] == 0 ? kNone : cell - step[axis];
  return at[axis] + 1 == grid.options.size[axis] ? kNone : cell + step[axis];
}

Wall cell_wall(const HexGrid& grid, std::uint32_t cell, std::uint32_t side) {
  Wall wall;
  wall.vertex_count = 4;
  const std::int32_t* points = grid.mesh.cell(cell);
  for (std::size_t i = 0; i < 4; ++i) wall.vertices[i] = static_cast<std::uint32_t>(points[kHexFaces[side][3 - i]]);
  return wall;
}

void append_cell_walls(const HexGrid& grid, std::uint32_t cell, std::vector<Wall>& walls) {
  for (std::uint32_t side = 0; side < 6; ++side) {
    const std::uint32_t other = neighbour(grid, cell, side);
    if (other == kNone || grid.obstacle[other] != 0) walls.push_back(cell_wall(grid, cell, side));
  }
}

std::vector<Wall> hex_grid_walls(const HexGrid& grid) {
  std::vector<Wall> walls;
  for (std::uint32_t cell = 0; cell < grid.obstacle.size(); ++cell) {
    if (grid.obstacle[cell] == 0) append_cell_walls(grid, cell, walls);
  }
  return walls;
}

}  // namespace dsw::scenes
