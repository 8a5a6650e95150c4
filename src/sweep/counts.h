#pragma once
// What sweeps of a body count.

#include <cstdint>

namespace dsw {

/** How many sweeps of edges were asked for, and how many of these were left out. */
struct SweepCounts {
  uint32_t swept = 0, skipped = 0;
};

}  // namespace dsw
