// Exact signs of body points against the environment, for any finite doubles: the cold half of the predicates.
//
// Environment points are fixed; every body point x stands for x + s, s = (e, e^2, e^3) in space and (e, e^2) in the
// plane, e an infinitesimal > 0. A value that is exactly zero takes the sign of its first non-zero coefficient in e.
// This folder is the only home of that rule.
//
// A simplex is D points: a triangle (counter-clockwise seen from outside) in space; in the plane an edge of a
// counter-clockwise polygon, so that the outside lies on its right. With a = simplex[0] its outward normal is
//   space: n = (b-a) x (c-a)        plane: n = (y, -x) of b-a
// and everything below is written with n.(x-a), positive outside.
#pragma once

#include "base/fp_rules.h"

namespace dsw {

// sign: of the shifted value, 0 only where the shift leaves it open (see each function).
// tie: the value without the shift is exactly 0.
struct ShiftedSign {
  int sign;
  bool tie;
};

namespace exact {

// Side of body point q: +1 outside, -1 inside; 0 only if the simplex is degenerate.
template <int D>
ShiftedSign plane_side(const double* const* simplex, const double* q) noexcept;

// How body segment p->q passes the ridge (D-1 environment points).
// Space: sign of orient3(p, q, a, b), with coefficients of (q-p) x (b-a); p->q pierces abc outwards when p is inside,
// q outside and the signs for ab, bc, ca are all +1. 0 only if p->q and a->b are parallel (or one is a point).
// Plane: +1 if a lies on the left of p->q; p->q crosses ab outwards when p is inside, q outside, a on its right (-1)
// and b on its left (+1). 0 only if p = q.
template <int D>
ShiftedSign line_side(const double* p, const double* q, const double* const* ridge) noexcept;

// Sign of t_a - t_b, the times in which body point p on its way to q meets the planes of simplices a and b. Both
// denominators n.(q-p) must be non-zero, of either sign. tie: the times are equal but for the shift; sign 0: the two
// simplices lie in one plane.
template <int D>
ShiftedSign compare_times(const double* p, const double* q, const double* const* a, const double* const* b) noexcept;

// Sign of n.(q-a), no shift: +1 outside, 0 in the plane. For two environment points, or for what lies exactly where.
template <int D>
int orient(const double* const* simplex, const double* q) noexcept;

}  // namespace exact
}  // namespace dsw
