// Closed surfaces in which every vertex has six neighbours, so that one moving vertex means seven casts (its own move and
// its edges), as in figure 11 of [JCD10]: small tori of 18 vertices drifting through a lattice. Where they get to depends on what
// they meet, which the caller says.
#ifndef DARTSWEEP_TESTS_SCENES_TORI_H
#define DARTSWEEP_TESTS_SCENES_TORI_H

#include "scenes/drift.h"

namespace dsw::scenes {

constexpr std::size_t kTorusVertices = 18, kTorusEdges = 54, kTorusFaces = 36;

/** Edges of a torus, two vertices each, and its triangles, turning alike. */
std::array<std::array<std::uint32_t, 2>, kTorusEdges> torus_edges();
std::array<std::array<std::uint32_t, 3>, kTorusFaces> torus_faces();

struct TorusOptions : DriftOptions {
  TorusOptions() { bodies = 100; }
  double ring = 0.5, tube = 0.25;  // radii, cells: edges are about half a cell long
};

/** Tori that keep their direction as long as they arrive; one that does not stays, presses for some steps, and leaves in a
 * random direction. The starts are those of the first step: free, with room around. */
class TorusMotion : public Drift<kTorusVertices> {
 public:
  TorusMotion(const HexGrid& grid, const TorusOptions& options);

  /** Goes to the next step. @param arrived one a body: whether all of its vertices are at their targets. */
  void advance(const std::vector<std::uint8_t>& arrived);

 private:
  bool has_room(const double* vertices) const;
};

}  // namespace dsw::scenes

#endif
