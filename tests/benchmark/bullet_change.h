// Bullet's ways to keep triangles that change.
#ifndef DARTSWEEP_TESTS_BENCHMARK_BULLET_CHANGE_H
#define DARTSWEEP_TESTS_BENCHMARK_BULLET_CHANGE_H

#include "embree_change.h"

namespace dsw::bench {

/** A btDbvt whose leaves come and go, walked with the segment or asked for its box. */
std::unique_ptr<ChangingEngine> make_bullet_tree(const WallMesh& walls, std::size_t slots, bool box);

/** btBvhTriangleMeshShape, made anew with every change (a triangle that is gone shrinks to a point). */
std::unique_ptr<ChangingEngine> make_bullet_rebuilt(const WallMesh& walls, std::size_t slots);

}  // namespace dsw::bench

#endif
