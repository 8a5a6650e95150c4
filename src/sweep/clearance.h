#pragma once
// Balls round a body's vertices that are known to hold nothing impassable: what an edge sweeps inside of one is free.

#include "body/body.h"

namespace dsw {

/** Whether the ball of a vertex is known to hold three points, and so all between them. */
bool covers(const Environment<3>& env, const Clearance& ball, const double* a, const double* b,
            const double* c) noexcept;

/** Measures the ball of vertex v again unless it still reaches `needed` far from where the vertex is, or was found too small not
 * long ago: the wait doubles each time. May throw std::bad_alloc. */
void refresh_clearance(const Environment<3>& env, Body& body, uint32_t v, double needed);

}  // namespace dsw
