// Bullet 3 as a peer: its triangle mesh shape and its dynamic tree, in every way that answers a segment.
#ifndef DARTSWEEP_TESTS_BENCHMARK_BULLET_H
#define DARTSWEEP_TESTS_BENCHMARK_BULLET_H

#include "engine.h"

namespace dsw::bench {

enum class BulletKind {
  kQuantizedRay,  // btBvhTriangleMeshShape::performRaycast, 16-bit boxes
  kPlainRay,      // the same with float boxes
  kQuantizedBox,  // btBvhTriangleMeshShape::processAllTriangles with the segment's box
  kTreeRay,       // btDbvt::rayTestInternal
  kTreeBox        // btDbvt::collideTV with the segment's box
};

std::unique_ptr<Engine> make_bullet(BulletKind kind, const WallMesh& walls);

/** Makes the kinds that ask a tree for the segment's box, or else those that walk a tree with the segment. */
std::vector<std::unique_ptr<Engine>> make_bullets(const WallMesh& walls, bool box);

}  // namespace dsw::bench

#endif
