// An environment in space that is deformed.
#pragma once

#include "deform_ground.h"
#include "sweep_scenes.h"

namespace dsw::oracle {

/// Makes the ground of a stage with its marks.
std::unique_ptr<Ground> make_ground(std::unique_ptr<Stage> stage, Rng& rng);
/// The ground of a scene's seed, of which faults will be told; null as make_stage.
std::unique_ptr<Ground> space_ground_of(const SweepTurn& turn, uint64_t seed, Rng& rng, SweepReport& faults);

}  // namespace dsw::oracle
