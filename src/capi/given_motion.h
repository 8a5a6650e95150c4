#pragma once
// Rigid motions as a host gives them.

#include <algorithm>
#include <cmath>

#include "capi/convert.h"
#include "dartsweep/move.h"
#include "response/rigid_move.h"

namespace dsw::capi {

/** Only what keeps the plane in place: a rotation about its normal and a translation in it. */
inline void check_planar(const dsw_rigid_motion& motion, const char* name) {
  if (motion.rotation[0] != 0 || motion.rotation[1] != 0) {
    fail(DSW_STATUS_OUT_OF_RANGE, "%srotation is (%g, %g, ...), x and y must be 0 in the plane", name,
         motion.rotation[0], motion.rotation[1]);
  }
  if (motion.centre[2] != 0 || motion.translation[2] != 0) {
    fail(DSW_STATUS_OUT_OF_RANGE, "%scentre[2] is %g and its translation[2] %g, both must be 0 in the plane", name,
         motion.centre[2], motion.translation[2]);
  }
}

/** @param name what messages put before the name of a member. */
template <int D>
RigidMove<D> to_motion(const dsw_rigid_motion& motion, const char* name) {
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(motion.centre[k]) || !std::isfinite(motion.translation[k])) {
      fail(DSW_STATUS_NON_FINITE, "%scentre[%d] is %g, its translation there %g: both must be finite", name, k,
           motion.centre[k], motion.translation[k]);
    }
  }
  for (int k = 0; k < 4; ++k) {
    if (!std::isfinite(motion.rotation[k])) {
      fail(DSW_STATUS_NON_FINITE, "%srotation[%d] is %g", name, k, motion.rotation[k]);
    }
    largest = std::max(largest, std::fabs(motion.rotation[k]));
  }
  if (!(largest > 0)) fail(DSW_STATUS_OUT_OF_RANGE, "%srotation is zero", name);
  if (D == 2) check_planar(motion, name);
  return {motion.rotation, motion.centre, motion.translation};
}

}  // namespace dsw::capi
