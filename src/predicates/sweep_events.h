// When an edge that turns about its fixed end meets the environment. Its moving end goes from p to p', the other end is q; all
// three are body points and shifted together, see exact.h. Every time is a ratio N/D of two polynomials in the shift s:
//   a vertex event, p(t) in the plane of triangle abc:   N = n.(a-p-s)                D = n.(p'-p)
//   an edge event, p(t) q meets the line ab:             N = L(p)                     D = L(p) - L(p')
// with L(x) = orient3(x+s, q+s, a, b) = (q-x).((a-x) x (b-x)) + s.((q-x) x (b-a)).
#pragma once

#include "predicates/exact.h"

namespace dsw {

struct EdgeMotion {
  const double *p, *to, *q;
};

// What is met: a triangle by the moving end, or a line by the edge (points[0] and points[1]).
struct SweepEvent {
  const double* points[3] = {};
  bool of_edge = false;
};

// Side of environment point v: sign of n.(v-p-s) with n = (p'-p) x (q-p). 0 only if p, p', q are collinear.
ShiftedSign swept_side(const EdgeMotion& m, const double* v) noexcept;

// Sign of t_a - t_b for two events that take place: each N/D lies in [0,1] and no D is the zero polynomial. tie: the
// times are equal but for the shift, or the shift alone decides one of them. 0: they are the same in all orders.
ShiftedSign compare_events(const EdgeMotion& m, const SweepEvent& a, const SweepEvent& b) noexcept;

// Largest double <= the standard part of the time of an event that takes place.
double event_time(const EdgeMotion& m, const SweepEvent& event) noexcept;

}  // namespace dsw
