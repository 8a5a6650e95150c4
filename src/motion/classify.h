#pragma once
// What a point lies on exactly, without the shift.

#include "environment/environment.h"

namespace dsw {

/** A cell of any dimension, named by a volume and a number in its shape: vertex, edge, facet; none for the volume. */
struct FeatureRef {
  int dimension = 3;
  Cell cell;
  uint32_t local = 0;
};

/** The cell of lowest dimension in the closure of volume c that holds the point. The volume contains the point under the
 * shift, so what is left to find is zeros. *inside: whether the point lies in the closure, for callers that were told a
 * volume and do not trust it. */
FeatureRef classify(const Environment<3>& env, const double* point, Cell c, bool* inside) noexcept;

}  // namespace dsw
