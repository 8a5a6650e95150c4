#pragma once
// An environment bends and bodies move, all at once.

#include "scene/bodies.h"
#include "together/settings.h"

namespace dsw {

/** Takes the environment to the points `next` and bodies, distinct, to their finite targets, which stand one after the other.
 * All else stands still. Everything stops at the first contact. What came of it is in the scene's deformation and in the
 * bodies' records. Throws std::bad_alloc, NON_FINITE and UNSUPPORTED: then nothing has changed.
 * @param point_room see WallSettings.
 * @param settings only the limit of work counts. */
template <int D>
void deform_together(Scene<D>& scene, double* next, size_t point_room, BodyRecord<D>* const* bodies, size_t count,
                     PointArray targets, const TogetherSettings& settings);

}  // namespace dsw
