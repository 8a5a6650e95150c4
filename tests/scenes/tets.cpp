#include "scenes/tets.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>

namespace dsw::scenes {

namespace {

Wall tet_wall(const VolumeMesh& mesh, std::uint32_t cell, std::uint32_t side, bool two_sided) {
  Wall wall;
  wall.vertex_count = 3;
  wall.two_sided = two_sided;
  for (std::size_t i = 0; i < 3; ++i) {
    wall.vertices[i] = static_cast<std::uint32_t>(mesh.cell(cell)[kTetFaces[side][2 - i]]);
  }
  return wall;
}

/** A random point of a tetrahedron, even by volume (up to rounding). */
void random_point(const VolumeMesh& mesh, std::uint32_t cell, Random& random, double* xyz) {
  double cuts[3] = {random.uniform(), random.uniform(), random.uniform()};
  std::sort(cuts, cuts + 3);
  const double weights[4] = {cuts[0], cuts[1] - cuts[0], cuts[2] - cuts[1], 1.0 - cuts[2]};
  for (std::size_t k = 0; k < 3; ++k) {
    xyz[k] = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      xyz[k] += weights[i] * mesh.point(static_cast<std::size_t>(mesh.cell(cell)[i]))[k];
    }
  }
}

template <typename Counts>
double mean_edge_where(const VolumeMesh& mesh, Counts counts) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!counts(cell)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double* a = mesh.point(static_cast<std::size_t>(mesh.cell(cell)[i]));
        const double* b = mesh.point(static_cast<std::size_t>(mesh.cell(cell)[j]));
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        ++count;
      }
    }
  }
  return sum / static_cast<double>(count);
}

template <typename Marked>
TetWalls collect(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours, Marked marked) {
  TetWalls walls;
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t other = neighbours[cell][side];
      if (other == kNone) {
        walls.all.push_back(tet_wall(mesh, cell, side, false));
      } else if (cell < other && marked(cell, other)) {
        walls.all.push_back(tet_wall(mesh, cell, side, true));
        const auto& v = walls.all.back().vertices;
        walls.marked.push_back({v[0], v[1], v[2]});
      }
    }
  }
  return walls;
}

}  // namespace

std::vector<std::array<std::uint32_t, 4>> tet_neighbours(const VolumeMesh& mesh) {
  struct HalfFace {
    std::array<std::uint32_t, 3> key;
    std::uint32_t cell, side;
  };
  std::vector<HalfFace> halves;
  halves.reserve(mesh.cell_count() * 4);
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
    for (std::uint32_t side = 0; side < 4; ++side) {
      HalfFace half{{}, cell, side};
      for (std::size_t i = 0; i < 3; ++i) half.key[i] = static_cast<std::uint32_t>(mesh.cell(cell)[kTetFaces[side][i]]);
      std::sort(half.key.begin(), half.key.end());
      halves.push_back(half);
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfFace& a, const HalfFace& b) { return a.key < b.key; });
  std::vector<std::array<std::uint32_t, 4>> neighbours(mesh.cell_count(), {kNone, kNone, kNone, kNone});
  for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
    if (halves[i].key == halves[i + 1].key) {
      neighbours[halves[i].cell][halves[i].side] = halves[i + 1].cell;
      neighbours[halves[i + 1].cell][halves[i + 1].side] = halves[i].cell;
    }
  }
  return neighbours;
}

TetWalls random_tet_walls(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours,
                          double share, std::uint64_t seed) {
  Random random(seed);
  return collect(mesh, neighbours, [&](std::uint32_t, std::uint32_t) { return random.uniform() < share; });
}

TetWalls region_walls(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours) {
  return collect(mesh, neighbours,
                 [&](std::uint32_t cell, std::uint32_t other) { return mesh.regions[cell] != mesh.regions[other]; });
}

TetCasts short_tet_casts(const VolumeMesh& mesh, const std::vector<std::array<std::uint32_t, 4>>& neighbours,
                         std::size_t count, std::uint64_t seed) {
  Random random(seed);
  TetCasts casts;
  casts.from.resize(3 * count);
  casts.to.resize(3 * count);
  casts.cells.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto cell = static_cast<std::uint32_t>(random.index(mesh.cell_count()));
    std::uint32_t target = cell;
    if (random.uniform() < 0.5) {
      do {
        target = neighbours[cell][random.index(4)];
      } while (target == kNone);
    }
    casts.cells[i] = cell;
    random_point(mesh, cell, random, &casts.from[3 * i]);
    random_point(mesh, target, random, &casts.to[3 * i]);
  }
  return casts;
}

TetCasts long_tet_casts(const VolumeMesh& mesh, std::size_t count, double length, std::int32_t region, bool any_region,
                        std::uint64_t seed) {
  Random random(seed);
  TetCasts casts;
  casts.from.resize(3 * count);
  casts.to.resize(3 * count);
  casts.cells.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t cell = 0;
    do {
      cell = static_cast<std::uint32_t>(random.index(mesh.cell_count()));
    } while (!any_region && mesh.regions[cell] != region);
    casts.cells[i] = cell;
    random_point(mesh, cell, random, &casts.from[3 * i]);
    double direction[3], length_sq = 0.0;
    do {
      length_sq = 0.0;
      for (double& value : direction) {
        value = random.uniform(-1, 1);
        length_sq += value * value;
      }
    } while (length_sq < 0.01 || length_sq > 1.0);
    for (std::size_t k = 0; k < 3; ++k) {
      casts.to[3 * i + k] = casts.from[3 * i + k] + direction[k] / std::sqrt(length_sq) * length;
    }
  }
  return casts;
}

double mean_edge(const VolumeMesh& mesh) {
  return mean_edge_where(mesh, [](std::size_t) { return true; });
}

double mean_edge(const VolumeMesh& mesh, std::int32_t region) {
  return mean_edge_where(mesh, [&](std::size_t cell) { return mesh.regions[cell] == region; });
}

}  // namespace dsw::scenes
