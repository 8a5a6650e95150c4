#pragma once
// An edge's sequence turned round an edge of the environment, among cells of several forms.

#include "flood/sequence.h"

namespace dsw {

/** As `turn`, of a sequence that is not kept in rows: through tetrahedra, pyramids and hexahedra that are exactly
 * convex. What the edge sweeps is free as it is among tetrahedra (sweep/known_edge.cpp has the proof): all cells round
 * the pivot have it as an edge. Throws std::bad_alloc. */
bool turn_round_edge(const Environment<3>& env, EdgeSequence<3>& sequence, const double* from, const double* to,
                     Pivot<3>& pivot);

}  // namespace dsw
