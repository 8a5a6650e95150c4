// The lattice of hexahedra with obstacles in which moves are timed.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_LATTICE_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_LATTICE_H

#include "../ours.h"
#include "figure.h"
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
  /** Whether there was room for a body, at the level of its parts. */
  bool add(const Figure& body, double radius, dsw_body_id& id);

 private:
  scenes::HexGrid grid_;
  bench::World world_;
  Figure walls_;
};

/** A sphere with 4^k times 8 triangles, nearly. */
Figure make_ball(int k, double radius);
/** The 12 triangles of a cuboid round the origin. */
Figure make_box(const Point& half);

}  // namespace dsw::rigid

#endif
