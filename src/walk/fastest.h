#pragma once
// Which of the walks is fastest on this processor. Nobody can tell by its name: the same instructions are fast on one
// and slow on the next.

#include "base/processor.h"
#include "environment/environment.h"

namespace dsw {

/** The kernels of environments that name none: for each kind of cells the most instructions that the processor has, until
 * `measure_kernels` has found faster ones. */
const Kernels& fastest_kernels() noexcept;

/** Finds for the kinds of cells that `env` has the instructions that cross a few hundred of them in the least time. Each kind
 * is measured once in a process, in less than half a millisecond. Does nothing if the environment or DARTSWEEP_KERNEL names
 * instructions. */
void measure_kernels(const Environment<3>& env) noexcept;

}  // namespace dsw
