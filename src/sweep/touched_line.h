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

/** A kept edge that pierces what an edge sweeps: of those the one that is met first. */
struct PiercedLine {
  TouchedLines* kept = nullptr;  // the first of these; null: none
  SweepEvent event;

  explicit operator bool() const noexcept { return kept != nullptr; }
};

/** A forecast: the line may have lost its walls, and another contact may come first. Brings the line to the front. */
PiercedLine find_pierced_line(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep) noexcept;

/** Whether the first contact is that with a kept edge, round which all cells are tetrahedra. The same contact as that
 * of a flood. False: not known. Throws std::bad_alloc. */
bool meets_first(const Environment<3>& env, const Body<3>& body, const EdgeSweep& sweep, const PiercedLine& pierced,
                 SweepContact* found, EdgeScratch<3>& scratch);

// In the plane there are no such edges.
inline void keep_touched_line(const Environment<2>&, const Body<2>&, uint32_t, uint32_t, const SweepContact&) noexcept {
}
inline PiercedLine find_pierced_line(const Environment<2>&, const Body<2>&, const EdgeSweep&) noexcept { return {}; }
inline bool meets_first(const Environment<2>&, const Body<2>&, const EdgeSweep&, const PiercedLine&, SweepContact*,
                        EdgeScratch<2>&) noexcept {
  return false;
}

}  // namespace dsw
