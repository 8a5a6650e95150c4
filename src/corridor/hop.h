#pragma once
// A line from one cell into the next.

#include "environment/environment.h"

namespace dsw {

/** Whether a line passes the passable facet between two exactly convex cells, on its way from the first to the second:
 * line tests with the facet's ridges alone. False also where a filter cannot tell, and in space of cells that are
 * neither tetrahedra, pyramids nor hexahedra. */
template <int D>
bool passes_between(const Environment<D>& env, Cell first, Cell second, const double* from, const double* to) noexcept;

}  // namespace dsw
