#pragma once
// What of a body that stands still a segment meets first.

#include "base/vec.h"
#include "predicates/touch.h"
#include "proximity/pair_sweep.h"

namespace dsw {

/** Whether touches at the ends of a segment count. */
enum class SegmentEnds { kClosed, kOpen };

/** What a segment has met. `time` is a share of the segment. */
template <int D>
struct SegmentTouch : PairContact<D> {
  Vec away{};             // from a thick body: unit, out of it
  bool is_thick = false;  // it came as near as the radius; at a thin body the other members say what it touched

  /** Equal times, as they are rounded: the body with the lower index, vertices before edges before faces, by index. */
  bool comes_before(const SegmentTouch& o) const noexcept;
};

/** Makes `first` what a segment meets of the partner's body if that comes before it. Vertices, edges and faces count as far
 * as the level of the body covers them; a thick body counts where its distance is the radius, and its ends count always.
 * Reads the boxes of the body, if it keeps any; those are fresh. */
template <int D>
void meet_segment(const Partner<D>& partner, const double* from, const double* to, SegmentEnds ends,
                  SegmentTouch<D>& first) noexcept;

}  // namespace dsw
