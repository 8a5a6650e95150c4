#pragma once
// Balls that are known to hold nothing impassable: what an edge sweeps inside of one is free.

#include "base/position.h"
#include "environment/environment.h"

namespace dsw {

template <int D>
struct Clearance {
  double centre[D] = {};
  double radius = 0;                // 0: none is known
  uint64_t version = 0;             // of the environment when it was measured
  uint32_t wait = 0, patience = 1;  // moves until it is measured again where it was too small
  double wanted = 0;                // square of the longest edge that the last move had to cast for want of room

  bool is_known(const Environment<D>& env) const noexcept { return radius > 0 && version == env.obstacle_version; }
  /** Whether it is known to hold three points, and so all between them. */
  bool covers(const Environment<D>& env, const double* a, const double* b, const double* c) const noexcept {
    const double limit = radius * radius;
    return is_known(env) && distance_squared<D>(a, centre) < limit && distance_squared<D>(b, centre) < limit &&
           distance_squared<D>(c, centre) < limit;
  }
};

}  // namespace dsw
