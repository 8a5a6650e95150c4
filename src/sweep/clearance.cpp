#include "sweep/clearance.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "motion/nearest.h"

namespace dsw {
namespace {

constexpr uint32_t kMostPatience = 1024;
constexpr double kReach = 2;  // how far is measured, in units of what is needed
// The distance to an obstacle is rounded. What is left of a ball is free if that error, a few units in the last place of the
// coordinates, is smaller than what is left out of it. The obstacle's count too: its ends can be far from where it is near.
constexpr double kKept = 0.999, kLeastShare = 1e-9;

bool is_known(const Environment<3>& env, const Clearance& ball) noexcept {
  return ball.radius > 0 && ball.version == env.obstacle_version;
}

}  // namespace

bool covers(const Environment<3>& env, const Clearance& ball, const double* a, const double* b,
            const double* c) noexcept {
  const double limit = ball.radius * ball.radius;
  return is_known(env, ball) && distance_squared(a, ball.centre) < limit && distance_squared(b, ball.centre) < limit &&
         distance_squared(c, ball.centre) < limit;
}

void refresh_clearance(const Environment<3>& env, Body& body, uint32_t v, double needed) {
  Clearance& ball = body.clearances[v];
  const double* const at = body.position(v);
  if (is_known(env, ball) && length(difference(at, ball.centre)) + needed < ball.radius) return;
  if (ball.wait != 0) {
    --ball.wait;
    return;
  }
  NearestResult nearest;
  const double reach = kReach * needed;
  if (!std::isfinite(reach)) return;
  const bool found = find_nearest(env, at, body.vertices[v].cell, reach, nearest);
  const double radius = kKept * (found ? nearest.distance : reach);
  double largest = reach;
  for (int k = 0; k < 3; ++k) largest = std::max({largest, std::fabs(env.lower[k]), std::fabs(env.upper[k])});
  std::copy_n(at, 3, ball.centre);
  ball.radius = radius > kLeastShare * largest ? radius : 0;
  ball.version = env.obstacle_version;
  if (ball.radius > needed) {
    ball.patience = 1;
    return;
  }
  ball.wait = ball.patience;
  ball.patience = std::min(2 * ball.patience, kMostPatience);
}

}  // namespace dsw
