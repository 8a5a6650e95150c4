#pragma once
// What has to hold in every body, checked without trusting any of its words.

#include "body/body.h"

namespace dsw {

/** Null, or the name of the first invariant found broken: slots, ends and corners that live, lists that are whole, a
 * manifold where there are faces. Where vertices are is not looked at. O(n log n); throws std::bad_alloc only. */
template <int D>
const char* check_integrity(const Body<D>& body);

}  // namespace dsw
