#pragma once
// Links the facets of all cells: expected linear time, one chain of candidates for every vertex.

#include "environment/builder.h"

namespace dsw {

/** What is wrong with a facet that does not match. */
enum class MatchDefect { kNone, kSameSide, kThirdCell };

/** Cells that have the same facets in another environment, in which these are linked. */
template <int D>
struct LinkedBefore {
  const Environment<D>& env;
  const Array<uint8_t>& is_other;  // of each cell: 1: it has other facets there
  const Array<uint64_t>&
      poor_fans;  // bits: vertices from which loops of five and more are not cut if another one is there
};

/** Links facets between such cells as they are linked there. */
template <int D>
void copy_links(Environment<D>& env, const LinkedBefore<D>& before);

/** Links every facet with its opposite, unless it has a link (`has_links`: some have), and counts facets. Returns the first kind of defect in the order of cells, with
 * its first offenders. */
template <int D>
MatchDefect match_facets(Environment<D>& env, Offenders& offenders, bool has_links);

}  // namespace dsw
