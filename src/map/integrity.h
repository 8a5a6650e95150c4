#pragma once
// What has to hold in every map, checked without trusting any of its words.

#include "map/map.h"

namespace dsw {

/** Null, or the name of the first invariant found broken. Safe for any contents of the arrays: whatever is followed was
 * checked before. O(n); throws std::bad_alloc only. */
template <int D>
const char* check_integrity(const Map<D>& map);

/** Length of the shape table that starts at `table`, of which `available` words may be read; 0 when it is not sound:
 * not what append_polyhedron (in the plane append_polygon) makes of its loops, with any triangles that fill them.
 * `scratch` is overwritten. */
template <int D>
size_t sound_table_length(const uint16_t* table, size_t available, Array<uint16_t>& scratch);

/** Units of a record whose first word is `word0`; 0 if no record begins like that. Shapes have been checked. */
template <int D>
uint32_t record_units(const Map<D>& map, uint32_t word0);

/** Counts facets and those with one side. Links must lie inside of `words`; nothing else is assumed of them. */
template <int D>
void count_facets(const Map<D>& map, uint32_t* facets, uint32_t* boundary_facets);

}  // namespace dsw
