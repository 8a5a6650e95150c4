// The proof that a body is free, by other calls of the library than those that moved it.
#ifndef DARTSWEEP_PHYSICS_VERIFY_H
#define DARTSWEEP_PHYSICS_VERIFY_H

#include "library.h"

namespace physics {

struct Validation {
  std::size_t edges = 0, vertices = 0;  // looked at
  std::size_t nonfinite = 0;            // vertices whose position is no number
  std::size_t not_free = 0;             // edges that meet something impassable; one more for a surface that does
  std::size_t lost = 0;  // vertices that are not in the volume that the body reports, or not in a passable one
  // Vertices found only from that volume, since another one lies over it; edges that only a cast from their second end
  // finds free, among volumes that are invalid.
  std::size_t from_own = 0;
  bool good() const { return nonfinite == 0 && not_free == 0 && lost == 0; }
};

// Casts every edge through the environment alone, and finds every vertex again: without a hint or, where walls have folded cells over
// others, from its own cell. There the straight way from one end can lead into a volume that lies over those of the edge, so the other end
// is asked, too. A surface is created once more where it is, which fails unless it is free at its level. Throws LibraryError.
// O(edges + vertices), given an environment with a grid.
Validation verify(dsw_scene* scene, dsw_body_id body);

}  // namespace physics

#endif
