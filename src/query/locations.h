#pragma once
// What contains a point, and what it lies on, as a host reads it.

#include "dartsweep/query.h"
#include "environment/environment.h"
#include "locate/classify.h"

namespace dsw {

/** What a cell is that locate has found. */
template <int D>
dsw_location location_of(const Environment<D>& env, Cell c) noexcept {
  return !c.valid() ? DSW_LOCATION_OUTSIDE : is_closed(env, c) ? DSW_LOCATION_IMPASSABLE : DSW_LOCATION_PASSABLE;
}

/** Throws OUTSIDE or IMPASSABLE: a point lies in no passable cell. The text says where it lies: c is what locate has
 * found. */
template <int D>
[[noreturn]] void fail_not_free(const Environment<D>& env, const char* name, const double* point, Cell c);

/** The public id of what classify and find_nearest name. */
template <int D>
dsw_cell name_feature(const Environment<D>& env, const FeatureRef& feature) noexcept;

}  // namespace dsw
