#pragma once
// Links the facets of all cells: expected linear time, one chain of candidates for every vertex.

#include "environment/builder.h"

namespace dsw {

/** What is wrong with a facet that does not match. */
enum class MatchDefect { kNone, kSameSide, kThirdCell };

/** Links every facet with its opposite and counts facets. Returns the first kind of defect in the order of cells, with
 * its first offenders. */
template <int D>
MatchDefect match_facets(Environment<D>& env, Offenders& offenders);

}  // namespace dsw
