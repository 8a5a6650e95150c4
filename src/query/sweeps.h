#pragma once
// Edges swept without a body. Arguments have been checked: ids are alive or null, coordinates finite.

#include "base/parallel.h"
#include "base/points.h"
#include "body/body.h"
#include "dartsweep/contact.h"
#include "environment/environment.h"

namespace dsw {

struct SweepOptions {
  SweepLevel level = SweepLevel::kEdgesSwept;
  uint32_t max_volumes = 0;
  bool start_known = false;  // starts contain the moving ends; else they are hints
  bool start_free = false;   // the edges are free where they start
};

/** Sweeps edges from[i] fixed[i] to to[i] fixed[i]; `starts` may be null. Throws when memory runs out; `sweeps` is
 * undefined then. */
template <int D>
void sweep_edges(const Environment<D>& env, const Parallel& parallel, size_t count, const dsw_volume_id* starts,
                 PointArray from, PointArray to, PointArray fixed, const SweepOptions& options, dsw_sweep* sweeps);

}  // namespace dsw
