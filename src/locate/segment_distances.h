#pragma once
// How far something is from a segment, and where on the segment.
//
// The segment passes nothing impassable, and no facet on the way to the cells that it enters, so nothing here looks
// for a segment that pierces a triangle.

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

/** A segment from the origin to `along`. */
struct SegmentLine {
  Vec along;
  double square = dot(along, along), inverse = 1 / square;
  bool has_length = square >= 0x1p-1000;  // what is shorter is a point: its square is not

  SegmentWay way(const SegmentCorner& a) const;
  /** To an edge.
   *
   * The nearest points of the lines are found by the part of the edge that is normal to the segment, `across`, and are
   * then drawn back to the ends. `across` has a rounding error of the size of the edge. Where the lines have a small
   * angle, the place on the edge is uncertain by that error over the angle. In the direction of `across` the gap then
   * misses the shortest one by a rounding error of the edge; in the direction of the gap the miss counts in second
   * order only. Where that is still too much, the angle is so small that any place is as near, up to a rounding error
   * of the lengths. */
  SegmentWay way(const SegmentCorner& a, const SegmentCorner& b) const;
  /** To a triangle that the segment does not pierce.
   *
   * Then the nearest point of the triangle lies on an edge, or is the foot of the end of the segment that is nearer to
   * the plane. If the ends are on one side and this foot lies in the triangle, nothing is nearer. If rounding hides
   * which end is nearer, both feet are tried. If rounding hides the side of an end, the edges are tried, too: a segment
   * whose ends are on two sides comes nearer to the plane until it is over an edge. Where all is farther than `limit`,
   * the way may be infinite. */
  SegmentWay way(const SegmentCorner& a, const SegmentCorner& b, const SegmentCorner& c, double limit) const;
};

/** What Distances measures from: the segment from one point to another. */
template <int D>
struct FromSegment {
  using Corner = SegmentCorner;
  using Way = SegmentWay;
  using Result = SegmentNearest;

  const double* from;
  const double* to;
  double scale;
  SegmentLine line{relative<D>(to, from, scale)};
  Vec first = to_vec<D>(from) * scale, last = to_vec<D>(to) * scale;

  Corner corner(const double* position) const {
    const Vec at = to_vec<D>(position) * scale;
    return {at - first, at - last};
  }
  Way way(const Corner& a) const { return line.way(a); }
  Way way(const Corner& a, const Corner& b) const { return line.way(a, b); }
  Way way(const Corner& a, const Corner& b, const Corner& c, double limit) const { return line.way(a, b, c, limit); }
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
