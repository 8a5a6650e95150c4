#pragma once
// The normal of a contact by [JCD10] 4.2: that at a vertex of the wall.

#include "dartsweep/contact.h"
#include "environment/environment.h"

namespace dsw {

/** Turns the normal of a contact with a wall to the mean of the unit normals of the walls at a vertex: at that vertex of the
 * touched wall which is nearest to the point. Walls count that are reached from the front round the vertex. The normal
 * stays where there is no wall, or where these normals cancel. Throws std::bad_alloc. */
template <int D>
void turn_to_vertex(const Environment<D>& env, const double* point, dsw_contact& contact);

}  // namespace dsw
