#pragma once
// The outer boundary as simplices (triangles in space, sides in the plane), with a tree of boxes over it: what the
// boundary check works on.

#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

/** A simplex of a facet with one cell: a triangle, counter-clockwise seen from outside; in the plane a side, the cell
 * on its left. */
template <int D>
struct BoundarySimplex {
  uint32_t vertex[D];
  /** Ridge k joins vertex k to the next; in the plane it is vertex k. Across it lies ridge mate[k] % D of simplex
   * mate[k] / D: the one that is met by turning about the ridge through the cells behind. Several sheets may meet in
   * one ridge; mates belong together. */
  uint32_t mate[D];
  Cell cell;
};

template <int D>
struct BoundarySurface {
  Array<BoundarySimplex<D>> simplices;
  Array<uint32_t> sheet;  // of every simplex: the lowest simplex it is connected with through mates

  explicit BoundarySurface(const Environment<D>& env);

  /** The vertex of simplex mate / D that is not on its ridge mate % D. */
  uint32_t beyond(uint32_t mate) const { return simplices[mate / D].vertex[(mate % D + D - 1) % D]; }
};

/** Boxes of simplices in a balanced binary tree, stored in the order of a heap. */
template <int D>
class BoundaryTree {
 public:
  BoundaryTree(const Environment<D>& env, const BoundarySurface<D>& surface);

  /** Calls visit(simplex) for every simplex whose box meets a closed box. */
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
    double lower[D], upper[D];
    uint32_t first;  // of `count` simplices; of two nodes if count is 0
    uint32_t count;
  };
  static bool meets(const Node& node, const double* lower, const double* upper) {
    for (int k = 0; k < D; ++k) {
      if (node.upper[k] < lower[k] || node.lower[k] > upper[k]) return false;
    }
    return true;
  }

  Array<Node> nodes_;
  Array<uint32_t> order_;
};

}  // namespace dsw
