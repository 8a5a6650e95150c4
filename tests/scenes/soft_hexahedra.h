// The bodies of [JCD10] 7.4: deformable hexahedra of 8 particles, simulated by shape matching, each of which starts
// with a random impulse. Where their particles get to is decided by the caller, who answers every step with positions
// and contacts.
#ifndef DARTSWEEP_TESTS_SCENES_SOFT_HEXAHEDRA_H
#define DARTSWEEP_TESTS_SCENES_SOFT_HEXAHEDRA_H

#include "scenes/bodies.h"
#include "scenes/shape_matching.h"

namespace dsw::scenes {

/** The smallest box with axis-parallel edges round a body. */
struct Box {
  explicit Box(const double* vertices);
  bool overlaps(const Box& other) const;
  std::array<double, 3> low{}, high{};
};

struct SoftHexahedraOptions {
  std::size_t bodies = 225;
  double edge = 0.5;                        // cells
  double step_low = 0.05, step_high = 0.1;  // speed that the impulse gives a body, cells a step
  double stiffness = 0.2;  // share of the way to its goal by which a particle's velocity changes in a step
  std::uint64_t seed = 7;
};

/** The quadrilaterals of a body, counter-clockwise seen from outside; vertices as in kEdgeVertices. */
constexpr std::array<std::array<std::uint32_t, 4>, 6> kBodyFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

class SoftHexahedra {
 public:
  /** Bodies start at random places of the lattice, turned at random. Every cell that a body's box meets is passable,
   * and no two boxes overlap. */
  SoftHexahedra(const HexGrid& grid, const SoftHexahedraOptions& options);

  std::size_t body_count() const { return rotations_.size(); }
  /** Where the particles are, 3 doubles each, body by body. */
  const std::vector<double>& positions() const { return positions_; }
  /** One time step of shape matching. @return where the particles want to be. */
  const std::vector<double>& aim();
  /** Where the particles got to. */
  void reach(const std::vector<double>& positions) { positions_ = positions; }
  /** A contact: the touching point, (1 - along) of particle p and along of q, is reflected if it moves against the
   * normal. Its two particles share the impulse; nothing is lost. If only p touches, q is p and `along` 0. */
  void bounce(std::size_t p, std::size_t q, double along, const double* normal);

  /** Root of the mean square distance of particles to their goals, in edges of the rest shape. */
  double deformation() const;
  /** Mean speed of the particles, cells a step. */
  double speed() const;

 private:
  SoftHexahedraOptions options_;
  RestShape shape_;
  std::vector<Matrix> rotations_;
  std::vector<double> positions_, velocities_, targets_;
};

}  // namespace dsw::scenes

#endif
