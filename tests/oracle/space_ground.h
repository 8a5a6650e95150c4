// An environment in space that is deformed.
#pragma once

#include "deform_ground.h"
#include "sweep_scenes.h"

namespace dsw::oracle {

/// Makes the ground of a stage with its marks.
std::unique_ptr<Ground> make_ground(std::unique_ptr<Stage> stage, Rng& rng);

}  // namespace dsw::oracle
