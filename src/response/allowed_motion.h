#pragma once
// What touched walls allow of a rigid motion, as another rigid motion.

#include "response/rigid_move.h"
#include "response/settings.h"
#include "response/touched_planes.h"

namespace dsw {

/** What planes allow. kTooFar: of a shorter part they can tell. */
enum class Allowed { kNothing, kTooFar, kFound };

/** Finds what planes allow of a share of the motion that is left to a body.
 * @param motion may be `left`; written if anything is found. */
template <int D>
Allowed find_allowed(const Body<D>& body, const Inertia<D>& inertia, const TouchedPlanes<D>& planes,
                     const PlainMotion& left, double share, PlainMotion* motion) noexcept;

}  // namespace dsw
