// Whether a point lies on a triangle or a segment, in rational numbers.
#pragma once

#include "support.h"

#include "../gmp_numbers.h"

namespace dsw::oracle::exact {

using Q3 = std::array<mpq_class, 3>;
inline Q3 minus(const Vec& a, const Vec& b) {
  return {mpq_class(a[0]) - mpq_class(b[0]), mpq_class(a[1]) - mpq_class(b[1]), mpq_class(a[2]) - mpq_class(b[2])};
}
inline Q3 cross(const Q3& a, const Q3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline mpq_class dot(const Q3& a, const Q3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline bool zero(const Q3& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

inline bool on_segment(const Vec& p, const Vec& a, const Vec& b) {
  const Q3 u = minus(b, a), v = minus(p, a);
  return zero(cross(u, v)) && dot(u, v) >= 0 && dot(u, v) <= dot(u, u);
}
inline bool on_triangle(const Vec& p, const Vec& a, const Vec& b, const Vec& c) {
  const Q3 n = cross(minus(b, a), minus(c, a));
  if (dot(n, minus(p, a)) != 0) return false;
  return dot(n, cross(minus(b, a), minus(p, a))) >= 0 && dot(n, cross(minus(c, b), minus(p, b))) >= 0 &&
         dot(n, cross(minus(a, c), minus(p, c))) >= 0;
}

}  // namespace dsw::oracle::exact
