// A point against the four planes of a tetrahedron, without a branch between them.
#pragma once

#include <cmath>
#include <cstdint>

#include "predicates/filtered.h"

namespace dsw {

constexpr std::uint32_t kUncertainFacets = 1u << 4;

// The facets of a tetrahedron, those of standard_facets.h, that a point sees from strictly outside of it, a bit each; the
// point lies strictly inside of the other planes. kUncertainFacets: that is not certain. The filter is that of
// filter_bounds.h, with one extent for all four determinants.
inline std::uint32_t visible_facets(const double* const* corners, const double* x) noexcept {
  using filter::Vec;
  const Vec<3> a = filter::difference<3>(corners[0], x), b = filter::difference<3>(corners[1], x),
               c = filter::difference<3>(corners[2], x), d = filter::difference<3>(corners[3], x);
  const Vec<3> ab = filter::cross(a, b), cd = filter::cross(c, d);
  const double inside[4] = {filter::dot(ab, d), filter::dot(cd, b), -filter::dot(cd, a), -filter::dot(ab, c)};
  const double least = filter::smaller(filter::smaller(std::fabs(inside[0]), std::fabs(inside[1])),
                                       filter::smaller(std::fabs(inside[2]), std::fabs(inside[3])));
  if (!filter::certain(least, filter::extent(a, b, c, d))) return kUncertainFacets;
  std::uint32_t facets = 0;
  for (std::uint32_t f = 0; f < 4; ++f) facets |= static_cast<std::uint32_t>(inside[f] < 0) << f;
  return facets;
}

}  // namespace dsw
