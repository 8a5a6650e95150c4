// Bodies made of figures.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_BODIES_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_BODIES_H

#include "dartsweep/dartsweep.h"
#include "figure.h"

namespace dsw::rigid {

/** Throws with the library's message unless the status is DSW_STATUS_OK. */
void check(dsw_status status);

/** Creates a body at DSW_LEVEL_FACES if it has faces, or else DSW_LEVEL_EDGES_SWEPT. Returns whether there was room for it. */
bool add_body(dsw_scene* scene, const Figure& figure, double radius, dsw_body_id& id, std::uint32_t flags = 0);

/** A sphere with 4^k times 8 triangles, nearly. */
Figure make_ball(int k, double radius);
/** The 12 triangles of a cuboid round the origin. */
Figure make_box(const Point& half);
/** Edges in a line along x, round the origin. */
Figure make_rope(std::uint32_t edges, double length);

}  // namespace dsw::rigid

#endif
