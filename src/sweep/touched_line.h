#pragma once
// Edges of the environment that an edge of a body has touched. They are asked first, since it often touches them again.

#include "body/body.h"
#include "flood/sweep_contact.h"
#include "sweep/known_edge.h"

namespace dsw {

/** Keeps the edge of the environment that a contact of edge e names, when its end v moves; not where there is no memory
 * for it. */
void keep_touched_line(const Environment<3>& env, const Body<3>& body, uint32_t e, uint32_t v,
                       const SweepContact& contact) noexcept;

/** Finds the first contact without a flood, if it is with a kept edge, and all cells round that are tetrahedra. The same
 * contact as that of a flood. False: not known. Throws std::bad_alloc. */
bool find_touched_line(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep, SweepContact* found,
                       EdgeScratch<3>& scratch);

/** Whether a kept edge pierces what an edge sweeps. A forecast: the kept edge may have no wall any more. */
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
