// Whether two segments touch, exactly: a check of its own, in sums of doubles that lose nothing.
#pragma once

#include <array>

namespace knot {

using Point = std::array<double, 3>;

/// Whether segments a b and c d have no point in common. For coordinates between 1e-60 and 1e60, and 0.
bool are_apart(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace knot
