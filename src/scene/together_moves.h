#pragma once
// Bodies of which all vertices move at once.

#include "scene/bodies.h"
#include "together/settings.h"

namespace dsw {

/** Bodies, distinct, with their finite targets one after the other. Throws before anything has moved. */
template <int D>
void move_together(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, PointArray targets,
                   const TogetherSettings& settings);

}  // namespace dsw
