#pragma once
// Creation: from the arrays of a mesh to a validated environment, in one pass over the cells and expected linear time.

#include "dartsweep/environment.h"
#include "environment/environment.h"

namespace dsw {

/** First offenders of one kind, ascending. */
struct Offenders {
  static constexpr uint32_t kMax = 8;
  uint32_t count = 0;
  uint32_t index[kMax] = {};
  void add(uint32_t i) {
    if (count < kMax && (count == 0 || index[count - 1] != i)) index[count++] = i;
  }
};

struct BuildReport {
  Offenders offenders;
  uint32_t reoriented_count = 0, unused_point_count = 0, convex_volume_count = 0;
};

/** A description whose sizes and pointers fit each other, with its defaults in place of zeros. Throws Error. */
template <int D>
dsw_environment_desc check_description(dsw_environment_desc desc);

/** Fills an empty environment from a description that was checked; throws Error (and leaves the environment useless)
 * on the first kind of defect found, with the first offenders of that kind in the report. Order of checks: sizes,
 * points finite, cells well-formed, facets matched, cells valid. */
template <int D>
void build(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report);

/** Proves everything again; throws as build. */
template <int D>
void prove(const Environment<D>& env, BuildReport& report);

/** How many parts there are, connected through facets. Throws std::bad_alloc. */
template <int D>
uint32_t count_parts(const Environment<D>& env);

/** Counts the parts connected through facets and sets the box of used vertices; for build and for loading. */
template <int D>
void finish_topology(Environment<D>& env, BuildReport* report);

}  // namespace dsw
