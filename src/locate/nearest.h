#pragma once
// The nearest impassable thing round a point, found by a flood through passable cells, or by a tree of obstacles: what
// haptics ask for.

#include "locate/classify.h"

namespace dsw {

struct NearestResult {
  double distance = 0;
  double point[3] = {};          // of the obstacle; in the plane the third is 0, as below
  double normal[3] = {};         // unit, towards the asked point; zero at distance 0
  FeatureRef feature;            // canonical: facet, marked edge (in space) or marked vertex
  uint32_t volumes_visited = 0;  // how many cells were looked at; the tree looks at other ones than the flood
};

/** Whether something impassable that can be seen from `point`, in `start`, lies within `radius`. Cells are visited in
 * the order of their distance, so the work is that of the cells nearer than the answer. Equal distances: the lower
 * dimension, then the lower canonical cell. May throw std::bad_alloc. */
template <int D>
bool find_nearest(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result);

/** The same answer for points that may be far from everything: after a few cells the environment's tree of obstacles is
 * asked, if there is one (nearest_search.h). */
template <int D>
bool find_nearest_far(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result);

}  // namespace dsw
