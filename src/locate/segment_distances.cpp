#include "locate/segment_distances.h"

#include <algorithm>

namespace dsw {
namespace {

double clamped(double t) { return t > 0 ? (t < 1 ? t : 1) : 0; }

/** `v` without its part along a line; twice, as in distances.h. */
Vec without_line(const Vec& v, const Vec& along, double inverse) {
  const Vec once = v - dot(v, along) * inverse * along;
  return once - dot(once, along) * inverse * along;
}

double sum(const Vec& a) { return std::fabs(a.x()) + std::fabs(a.y()) + std::fabs(a.z()); }

/** Heights of both ends of a segment over the plane of a triangle, times the length of the computed normal.
 *
 * With u = 2^-53 and s = sum(ab) sum(ac): the normal's components have errors below 4 u s, so a height has one below
 * 16 u s reach, where `reach` is the sum of a corner's coordinates as seen from both ends. Of a thin triangle that can
 * be more than the height. */
struct Heights {
  double first, last, reach, doubt;
  bool is_sure_of_side() const { return (first > doubt && last > doubt) || (first < -doubt && last < -doubt); }
  bool is_sure_of_nearer() const { return std::fabs(std::fabs(first) - std::fabs(last)) > 2 * doubt; }
  bool is_last_nearer() const { return std::fabs(last) < std::fabs(first); }
  double least() const { return std::min(std::fabs(first), std::fabs(last)) - doubt; }
};

/** Whether a triangle is sure to be farther than a limit, since its plane is, and both ends are on one side of it. The
 * normal's square has an error below 2^-47 s^2. Distances have errors of some u times the coordinates; 2^-46 is
 * allowed. Where squares underflow, nothing is sure. */
bool is_beyond(const Vec& ab, const Vec& ac, const Vec& normal, const Heights& heights, double limit) {
  const double sides = sum(ab) * sum(ac), square = dot(normal, normal) + 0x1p-47 * sides * sides;
  const double least = heights.least(), most = limit + 0x1p-46 * (limit + heights.reach + sum(ab) + sum(ac));
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
  const double reach = sum(a.first) + sum(a.last);
  const Heights heights{dot(normal, a.first), dot(normal, a.last), reach, 0x1p-48 * sum(ab) * sum(ac) * reach};
  const bool is_beside = heights.is_sure_of_side(), is_sure = heights.is_sure_of_nearer();
  if (is_beside && is_beyond(ab, ac, normal, heights, limit)) return {};
  SegmentWay best;
  Vec foot;
  if (!(is_sure && heights.is_last_nearer()) && foot_inside(a.first, b.first, c.first, foot)) best = {foot, 0};
  if (!(is_sure && !heights.is_last_nearer()) && foot_inside(a.last, b.last, c.last, foot)) {
    best.take_nearer({foot, 1});
  }
  if (is_beside && is_sure && best.squared < HUGE_VAL) return best;
  best.take_nearer(way(a, b));
  best.take_nearer(way(b, c));
  best.take_nearer(way(c, a));
  return best;
}

}  // namespace dsw
