#include "scenes/bodies.h"

#include "scenes/random_turns.h"

namespace dsw::scenes {

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
