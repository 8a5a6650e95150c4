// Steps of elastic rods for rod.py. The rods themselves are numbers in Python: a solver gets them before each step.
#pragma once

#include <memory>

#include "common/host.h"

namespace dartsweep_python {

class RodSolver {
 public:
  explicit RodSolver(std::uint32_t rods);
  ~RodSolver();

  // vertices: 13 numbers for each: position, velocity, load, mass, curvature at rest, held. edges: 11 numbers for each: director, spin,
  // twist at its second vertex, length, stretching, bending, twisting at rest, held in its turn, radius.
  void set_rod(std::uint32_t rod, dartsweep::View<const double> vertices, dartsweep::View<const double> edges);
  // Directors without twist: `across` is that of the last edge, turned by an angle about it. Gives what is left of `across`, a unit vector,
  // and then the directors, 3 numbers for each edge.
  dartsweep::Array<double> carry_director(std::uint32_t rod, dartsweep::View<const double> across, double turned);
  // Bends of the shape of now: 2 numbers for each vertex.
  dartsweep::Array<double> curvatures(std::uint32_t rod) const;
  // Velocities without contacts. Gives the largest speed of the first vertices, so many of them.
  double predict(std::uint32_t rod, double dt, double drag, std::uint32_t vertices);
  // others: by row, the number of the rod that it is at, 0xffffffff for a wall, or 0xfffffffe where the row does not count. impulses: 3
  // numbers for each row, from which it starts.
  void set_rows(std::uint32_t rod, dartsweep::View<const dsw_near_row> rows,
                dartsweep::View<const std::uint32_t> others, dartsweep::View<const double> impulses);
  void set_options(std::uint32_t rod, double friction, double recovery, double tolerance, int most_sweeps);
  // The contacts of all rods. Gives the number of sweeps, and by how much a row has moved in the last one: a length.
  dartsweep::Array<double> finish(double dt);
  // After `finish`: how far an edge turns in a step, at most.
  double largest_turn(std::uint32_t rod, double dt) const;
  // Where the first vertices want to be, so many of them. Ways that are longer than `most` make all of them shorter.
  dartsweep::Array<double> targets(std::uint32_t rod, double dt, std::uint32_t vertices, double most) const;
  dartsweep::Array<double> spins(std::uint32_t rod) const;
  dartsweep::Array<double> impulses(std::uint32_t rod) const;
  // The rod is at `positions` after the step. Gives directors, 3 numbers for each edge, and then the twist by vertex.
  dartsweep::Array<double> advance(std::uint32_t rod, double dt, dartsweep::View<const double> positions);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dartsweep_python
