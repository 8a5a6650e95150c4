// Bodies of N vertices that drift through a lattice and wobble, in lattice coordinates. Their shapes, and where there
// is room for them, are their owners' business. Uses no libm but sqrt.
#ifndef DARTSWEEP_TESTS_SCENES_DRIFT_H
#define DARTSWEEP_TESTS_SCENES_DRIFT_H

#include "scenes/hex_grid.h"
#include "scenes/random_turns.h"

#include <algorithm>

namespace dsw::scenes {

struct DriftOptions {
  std::size_t bodies = 225;
  double step_low = 0.05, step_high = 0.1;  // cells a step
  double wobble = 0.03;                     // largest shift of a vertex along each axis, cells
  std::uint32_t press = 30;  // steps a body presses against what stops it before it leaves in another direction
  std::uint64_t seed = 7;
};

template <std::size_t N>
class Drift {
 public:
  std::size_t body_count() const { return bodies_.size(); }
  std::size_t vertex_count() const { return bodies_.size() * N; }
  /** Where the vertices are, 3 doubles each. */
  const std::vector<double>& starts() const { return starts_; }
  /** Where they aim at in this step. */
  const std::vector<double>& targets() const { return targets_; }

 protected:
  using Frame = std::array<std::array<double, 3>, 3>;
  using Corners = std::array<std::array<double, 3>, N>;

  Drift(const HexGrid& grid, const DriftOptions& options)
      : grid_(grid),
        options_(options),
        random_(options.seed),
        bodies_(options.bodies),
        starts_(3 * N * options.bodies),
        targets_(starts_.size()) {}

  /** Puts every body where it has room. @param shape (frame) -> Corners. @param has_room (vertices) -> bool. */
  template <class Shape, class HasRoom>
  void place_all(const Shape& shape, const HasRoom& has_room) {
    double* vertices = starts_.data();
    for (Body& body : bodies_) {
      body.corners = shape(random_frame(random_));
      for (auto& phase : body.phase) phase = random_phase(random_);
      const double slope = random_.uniform(0.05, 0.3);  // tangent of half the turn a step
      body.turn = {(1 - slope * slope) / (1 + slope * slope), 2 * slope / (1 + slope * slope)};
      choose_direction(body);
      do {
        for (std::size_t k = 0; k < 3; ++k) body.centre[k] = random_.uniform(0.0, double(grid_.options.size[k]));
        place(body, body.centre, vertices);
      } while (!has_room(vertices));
      vertices += 3 * N;
    }
    aim();
  }

  /** Body i follows its centre. */
  void arrive(std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) bodies_[i].centre[k] += bodies_[i].velocity[k];
  }
  /** Body i stays, and after some steps turns to a random direction. */
  void press(std::size_t i) {
    if (++bodies_[i].pressed >= options_.press) choose_direction(bodies_[i]);
  }

  void aim() {
    double* target = targets_.data();
    for (Body& body : bodies_) {
      for (auto& phase : body.phase) {
        phase = {phase[0] * body.turn[0] - phase[1] * body.turn[1], phase[0] * body.turn[1] + phase[1] * body.turn[0]};
      }
      place(body,
            {body.centre[0] + body.velocity[0], body.centre[1] + body.velocity[1], body.centre[2] + body.velocity[2]},
            target);
      target += 3 * N;
    }
  }

  const HexGrid& grid_;
  DriftOptions options_;
  Random random_;

  struct Body {
    std::array<double, 3> centre, velocity;
    Corners corners;                                 // of the turned shape at rest
    std::array<std::array<double, 2>, 3 * N> phase;  // a point on the unit circle for each coordinate
    std::array<double, 2> turn;                      // how far the phases turn in a step
    std::uint32_t pressed = 0;
  };
  std::vector<Body> bodies_;
  std::vector<double> starts_, targets_;

 private:
  void choose_direction(Body& body) {
    const double speed = random_.uniform(options_.step_low, options_.step_high);
    const auto direction = random_direction(random_);
    for (std::size_t k = 0; k < 3; ++k) body.velocity[k] = direction[k] * speed;
    body.pressed = 0;
  }

  void place(const Body& body, const std::array<double, 3>& centre, double* vertices) const {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        vertices[3 * i + k] = centre[k] + body.corners[i][k] + options_.wobble * body.phase[3 * i + k][0];
      }
    }
  }
};

}  // namespace dsw::scenes

#endif
