#pragma once
// Edges that have no obstacle of the environment near their ways, many at a time.

#include "base/key_table.h"
#include "together/trajectory.h"

namespace dsw {

/** Asks the tree of obstacles, in an environment whose points have not moved. What touches a part first is an obstacle at a
 * passable cell. So if no such obstacle has a box that overlaps the box of the part's way, the part touches nothing, even without
 * the shift. */
template <int D>
class FarEdges {
 public:
  explicit FarEdges(const Environment<D>& env) : env_(env) {}

  /** Leaves edges out of a list that have no obstacle in the boxes of their ways. Returns how many these are. As long as there is no
   * tree, none is: what edges cost without it counts towards making it, as floods do. Throws std::bad_alloc. */
  uint32_t leave_out(const Trajectory<D>& of, Array<uint32_t>& edges);

 private:
  const CellTree<D>* find_tree(size_t edges) const;
  struct Vertex {
    Box<D> way;
    uint32_t group = kNone;  // kNone: not looked at yet
  };
  static double size_of_cubes(const Trajectory<D>& of, const Array<uint32_t>& edges);
  const Vertex& find_vertex(const Trajectory<D>& of, uint32_t v, const double* origin, double cubes);
  void group_edges(const Trajectory<D>& of, const Array<uint32_t>& edges);

  const Environment<D>& env_;
  Array<Vertex> vertices_{env_.memory};  // of the body
  KeyTable keys_{env_.memory};           // of groups of edges that lie side by side
  Array<Box<D>> group_boxes_{env_.memory};
  Array<uint8_t> is_far_{env_.memory};  // by group
};

}  // namespace dsw
