// Meshes in the plane: Delaunay triangles, quads that need not be convex, and polygons joined from triangles.
#pragma once

#include "plane_truth.h"
#include "rng.h"

namespace dsw::oracle::plane {

/// Points are integers, scaled by a power of two and moved.
World make_world(Rng& rng);

}  // namespace dsw::oracle::plane
