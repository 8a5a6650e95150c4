#pragma once
// What stopped an edge before is asked first: the edge of the environment that it touched, kept with the body.

#include "body/body.h"
#include "flood/sweep_contact.h"
#include "sweep/known_edge.h"

namespace dsw {

/** Keeps the edge of the environment that a contact of edge e names, when its end v moves. Throws std::bad_alloc. */
void keep_touched_line(const Environment<3>& env, const Body<3>& body, uint32_t e, uint32_t v,
                       const SweepContact& contact);

/** Finds the first contact of a sweep if that is with a kept edge of the environment, as a flood would find it. False:
 * it may be another one, or none. Asked among tetrahedra alone. Throws std::bad_alloc. */
bool find_touched_line(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep, SweepContact* found,
                       EdgeScratch<3>& scratch);

/** Whether a kept edge of the environment pierces what an edge sweeps. If it still has a wall, the sweep is not free. */
bool pierces_touched_line(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep) noexcept;

// In the plane there are no such edges.
inline void keep_touched_line(const Environment<2>&, const Body<2>&, uint32_t, uint32_t, const SweepContact&) noexcept {
}
inline bool find_touched_line(const Environment<2>&, const Body<2>&, const EdgeSweep&, SweepContact*,
                              EdgeScratch<2>&) noexcept {
  return false;
}
inline bool pierces_touched_line(const Environment<2>&, const Body<2>&, const EdgeSweep&) noexcept { return false; }

}  // namespace dsw
