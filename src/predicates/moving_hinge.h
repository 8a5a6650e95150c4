// Two edges with a common vertex, all of which move: a filter that says that they touch nowhere else.
//
// Let a(t) and b(t) be the two edges as vectors from the common vertex. If one of them touches the other elsewhere, or
// has no length, a x b is 0. It is quadratic in t, with the coefficients a0 x b0, (a0 x b1 + a1 x b0) / 2 and a1 x b1 in
// the basis of Bernstein. If all have a positive part along some vector n, it is never 0. Any n will do; here it is the
// rounded second coefficient, doubled.
//
// Errors. Let u = 2^-53, and let A and B be the largest components of a and b. A component of a x b errs by 8u A B and
// is at most 2 A B, so one of n errs by 20u A B and is at most 4 A B. In a dot product n counts as exact, and only the other
// factor errs. So the product errs by less than 3 (4 A B) (20u A B) + 3u (3 (4 A B) (4 A B)) = 384u A^2 B^2, less than
// 2^-43 A^2 B^2. With A and B in [2^-100, 2^100]
// nothing over- or underflows that counts.
#pragma once

#include "predicates/filtered.h"

namespace dsw {

// Points are the common vertex, and the far ends. False: not known.
inline bool stays_open(const double* const (&start)[3], const double* const (&end)[3]) noexcept {
  using filter::Vec;
  const Vec<3> a0 = filter::difference<3>(start[1], start[0]), a1 = filter::difference<3>(end[1], end[0]);
  const Vec<3> b0 = filter::difference<3>(start[2], start[0]), b1 = filter::difference<3>(end[2], end[0]);
  const double a = filter::highest(filter::extent(a0, a1)), b = filter::highest(filter::extent(b0, b1));
  if (!(a >= 0x1p-100 && a <= 0x1p100 && b >= 0x1p-100 && b <= 0x1p100)) return false;
  const Vec<3> first = filter::cross(a0, b0), last = filter::cross(a1, b1), c = filter::cross(a0, b1),
               d = filter::cross(a1, b0), n{c.x + d.x, c.y + d.y, c.z + d.z};
  const double bound = 0x1p-43 * (a * b) * (a * b);
  return filter::dot(n, first) > bound && filter::dot(n, n) > bound && filter::dot(n, last) > bound;
}

}  // namespace dsw
