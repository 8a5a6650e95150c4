#pragma once
// The plane of the triangle that edge p(t) q sweeps, asked about many points: a filter alone, without the shift.

#include "predicates/filtered.h"
#include "predicates/sweep_events.h"

namespace dsw {

class SweptPlane {
 public:
  explicit SweptPlane(const EdgeMotion& m) noexcept
      : p_(m.p),
        move_(filter::difference<3>(m.to, m.p)),
        edge_(filter::difference<3>(m.q, m.p)),
        normal_(filter::cross(move_, edge_)) {}

  /** Sign of orient<3>({p, p', q}, v) where the filter knows that it is not 0; else 0. A segment with both ends on one
   * side does not touch the triangle; nor does a point on a side, and p, p' and q are not in one line then. */
  int side(const double* v) const noexcept {
    const filter::Vec<3> w = filter::difference<3>(v, p_);
    const double det = filter::dot(normal_, w);
    return filter::certain(det, filter::extent(w, move_, edge_)) ? filter::sign_of(det) : 0;
  }

 private:
  const double* p_;
  filter::Vec<3> move_, edge_, normal_;
};

}  // namespace dsw
