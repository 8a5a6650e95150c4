#pragma once
// What segments meet first in a scene, and what is nearest to points: of the environment and of bodies.

#include "query/nearest.h"
#include "query/segments.h"
#include "scene/scene.h"

namespace dsw {

/** Casts segments among walls and bodies. Nothing changes but boxes that have not been noted yet. Throws std::bad_alloc; then
 * some answers are written. */
template <int D>
void cast_among_bodies(Scene<D>& scene, size_t count, const dsw_volume_id* starts, PointArray from, PointArray to,
                       const SegmentOptions& options, dsw_flight* flights, dsw_contact_partner* partners);

/** What is nearest to points; a body only where it is nearer than all that nearest_to_points finds. Throws
 * std::bad_alloc; then some answers are written. */
template <int D>
void nearest_among_bodies(Scene<D>& scene, size_t count, PointArray points, const dsw_volume_id* hints, double radius,
                          const NearestAnswers<dsw_nearest>& answers, dsw_contact_partner* partners);

}  // namespace dsw
