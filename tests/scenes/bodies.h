// The moving bodies of [JCD10] 7.4: small deformable hexahedra of 8 particles and 12 edges. How they move is ours: the
// paper does not say it. Everything is in lattice coordinates, so variants of one lattice see the same motion.
#ifndef DARTSWEEP_TESTS_SCENES_BODIES_H
#define DARTSWEEP_TESTS_SCENES_BODIES_H

#include "scenes/hex_grid.h"
#include "scenes/random.h"

namespace dsw::scenes {

constexpr std::size_t kBodyVertices = 8;
constexpr std::size_t kBodyEdges = 12;
constexpr std::size_t kBodySegments = kBodyVertices + kBodyEdges;

/** Vertex numbers of a body's edges; vertex i has its corner at (i & 1, i >> 1 & 1, i >> 2). */
constexpr std::array<std::array<std::uint8_t, 2>, kBodyEdges> kEdgeVertices = {
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

struct BodyOptions {
  std::size_t bodies = 225;
  double edge = 0.5;                        // cells
  double step_low = 0.05, step_high = 0.1;  // cells a step
  double wobble = 0.03;                     // largest shift of a vertex along each axis, cells
  std::uint32_t press = 30;  // steps a body presses against what stops it before it leaves in another direction
  std::uint64_t seed = 7;
};

/** Bodies drift through the passable cells, wobbling; one that would enter an obstacle or leave the lattice stays where
 * it is, keeps pressing for some steps and then turns to a random direction. Uses no libm but sqrt. */
class BodyMotion {
 public:
  BodyMotion(const HexGrid& grid, const BodyOptions& options);

  std::size_t vertex_count() const { return bodies_.size() * kBodyVertices; }
  /** Where the vertices are now, 3 doubles each: always in passable cells. */
  const std::vector<double>& starts() const { return starts_; }
  /** Where they aim at in this step; some lie in obstacles or outside. */
  const std::vector<double>& targets() const { return targets_; }
  /** Goes to the next step. */
  void advance();

 private:
  struct Body {
    std::array<double, 3> centre, velocity;
    std::array<std::array<double, 3>, kBodyVertices> corners;    // of the turned cube at rest
    std::array<std::array<double, 2>, kBodyVertices * 3> phase;  // a point on the unit circle for each coordinate
    std::array<double, 2> turn;                                  // how far the phases turn in a step
    std::uint32_t pressed = 0;
  };

  bool free(const double* vertices) const;
  void place(const Body& body, const std::array<double, 3>& centre, double* vertices) const;
  void choose_direction(Body& body);
  void aim();

  const HexGrid& grid_;
  BodyOptions options_;
  Random random_;
  std::vector<Body> bodies_;
  std::vector<double> starts_, targets_;
};

/** All casts of one step in space, body by body: 8 trajectories (start to target of a vertex), then 12 casts along edges
 * (start of one vertex to the target of the other, the paper's p'q). `from` and `to` get 3 doubles a cast; `lattice_cells`
 * gets the lattice cell of each start. All are appended. */
void append_step_segments(const HexGrid& grid, const BodyMotion& motion, std::vector<double>& from,
                          std::vector<double>& to, std::vector<std::uint32_t>& lattice_cells);

}  // namespace dsw::scenes

#endif
