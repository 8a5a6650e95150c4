// Finds what is near a line in an environment.
#ifndef DARTSWEEP_PHYSICS_ROD_NEAR_ROWS_H
#define DARTSWEEP_PHYSICS_ROD_NEAR_ROWS_H

#include "library.h"
#include "near_row.h"

namespace physics {

struct NearRowOptions {
  double radius = 0.1;  // of the body
  double margin = 0.2;  // rows have a smaller gap than this
};

// The rows of one step, and the key of each: the vertex or edge of the body that is near something.
struct KeyedRows {
  NearRows rows;
  std::vector<std::uint32_t> keys;
};

// Replaces `found`, the rows of the step before. `volumes` are those that the vertices of the line lie in. Throws
// LibraryError.
void find_near_rows(const dsw_environment* environment, const Positions& line,
                    const std::vector<dsw_volume_id>& volumes, const NearRowOptions& options, KeyedRows* found);

}  // namespace physics

#endif
