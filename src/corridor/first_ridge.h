#pragma once
// Which edge of the environment a moving edge of a body meets first, if it has kept to its corridor until then.

#include "corridor/corridor.h"

namespace dsw {

/** A ridge of a facet of a corridor. */
struct FirstRidge {
  HalfFacet facet;  // of the corridor, with this ridge; invalid: no ridge is met
  RidgeName ridge;
  SweepEvent event;
};

/** Finds the ridge that edge p q meets first while p goes to `to`. The corridor is in rows and of the present version.
 * It is that of the edge at the start; facets that the path of p passes have been removed, or added: at most two.
 *
 * On which side the line through p and q passes a ridge is linear in time. All ridges that the edge passes at the start
 * have the right side. So one that has the right side at the end is never met, and one that has not is met just once.
 * The first of these in time is where the edge leaves its corridor: until then it passes the inside of all
 * facets, and there it meets the ridge itself, as it lies in the closed facet. The edge passes a facet that has been
 * removed until p comes to it, on the right side of its ridges. One that has been added it passes from then on, on the
 * right side at first, if it still is in its corridor. So the ridges of such a facet count only if no other is met before
 * p comes to it.
 *
 * Exact. `first` is empty if none is met. False: two are met at one time.
 * @param added how many facets at the end of p the path has added. */
bool find_first_ridge(const Environment<3>& env, const Corridor<3>& corridor, const EdgeMotion& m, bool p_first,
                      size_t added, FirstRidge* first) noexcept;

/** Turns the corridor round a ridge that was found, if that is not marked and the way round it is passable. While p
 * stays in its cell, find_first_ridge then tells what is met next: when the edge meets the ridge, it passes all other
 * facets of the old corridor inside. Just after, it passes the other facets at the ridge beside it, so inside: all of
 * their ridges have the right side then. Throws std::bad_alloc. */
bool turn_round(const Environment<3>& env, Corridor<3>& corridor, const FirstRidge& ridge);

}  // namespace dsw
