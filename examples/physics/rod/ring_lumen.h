// A wire in a lumen that is a ring: a scene for the rod alone, whose rows are known without an environment.
#ifndef DARTSWEEP_PHYSICS_ROD_RING_LUMEN_H
#define DARTSWEEP_PHYSICS_ROD_RING_LUMEN_H

#include "rod/rod.h"

namespace physics {

struct RingLumen {
  static constexpr double kRing = 10, kLumen = 1, kLink = 0.25, kStep = 1e-3, kSpeed = 10;

  // A straight wire of so many links, bent along the ring, that is held at its last link.
  static Rod wire(std::size_t links);

  // `count` rows, evenly along the wire; every third one is in the middle of an edge.
  static NearRows rows(const Rod& rod, std::size_t count, bool has_previous);

  // One step in which the hand goes on along the ring.
  static RodContactReport step(Rod* rod, const NearRows& rows);
};

}  // namespace physics

#endif
