#pragma once
// What was touched, and how a host reads it.

#include "body/simplices.h"
#include "dartsweep/contact.h"
#include "dartsweep/deform.h"

namespace dsw {

template <int D>
struct Environment;
struct WallFeature;

/** A touch of a part of a body. Which formula fills it in depends on what moves; what a host reads follows from it alone. */
struct Touch {
  double time = 0;                        // of the way, rounded down
  Simplex part{Simplex::kVertex, kNone};  // that touches; a vertex: the moving one
  dsw_contact other = {};                 // what is touched, with the unit normal out of it; see dsw_sweep
  double position[3] = {};                // of the moving vertex at that time
  double point[3] = {};                   // where the touch is
  double along = 0;                       // on a touching edge: 0 the moving end, 1 the fixed one
};

/** All but `distance_left` and `history` of a contact on the way of vertex v to `to`. The rest of the body stays. */
template <int D>
dsw_body_contact describe(const Body<D>& body, uint32_t v, const double* to, const Touch& touch);

/** The contact of a wall whose first vertex goes from `from` to `to`, without the names of the body or particle. */
template <int D>
dsw_wall_contact describe(const Environment<D>& env, const WallFeature& wall, const double* from, const double* to,
                          const Touch& touch, dsw_wall_response response) noexcept;

}  // namespace dsw
