#pragma once
// What a point lies on exactly, without the shift.

#include "environment/environment.h"

namespace dsw {

/** A cell of any dimension, named by a cell of full dimension and a number in its shape: vertex, edge (in space),
 * facet; none for the cell itself. */
struct FeatureRef {
  int dimension = 0;
  Cell cell;
  uint32_t local = 0;
};

/** The cell of lowest dimension in the closure of cell c that holds the point. The cell contains the point under the
 * shift, so what is left to find is zeros. *inside: whether the point lies in the closure, for callers that were told a
 * cell and do not trust it. */
template <int D>
FeatureRef classify(const Environment<D>& env, const double* point, Cell c, bool* inside) noexcept;

/** Whether a point lies exactly on a vertex, edge or facet, without the shift. */
template <int D>
bool lies_on(const Environment<D>& env, const FeatureRef& feature, const double* point) noexcept;

}  // namespace dsw
