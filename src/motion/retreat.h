#pragma once
// Back from a contact, to a place that is verified free.

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/move.h"

namespace dsw {

/** First step back from a contact: one unit in the last place of the largest coordinate, as a fraction of the move. */
template <int D>
double first_step(const double* p, const double* q) noexcept {
  double largest = 0, length = 0;
  for (int k = 0; k < D; ++k) {
    largest = std::max(largest, std::max(std::fabs(p[k]), std::fabs(q[k])));
    length = std::max(length, std::fabs(q[k] - p[k]));
  }
  const double ulp = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  const double step = std::isfinite(ulp) ? ulp / length : std::numeric_limits<double>::epsilon();
  return std::min(std::max(step, std::numeric_limits<double>::epsilon() / 2), 1.0);
}

/** Candidates recede from `time` on the way from p to q by doubling steps; the first for which is_free(candidate) is kept. Returns
 * how many were tried; *found tells whether one was free, else `position` is p after 60 of them. */
template <int D, class IsFree>
uint32_t retreat(const double* p, const double* q, double time, double* position, bool* found, IsFree is_free) {
  uint32_t candidates = 0;
  double step = first_step<D>(p, q);
  double last[D];
  *found = true;
  for (int tries = 0; tries < 60; ++tries, step *= 2) {
    const double t = time - step;
    if (!(t > 0)) break;
    point_at<D>(p, q, t, position);
    if (tries != 0 && std::equal(last, last + D, position)) continue;
    std::copy(position, position + D, last);
    ++candidates;
    if (is_free(position)) return candidates;
  }
  std::copy(p, p + D, position);
  *found = false;
  return candidates;
}

}  // namespace dsw
