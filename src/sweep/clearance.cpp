#include "sweep/clearance.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "base/position.h"
#include "locate/nearest.h"

namespace dsw {
namespace {

constexpr uint32_t kMostPatience = 1024;
constexpr double kReach = 4;    // how far is measured, in units of what is needed
constexpr double kLasts = 1.5;  // a ball of so many of these units is not left at once
// Credit, in hundredths of a cast: half of what is saved may be spent again, and a twentieth of what is not. A cell
// that a measurement looks at takes as long as some 25 casts.
constexpr int64_t kSaved = 50, kSwept = 5, kCell = 2500, kMostOfEdge = 200;
// The distance to an obstacle is rounded. What is left of a ball is free if that error, a few units in the last place
// of the coordinates, is smaller than what is left out of it. The obstacle's count too: its ends can be far from where
// it is near.
constexpr double kKept = 0.999, kLeastShare = 1e-9;

/** Takes the ball of a neighbour, if that is large enough. */
template <int D>
bool borrow(const Environment<D>& env, Body<D>& body, uint32_t v, double needed) noexcept {
  Clearance<D>& ball = body.clearances[v];
  bool found = false;
  for_each_edge(body, v, [&](uint32_t e) {
    const Clearance<D>& other = body.clearances[body.edges[e].other(v)];
    found = room_squared(env, other, body.position(v), 0) > needed * needed;
    if (!found) return true;
    std::copy_n(other.centre, D, ball.centre);
    ball.radius = other.radius;
    ball.version = other.version;
    return false;
  });
  return found;
}

/** False if it can't be paid. */
template <int D>
bool measure(const Environment<D>& env, Body<D>& body, uint32_t v, double needed) {
  const double reach = kReach * needed;
  // The extent of points that have moved, which bounds the rounding below, is not known. And with each deformation
  // balls are gone.
  if (env.has_moved() || body.clearance_credit < 0 || !std::isfinite(reach)) return false;
  Clearance<D>& ball = body.clearances[v];
  const double* const at = body.position(v);
  NearestResult nearest;
  const bool found = find_nearest(env, at, body.vertices[v].cell, reach, nearest);
  body.clearance_credit -= kCell * nearest.volumes_visited;
  const double radius = kKept * (found ? nearest.distance : reach);
  const double largest = std::max(reach, largest_coordinate<D>(env.lower, env.upper));
  std::copy_n(at, D, ball.centre);
  ball.radius = radius > kLeastShare * largest ? radius : 0;
  ball.version = env.obstacle_version;
  return true;
}

}  // namespace

template <int D>
double room_squared(const Environment<D>& env, const Clearance<D>& ball, const double* at, double way) noexcept {
  if (!ball.is_known(env)) return 0;
  const double room = ball.radius - std::sqrt(distance_squared<D>(at, ball.centre)) - way;
  return room > 0 ? room * room : 0;
}

template <int D>
void refresh_clearance(const Environment<D>& env, Body<D>& body, uint32_t v, double needed) {
  Clearance<D>& ball = body.clearances[v];
  if (ball.wait != 0) {
    --ball.wait;
    return;
  }
  if ((borrow(env, body, v, needed) || measure(env, body, v, needed)) && ball.radius > kLasts * needed) {
    ball.patience = 1;
    return;
  }
  ball.wait = ball.patience;
  ball.patience = std::min(2 * ball.patience, kMostPatience);
}

template <int D>
void earn_credit(Body<D>& body, uint32_t saved, uint32_t swept) noexcept {
  const int64_t most = kMostOfEdge * static_cast<int64_t>(body.edges.size());
  body.clearance_credit = std::min(body.clearance_credit + kSaved * saved + kSwept * swept, most);
}

DSW_INSTANTIATE(room_squared);
DSW_INSTANTIATE(refresh_clearance);
DSW_INSTANTIATE(earn_credit);

}  // namespace dsw
