#pragma once
// What is cheaply known of the triangle that edge p(t) q sweeps and many points or segments: by filters alone, without
// the shift.
//
// A determinant of three rounded differences is certain if it exceeds 50u times the product of the three vectors'
// largest components. The proof is that of filter_bounds.h: its M bounds each of the six products, and so does this
// product, since each of them takes one component of each vector; what underflows is bounded alike, since each factor
// is in [kFilterMin, kFilterMax]. Unlike M it shrinks with a short vector, and moves are short.

#include <limits>

#include "predicates/filtered.h"
#include "predicates/sweep_events.h"

namespace dsw {

namespace filter {

/** Of one vector of a determinant. */
inline double largest(const Vec<3>& a) noexcept { return highest(extent(a)); }
inline bool in_range(double size) noexcept { return kFilterMin <= size && size <= kFilterMax; }

}  // namespace filter

/** The same plane, as far as one or two signs of it are asked for. */
class SwingPlane {
 public:
  SwingPlane(const double* p, const double* to, const double* q) noexcept
      : edge_(filter::difference<3>(q, p)), size_(filter::largest(edge_)) {
    const filter::Vec<3> move = filter::difference<3>(to, p);
    const double moved = filter::largest(move);
    normal_ = filter::cross(move, edge_);
    bound_ = kPlaneFilter3 * moved * size_;
    known_ = filter::in_range(moved) && filter::in_range(size_);
  }

  /** Whether v, or the fixed end of another edge at p, is known not to lie in the plane. */
  bool is_off(const double* p, const double* v) const noexcept { return is_off(filter::difference<3>(v, p)); }
  bool is_off(const SwingPlane& other) const noexcept { return is_off(other.edge_); }

 private:
  bool is_off(const filter::Vec<3>& w) const noexcept {
    const double size = filter::largest(w);
    return known_ && filter::in_range(size) && std::fabs(filter::dot(normal_, w)) > bound_ * size;
  }

  filter::Vec<3> edge_, normal_;
  double size_, bound_;
  bool known_;
};

/** The plane of the swept triangle. */
class SweptPlane {
 public:
  explicit SweptPlane(const EdgeMotion& m) noexcept : p_(m.p) {
    const filter::Vec<3> move = filter::difference<3>(m.to, m.p), edge = filter::difference<3>(m.q, m.p);
    const double moved = filter::largest(move), size = filter::largest(edge);
    normal_ = filter::cross(move, edge);
    bound_ = filter::in_range(moved) && filter::in_range(size) ? kPlaneFilter3 * moved * size : kNoBound;
  }

  /** Sign of orient<3>({p, p', q}, v) where it is known not to be 0; else 0. A segment with both ends on one side does
   * not touch the triangle; nor does a point on a side, and then p, p' and q are not in one line. */
  int side(const double* v) const noexcept {
    const filter::Vec<3> w = filter::difference<3>(v, p_);
    const double det = filter::dot(normal_, w), size = filter::largest(w);
    return filter::in_range(size) && std::fabs(det) > bound_ * size ? filter::sign_of(det) : 0;
  }

 private:
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  const double* p_;
  filter::Vec<3> normal_;
  double bound_;  // what a certain determinant exceeds, without its last factor
};

/** The edge on its way. */
class SweptEdge {
 public:
  explicit SweptEdge(const EdgeMotion& m) noexcept
      : q_(m.q), start_(filter::difference<3>(m.p, m.q)), end_(filter::difference<3>(m.to, m.q)) {
    const double before = filter::largest(start_), after = filter::largest(end_);
    known_ = filter::in_range(before) && filter::in_range(after);
    size_before_ = kPlaneFilter3 * before;
    size_after_ = kPlaneFilter3 * after;
  }

  /** Whether it is known to stay on one side of the line through a and b, so that it does not touch segment a b: the
   * determinant of p(t), q, a and b is linear in t and has one sign at both ends, and is 0 where they touch. */
  bool stays_beside(const double* a, const double* b) const noexcept {
    const filter::Vec<3> x = filter::difference<3>(a, q_), y = filter::difference<3>(b, q_), n = filter::cross(x, y);
    const double size_x = filter::largest(x), size_y = filter::largest(y), size = size_x * size_y;
    const double before = filter::dot(n, start_), after = filter::dot(n, end_);
    return known_ && filter::in_range(size_x) && filter::in_range(size_y) && (before > 0) == (after > 0) &&
           std::fabs(before) > size_before_ * size && std::fabs(after) > size_after_ * size;
  }

 private:
  const double* q_;
  filter::Vec<3> start_, end_;  // from q to p and p'
  double size_before_, size_after_;
  bool known_;
};

}  // namespace dsw
