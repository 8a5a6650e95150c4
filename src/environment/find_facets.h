#pragma once
// Facets, and edges in space, by their vertices, in bulk: how the boundary groups of a mesh file become names of cells.

#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

/** Query i has the vertices indices[offsets[i] .. offsets[i+1]-1], in any order. out[i]: the canonical half-facet,
 * invalid if there is none; *missing: how many those are. Expected O(facets + vertices given). */
template <int D>
void find_facets(const Environment<D>& env, size_t count, const size_t* offsets, const uint32_t* indices,
                 HalfFacet* out, size_t* missing);

/** Query i joins indices[2 i] and indices[2 i + 1]. out[i]: a dart of the edge in the first of its volumes; its cell is
 * invalid if there is none. Expected O(edges + count). */
void find_edges(const Environment<3>& env, size_t count, const uint32_t* indices, Dart* out, size_t* missing);

}  // namespace dsw
