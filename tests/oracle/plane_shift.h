// The truth about a swept edge in the plane once more, by other means: all body points really are moved, by (e, e^2)
// with an e so small that nothing comes closer to zero; and what is met is where two lines cross, in rationals.
#pragma once

#include "arena.h"
#include "plane_truth.h"

namespace dsw::oracle {

/// What differs from the sweep's truth; empty if nothing does, or if numbers get too long. Marks must be set.
std::string differs_by_small_shift(const plane::World& world, const std::vector<int>& obstacles, const Sweep& sweep);

}  // namespace dsw::oracle
