#pragma once
// An environment bends and rigid bodies move, all at once.

#include "response/rigid_move.h"
#include "scene/bodies.h"
#include "together/settings.h"

namespace dsw {

/** Takes the environment to the points `next` and bodies, distinct, along their motions, up to the first touch of anything. All else
 * stands still. What came of it is in the scene's deformation and in the bodies' records. Throws std::bad_alloc and NON_FINITE: then
 * nothing has changed.
 * @param point_room see WallSettings.
 * @param settings only the limit of work counts. */
template <int D>
void deform_rigid(Scene<D>& scene, double* next, size_t point_room, BodyRecord<D>* const* bodies,
                  const RigidMove<D>* motions, size_t count, const TogetherSettings& settings);

}  // namespace dsw
