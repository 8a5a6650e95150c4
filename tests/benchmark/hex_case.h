// One lattice of [JCD10] 7.4 with bodies moving through it, ready to be cast in by all engines.
#ifndef DARTSWEEP_TESTS_BENCHMARK_HEX_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_HEX_CASE_H

#include "ours.h"

#include "scenes/bodies.h"
#include "scenes/hex_grid.h"

namespace dsw::bench {

struct HexCase {
  HexCase(std::string case_label, const scenes::HexGridOptions& grid_options, const scenes::BodyOptions& body_options,
          std::uint32_t threads);

  /** Casts of the next steps, located. @return how many of them start in an obstacle and were left out. */
  std::size_t next_block(std::size_t steps, Segments& segments);

  std::string label;  // "hex.n1e6"
  scenes::HexGrid grid;
  World world;
  scenes::BodyMotion motion;
  WallMesh walls;
};

}  // namespace dsw::bench

#endif
