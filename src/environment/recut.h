#pragma once
// Cutting facets anew where the rule "from the lowest vertex" gives a star that is not positive.

#include "environment/environment.h"

namespace dsw {

/** Cuts those facets of a cell anew that spoil its star, the same way for both sides, if a triangulation exists that is
 * positive seen from both centres. Adds the cells on the other side of changed facets to `changed`. */
void recut_cell(Environment<3>& env, Cell c, Array<Cell>& changed);
inline void recut_cell(Environment<2>&, Cell, Array<Cell>&) {}

}  // namespace dsw
