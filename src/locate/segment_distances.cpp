#include "locate/segment_distances.h"

namespace dsw {
namespace {

double clamped(double t) { return t > 0 ? (t < 1 ? t : 1) : 0; }

/** `v` without its part along a line; twice, as in distances.h. */
Vec without_line(const Vec& v, const Vec& along, double inverse) {
  const Vec once = v - dot(v, along) * inverse * along;
  return once - dot(once, along) * inverse * along;
}

double sum(const Vec& a) { return std::fabs(a.x()) + std::fabs(a.y()) + std::fabs(a.z()); }

/** Whether a triangle is sure to be farther than a limit, since its plane is. `height` is the product of the normal and
 * of a corner as seen from the segment; `reach` is the sum of that corner's coordinates.
 *
 * With u = 2^-53 and s = sum(ab) sum(ac): the normal's components have errors below 4 u s, so `height` has one below
 * 16 u s reach, and the normal's square one below 2^-47 s^2. Distances have errors of some u times the coordinates;
 * 2^-46 is allowed. Where squares underflow, nothing is sure. */
bool is_beyond(const Vec& ab, const Vec& ac, const Vec& normal, double height, double reach, double limit) {
  const double sides = sum(ab) * sum(ac), square = dot(normal, normal) + 0x1p-47 * sides * sides;
  const double least = std::fabs(height) - 0x1p-48 * sides * reach;
  const double most = limit + 0x1p-46 * (limit + reach + sum(ab) + sum(ac));
  return least > 0 && square > 0x1p-900 && least * least > most * most * square;
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

SegmentWay SegmentLine::way(const SegmentCorner& a, const SegmentCorner& b, const SegmentCorner& c,
                            double limit) const {
  if (!has_length) return {nearest_on(a.first, b.first, c.first), 0};
  const Vec ab = b.first - a.first, ac = c.first - a.first, normal = ab.cross(ac);
  const double first = dot(normal, a.first), last = dot(normal, a.last);
  const bool is_beside = (first > 0) == (last > 0), is_last = std::fabs(last) < std::fabs(first);
  if (is_beside && is_beyond(ab, ac, normal, is_last ? last : first, sum(a.first) + sum(a.last), limit)) return {};
  SegmentWay best;
  if (Vec foot; is_last ? foot_inside(a.last, b.last, c.last, foot) : foot_inside(a.first, b.first, c.first, foot)) {
    best = {foot, is_last ? 1.0 : 0.0};
    if (is_beside) return best;
  }
  best.take_nearer(way(a, b));
  best.take_nearer(way(b, c));
  best.take_nearer(way(c, a));
  return best;
}

}  // namespace dsw
