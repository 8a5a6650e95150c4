#pragma once
// The outer boundary as a surface of triangles, with a tree of boxes over it: what the boundary check works on.

#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

/** A triangle of a facet with one cell, counter-clockwise seen from outside. */
struct BoundaryTriangle {
  uint32_t vertex[3];
  /** Edge k joins vertex k to the next. Across it lies edge mate[k] % 3 of triangle mate[k] / 3: the one that is met by
   * turning about the edge through the cells behind. Several sheets may meet in one edge; mates belong together. */
  uint32_t mate[3];
  Cell cell;
};

struct BoundarySurface {
  Array<BoundaryTriangle> triangles;
  Array<uint32_t> sheet;  // of every triangle: the lowest triangle it is connected with through mates

  explicit BoundarySurface(const Environment<3>& env);

  /** The vertex of triangle mate / 3 that is not on its edge mate % 3. */
  uint32_t beyond(uint32_t mate) const { return triangles[mate / 3].vertex[(mate % 3 + 2) % 3]; }
};

/** Boxes of triangles in a balanced binary tree, stored in the order of a heap. */
class BoundaryTree {
 public:
  BoundaryTree(const Environment<3>& env, const BoundarySurface& surface);

  /** Calls visit(triangle) for every triangle whose box meets a closed box. */
  template <class Visit>
  void for_each(const double* lower, const double* upper, Visit visit) const {
    uint32_t stack[64];
    uint32_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth != 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!meets(node, lower, upper)) continue;
      if (node.count != 0) {
        for (uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
      } else {
        stack[depth++] = node.first;
        stack[depth++] = node.first + 1;
      }
    }
  }

 private:
  struct Node {
    double lower[3], upper[3];
    uint32_t first;  // of `count` triangles; of two nodes if count is 0
    uint32_t count;
  };
  static bool meets(const Node& node, const double* lower, const double* upper) {
    for (int k = 0; k < 3; ++k) {
      if (node.upper[k] < lower[k] || node.lower[k] > upper[k]) return false;
    }
    return true;
  }

  Array<Node> nodes_;
  Array<uint32_t> order_;
};

}  // namespace dsw
