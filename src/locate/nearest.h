#pragma once
// The nearest impassable thing round a point, found by a flood through passable cells: what haptics ask for.

#include "locate/classify.h"

namespace dsw {

struct NearestResult {
  double distance = 0;
  double point[3] = {};   // of the obstacle; in the plane the third is 0, as below
  double normal[3] = {};  // unit, towards the asked point; zero at distance 0
  FeatureRef feature;     // canonical: facet, marked edge (in space) or marked vertex
  uint32_t volumes_visited = 0;
};

/** Whether something impassable that can be seen from `point`, in `start`, lies within `radius`. Cells are visited in
 * the order of their distance, so the work is that of the cells nearer than the answer. Equal distances: the lower
 * dimension, then the lower canonical cell. May throw std::bad_alloc. */
template <int D>
bool find_nearest(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result);

}  // namespace dsw
