#include "locate/segment_distances.h"

namespace dsw {
namespace {

double clamped(double t) { return t > 0 ? (t < 1 ? t : 1) : 0; }

/** `v` without its part along a line; twice, as in distances.h. */
Vec without_line(const Vec& v, const Vec& along, double inverse) {
  const Vec once = v - dot(v, along) * inverse * along;
  return once - dot(once, along) * inverse * along;
}

}  // namespace

SegmentWay SegmentLine::way(const SegmentCorner& a) const {
  const double at = dot(a.first, along);
  if (!(at > 0)) return {a.first, 0};
  if (!(at < square)) return {a.last, 1};
  return {a.first - at / square * along, at / square};
}

SegmentWay SegmentLine::way(const SegmentCorner& a, const SegmentCorner& b) const {
  if (!has_length) return {nearest_on(a.first, b.first), 0};
  const Vec edge = b.first - a.first;
  const Vec across = without_line(edge, along, inverse);
  const double width = dot(across, across), ahead = dot(a.first, along) * inverse;
  double on_edge = 0;
  if (width > 0) on_edge = clamped(-dot(a.first - ahead * along, across) / width);
  double on_segment = ahead + on_edge * (dot(edge, along) * inverse);
  if (!(on_segment > 0 && on_segment < 1)) {
    on_segment = on_segment > 0 ? 1 : 0;
    const Vec& from = on_segment > 0 ? a.last : a.first;
    const double length = dot(edge, edge), at = -dot(from, edge);
    on_edge = at > 0 ? (at < length ? at / length : 1) : 0;
    // The end of the edge itself, not what rounding makes of it.
    if (on_edge == 1) return {on_segment > 0 ? b.last : b.first, on_segment};
    return {from + on_edge * edge, on_segment};
  }
  const Vec at = on_edge == 1 ? b.first : Vec(a.first + on_edge * edge);
  return {at - on_segment * along, on_segment};
}

SegmentWay SegmentLine::way(const SegmentCorner& a, const SegmentCorner& b, const SegmentCorner& c) const {
  if (!has_length) return {nearest_on(a.first, b.first, c.first), 0};
  const Vec normal = (b.first - a.first).cross(c.first - a.first);
  const bool is_last = std::fabs(dot(normal, a.last)) < std::fabs(dot(normal, a.first));
  SegmentWay best;
  if (Vec foot; is_last ? foot_inside(a.last, b.last, c.last, foot) : foot_inside(a.first, b.first, c.first, foot))
    best = {foot, is_last ? 1.0 : 0.0};
  best.take_nearer(way(a, b));
  best.take_nearer(way(b, c));
  best.take_nearer(way(c, a));
  return best;
}

}  // namespace dsw
