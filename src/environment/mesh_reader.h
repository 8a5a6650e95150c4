#pragma once
// First half of creation: the host's arrays become records, every index and count checked before it is used.

#include "environment/builder.h"

namespace dsw {

/** Copies or borrows the points. Throws NON_FINITE, with the first such points in the report. */
template <int D>
void read_points(Environment<D>& env, const MeshInput& input, BuildReport& report);

/** Writes a record for every cell, links empty. Throws WRONG_SIZE, BAD_CELL_TYPE, INDEX_OUT_OF_RANGE, BAD_CELL,
 * TOO_LARGE. */
template <int D>
void read_cells(Environment<D>& env, const MeshInput& input, BuildReport& report);

/** Turns a cell inside out by renumbering its vertices; before its facets are matched. */
template <int D>
void mirror_cell(Environment<D>& env, Cell c);

}  // namespace dsw
