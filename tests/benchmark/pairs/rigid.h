// Pairs whose features turn, against exact times.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PAIRS_RIGID_H
#define DARTSWEEP_TESTS_BENCHMARK_PAIRS_RIGID_H

#include "../report.h"

#include <cstddef>
#include <cstdint>

namespace dsw::pairs {

/** Asks dsw_sweep_rigid_pairs `count` queries where one feature turns, and as many where both do: the figures
 * rigid.pairs.*. @return whether every answer is exact. */
bool report_rigid_pairs(bench::Report& report, std::size_t count, std::uint64_t seed);

}  // namespace dsw::pairs

#endif
