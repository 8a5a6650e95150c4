#pragma once
// Facets of the outer boundary that lie on facets of other cells: parts of a mesh that touch and are not sewn.

#include "environment/outer_facets.h"

namespace dsw {

/** How many outer facets lie on, or overlap, outer facets of other cells; the first of them, and the first that it lies on. */
struct Touching {
  uint32_t count = 0;
  HalfFacet first, other;
};

/** Whether two outer facets have an area in common (a length in the plane), or all corners of one are corners of the
 * other. Exact. */
template <int D>
bool facets_touch(const Environment<D>& env, const OuterFacets<D>& outer, uint32_t i, uint32_t j) noexcept;

/** Expected O(n log n) for n outer facets of like size. Throws std::bad_alloc. */
template <int D>
Touching find_touching(const Environment<D>& env);

}  // namespace dsw
