#pragma once
// What is cheaply known of the triangle that edge p(t) q sweeps and many points or segments: by filters alone, without
// the shift.
//
// A determinant of three rounded differences is certain if it exceeds 50u times the product of the three vectors'
// largest components. The proof is that of filter_bounds.h: its M bounds each of the six products, and so does this
// product, since each of them takes one component of each vector; what underflows is bounded alike, since each factor
// is in [kFilterMin, kFilterMax]. Unlike M it shrinks with a short vector, and moves are short.
//
// If all points lie in one box, M may be taken of the lengths of the box: rounding keeps the order of differences, so no
// rounded difference exceeds them. This bound is computed once for all determinants, and is tried first.

#include <limits>

#include "predicates/filtered.h"
#include "predicates/sweep_events.h"

namespace dsw {

/** No determinant is certain by it alone. */
constexpr double kNoBound = std::numeric_limits<double>::infinity();

namespace filter {

/** The largest magnitude in one vector of a determinant. */
inline double largest(const Vec<3>& a) noexcept { return highest(extent(a)); }
inline bool in_range(double size) noexcept { return kFilterMin <= size && size <= kFilterMax; }

/** What a certain determinant of differences of points of a box exceeds. */
inline double bound_in_box(const double* lower, const double* upper) noexcept {
  const Vec<3> m = difference<3>(upper, lower);
  return lowest(m) >= kFilterMin && highest(m) <= kFilterMax ? bound(m) : kNoBound;
}

/** Whether the sign of a determinant of three vectors is that of its rounded value. */
inline bool certain(double det, const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) noexcept {
  const double x = largest(a), y = largest(b), z = largest(c);
  return in_range(x) && in_range(y) && in_range(z) && std::fabs(det) > kPlaneFilter3 * x * y * z;
}

}  // namespace filter

/** The plane of the swept triangle. `bound` is that of a box that all points lie in. */
class SweptPlane {
 public:
  explicit SweptPlane(const EdgeMotion& m, double bound = kNoBound) noexcept
      : p_(m.p),
        move_(filter::difference<3>(m.to, m.p)),
        edge_(filter::difference<3>(m.q, m.p)),
        normal_(filter::cross(move_, edge_)),
        bound_(bound) {}

  /** Sign of orient<3>({p, p', q}, v) where it is known not to be 0; else 0. A segment with both ends on one side does
   * not touch the triangle; nor does a point on a side, and then p, p' and q are not in one line. */
  int side(const double* v) const noexcept { return side_of(filter::difference<3>(v, p_)); }
  /** That of the fixed end of another edge at p. */
  int side(const SweptPlane& other) const noexcept { return side_of(other.edge_); }

 private:
  int side_of(const filter::Vec<3>& w) const noexcept {
    const double det = filter::dot(normal_, w);
    const bool known = std::fabs(det) > bound_ || filter::certain(det, move_, edge_, w);
    return known ? filter::sign_of(det) : 0;
  }

  const double* p_;
  filter::Vec<3> move_, edge_, normal_;
  double bound_;
};

/** The edge on its way. `bound` is that of a box that all points lie in. */
class SweptEdge {
 public:
  explicit SweptEdge(const EdgeMotion& m, double bound = kNoBound) noexcept
      : q_(m.q), start_(filter::difference<3>(m.p, m.q)), end_(filter::difference<3>(m.to, m.q)), bound_(bound) {}

  /** Whether it is known to stay on one side of the line through a and b, so that it does not touch segment a b: the
   * determinant of p(t), q, a and b is linear in t and has one sign at both ends, and is 0 where they touch. */
  bool stays_beside(const double* a, const double* b) const noexcept {
    const filter::Vec<3> x = filter::difference<3>(a, q_), y = filter::difference<3>(b, q_), n = filter::cross(x, y);
    const double before = filter::dot(n, start_), after = filter::dot(n, end_);
    if ((before > 0) != (after > 0)) return false;
    if (filter::smaller(std::fabs(before), std::fabs(after)) > bound_) return true;
    return filter::certain(before, x, y, start_) && filter::certain(after, x, y, end_);
  }

 private:
  const double* q_;
  filter::Vec<3> start_, end_;  // from q to p and p'
  double bound_;
};

}  // namespace dsw
