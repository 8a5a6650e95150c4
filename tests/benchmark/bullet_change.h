// Bullet's ways to keep triangles that change, and GIMPACT, its way to meet triangles with triangles.
#ifndef DARTSWEEP_TESTS_BENCHMARK_BULLET_CHANGE_H
#define DARTSWEEP_TESTS_BENCHMARK_BULLET_CHANGE_H

#include "embree_change.h"

namespace dsw::bench {

/** A btDbvt whose leaves come and go, walked with the segment or asked for its box. */
std::unique_ptr<ChangingEngine> make_bullet_tree(const WallMesh& walls, std::size_t slots, bool box);

/** btBvhTriangleMeshShape, made anew with every change (a triangle that is gone shrinks to a point). */
std::unique_ptr<ChangingEngine> make_bullet_rebuilt(const WallMesh& walls, std::size_t slots);

/** btGImpactMeshShape against btGImpactMeshShape: bodies, whose vertices move, against walls. It answers which triangles of a body
 * cut walls where the body is, which is less than what happens on the way there. */
class Gimpact {
 public:
  /** @param faces three vertices each, of one body; all bodies are alike. */
  Gimpact(const WallMesh& walls, std::size_t slots, std::size_t bodies, std::size_t body_vertices,
          const std::vector<std::array<std::uint32_t, 3>>& faces, const std::vector<double>& positions);
  ~Gimpact();
  Gimpact(const Gimpact&) = delete;
  Gimpact& operator=(const Gimpact&) = delete;

  /** Walls in place and the boxes over them refitted. */
  void apply(const WallChange& change);
  /** Moves all vertices there and tests every body; `positions` are floats, 3 a vertex. @return contacts. */
  std::size_t step(const float* positions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsw::bench

#endif
