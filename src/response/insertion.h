#pragma once
// Vertices put on edges and merged away again, verified free [JCD10] 4.2.

#include "dartsweep/body.h"
#include "sweep/star.h"

namespace dsw {

/** Whether an edge can be bent to pass through `point`: what that sweeps is free at its level. *cell contains it. */
template <int D>
bool can_bend(const Environment<D>& env, StarSweep<D>& star, const Body<D>& body, uint32_t edge, const double* point,
              Cell* cell);

/** Splits an edge at a point that can_bend has allowed; throws std::bad_alloc before it changes anything. Returns the
 * new vertex. */
template <int D>
uint32_t insert_vertex(Body<D>& body, uint32_t edge, const double* point, Cell cell, double share, dsw_body_edit* edit);

/** Merges a vertex into the other end of one of its edges if the way there is free and the body stays a manifold. */
template <int D>
bool merge_vertex(StarSweep<D>& star, Body<D>& body, uint32_t edge, uint32_t vertex, dsw_body_edit* edit);

}  // namespace dsw
