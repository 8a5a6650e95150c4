// The moving bodies of [JCD10] 7.4: small deformable hexahedra of 8 particles and 12 edges. How they move is ours: the
// paper does not say it. Everything is in lattice coordinates, so variants of one lattice see the same motion.
#ifndef DARTSWEEP_TESTS_SCENES_BODIES_H
#define DARTSWEEP_TESTS_SCENES_BODIES_H

#include "scenes/drift.h"

namespace dsw::scenes {

constexpr std::size_t kBodyVertices = 8;
constexpr std::size_t kBodyEdges = 12;
constexpr std::size_t kBodySegments = kBodyVertices + kBodyEdges;

/** Vertex numbers of a body's edges; vertex i has its corner at (i & 1, i >> 1 & 1, i >> 2). */
constexpr std::array<std::array<std::uint8_t, 2>, kBodyEdges> kEdgeVertices = {
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

struct BodyOptions : DriftOptions {
  double edge = 0.5;  // cells
};

/** Bodies drift through the passable cells, wobbling; one that would enter an obstacle or leave the lattice stays where
 * it is, keeps pressing for some steps and then turns to a random direction. Some targets lie in obstacles or
 * outside. */
class BodyMotion : public Drift<kBodyVertices> {
 public:
  BodyMotion(const HexGrid& grid, const BodyOptions& options);

  /** Goes to the next step. */
  void advance();

 private:
  bool free(const double* vertices) const;
};

/** All casts of one step in space, body by body: 8 trajectories (start to target of a vertex), then 12 casts along
 * edges (start of one vertex to the target of the other, the paper's p'q). `from` and `to` get 3 doubles a cast;
 * `lattice_cells` gets the lattice cell of each start. All are appended. */
void append_step_segments(const HexGrid& grid, const BodyMotion& motion, std::vector<double>& from,
                          std::vector<double>& to, std::vector<std::uint32_t>& lattice_cells);

}  // namespace dsw::scenes

#endif
