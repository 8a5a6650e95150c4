#pragma once
// The outer boundary as simplices (triangles in space, sides in the plane), and a tree of their boxes: what the boundary
// check works on.

#include "environment/box_tree.h"
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

/** A tree of the boxes of all simplices. */
template <int D>
BoxTree<D> tree_of(const Environment<D>& env, const BoundarySurface<D>& surface);

}  // namespace dsw
