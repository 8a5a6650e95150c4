// The lattice of hexahedra with obstacles in which moves are timed.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_LATTICE_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_LATTICE_H

#include "../ours.h"
#include "bodies.h"
#include "scenes/hex_grid.h"
#include "scenes/random.h"

namespace dsw::rigid {

/** 21 x 21 x 21 cells of unit size, 5 % of them obstacles: some 10,000 triangles. */
class Lattice {
 public:
  explicit Lattice(std::uint64_t seed);

  dsw_scene* scene() { return world_.scene(); }
  const Figure& walls() const { return walls_; }
  /** The middle of a random cell that is no obstacle. */
  Point draw_middle(scenes::Random& random) const;

 private:
  scenes::HexGrid grid_;
  bench::World world_;
  Figure walls_;
};

}  // namespace dsw::rigid

#endif
