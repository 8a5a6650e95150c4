#pragma once
// Contacts of bodies of which all vertices move at once, as a host reads them.

#include <tuple>

#include "contact/describe.h"
#include "dartsweep/deform.h"
#include "together/thick_ways.h"

namespace dsw {

/** A name of a touch: the same pair has the same name all through a call. */
template <int D>
auto name_of(const WayTouch<D>& t) {
  return std::make_tuple(t.trajectory, static_cast<uint32_t>(t.part.kind), t.part.index,
                         t.other == nullptr ? 0 : t.other->index + 1, static_cast<uint32_t>(t.other_part.kind),
                         t.other_part.index, t.wall.vertices[0], t.wall.vertices[1]);
}

template <int D>
auto name_of(const TooNearOnWay<D>& n) {
  return std::make_tuple(n.trajectory, static_cast<uint32_t>(n.part.kind), n.part.index,
                         n.other == nullptr ? 0 : n.other->index + 1, static_cast<uint32_t>(n.other_part.kind),
                         n.other_part.index, n.wall.vertices[0], n.wall.vertices[1], n.wall.vertices[2]);
}

/** Adds touches to the records of the bodies that move there, in the order of bodies, parts and what is
 * touched. Throws std::bad_alloc. */
template <int D>
void describe_touches(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& touches);

/** Adds what comes too near, in the order of describe_touches. */
template <int D>
void describe_too_near(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<TooNearOnWay<D>>& first);
/** What the part comes too near to, without the part. */
template <int D>
Touch touch_of(const Environment<D>& env, const Trajectory<D>& of, const TooNearOnWay<D>& near);

/** A touch of the environment's, without the names of the body or particle. */
template <int D>
dsw_wall_contact describe_wall(const Environment<D>& env, const Array<Trajectory<D>>& trajectories,
                               const WayTouch<D>& met);

}  // namespace dsw
