// An environment in the plane that is deformed.
#pragma once

#include "deform_ground.h"
#include "plane_scenes.h"
#include "sweep_check.h"

namespace dsw::oracle {

/// The ground of a scene's seed, of which faults will be told. Null if creation may refuse the mesh, or with what is
/// wrong in `fault`.
std::unique_ptr<Ground> plane_ground_of(const plane::Turn& turn, uint64_t seed, Rng& rng, SweepReport& faults,
                                        std::string& fault);

}  // namespace dsw::oracle
