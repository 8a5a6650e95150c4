#pragma once
// A body that was created where it is not free moves out: dsw_body_depenetrate.

#include "scene/scene.h"

namespace dsw {

struct DepenetrationResult {
  bool freed = false;
  double distance = 0;  // of the vertex that moved farthest
};

/** Moves a penetrating body to where it is free, or leaves it and fills scene.offending. A free body stays.
 * @param inside a passable cell on the side of the walls to go to; invalid: where most of the body is.
 * @param limit largest displacement of a vertex. */
template <int D>
DepenetrationResult depenetrate(Scene<D>& scene, BodyRecord<D>& of, Cell inside, double limit);

}  // namespace dsw
