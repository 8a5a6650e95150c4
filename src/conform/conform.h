#pragma once
// A mesh whose parts lie on each other, made to hang together: facets of the outer boundary are split where facets of other
// cells cover them, so that cells become polyhedra (in the plane polygons) and both sides have the same facets.

#include "environment/builder.h"

namespace dsw {

/** Replaces cells of a mesh that was read, and whose points are merged (read_mesh). Points within `room` of an edge or of the
 * plane of a facet lie on it; 0: exactly. Throws NOT_CONFORMING, with the first two cells in the report, where facets overlap
 * and points to split them at are missing; as replace_cells. */
template <int D>
void conform(Environment<D>& env, double room, BuildReport& report);

}  // namespace dsw
