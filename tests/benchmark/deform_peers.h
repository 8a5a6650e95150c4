// Peers whose triangles all move every step: Embree and Bullet refit their trees or make them anew.
#ifndef DARTSWEEP_TESTS_BENCHMARK_DEFORM_PEERS_H
#define DARTSWEEP_TESTS_BENCHMARK_DEFORM_PEERS_H

#include "engine.h"

namespace dsw::bench {

/** An engine over walls that move. */
class MovingEngine : public Engine {
 public:
  using Engine::Engine;
  /** Takes over where the walls' points are, in its own format; not timed, the host's work. */
  virtual void write() = 0;
  /** Makes the engine ready for casts; timed. */
  virtual void update() = 0;
};

/** The points that walls have, in the order of the walls, and the walls by these. */
struct WallPoints {
  explicit WallPoints(const WallMesh& walls);
  std::vector<std::uint32_t> vertices;                  // of the mesh
  std::vector<std::array<std::uint32_t, 3>> triangles;  // by place in `vertices`
  std::vector<std::array<std::uint32_t, 4>> quads;      // likewise; cut from their first vertex
};

/** Dynamic scenes that are refitted or rebuilt, and plain ones that are rebuilt, of triangles and of quadrilaterals. */
std::vector<std::unique_ptr<MovingEngine>> make_moving_embrees(const WallMesh& walls);

/** btBvhTriangleMeshShape, refitted or made anew, walked with the segment or asked for its box. */
std::vector<std::unique_ptr<MovingEngine>> make_moving_bullets(const WallMesh& walls);

/** btDbvt whose leaves have a margin: what Bullet does for objects that move. With one as high as a wave none moves. */
std::vector<std::unique_ptr<MovingEngine>> make_moving_bullet_trees(const WallMesh& walls);

/** Uniform grids into which all walls are put again. */
std::vector<std::unique_ptr<MovingEngine>> make_moving_grids(const WallMesh& walls);

}  // namespace dsw::bench

#endif
