#pragma once
// Where a blade is met first: from there a cut follows it.

#include "cutting/crossings.h"

namespace dsw {

/** A cell that the blade meets: `hint`, or where the straight way from its centre to the nearest point of the blade leads, walls or not;
 * without a hint the cell of the first point of the blade that is in any. Invalid: there is none. Adds the cells that were walked through
 * to *visited. O(triangles + cells between); without a hint as locate(). */
Cell find_start(const Environment<3>& env, const Blade& blade, Cell hint, uint32_t* visited);

}  // namespace dsw
