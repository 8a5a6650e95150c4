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
//
// If a . b is negative all the time, they touch nowhere else either: where they do, a is b times a positive number, or has no length.
// The coefficients are a0 . b0, (a0 . b1 + a1 . b0) / 2 and a1 . b1. Each a_i . b_k errs by less than 3 (2u + u^2) A B before and
// 3u + 2u (3 A B) more in the sums, less than 16u A B, and the sum of two by 48u A B, less than 2^-46 A B.
//
// Where neither is certain, time is halved up to four times. A component of a mean errs by u A more than what it is the mean of, so
// after four halvings by 5u A instead of u A. The three bounds above become 24u A B for a component of a x b, 52u A B for one of n, and
// 768u A^2 B^2 for the product, still below 2^-43 A^2 B^2; and 39u A B for a dot product, 84u A B for the sum of two.
#pragma once

#include "predicates/filtered.h"

namespace dsw {

// An edge as a vector from the common vertex.
struct HingeArm {
  filter::Vec<3> start, end;
  double size;  // its largest component, or 0 if a filter can't use it

  HingeArm(const double* const (&from)[2], const double* const (&to)[2]) noexcept
      : start(filter::difference<3>(to[0], from[0])),
        end(filter::difference<3>(to[1], from[1])),
        size(filter::highest(filter::extent(start, end))) {
    if (!(size >= 0x1p-100 && size <= 0x1p100)) size = 0;
  }
};

namespace hinge {

constexpr int kMostHalvings = 4;

// Whether the arms surely stay open without halving.
inline bool is_open(const HingeArm& a, const HingeArm& b) noexcept {
  using filter::Vec;
  const double scale = a.size * b.size, least = -0x1p-46 * scale;
  if (filter::dot(a.start, b.start) < least && filter::dot(a.end, b.end) < least &&
      filter::dot(a.start, b.end) + filter::dot(a.end, b.start) < least) {
    return true;
  }
  const Vec<3> first = filter::cross(a.start, b.start), last = filter::cross(a.end, b.end),
               c = filter::cross(a.start, b.end), d = filter::cross(a.end, b.start), n{c.x + d.x, c.y + d.y, c.z + d.z};
  const double bound = 0x1p-43 * scale * scale;
  return filter::dot(n, first) > bound && filter::dot(n, n) > bound && filter::dot(n, last) > bound;
}

inline filter::Vec<3> middle(const HingeArm& arm) noexcept {
  return {0.5 * (arm.start.x + arm.end.x), 0.5 * (arm.start.y + arm.end.y), 0.5 * (arm.start.z + arm.end.z)};
}

inline bool stays_open(const HingeArm& a, const HingeArm& b, int halvings) noexcept {
  if (is_open(a, b)) return true;
  if (halvings == 0) return false;
  HingeArm first[2] = {a, b}, second[2] = {a, b};
  for (int i = 0; i < 2; ++i) first[i].end = second[i].start = middle(first[i]);
  return stays_open(first[0], first[1], halvings - 1) && stays_open(second[0], second[1], halvings - 1);
}

}  // namespace hinge

// False: not known.
inline bool stays_open(const HingeArm& a, const HingeArm& b) noexcept {
  return a.size != 0 && b.size != 0 && hinge::stays_open(a, b, hinge::kMostHalvings);
}

// Points are the common vertex, and the far ends. False: not known.
inline bool stays_open(const double* const (&start)[3], const double* const (&end)[3]) noexcept {
  const double* const from[2] = {start[0], end[0]};
  const double *const first[2] = {start[1], end[1]}, *const second[2] = {start[2], end[2]};
  return stays_open(HingeArm(from, first), HingeArm(from, second));
}

}  // namespace dsw
