#pragma once
// Contacts of bodies of which all vertices move at once, as a host reads them.

#include "together/traveller.h"

namespace dsw {

/** Adds the touches of a round to the records of the bodies that move there, in the order of bodies, parts and what is
 * touched. Throws std::bad_alloc. */
template <int D>
void describe_touches(const Environment<D>& env, Array<Traveller<D>>& travellers, FirstTouches<D>& first);

}  // namespace dsw
