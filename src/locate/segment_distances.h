#pragma once
// How far something is from a segment, and where on the segment.
//
// The segment passes nothing impassable, and no facet on the way to the cells that it enters, so nothing here looks
// for a segment that pierces a triangle. Then one end of a shortest way is an end of the segment, or a corner or an
// edge of the triangle.

#include "locate/distances.h"

namespace dsw {

/** From a point of a segment to something. */
struct SegmentWay {
  Vec gap;
  double parameter = 0;  // of the segment's point
  double squared = HUGE_VAL;

  SegmentWay() = default;
  SegmentWay(const Vec& way, double at) : gap(way), parameter(at), squared(dot(way, way)) {}
  void take_nearer(const SegmentWay& other) {
    if (other.squared < squared) *this = other;
  }
};

/** A corner as seen from the first and from the last point of a segment. */
struct SegmentCorner {
  Vec first, last;
};

/** From segment 0 .. `along`. */
SegmentWay way_from_segment(const Vec& along, const SegmentCorner& a);
/** From the segment to an edge; `inner`: also where the insides of both are nearest. */
SegmentWay way_from_segment(const Vec& along, const SegmentCorner& a, const SegmentCorner& b, bool inner);
/** From the segment to a triangle that it does not pierce. */
SegmentWay way_from_segment(const Vec& along, const SegmentCorner& a, const SegmentCorner& b, const SegmentCorner& c);

/** What Distances measures from: the segment from one point to another. */
template <int D>
struct FromSegment {
  using Corner = SegmentCorner;
  using Way = SegmentWay;
  using Result = SegmentNearest;

  const double* from;
  const double* to;
  double scale;
  Vec along = relative<D>(to, from, scale);

  Corner corner(const double* position) const {
    return {relative<D>(position, from, scale), relative<D>(position, to, scale)};
  }
  Way way(const Corner& a) const { return way_from_segment(along, a); }
  // In the plane segments that do not cross are nearest at an end.
  Way way(const Corner& a, const Corner& b) const { return way_from_segment(along, a, b, D == 3); }
  Way way(const Corner& a, const Corner& b, const Corner& c) const { return way_from_segment(along, a, b, c); }
  static double squared(const Way& way) { return way.squared; }
  void report(const Way& way, Result& result) const {
    result.parameter = way.parameter;
    if (way.parameter == 1) {
      std::copy_n(to, D, result.segment_point);
    } else {
      point_at<D>(from, to, way.parameter, result.segment_point);
    }
    report_obstacle<D>(way.gap, result.segment_point, scale, result);
  }
};

}  // namespace dsw
