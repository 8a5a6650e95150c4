// The first touch of a moving pair by machine integers, where the coordinates of an axis span at most 60 bits from the lowest set
// bit to the highest. Private to this folder.
#pragma once

#include "predicates/moving_pair.h"

namespace dsw {

// Whether the answer is known: *first is it then. Else ExactPair must tell.
template <int D>
bool small_first_touch(const MovingPair<D>& pair, FirstTouch* first) noexcept;

}  // namespace dsw
