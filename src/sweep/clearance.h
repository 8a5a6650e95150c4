#pragma once
// Balls round a body's vertices that are known to hold nothing impassable: what an edge sweeps inside of one is free. A
// ball serves whoever is in it, so vertices borrow those of their neighbours. Measuring one takes as long as hundreds
// of casts: it is paid with what balls have saved before, and with a twentieth of what had to be cast.

#include "body/body.h"

namespace dsw {

/** Square of the length of edges at a vertex that stay in its ball while none of their ends goes further than `way`. */
template <int D>
double room_squared(const Environment<D>& env, const Clearance<D>& ball, const double* at, double way) noexcept;

/** Finds a ball for vertex v that reaches `needed` far from where it is: a neighbour's, or a new one if there is
 * credit. Where none was found it waits, twice as long each time. May throw std::bad_alloc. */
template <int D>
void refresh_clearance(const Environment<D>& env, Body<D>& body, uint32_t v, double needed);

/** Notes how many sweeps balls have saved and how many they have not. */
template <int D>
void earn_credit(Body<D>& body, uint32_t saved, uint32_t swept) noexcept;

}  // namespace dsw
