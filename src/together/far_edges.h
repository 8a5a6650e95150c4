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
  void box_ways(const Trajectory<D>& of, const Array<uint32_t>& edges);
  void group_ways();

  const Environment<D>& env_;
  Array<Box<D>> boxes_{env_.memory};     // of the ways of the edges in the list
  KeyTable keys_{env_.memory};           // of groups of edges that lie side by side
  Array<uint32_t> groups_{env_.memory};  // of the edges
  Array<Box<D>> group_boxes_{env_.memory};
  Array<uint8_t> is_far_{env_.memory};  // by group
};

}  // namespace dsw
