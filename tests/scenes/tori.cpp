#include "scenes/tori.h"

#include "scenes/random_turns.h"

#include <cmath>

namespace dsw::scenes {

namespace {

constexpr std::uint32_t kRound = 6, kTube = 3;

std::uint32_t vertex(std::uint32_t i, std::uint32_t j) { return i % kRound * kTube + j % kTube; }

/** Points of a regular polygon on the unit circle: the first has angle 0, `turn` is the second. */
template <std::size_t N>
std::array<std::array<double, 2>, N> polygon(std::array<double, 2> turn) {
  std::array<std::array<double, 2>, N> points{};
  points[0] = {1.0, 0.0};
  for (std::size_t i = 1; i < N; ++i) {
    points[i] = {points[i - 1][0] * turn[0] - points[i - 1][1] * turn[1],
                 points[i - 1][0] * turn[1] + points[i - 1][1] * turn[0]};
  }
  return points;
}

}  // namespace

std::array<std::array<std::uint32_t, 2>, kTorusEdges> torus_edges() {
  std::array<std::array<std::uint32_t, 2>, kTorusEdges> edges{};
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kRound; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      edges[count++] = {vertex(i, j), vertex(i + 1, j)};
      edges[count++] = {vertex(i, j), vertex(i, j + 1)};
      edges[count++] = {vertex(i, j), vertex(i + 1, j + 1)};
    }
  }
  return edges;
}

std::array<std::array<std::uint32_t, 3>, kTorusFaces> torus_faces() {
  std::array<std::array<std::uint32_t, 3>, kTorusFaces> faces{};
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kRound; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      faces[count++] = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)};
      faces[count++] = {vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
    }
  }
  return faces;
}

TorusMotion::TorusMotion(const HexGrid& grid, const TorusOptions& options)
    : grid_(grid),
      options_(options),
      random_(options.seed),
      bodies_(options.bodies),
      starts_(options.bodies * kTorusVertices * 3),
      targets_(starts_.size()) {
  const double height = std::sqrt(0.75);
  const auto round = polygon<kRound>({0.5, height});
  const auto tube = polygon<kTube>({-0.5, height});
  double* vertices = starts_.data();
  for (Body& body : bodies_) {
    const auto frame = random_frame(random_);
    for (std::uint32_t i = 0; i < kRound; ++i) {
      for (std::uint32_t j = 0; j < kTube; ++j) {
        const double out = options.ring + options.tube * tube[j][0];
        const double at[3] = {out * round[i][0], out * round[i][1], options.tube * tube[j][1]};
        for (std::size_t k = 0; k < 3; ++k) {
          body.corners[vertex(i, j)][k] = at[0] * frame[0][k] + at[1] * frame[1][k] + at[2] * frame[2][k];
        }
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
    } while (!has_room(vertices));
    vertices += 3 * kTorusVertices;
  }
  aim();
}

void TorusMotion::choose_direction(Body& body) {
  const double speed = random_.uniform(options_.step_low, options_.step_high);
  const auto direction = random_direction(random_);
  for (std::size_t k = 0; k < 3; ++k) {
    body.velocity[k] = direction[k] * speed;
  }
  body.pressed = 0;
}

void TorusMotion::place(const Body& body, const std::array<double, 3>& centre, double* vertices) const {
  for (std::size_t i = 0; i < kTorusVertices; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[3 * i + k] = centre[k] + body.corners[i][k] + options_.wobble * body.phase[3 * i + k][0];
    }
  }
}

/** Whether every cell that the vertices' box meets is passable. */
bool TorusMotion::has_room(const double* vertices) const {
  std::array<double, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = high[k] = vertices[k];
    for (std::size_t i = 1; i < kTorusVertices; ++i) {
      low[k] = std::fmin(low[k], vertices[3 * i + k]);
      high[k] = std::fmax(high[k], vertices[3 * i + k]);
    }
  }
  if (grid_.cell_at(low.data()) == kNone || grid_.cell_at(high.data()) == kNone) {
    return false;
  }
  for (auto z = static_cast<std::uint32_t>(low[2]); z <= static_cast<std::uint32_t>(high[2]); ++z) {
    for (auto y = static_cast<std::uint32_t>(low[1]); y <= static_cast<std::uint32_t>(high[1]); ++y) {
      for (auto x = static_cast<std::uint32_t>(low[0]); x <= static_cast<std::uint32_t>(high[0]); ++x) {
        if (grid_.obstacle[grid_.cell(x, y, z)] != 0) {
          return false;
        }
      }
    }
  }
  return true;
}

void TorusMotion::aim() {
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
    target += 3 * kTorusVertices;
  }
}

void TorusMotion::advance(const std::vector<std::uint8_t>& arrived) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (arrived[i] != 0) {
      for (std::size_t k = 0; k < 3; ++k) {
        body.centre[k] += body.velocity[k];
      }
    } else if (++body.pressed >= options_.press) {
      choose_direction(body);
    }
  }
  aim();
}

}  // namespace dsw::scenes
