// The buckets of a uniform grid that a segment meets, one after the other.
#ifndef DARTSWEEP_TESTS_BENCHMARK_BUCKET_WALK_H
#define DARTSWEEP_TESTS_BENCHMARK_BUCKET_WALK_H

#include "engine.h"
#include "vector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace dsw::bench {

struct Buckets {
  double low[3], edge, inverse;  // edge of a bucket, and one over it
  std::int32_t size[3];

  std::int32_t at(double x, std::size_t k) const {
    return std::clamp(static_cast<std::int32_t>(std::floor((x - low[k]) * inverse)), 0, size[k] - 1);
  }
};

/** Calls test(bucket, answer) until an answer lies before the next bucket. */
template <typename Test>
inline Answer walk_buckets(const Buckets& buckets, const double* from, const double* to, Test&& test) {
  std::int32_t at[3], end[3];
  for (std::size_t k = 0; k < 3; ++k) {
    // A point outside walks in the outermost bucket of its row, where the walls it can meet are.
    at[k] = buckets.at(from[k], k);
    end[k] = buckets.at(to[k], k);
  }
  Answer answer;
  const std::int32_t stride[3] = {1, buckets.size[0], buckets.size[0] * buckets.size[1]};
  auto bucket = static_cast<std::ptrdiff_t>(at[0]) + static_cast<std::ptrdiff_t>(buckets.size[0]) *
                                                         (at[1] + static_cast<std::ptrdiff_t>(buckets.size[1]) * at[2]);
  test(static_cast<std::size_t>(bucket), answer);
  std::int32_t left = std::abs(end[0] - at[0]) + std::abs(end[1] - at[1]) + std::abs(end[2] - at[2]);
  if (left == 0) return answer;
  double next[3], delta[3];
  std::int32_t step[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = to[k] - from[k];
    step[k] = end[k] > at[k] ? 1 : -1;
    if (end[k] == at[k]) {
      next[k] = delta[k] = std::numeric_limits<double>::infinity();
    } else {
      const double side = buckets.low[k] + (at[k] + (step[k] > 0 ? 1 : 0)) * buckets.edge;
      next[k] = (side - from[k]) / along;
      delta[k] = buckets.edge / std::fabs(along);
    }
  }
  for (; left > 0; --left) {
    const std::size_t axis = next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : (next[1] <= next[2] ? 1 : 2);
    if (answer.wall != kNone && answer.time < next[axis] - 1e-12) break;
    at[axis] += step[axis];
    next[axis] = at[axis] == end[axis] ? std::numeric_limits<double>::infinity() : next[axis] + delta[axis];
    bucket += step[axis] * static_cast<std::ptrdiff_t>(stride[axis]);
    test(static_cast<std::size_t>(bucket), answer);
  }
  return answer;
}

}  // namespace dsw::bench

#endif
