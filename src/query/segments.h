#pragma once
// Free queries: points located and segments cast without particles. Arguments have been checked: ids are alive or null,
// coordinates finite.

#include "base/parallel.h"
#include "base/points.h"
#include "query/report.h"

namespace dsw {

struct SegmentOptions {
  uint32_t max_volumes = 0;
  bool detail = true;
  bool start_known = false;  // starts contain their points; else they are hints
  bool open_ends = false;    // touches at the ends do not count, and walls are closed
  bool leave = false;        // particles that come to an exit are removed
};

/** Casts segments; `starts` may be null. Throws std::bad_alloc, with open ends alone; then some flights are written. */
template <int D>
void cast_segments(const Environment<D>& env, const Parallel& parallel, size_t count, const dsw_volume_id* starts,
                   PointArray from, PointArray to, const SegmentOptions& options, dsw_flight* flights);

/** One segment and the volumes it enters, in order. `*count` is how many there are; they are written only if
 * `capacity` is enough. */
template <int D>
void cast_path(const Environment<D>& env, dsw_volume_id start, const double* from, const double* to,
               const SegmentOptions& options, dsw_crossing* crossings, size_t capacity, size_t* count,
               dsw_flight* flight) noexcept;

/** The cell that contains a point; invalid when there is none. */
template <int D>
Cell locate_point(const Environment<D>& env, const double* point, dsw_volume_id hint) noexcept;

/** Volumes of points, null ids where there is none; `hints` may be null. */
template <int D>
void locate_points(const Environment<D>& env, const Parallel& parallel, PointArray points, size_t count,
                   const dsw_volume_id* hints, dsw_volume_id* volumes);

}  // namespace dsw
