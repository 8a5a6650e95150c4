#include "proximity/near_points.h"

#include <algorithm>
#include <utility>

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/near_signs.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

// Two points that are closer than this share of what is compared do not tell the direction between them.
constexpr double kTellingShare = 0x1p-45;
// Edges are nearly parallel up to this sine of their angle.
constexpr double kSlanted = 0x1p-9;

/** The direction of a way. A length below the least normal number has too few bits to divide by. */
Vec direction(const Vec& way, double length) { return length < 0x1p-1000 ? unit(way) : Vec(way / length); }

void set_normal(const Vec& way, double size, NearPoints& n) {
  n.distance = length(way);
  n.has_normal = n.distance > kTellingShare * size;
  n.normal = n.has_normal ? direction(way, n.distance) : Vec::Zero();
}

/** The share of b in the foot on edge ab of what lies at `x`, as seen from a. */
double share_of(const Vec& ab, const Vec& x) {
  const double size = largest(ab);
  if (!(size > 0)) return 0;
  const Vec u = ab / size;
  return std::clamp(dot(u, x) / size / dot(u, u), 0.0, 1.0);
}

Vec between(const Vec& a, const Vec& b, double share) {
  return share < 0.5 ? Vec(a + share * (b - a)) : Vec(b - (1 - share) * (b - a));
}

/** A point and an edge: the weight of b, the foot. `x` to foot is the way. */
template <int D>
double foot_on_edge(const double* x, const double* const* a, Vec& foot, Vec& way) {
  const Vec ab = difference<D>(a[1], a[0]), to = difference<D>(x, a[0]);
  const double share = share_of(ab, to);
  foot = between(to_vec<D>(a[0]), to_vec<D>(a[1]), share);
  // What is across is told from the nearer end.
  const Vec from_end = share < 0.5 ? to : difference<D>(x, a[1]);
  const Vec u = unit(ab);
  way = from_end - dot(from_end, u) * u;
  way -= dot(way, u) * u;
  return share;
}

/** Weights of a triangle's corners at the foot of x. In coordinates along the longest edge and across it, as
 * nearest_on of locate/distances.h. */
void foot_on_triangle(const double* x, const double* const* a, double* weights) {
  uint32_t first = 0;
  double longest = -1;
  for (uint32_t i = 0; i < 3; ++i) {
    const double l = length(difference<3>(a[(i + 1) % 3], a[i]));
    if (l > longest) longest = l, first = i;
  }
  const uint32_t i = first, j = (first + 1) % 3, k = (first + 2) % 3;
  const Vec u = unit(difference<3>(a[j], a[i])), ac = difference<3>(a[k], a[i]), at = difference<3>(x, a[i]);
  Vec height = ac - dot(ac, u) * u;
  height -= dot(height, u) * u;
  const double h = length(height), y = h > 0 ? std::clamp(dot(height / h, at) / h, 0.0, 1.0) : 0;
  const double along = (dot(at, u) - y * dot(ac, u)) / longest;
  weights[k] = y;
  weights[j] = std::clamp(along, 0.0, 1 - y);
  weights[i] = std::max(0.0, 1 - weights[j] - y);
}

/** A point x and a simplex of `count` points: weights of the simplex, foot, and the way from the foot to x. */
template <int D>
NearPoints point_to_simplex(const double* x, const double* const* a, uint32_t count) {
  NearPoints n;
  n.point = to_vec<D>(x);
  if (count == 1) {
    n.obstacle_point = to_vec<D>(a[0]);
    set_normal(difference<D>(x, a[0]), 0, n);
  } else if (count == 2 && D == 3) {
    Vec way;
    n.obstacle_weights[1] = foot_on_edge<D>(x, a, n.obstacle_point, way);
    n.obstacle_weights[0] = 1 - n.obstacle_weights[1];
    set_normal(way, length(difference<D>(x, a[0])), n);
  } else {
    double normal[3] = {};
    unit_normal<D>(a, normal);
    n.normal = to_vec<D>(normal);
    const double height = dot(n.normal, difference<D>(x, a[0]));
    const int side = orient<D>(a, x);
    if (side < 0) n.normal = -n.normal;
    n.has_normal = side != 0;
    n.distance = side == 0 ? 0 : std::fabs(height);
    if (D == 3) {
      foot_on_triangle(x, a, n.obstacle_weights);
    } else {
      n.obstacle_weights[1] = share_of(difference<D>(a[1], a[0]), difference<D>(x, a[0]));
      n.obstacle_weights[0] = 1 - n.obstacle_weights[1];
    }
    n.obstacle_point = n.point - n.distance * n.normal;
  }
  return n;
}

