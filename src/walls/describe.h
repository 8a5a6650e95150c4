#pragma once
// A contact of a wall as a host reads it.

#include "dartsweep/deform.h"
#include "walls/wall_sweep.h"

namespace dsw {

/** What the walls at a vertex meet on its way. */
template <int D>
dsw_wall_contact describe(const Environment<D>& env, const Occupants<D>& all, const WallHit& hit, const double* from,
                          const double* to, dsw_wall_response done) noexcept;

/** Names the feature that is touched. */
template <int D>
void name_feature(const Occupants<D>& all, const Feature& feature, dsw_wall_contact& contact) noexcept;
}  // namespace dsw
