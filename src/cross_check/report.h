#pragma once
// The cross-check of a contact, as a host reads it.

#include "cross_check/features.h"
#include "dartsweep/cross_check.h"

namespace dsw {

/** What libccd says of the normal of a touch, or why it says nothing. Where no wall is known there is nothing to ask
 * about. Throws std::bad_alloc. */
dsw_cross_check cross_check_of(const Environment<3>& env, const ReportedTouch& touch, bool has_wall);

}  // namespace dsw
