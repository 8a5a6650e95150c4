#pragma once
// Normals of contacts, as vectors: doubles that follow from an exact event.

#include "base/vec.h"
#include "predicates/sweep_events.h"

namespace dsw {

/** `chosen` turned against the motion; where there is none, against the motion itself. */
Vec against(const Vec& chosen, const Vec& move);

/** The unit vector across two directions; zero if they have none. */
Vec unit_across(const Vec& a, const Vec& b);

/** Unit normal of a triangle, in the plane of an edge, on that side. Of what moves within it, against the motion. */
template <int D>
Vec normal_on(int side, const double* const* corners, const Vec& move);

/** Unit normal of an edge of the plane which swings about m.q where its end is at `position` and it lies on the point
 * `at`: on the side that it comes from. */
Vec swing_normal(const EdgeMotion& m, const double* position, const double* at);

}  // namespace dsw
