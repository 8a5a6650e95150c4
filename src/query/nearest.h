#pragma once
// The nearest obstacles of points and of segments, as a host reads them. Arguments have been checked.

#include "base/parallel.h"
#include "base/points.h"
#include "dartsweep/query.h"
#include "environment/environment.h"

namespace dsw {

/** The nearest obstacle within `radius` of a point in cell c, which locate has given. A point in no passable cell has to
 * lie on an obstacle, at distance 0; else OUTSIDE or IMPASSABLE is thrown. Throws std::bad_alloc. */
template <int D>
dsw_nearest nearest_to_point(const Environment<D>& env, const double* point, Cell c, double radius);

/** For each point the nearest place inside (locate/inside.h), and its cell. `volumes` may be null, or the hints. */
template <int D>
void find_inside(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray points,
                 const dsw_volume_id* hints, double by, double* inside, dsw_volume_id* volumes);

/** For each point its distance from the outer boundary, negative inside; `nearest` may be null. */
template <int D>
void signed_distances(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray points,
                      double* distances, dsw_nearest* nearest);

/** Where the answers of a batch go. */
template <class Nearest>
struct NearestAnswers {
  Nearest* nearest;
  dsw_volume_id* volumes;   // may be null, or the hints
  dsw_location* locations;  // may be null
};

/** Throws std::bad_alloc; then some answers are written. */
template <int D>
void nearest_to_points(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray points,
                       const dsw_volume_id* hints, double radius, const NearestAnswers<dsw_nearest>& answers);
template <int D>
void nearest_to_segments(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray from,
                         PointArray to, const dsw_volume_id* hints, double radius,
                         const NearestAnswers<dsw_segment_nearest>& answers);

}  // namespace dsw
