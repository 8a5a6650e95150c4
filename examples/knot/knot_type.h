// What knot a thread is tied into.
#pragma once

#include <vector>

#include "apart.h"

namespace knot {

/// The determinant of the knot that an open thread becomes when its ends are joined far outside: 1 for a thread without a knot, 3 for an
/// overhand knot. The thread's first point must be the leftmost one, its last the rightmost one; seen from above, along the third axis.
/// The determinant is computed modulo a prime near 2^31 and answered as the smaller of it and its negative.
long determinant(const std::vector<Point>& thread);

/// How often a thread goes round the third axis, in turns.
double turns_round_axis(const std::vector<Point>& thread);

}  // namespace knot
