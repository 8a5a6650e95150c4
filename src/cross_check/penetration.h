#pragma once
// libccd behind one function. `penetration_ccd.cpp` is built with libccd, `penetration_none.cpp` without.

#include "cross_check/features.h"

namespace dsw {

struct Penetration {
  double normal[3];  // along which the body leaves the obstacle on the shortest way; unit
  double depth;      // how far that is
};

/** Throws Error(DSW_STATUS_NOT_BUILT) without libccd. */
void require_libccd();

/** False if libccd finds no overlap, does not end within its calls or gives no number. */
bool find_penetration(const Hull& body, const Hull& obstacle, Penetration& result);

}  // namespace dsw
