#pragma once
// Back from a contact, to a place that is verified free.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "walk/move.h"

namespace dsw {

/** Largest coordinate on the way from p to q: of all of it, but up to `time` where it ends 2^10 times as far out. The
 * target of such a long way says nothing about where it stops. */
template <int D>
double reach(const double* p, const double* q, double time) noexcept {
  constexpr double kFar = 1024;
  const double start = largest_coordinate<D>(p), target = largest_coordinate<D>(q);
  if (target > kFar * start) {
    double there[D];
    point_at<D>(p, q, time, there);
    const double passed = std::max(start, largest_coordinate<D>(there));
    if (target > kFar * passed) return passed;
  }
  return std::max(start, target);
}

/** First step back from a contact at `time`: one unit in the last place of the largest coordinate, as a fraction of the
 * move. */
template <int D>
double first_step(const double* p, const double* q, double time) noexcept {
  using Limits = std::numeric_limits<double>;
  const double largest = reach<D>(p, q, time);
  const bool is_long = largest < largest_coordinate<D>(q);
  double length = 0;
  for (int k = 0; k < D; ++k) length = std::max(length, std::fabs(q[k] - p[k]));
  const double ulp = std::nextafter(largest, Limits::infinity()) - largest;
  const double step = std::isfinite(ulp) ? ulp / length : Limits::epsilon();
  return std::min(std::max(step, is_long ? Limits::denorm_min() : Limits::epsilon() / 2), 1.0);
}

/** Where the contact of a long way comes so early that no double tells its time well: q comes nearer on this way, and
 * `time` is found again there, by bisection, as the last at which is_free. */
template <int D, class IsFree>
void shorten(const double* p, double* q, double* time, IsFree is_free) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  if (*time >= kLeast || first_step<D>(p, q, *time) >= kLeast) return;
  point_at<D>(p, q, kLeast, q);
  // Positive doubles are in the order of their bits: 62 halvings lead from all of them to one.
  const auto time_of = [](uint64_t bits) {
    double t;
    std::memcpy(&t, &bits, sizeof t);
    return t;
  };
  uint64_t free = 0, met = 0x3ff0000000000000u;  // 0 and 1
  while (met - free > 1) {
    const uint64_t middle = free + (met - free) / 2;
    double candidate[D];
    point_at<D>(p, q, time_of(middle), candidate);
    (is_free(candidate) ? free : met) = middle;
  }
  *time = time_of(free);
}

/** Candidates recede from `time` on the way from p to q by doubling steps, at most 60; `position` is the first for
 * which is_free, or p. Returns whether one was. */
template <int D, class IsFree>
bool retreat(const double* p, const double* q, double time, double* position, IsFree is_free) {
  double step = time > 0 ? first_step<D>(p, q, time) : 1;
  double last[D];
  for (int tries = 0; tries < 60; ++tries, step *= 2) {
    const double t = time - step;
    if (!(t > 0)) break;
    point_at<D>(p, q, t, position);
    if (tries != 0 && std::equal(last, last + D, position)) continue;
    std::copy(position, position + D, last);
    if (is_free(position)) return true;
  }
  std::copy(p, p + D, position);
  return false;
}

}  // namespace dsw
