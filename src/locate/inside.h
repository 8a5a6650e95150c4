#pragma once
// Points that lie exactly on an obstacle, which the shift may put outside, and the nearest places that are free.

#include "locate/classify.h"

namespace dsw {

/** An obstacle, and the passable cell that sees it. */
struct SeenObstacle {
  FeatureRef feature;  // canonical
  HalfFacet side;      // of a facet: the side of the passable cell; else invalid
  Cell cell;           // passable; invalid: there is none
};

/** The obstacle at a passable cell on which a point lies exactly, without the shift. If there are several: the lower
 * dimension, then the lowest canonical one. O(log n) expected with the tree of cells, else O(n). */
template <int D>
SeenObstacle find_touched(const Environment<D>& env, const double* point) noexcept;

/** Finds the obstacle on which a point lies exactly, if locate has found the point's cell c; an invalid c: no cell
 * contains it. Mostly O(1) if c is valid. */
template <int D>
SeenObstacle find_touched(const Environment<D>& env, const double* point, Cell c) noexcept;

/** Finds the obstacle on which a point lies exactly, if a rounded distance to the nearest obstacle is known: a point
 * that is far from all obstacles lies on none. */
template <int D>
SeenObstacle find_touched_near(const Environment<D>& env, const double* point, Cell c, double distance) noexcept;

/** The nearest place in passable space, and its cell. A point in passable space that lies on no obstacle stays where it
 * is. Another goes to the nearest wall, and `by` further along its normal; where that way is not free, as far towards
 * the centre of the cell there. So little as rounding allows is the least. An invalid cell, and the point as it is: there is no such place. */
template <int D>
Cell find_inside(const Environment<D>& env, const double* point, Cell hint, double by, double* inside);

}  // namespace dsw
