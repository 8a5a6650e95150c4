#include "together/kept_sides.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/position.h"
#include "predicates/filtered.h"
#include "predicates/sweep_events.h"

namespace dsw {
namespace {

/** On which side of the feature the part is, under the shift of the part. */
template <int D>
int side_of(const double* const* part, uint32_t part_count, const double* const* feature) noexcept {
  if (part_count == 1) return plane_side<D>(feature, part[0], NoTally{}).sign;
  if constexpr (D == 3) {
    if (part_count == 3) return swept_side({part[0], part[1], part[2]}, feature[0]).sign;
    return line_side<3>(part[0], part[1], feature, NoTally{}).sign;
  } else {
    const double* const ridge[2] = {feature[0], nullptr};
    return line_side<2>(part[0], part[1], ridge, NoTally{}).sign;
  }
}

}  // namespace

template <int D>
int side_kept(const MovingPair<D>& pair, uint32_t part_count, bool part_first) noexcept {
  const uint32_t part_at = part_first ? 0 : D + 1 - part_count, feature_at = part_first ? part_count : 0;
  uint32_t moving = 0;
  for (int i = 0; i <= D; ++i) moving |= is_same_place<D>(pair.start[i], pair.end[i]) ? 0u : 1u << i;
  int side = 0;
  // All subsets of the points that move.
  for (uint32_t at_end = moving;; at_end = (at_end - 1) & moving) {
    const double* at[D + 1];
    for (int i = 0; i <= D; ++i) at[i] = (at_end >> i & 1u) != 0 ? pair.end[i] : pair.start[i];
    const int sign = side_of<D>(at + part_at, part_count, at + feature_at);
    if (sign == 0 || (side != 0 && sign != side)) return 0;
    side = sign;
    if (at_end == 0) return side;
  }
}

DSW_INSTANTIATE(side_kept);

}  // namespace dsw