/** Exchanges the part and the obstacle. */
void turn_round(NearPoints& n) {
  std::swap(n.weights, n.obstacle_weights);
  std::swap(n.point, n.obstacle_point);
  n.normal = -n.normal;
}

/** Two edges of space. */
NearPoints edge_to_edge(const double* const* p, const double* const* a) {
  NearPoints n;
  const Vec d = difference<3>(p[1], p[0]), u = difference<3>(a[1], a[0]);
  const Vec along = unit(d), other = unit(u), across = along.cross(other);
  const double sine = length(across), size = std::max(length(d), length(difference<3>(p[0], a[0])));
  const Vec p0 = to_vec<3>(p[0]), p1 = to_vec<3>(p[1]), a0 = to_vec<3>(a[0]), a1 = to_vec<3>(a[1]);
  double s = 0, t = 0;
  n.point = p0;
  n.obstacle_point = a0;
  if (sine > kSlanted) {
    // Twice, the second time from the points found first: so what is lost is a share of the distance.
    for (int round = 0; round < 2; ++round) {
      const Vec way = n.obstacle_point - n.point;
      const Vec straight = along - dot(along, other) * other;  // of length `sine`, across the obstacle
      s = std::clamp(s + dot(straight, way) / (sine * sine) / length(d), 0.0, 1.0);
      n.point = between(p0, p1, s);
      t = share_of(u, n.point - a0);
      n.obstacle_point = between(a0, a1, t);
    }
  } else {
    s = exact_share({a[0], a[1]}, {p[0], p[1]}, {p[0], a[0]});
    t = exact_share({p[0], p[1]}, {a[0], a[1]}, {a[0], p[0]});
    n.point = between(p0, p1, s);
    n.obstacle_point = between(a0, a1, t);
  }
  n.weights[1] = s;
  n.weights[0] = 1 - s;
  n.obstacle_weights[1] = t;
  n.obstacle_weights[0] = 1 - t;
  // The direction between the points loses `size` over their distance, the direction across both edges 1 over the sine.
  const Vec way = n.point - n.obstacle_point;
  const double apart = length(way);
  if (apart > kTellingShare * size && apart >= sine * size) {
    n.distance = apart;
    n.normal = direction(way, apart);
    return n;
  }
  const int side = volume_sign({p[0], p[1]}, {a[0], a[1]}, {a[0], p[0]});
  n.has_normal = side != 0 && sine > kTellingShare;
  n.normal = n.has_normal ? Vec(across / (side < 0 ? -sine : sine)) : Vec::Zero();
  n.distance = side == 0 ? 0 : sine > kSlanted ? std::fabs(dot(n.normal, difference<3>(p[0], a[0]))) : apart;
  return n;
}

}  // namespace

template <int D>
NearPoints find_near_points(const double* const* p, uint32_t count, const double* const* a, uint32_t obstacle_count) {
  if (count == 1) return point_to_simplex<D>(p[0], a, obstacle_count);
  if (obstacle_count == 2) return edge_to_edge(p, a);
  NearPoints n = point_to_simplex<D>(a[0], p, count);
  turn_round(n);
  return n;
}

DSW_INSTANTIATE(find_near_points);

}  // namespace dsw
