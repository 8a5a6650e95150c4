// Which pairs of simplices are nearest to each other: signs of dot products of differences of points. No Simulation of
// Simplicity: zeros stay zeros. Right for any finite doubles.
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

}  // namespace dsw
