#pragma once
// Which of the walks is fastest on this processor. Nobody can tell by its name: the same instructions are fast on one
// and slow on the next.

#include "base/processor.h"

namespace dsw {

/** For each kind of cells the instructions that crossed a few thousand of them in the least time. Measured once, in a
 * few milliseconds, by the first who asks; not if DARTSWEEP_KERNEL names some. Never fails: without memory it names the
 * most that the processor has. */
const Kernels& fastest_kernels() noexcept;

}  // namespace dsw
