#pragma once
// Edges of the environment that an edge of a body touches. Those that it has touched are a forecast, since it often
// touches them again.

#include "body/body.h"
#include "corridor/first_ridge.h"
#include "corridor/moving_part.h"
#include "corridor/sweep_contact.h"

namespace dsw {

/** What an edge has touched while one end moves; null: nothing yet. */
template <int D>
TouchedLines* lines_of(const Body<D>& body, uint32_t e, uint32_t v) noexcept {
  const size_t slot = 2 * size_t{e} + body.edges[e].side_of(v);
  return slot < body.touched.size() ? &body.touched[slot] : nullptr;
}

/** Keeps the edge of the environment that a contact of edge e names, when its end v moves; not where there is no memory
 * for it. */
void keep_touched_line(const Environment<3>& env, const Body<3>& body, uint32_t e, uint32_t v,
                       const SweepContact& contact) noexcept;

/** Whether an edge that was touched pierces what an edge sweeps: then it is most likely touched again. */
bool pierces_touched_line(const Environment<3>& env, const Body<3>& body, const MovingPart& edge) noexcept;

/** Whether the first contact is that with the ridge that an edge meets first: walls end the passable cells round it,
 * all of them tetrahedra. The same contact as that of a flood. False: not known. */
bool meets_first(const Environment<3>& env, const Body<3>& body, const MovingPart& edge, const FirstRidge& ridge,
                 SweepContact* found) noexcept;

// In the plane there are no such edges.
inline void keep_touched_line(const Environment<2>&, const Body<2>&, uint32_t, uint32_t, const SweepContact&) noexcept {
}
inline bool pierces_touched_line(const Environment<2>&, const Body<2>&, const MovingPart&) noexcept { return false; }
inline bool meets_first(const Environment<2>&, const Body<2>&, const MovingPart&, const FirstRidge&,
                        SweepContact*) noexcept {
  return false;
}

}  // namespace dsw
