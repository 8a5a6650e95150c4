#pragma once
// Bodies of a scene that rotate and move along as a whole.

#include "response/rigid_move.h"
#include "scene/scene.h"

namespace dsw {

/** Whether the motion takes no vertex of a body further than doubles go. */
template <int D>
bool stays_finite(const Body<D>& body, const RigidMove<D>& motion) noexcept;

/** Moves a body as a whole as far as it is free. The places of a body that walls move as a whole follow from the shape
 * that it keeps. */
template <int D>
void move_rigid(Scene<D>& scene, BodyRecord<D>& of, const RigidMove<D>& motion, const MoveOrder& order);

}  // namespace dsw
