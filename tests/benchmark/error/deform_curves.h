#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_DEFORM_CURVES_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_DEFORM_CURVES_H

#include "curves.h"

namespace dsw::curves {

/** deform_passed, deform_pushed, deform_way: walls that move 0.01 to 10 cell radii a step, by both methods, over
 * particles and over edges. */
void deform_curves(const Options& options);

}  // namespace dsw::curves

#endif
