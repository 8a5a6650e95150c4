// A point against the four planes of a tetrahedron, without a branch between them.
#pragma once

#include <cmath>

#include "predicates/filtered.h"

namespace dsw {

// Whether a point certainly lies strictly inside of a tetrahedron whose facets are those of standard_facets.h. The
// filter is that of filter_bounds.h, with one extent for all four determinants.
inline bool is_inside_tetrahedron(const double* const* corners, const double* x) noexcept {
  using filter::Vec;
  const Vec<3> a = filter::difference<3>(corners[0], x), b = filter::difference<3>(corners[1], x),
               c = filter::difference<3>(corners[2], x), d = filter::difference<3>(corners[3], x);
  const Vec<3> ab = filter::cross(a, b), cd = filter::cross(c, d);
  const double first = filter::smaller(filter::dot(ab, d), -filter::dot(ab, c));
  const double second = filter::smaller(filter::dot(cd, b), -filter::dot(cd, a));
  const double lowest = filter::smaller(first, second);
  return lowest > 0 && filter::certain(lowest, filter::extent(a, b, c, d));
}

}  // namespace dsw
