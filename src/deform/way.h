#pragma once
// Where a point is on a straight way.

#include <algorithm>
#include <cmath>

namespace dsw {

/** At a fraction of the way from `start` to `target`, both ends to the bit; `out` may be one of them. Stays finite where the way is longer
 * than doubles go. */
inline void point_on_way(const double* start, const double* target, double fraction, double* out) noexcept {
  for (int k = 0; k < 3; ++k) {
    const double step = target[k] - start[k];
    const double between =
        std::isfinite(step) ? start[k] + fraction * step : (1 - fraction) * start[k] + fraction * target[k];
    out[k] = fraction == 1 ? target[k] : fraction == 0 ? start[k] : between;
  }
}

}  // namespace dsw
