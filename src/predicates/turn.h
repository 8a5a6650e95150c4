#pragma once
// Turns of three points, in the plane or along an axis of space.

#include "predicates/filtered.h"

namespace dsw {

/** Turn of a, b, c: positive to the left, 0 on a line. In space with coordinate `axis` left out, seen so that the axis points
 * at the viewer. Exact. */
template <int D>
int turn_sign(const double* a, const double* b, const double* c, [[maybe_unused]] int axis = 0) noexcept {
  if constexpr (D == 3) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double pa[2] = {a[i], a[j]}, pb[2] = {b[i], b[j]}, pc[2] = {c[i], c[j]};
    return turn_sign<2>(pa, pb, pc);
  } else {
    const double* const edge[2] = {a, b};
    return -orient<2>(edge, c);  // orient<2> is positive on the right
  }
}

/** A coordinate that can be left out without making a triangle flat; 2 if the triangle is flat. */
inline int projection(const double* const (&t)[3]) noexcept {
  return turn_sign<3>(t[0], t[1], t[2], 0) != 0 ? 0 : turn_sign<3>(t[0], t[1], t[2], 1) != 0 ? 1 : 2;
}

/** Whether three points lie on a line. */
template <int D>
bool are_collinear(const double* a, const double* b, const double* c) noexcept {
  for (int axis = 0; axis < (D == 3 ? 3 : 1); ++axis) {
    if (turn_sign<D>(a, b, c, axis) != 0) return false;
  }
  return true;
}

/** Whether the insides of two triangles meet, with coordinate `axis` left out: no side of one has the other one beyond it. */
inline bool insides_meet(const double* const (&t)[3], const double* const (&s)[3], int axis) noexcept {
  const auto separates = [axis](const double* const(&one)[3], const double* const(&other)[3]) {
    const int sense = turn_sign<3>(one[0], one[1], one[2], axis);
    for (int k = 0; k < 3; ++k) {
      bool beyond = true;
      const double *const from = one[k], *const to = one[(k + 1) % 3];
      for (const double* p : other) {
        beyond = beyond && (p == from || p == to || turn_sign<3>(from, to, p, axis) * sense <= 0);
      }
      if (beyond) return true;
    }
    return false;
  };
  return !separates(t, s) && !separates(s, t);
}

}  // namespace dsw
