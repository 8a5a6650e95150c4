#include "response/allowed_motion.h"

#include <algorithm>
#include <cmath>

namespace dsw {

template <int D>
Allowed find_allowed(const Body<D>& body, const Inertia<D>& inertia, const TouchedPlanes<D>& planes,
                     const PlainMotion& left, double share, PlainMotion* motion) noexcept {
  // Planes hold for small turns.
  constexpr double kMostTurn = 0.25, kStandOff = 0x1p-40, kUnits = 32;
  double size = 0;
  for (const BodyVertex<D>& each : body.vertices) {
    if (each.cell.valid()) size = std::max(size, largest(to_vec<D>(each.position)));
  }
  const double units = kUnits * (std::nextafter(size, 2 * size + 1) - size);
  const RigidMotion<D> part = RigidMove<D>(left.rotation, left.centre, left.translation).part(share);
  double middle[3] = {}, to[3] = {};
  store<D>(inertia.middle, middle);
  part.place(middle, to);
  Twist wanted, allowed;
  wanted.shift = to_vec<D>(to) - inertia.middle;
  wanted.turn = (2 / part.rotation[3]) * to_vec<3>(part.rotation);
  if (!(length(wanted.turn) <= kMostTurn)) return Allowed::kTooFar;
  if (!planes.allow(inertia, wanted, kStandOff * length(wanted.shift) + units, &allowed)) return Allowed::kNothing;
  if (!(length(allowed.turn) <= kMostTurn)) return Allowed::kTooFar;
  PlainMotion found;
  store<3>(0.5 * allowed.turn, found.rotation);
  store<D>(inertia.middle, found.centre);
  store<D>(allowed.shift, found.translation);
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(found.rotation[k]) || !std::isfinite(found.centre[k] + found.translation[k])) {
      return Allowed::kNothing;
    }
  }
  *motion = found;
  return Allowed::kFound;
}

#define DSW_FIND_ALLOWED(D)                                                                                     \
  template Allowed find_allowed(const Body<D>&, const Inertia<D>&, const TouchedPlanes<D>&, const PlainMotion&, \
                                double, PlainMotion*) noexcept
DSW_FIND_ALLOWED(2);
DSW_FIND_ALLOWED(3);
#undef DSW_FIND_ALLOWED

}  // namespace dsw
