#include "scenes/bodies.h"

namespace dsw::scenes {

BodyMotion::BodyMotion(const HexGrid& grid, const BodyOptions& options) : Drift(grid, options) {
  const auto cube = [&](const Frame& frame) {
    Corners corners;
    for (std::size_t i = 0; i < kBodyVertices; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) sum += frame[axis][k] * ((i >> axis & 1) != 0 ? 0.5 : -0.5);
        corners[i][k] = sum * options.edge;
      }
    }
    return corners;
  };
  place_all(cube, [this](const double* vertices) { return free(vertices); });
}

bool BodyMotion::free(const double* vertices) const {
  for (std::size_t i = 0; i < kBodyVertices; ++i) {
    const std::uint32_t cell = grid_.cell_at(vertices + 3 * i);
    if (cell == kNone || grid_.obstacle[cell] != 0) return false;
  }
  return true;
}

void BodyMotion::advance() {
  for (std::size_t i = 0; i < body_count(); ++i) {
    const double* target = targets_.data() + i * kBodyVertices * 3;
    if (free(target)) {
      std::copy_n(target, kBodyVertices * 3, starts_.data() + i * kBodyVertices * 3);
      arrive(i);
    } else {
      press(i);
    }
  }
  aim();
}

void append_step_segments(const HexGrid& grid, const BodyMotion& motion, std::vector<double>& from,
                          std::vector<double>& to, std::vector<std::uint32_t>& lattice_cells) {
  const auto append = [&](std::size_t start_vertex, std::size_t target_vertex) {
    const double* start = motion.starts().data() + 3 * start_vertex;
    double space[3];
    lattice_to_space(grid.options, start, space);
    from.insert(from.end(), space, space + 3);
    lattice_to_space(grid.options, motion.targets().data() + 3 * target_vertex, space);
    to.insert(to.end(), space, space + 3);
    lattice_cells.push_back(grid.cell_at(start));
  };
  for (std::size_t body = 0; body < motion.body_count(); ++body) {
    const std::size_t first = body * kBodyVertices;
    for (std::size_t i = 0; i < kBodyVertices; ++i) append(first + i, first + i);
    for (const auto& edge : kEdgeVertices) append(first + edge[0], first + edge[1]);
  }
}

}  // namespace dsw::scenes
