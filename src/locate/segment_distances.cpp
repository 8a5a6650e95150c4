#include "locate/segment_distances.h"

namespace dsw {
namespace {

/** Where the insides of the segment and of edge ab are nearest. Infinitely far if an end of one of them is nearer.
 *
 * `across` is the part of ab that is normal to the segment, with a rounding error of the size of ab. Where the lines
 * have a small angle, its direction is uncertain by that error over the angle. So is the place on the edge, by which the
 * gap misses the shortest one. In the direction of `across` that is a rounding error of ab; in the direction of the
 * gap it counts in second order only. Where that is still too much, the angle is so small that the ends are as near, up
 * to a rounding error of the lengths. */
SegmentWay way_between_insides(const Vec& along, const Vec& a, const Vec& b) {
  const Vec edge = b - a;
  const double square = dot(along, along);
  const Vec across = without(edge, along, square);
  const double width = dot(across, across);
  if (!(width > 0)) return {};
  const Vec beside = a - dot(a, along) / square * along;
  const double on_edge = -dot(beside, across) / width;
  const Vec at = a + on_edge * edge;
  const double on_segment = dot(at, along) / square;
  if (!(on_edge > 0 && on_edge < 1 && on_segment > 0 && on_segment < 1)) return {};
  return {at - on_segment * along, on_segment};
}

}  // namespace

SegmentWay way_from_segment(const Vec& along, const SegmentCorner& a) {
  const double square = dot(along, along), at = dot(a.first, along);
  if (!(at > 0)) return {a.first, 0};
  if (!(at < square)) return {a.last, 1};
  return {a.first - at / square * along, at / square};
}

SegmentWay way_from_segment(const Vec& along, const SegmentCorner& a, const SegmentCorner& b, bool inner) {
  SegmentWay best(nearest_on(a.first, b.first), 0);
  if (is_zero(along)) return best;
  best.take_nearer({nearest_on(a.last, b.last), 1});
  best.take_nearer(way_from_segment(along, a));
  best.take_nearer(way_from_segment(along, b));
  if (inner) best.take_nearer(way_between_insides(along, a.first, b.first));
  return best;
}

SegmentWay way_from_segment(const Vec& along, const SegmentCorner& a, const SegmentCorner& b, const SegmentCorner& c) {
  SegmentWay best(nearest_on(a.first, b.first, c.first), 0);
  if (is_zero(along)) return best;
  best.take_nearer({nearest_on(a.last, b.last, c.last), 1});
  for (const SegmentCorner* corner : {&a, &b, &c}) best.take_nearer(way_from_segment(along, *corner));
  best.take_nearer(way_between_insides(along, a.first, b.first));
  best.take_nearer(way_between_insides(along, b.first, c.first));
  best.take_nearer(way_between_insides(along, c.first, a.first));
  return best;
}

}  // namespace dsw
