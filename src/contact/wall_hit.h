#pragma once
// What a wall that moves touches.

#include "body/feature.h"
#include "contact/touch.h"
#include "corridor/candidates.h"

namespace dsw {

/** The first touch of a feature by the walls at a moving vertex, without the names of what is touched. walls/wall_sweep.h
 * finds when, and what; its `measure` the rest. `along` begins at the first end of a touched edge. */
struct WallHit : Touch {
  Feature feature;
  WallFeature wall{};             // what touches it, the moving vertex first
  bool is_near = false;           // the wall comes too near to a thick body: then all but the point is found at once
  double weights[3] = {1, 0, 0};  // of the feature's corners in the point
  // How far the touched point of the wall still goes: a part of the vertex's way, as that point is between the vertex
  // and what stays. Not more than 1 - time.
  double left = 0;
  double end_normal[3] = {};  // the normal where that ends, in the sense of the wall's motion, as that of the touch

  bool operator<(const WallHit& o) const { return time != o.time ? time < o.time : feature < o.feature; }
};

}  // namespace dsw
