#pragma once
// Whether the nearest point of an obstacle is seen from that of a part: a walk through cells along the exact segment.

#include "environment/environment.h"
#include "map/cell_queue.h"
#include "predicates/sightline.h"

namespace dsw {

/** Where a walk along a sightline ended. */
struct SightResult {
  bool is_hit = false;  // a facet there is impassable
  Cell cell;            // the last cell entered
};

/** Walks from a cell that contains the start of a line, under the shift, to the end or to an impassable facet. Every step
 * crosses a facet later than the one before.
 * @param target vertices: the end lies on every facet that has all of them. Throws std::bad_alloc. */
template <int D>
SightResult walk_along(const Environment<D>& env, Sightline<D>& line, Cell start, const uint32_t* target,
                       uint32_t target_count);

/** Whether a line that ends in a cell ends at an obstacle with these vertices: a cell there has it. Not at the other lip of
 * a closed slit, which has vertices of its own and can lie before this lip up to rounding, nor at a sheet that overlaps.
 * @param cells is overwritten. Throws std::bad_alloc. */
template <int D>
bool ends_at(const Environment<D>& env, Sightline<D>& line, Cell end, const uint32_t* vertices, uint32_t count,
             CellQueue& cells);

}  // namespace dsw
