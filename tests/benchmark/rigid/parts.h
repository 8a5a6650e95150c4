// The parts of the program. Each adds its figures to the report.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_PARTS_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_PARTS_H

#include "../report.h"

#include <cstddef>
#include <cstdint>

namespace dsw::rigid {

using bench::Report;

struct Options {
  std::size_t moves = 4000, thick = 4000, bodies = 60, fcl = 200;
  std::uint64_t seed = 1;
  std::size_t print = 20;       // faults, at most
  std::size_t only = SIZE_MAX;  // the one case to look at, which is printed
};

/** Moves against rational arithmetic. @return whether there was no fault. */
bool run_moves(const Options& options, Report& report);
/** Bodies with a radius: whether they keep their distance on the way. @return whether all do. */
bool run_thick(const Options& options, Report& report);
/** What a vertex costs, over dsw_body_move. */
void run_cost(const Options& options, Report& report);
/** Moves that slide as a whole. @return whether all end free, unbent, and no farther from their targets than stops. */
bool run_slides(const Options& options, Report& report);
/** What dsw_body_find_free_fractions costs, over making bodies and moving them. */
void run_free(const Options& options, Report& report);
/** Capsules and boxes beside FCL. Nothing where FCL is missing. */
void run_fcl(const Options& options, Report& report);

}  // namespace dsw::rigid

#endif
