// Which pairs of simplices are nearest to each other: signs of dot products of differences of points. Right for any
// finite doubles. Zeros stay zeros, but for the functions with Simulation of Simplicity.
#pragma once

namespace dsw {

/** The difference of two points. */
struct Arrow {
  const double* from;
  const double* to;
};

/** Sign of u.v. */
template <int D>
int dot_sign(Arrow u, Arrow v) noexcept;

/** Sign of w.v', where v' is v without its part along u. So it says on which side of the line along u the foot of w
 * lies: +1 on the side of v. Computed as (u.u)(v.w) - (u.v)(u.w), so it is 0 where u and v are parallel. */
template <int D>
int lean_sign(Arrow u, Arrow v, Arrow w) noexcept;

/** Sign of (u x v).w. */
int volume_sign(Arrow u, Arrow v, Arrow w) noexcept;

/** dot_sign and lean_sign, if the last argument ends in a point of a body, which is shifted (README.md). 0 only if u is
 * zero, or u and v are parallel. */
template <int D>
int shifted_dot_sign(Arrow u, Arrow to_body) noexcept;
template <int D>
int shifted_lean_sign(Arrow u, Arrow v, Arrow to_body) noexcept;

/** How far on v the point lies that is nearest to a line along u: 0 to 1, up to 2^-53. w leads from the start of v to
 * the line. The quotient of (u.u)(v.w) - (u.v)(u.w) and (u.u)(v.v) - (u.v)(u.v), which are not 0. */
double exact_share(Arrow u, Arrow v, Arrow w) noexcept;

}  // namespace dsw
