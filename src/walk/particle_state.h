#pragma once
// Where a particle is.

#include "environment/environment.h"

namespace dsw {

/** Two to a cache line in space. A slot without a particle has no cell. */
template <int D>
struct ParticleState {
  double position[D];
  Cell cell;                     // contains the position, passable
  uint32_t forecast = kNoFacet;  // local facet of `cell` that the particle was last seen aiming at
};
static_assert(sizeof(ParticleState<3>) == 32 && sizeof(ParticleState<2>) == 24);

}  // namespace dsw
