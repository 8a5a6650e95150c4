#pragma once
// Links the facets of all cells: expected linear time, one chain of sides for every vertex.

#include "environment/builder.h"

namespace dsw {

/** What is wrong with a facet that does not match. */
enum class MatchDefect { kNone, kSameSide, kThirdCell };

constexpr size_t kAllSides = SIZE_MAX;

/** Links every facet with its opposite, unless it has a link, and counts facets. `open_sides`: how many sides have no link;
 * kAllSides: none has one. Returns the first kind of defect in the order of cells, with its first offenders. */
template <int D>
MatchDefect match_facets(Environment<D>& env, Offenders& offenders, size_t open_sides, const Parallel& parallel);

}  // namespace dsw
