// GIMPACT, Bullet's way to meet triangles with triangles, as [JCD10] 7.4 uses it.
#ifndef DARTSWEEP_TESTS_BENCHMARK_GIMPACT_H
#define DARTSWEEP_TESTS_BENCHMARK_GIMPACT_H

#include "embree_change.h"

namespace dsw::bench {

/** For every particle and each of its edges one triangle against the walls: the particle's old position, its new
 * position, the other end. Casts must come particle by particle, the own move first, then its edges. An answer tells
 * whether the triangle of an edge meets a wall; there is no time in it. */
class Gimpact : public ChangingEngine {
 public:
  using ChangingEngine::ChangingEngine;
  /** Triangles of the last run that met a wall. */
  virtual std::size_t hits() const = 0;
};

/** Every triangle asks the walls' tree for its own box. @param casts of a particle. */
std::unique_ptr<Gimpact> make_gimpact_triangles(const WallMesh& walls, std::size_t slots, std::size_t casts);

/** The triangles of a body are a mesh of its own, whose tree is refitted and met with that of the walls.
 * @param particles of a body. */
std::unique_ptr<Gimpact> make_gimpact_meshes(const WallMesh& walls, std::size_t slots, std::size_t casts,
                                             std::size_t particles);

}  // namespace dsw::bench

#endif
