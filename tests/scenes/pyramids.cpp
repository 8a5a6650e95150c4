#include "scenes/pyramids.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>

namespace dsw::scenes {

namespace {

std::array<std::int32_t, 8> corners(const Pyramids& pyramids, std::uint32_t cube) {
  const auto [nx, ny, nz] = pyramids.options.size;
  const std::uint32_t x = cube % nx, y = cube / nx % ny, z = cube / (nx * ny);
  const auto row = static_cast<std::int32_t>(nx + 1), layer = static_cast<std::int32_t>((nx + 1) * (ny + 1));
  const auto p = static_cast<std::int32_t>(x + (nx + 1) * (y + (ny + 1) * z));
  return {p, p + 1, p + 1 + row, p + row, p + layer, p + 1 + layer, p + 1 + row + layer, p + row + layer};
}

}  // namespace

Pyramids make_pyramids(const PyramidOptions& options) {
  Pyramids pyramids;
  pyramids.options = options;
  const auto [nx, ny, nz] = options.size;
  VolumeMesh& mesh = pyramids.mesh;
  mesh.points_per_cell = 5;
  const auto add_point = [&](double x, double y, double z) {
    mesh.points.push_back(options.low[0] + options.edge * x);
    mesh.points.push_back(options.low[1] + options.edge * y);
    mesh.points.push_back(options.low[2] + options.edge * z);
  };
  for (std::uint32_t z = 0; z <= nz; ++z) {
    for (std::uint32_t y = 0; y <= ny; ++y) {
      for (std::uint32_t x = 0; x <= nx; ++x) add_point(x, y, z);
    }
  }
  Random random(options.seed);
  for (std::uint32_t z = 0; z < nz; ++z) {
    for (std::uint32_t y = 0; y < ny; ++y) {
      for (std::uint32_t x = 0; x < nx; ++x) {
        const auto cube = static_cast<std::uint32_t>(pyramids.obstacle.size());
        const auto centre = static_cast<std::int32_t>(mesh.point_count());
        add_point(x + 0.5, y + 0.5, z + 0.5);
        const auto points = corners(pyramids, cube);
        for (const auto& face : kHexFaces) {  // turns clockwise seen from the centre
          for (std::size_t i = 0; i < 4; ++i) mesh.connectivity.push_back(points[face[3 - i]]);
          mesh.connectivity.push_back(centre);
        }
        pyramids.obstacle.push_back(random.uniform() < options.obstacle_share ? 1 : 0);
      }
    }
  }
  return pyramids;
}

void clear_box(Pyramids& pyramids, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  std::uint32_t from[3], to[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto cube_at = [&](double value) {
      const double most = static_cast<double>(pyramids.options.size[k]) - 1;
      const double at = std::floor((value - pyramids.options.low[k]) / pyramids.options.edge);
      return static_cast<std::uint32_t>(std::clamp(at, 0.0, most));
    };
    from[k] = cube_at(low[k]);
    to[k] = cube_at(high[k]);
  }
  for (std::uint32_t z = from[2]; z <= to[2]; ++z) {
    for (std::uint32_t y = from[1]; y <= to[1]; ++y) {
      for (std::uint32_t x = from[0]; x <= to[0]; ++x) pyramids.obstacle[pyramids.cube(x, y, z)] = 0;
    }
  }
}

std::vector<Wall> pyramid_walls(const Pyramids& pyramids) {
  const auto [nx, ny, nz] = pyramids.options.size;
  const std::array<std::uint32_t, 3> step = {1, nx, nx * ny}, size = {nx, ny, nz};
  std::vector<Wall> walls;
  for (std::uint32_t cube = 0; cube < pyramids.obstacle.size(); ++cube) {
    if (pyramids.obstacle[cube] != 0) continue;
    const std::array<std::uint32_t, 3> at = {cube % nx, cube / nx % ny, cube / (nx * ny)};
    const auto points = corners(pyramids, cube);
    for (std::uint32_t side = 0; side < 6; ++side) {
      const std::uint32_t axis = side / 2;
      const bool outer = side % 2 == 0 ? at[axis] == 0 : at[axis] + 1 == size[axis];
      if (!outer && pyramids.obstacle[side % 2 == 0 ? cube - step[axis] : cube + step[axis]] == 0) continue;
      Wall wall;
      wall.vertex_count = 4;
      for (std::size_t i = 0; i < 4; ++i) wall.vertices[i] = static_cast<std::uint32_t>(points[kHexFaces[side][3 - i]]);
      walls.push_back(wall);
    }
  }
  return walls;
}

}  // namespace dsw::scenes
