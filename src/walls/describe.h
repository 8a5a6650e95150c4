#pragma once
// A contact of a wall as a host reads it.

#include "dartsweep/deform.h"
#include "walls/wall_sweep.h"

namespace dsw {

/** What walls at `vertex` meet on its way. */
dsw_wall_contact describe(const Environment<3>& env, const Occupants& all, const WallHit& hit, uint32_t vertex,
                          const double* from, const double* to, dsw_wall_response done) noexcept;

/** Names a feature, and the wall that it meets. */
void name_feature(const Occupants& all, const Feature& feature, dsw_wall_contact& contact) noexcept;
void name_wall(const Environment<3>& env, HalfFacet wall, dsw_wall_contact& contact) noexcept;

}  // namespace dsw
