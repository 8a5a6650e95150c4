#pragma once
// Where and how something is touched: doubles that follow from an exact event.

#include "contact/touch.h"
#include "corridor/sweep.h"

namespace dsw {

/** What a sweep has met on the way of a vertex from p to `to`. Whose part touches is left open. */
template <int D>
Touch touch_of(const Environment<D>& env, const double* p, const double* to, const SweepContact& met);

/** An impassable facet from the side to which a normal looks; where an impassable cell is there, or nothing, as it is
 * given. */
template <int D>
HalfFacet facing(const Environment<D>& env, HalfFacet wall, const double* normal) noexcept;

/** The wall of a contact from where it is met: from `front`; at a vertex that need not be at the facet: as above. */
template <int D>
HalfFacet seen_wall(const Environment<D>& env, Cell front, HalfFacet wall, const double* normal) noexcept;

/** How far along the edge, which runs from `end` to q, a point on it lies: by the axis it is longest on. */
template <int D>
double share_along(const double* end, const double* q, const double* point);

}  // namespace dsw
