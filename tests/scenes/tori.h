// Closed surfaces in which every vertex has six neighbours, so that one moving vertex means seven casts (its own move and
// its edges), as in figure 11 of [JCD10]: small tori of 18 vertices drifting through a lattice. Where they get to depends on what
// they meet, which the caller says.
#ifndef DARTSWEEP_TESTS_SCENES_TORI_H
#define DARTSWEEP_TESTS_SCENES_TORI_H

#include "scenes/hex_grid.h"
#include "scenes/random.h"

namespace dsw::scenes {

constexpr std::size_t kTorusVertices = 18, kTorusEdges = 54, kTorusFaces = 36;

/** Edges of a torus, two vertices each, and its triangles, turning alike. */
std::array<std::array<std::uint32_t, 2>, kTorusEdges> torus_edges();
std::array<std::array<std::uint32_t, 3>, kTorusFaces> torus_faces();

struct TorusOptions {
  std::size_t bodies = 100;
  double ring = 0.5, tube = 0.25;           // radii, cells: edges are about half a cell long
  double step_low = 0.05, step_high = 0.1;  // cells a step
  double wobble = 0.03;                     // largest shift of a vertex along each axis, cells
  std::uint32_t press = 30;                 // steps a body presses against what stops it before it turns
  std::uint64_t seed = 7;
};

/** Tori that keep their direction as long as they arrive; one that does not stays, presses for some steps, and leaves in a
 * random direction. Uses no libm but sqrt. */
class TorusMotion {
 public:
  TorusMotion(const HexGrid& grid, const TorusOptions& options);

  std::size_t body_count() const { return bodies_.size(); }
  std::size_t vertex_count() const { return bodies_.size() * kTorusVertices; }
  /** Where the bodies begin: free, with room around. */
  const std::vector<double>& starts() const { return starts_; }
  /** Where they aim at in this step. */
  const std::vector<double>& targets() const { return targets_; }
  /** Goes to the next step. @param arrived one a body: whether all of its vertices are at their targets. */
  void advance(const std::vector<std::uint8_t>& arrived);

 private:
  struct Body {
    std::array<double, 3> centre, velocity;
    std::array<std::array<double, 3>, kTorusVertices> corners;
    std::array<std::array<double, 2>, kTorusVertices * 3> phase;
    std::array<double, 2> turn;
    std::uint32_t pressed = 0;
  };

  void choose_direction(Body& body);
  void place(const Body& body, const std::array<double, 3>& centre, double* vertices) const;
  bool has_room(const double* vertices) const;
  void aim();

  const HexGrid& grid_;
  TorusOptions options_;
  Random random_;
  std::vector<Body> bodies_;
  std::vector<double> starts_, targets_;
};

}  // namespace dsw::scenes

#endif
