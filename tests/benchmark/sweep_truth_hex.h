// Whether a triangle meets an obstacle of a lattice of unit cubes, in exact rational arithmetic.
#ifndef DARTSWEEP_TESTS_BENCHMARK_SWEEP_TRUTH_HEX_H
#define DARTSWEEP_TESTS_BENCHMARK_SWEEP_TRUTH_HEX_H

#include "scenes/hex_grid.h"

namespace dsw::bench {

/** Leaving the lattice counts as meeting. Touching counts as meeting, which the shift may see differently: it does not
 * happen at random. The lattice must be neither jittered nor sheared. */
bool triangle_meets_obstacle(const scenes::HexGrid& grid, const double* a, const double* b, const double* c);

}  // namespace dsw::bench

#endif
