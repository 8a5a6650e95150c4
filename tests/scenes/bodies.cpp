#include "scenes/bodies.h"

#include <cmath>

namespace dsw::scenes {

namespace {

std::array<double, 3> random_direction(Random& random) {
  for (;;) {
    const std::array<double, 3> v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double length_sq = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (length_sq > 0.01 && length_sq <= 1.0) {
      const double scale = 1.0 / std::sqrt(length_sq);
      return {v[0] * scale, v[1] * scale, v[2] * scale};
    }
  }
}

/** Three orthogonal unit vectors. */
std::array<std::array<double, 3>, 3> random_frame(Random& random) {
  const std::array<double, 3> a = random_direction(random);
  for (;;) {
    std::array<double, 3> b = random_direction(random);
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    double length_sq = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      b[k] -= along * a[k];
      length_sq += b[k] * b[k];
    }
    if (length_sq < 0.01) {
      continue;
    }
    for (double& value : b) {
      value /= std::sqrt(length_sq);
    }
    return {a, b, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
}

/** A point on the unit circle. */
std::array<double, 2> random_phase(Random& random) {
  for (;;) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const double length_sq = x * x + y * y;
    if (length_sq > 0.01 && length_sq <= 1.0) {
      const double scale = 1.0 / std::sqrt(length_sq);
      return {x * scale, y * scale};
    }
  }
}

}  // namespace

BodyMotion::BodyMotion(const HexGrid& grid, const BodyOptions& options)
    : grid_(grid),
      options_(options),
      random_(options.seed),
      bodies_(options.bodies),
      starts_(options.bodies * kBodyVertices * 3),
      targets_(starts_.size()) {
  double* vertices = starts_.data();
  for (Body& body : bodies_) {
    const auto frame = random_frame(random_);
    for (std::size_t i = 0; i < kBodyVertices; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          sum += frame[axis][k] * ((i >> axis & 1) != 0 ? 0.5 : -0.5);
        }
        body.corners[i][k] = sum * options.edge;
      }
    }
    for (auto& phase : body.phase) {
      phase = random_phase(random_);
    }
    const double slope = random_.uniform(0.05, 0.3);  // tangent of half the turn a step
    body.turn = {(1 - slope * slope) / (1 + slope * slope), 2 * slope / (1 + slope * slope)};
    choose_direction(body);
    do {
      for (std::size_t k = 0; k < 3; ++k) {
        body.centre[k] = random_.uniform(0.0, double(grid.options.size[k]));
      }
      place(body, body.centre, vertices);
    } while (!free(vertices));
    vertices += 3 * kBodyVertices;
  }
  aim();
}

void BodyMotion::choose_direction(Body& body) {
  const double speed = random_.uniform(options_.step_low, options_.step_high);
  const auto direction = random_direction(random_);
  for (std::size_t k = 0; k < 3; ++k) {
    body.velocity[k] = direction[k] * speed;
  }
  body.pressed = 0;
}

void BodyMotion::place(const Body& body, const std::array<double, 3>& centre, double* vertices) const {
  for (std::size_t i = 0; i < kBodyVertices; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[3 * i + k] = centre[k] + body.corners[i][k] + options_.wobble * body.phase[3 * i + k][0];
    }
  }
}

bool BodyMotion::free(const double* vertices) const {
  for (std::size_t i = 0; i < kBodyVertices; ++i) {
    const std::uint32_t cell = grid_.cell_at(vertices + 3 * i);
    if (cell == kNone || grid_.obstacle[cell] != 0) {
      return false;
    }
  }
  return true;
}

void BodyMotion::aim() {
  double* target = targets_.data();
  for (Body& body : bodies_) {
    for (auto& phase : body.phase) {
      const double x = phase[0] * body.turn[0] - phase[1] * body.turn[1];
      phase[1] = phase[0] * body.turn[1] + phase[1] * body.turn[0];
      phase[0] = x;
    }
    const std::array<double, 3> centre = {body.centre[0] + body.velocity[0], body.centre[1] + body.velocity[1],
                                          body.centre[2] + body.velocity[2]};
    place(body, centre, target);
    target += 3 * kBodyVertices;
  }
}

void BodyMotion::advance() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const std::size_t first = i * kBodyVertices * 3;
    if (free(targets_.data() + first)) {
      for (std::size_t k = 0; k < kBodyVertices * 3; ++k) {
        starts_[first + k] = targets_[first + k];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        body.centre[k] += body.velocity[k];
      }
    } else if (++body.pressed >= options_.press) {
      choose_direction(body);
    }
  }
  aim();
}

void append_step_segments(const HexGrid& grid, const BodyMotion& motion, std::vector<double>& from,
                          std::vector<double>& to, std::vector<std::uint32_t>& lattice_cells) {
  const std::size_t bodies = motion.vertex_count() / kBodyVertices;
  const auto append = [&](std::size_t start_vertex, std::size_t target_vertex) {
    const double* start = motion.starts().data() + 3 * start_vertex;
    double space[3];
    lattice_to_space(grid.options, start, space);
    from.insert(from.end(), space, space + 3);
    lattice_to_space(grid.options, motion.targets().data() + 3 * target_vertex, space);
    to.insert(to.end(), space, space + 3);
    lattice_cells.push_back(grid.cell_at(start));
  };
  for (std::size_t body = 0; body < bodies; ++body) {
    const std::size_t first = body * kBodyVertices;
    for (std::size_t i = 0; i < kBodyVertices; ++i) {
      append(first + i, first + i);
    }
    for (const auto& edge : kEdgeVertices) {
      append(first + edge[0], first + edge[1]);
    }
  }
}

}  // namespace dsw::scenes
