#pragma once
// Distances that thick bodies of a scene keep while they stand still.

#include "body/near.h"
#include "scene/bodies.h"

namespace dsw {

/** Throws OCCUPIED, and fills scene.offending, unless all parts of a body keep their distances. */
template <int D>
void check_distances(Scene<D>& scene, const Body<D>& body);
/** Whether the parts of a thick body near some places keep their distances from walls. Throws std::bad_alloc. */
template <int D>
bool keeps_distances(const Scene<D>& scene, const Body<D>& body, const Places<D>& places);
/** Takes back the marks of cells that are too near to a thick body. All have just been set. Returns how many there
 * were. Throws std::bad_alloc. */
template <int D>
size_t leave_out_near(Environment<D>& env, const Body<D>& body);

template <int D>
void set_radius(Scene<D>& scene, BodyRecord<D>& of, double radius);
/** A certified lower bound of the least gap, if that is at most `limit`; else the limit. */
template <int D>
double find_least_gap(const Scene<D>& scene, const Body<D>& body, double limit);

}  // namespace dsw
