// Bodies in the scene of figure 11 of [JCD10]: what the levels cost, what is tested, and whether sweeps are right.
#ifndef DARTSWEEP_TESTS_BENCHMARK_FIG11_BODIES_H
#define DARTSWEEP_TESTS_BENCHMARK_FIG11_BODIES_H

#include "fig11_case.h"
#include "report.h"

namespace dsw::bench {

/** Measures a script without changes. @param checked_most free sweeps that rational arithmetic looks at. */
void measure_fig11_bodies(Fig11Case& scene, const Script& script, std::size_t checked_most, Report& report);

}  // namespace dsw::bench

#endif
