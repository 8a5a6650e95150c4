#pragma once
// Coarsening: a static environment of many tetrahedra becomes one of few large cells [JCD10] 3.2.

#include "topology/merging.h"

namespace dsw {

struct CoarsenReport {
  uint64_t trials = 0;
  bool complete = true;
  double area_before = 0, area_after = 0;  // of the facets that can be passed
};

/** Fills an empty environment with what `source` is, its passable tetrahedra merged where marks, regions and tags
 * allow. Vertices keep their numbers. `new_index`: by cell index of the source the index of the cell that now holds it;
 * kNoCell without a cell. The points of `source` must not move. Throws std::bad_alloc, TOO_LARGE. O(n log n). */
void coarsen(const Environment<3>& source, const CoarsenOptions& options, Environment<3>& target,
             Array<uint32_t>& new_index, CoarsenReport& report);

}  // namespace dsw
