#pragma once
// Edges of bodies, cut along a blade.

#include "cutting/blade.h"
#include "scene/bodies.h"

namespace dsw {

/** Cuts the edges of bodies, distinct, that a blade crosses, and leaves scene.body_cuts. Throws OCCUPIED and
 * std::bad_alloc; then nothing has changed. */
template <int D>
void cut_bodies(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, const Blade<D>& blade);

}  // namespace dsw
