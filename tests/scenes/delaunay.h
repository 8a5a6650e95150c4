// A Delaunay mesh of random points in the unit cube, and casts through it.
#ifndef DARTSWEEP_TESTS_SCENES_DELAUNAY_H
#define DARTSWEEP_TESTS_SCENES_DELAUNAY_H

#include "scenes/mesh.h"

namespace dsw::scenes {

/** At least `tets` tetrahedra, hardly more, none of them flat (exact). In a program with CGAL only
 * (target dartsweep_scenes_delaunay). */
VolumeMesh make_delaunay(std::size_t tets, std::uint64_t seed);

}  // namespace dsw::scenes

#endif
