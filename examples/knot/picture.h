// Pictures of a thread, seen from above, as SVG.
#pragma once

#include <vector>

#include "thread.h"

namespace knot {

/// Draws moments of a thread into directory/knot.svg; ends the program if that fails.
void draw(const std::vector<View>& moments, const char* directory);

}  // namespace knot
