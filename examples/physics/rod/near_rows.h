// Finds what is near a body of the library.
#ifndef DARTSWEEP_PHYSICS_ROD_NEAR_ROWS_H
#define DARTSWEEP_PHYSICS_ROD_NEAR_ROWS_H

#include "library.h"
#include "rod/near_row.h"

namespace physics {

struct NearRowOptions {
  double radius = 0.1;  // of the body
  double margin = 0.1;  // rows have a smaller gap than this
};

// Replaces `rows` by those of the body, whose vertices are numbered along the rod. Throws LibraryError.
void find_near_rows(dsw_scene* scene, dsw_body_id body, const NearRowOptions& options, NearRows* rows);

}  // namespace physics

#endif
