#include "proximity/near_pair.h"

#include <algorithm>
#include <utility>

#include "predicates/filtered.h"
#include "predicates/near_signs.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

// Points of simplices below: one, two or three. D == 2 has no three.

/** Whether the foot of x lies inside of a simplex. */
template <int D>
bool foot_is_inside(const double* x, const double* const* a, uint32_t count) noexcept {
  if (count == 1) return true;
  if (count == 2) return dot_sign<D>({a[0], x}, {a[0], a[1]}) > 0 && dot_sign<D>({a[1], x}, {a[1], a[0]}) > 0;
  return lean_sign<D>({a[0], a[1]}, {a[0], a[2]}, {a[0], x}) > 0 &&
         lean_sign<D>({a[1], a[2]}, {a[1], a[0]}, {a[1], x}) > 0 &&
         lean_sign<D>({a[2], a[0]}, {a[2], a[1]}, {a[2], x}) > 0;
}

/** Whether the nearest points of two lines, which are not parallel, lie inside of edges on them. */
template <int D>
bool feet_are_inside(const double* const* p, const double* const* a) noexcept {
  return lean_sign<D>({a[0], a[1]}, {p[0], p[1]}, {p[0], a[0]}) > 0 &&
         lean_sign<D>({a[0], a[1]}, {p[1], p[0]}, {p[1], a[0]}) > 0 &&
         lean_sign<D>({p[0], p[1]}, {a[0], a[1]}, {a[0], p[0]}) > 0 &&
         lean_sign<D>({p[0], p[1]}, {a[1], a[0]}, {a[1], p[0]}) > 0;
}

/** Where two simplices are nearest, and in which direction. */
struct Measured {
  double weights[3] = {1, 0, 0}, obstacle_weights[3] = {1, 0, 0};
  Vec point, obstacle_point, normal;
  double distance = 0;
  bool has_normal = true;  // else the points are too close to tell it
};

// Two points that are closer than this share of what is compared do not tell the direction between them.
constexpr double kTellingShare = 0x1p-45;

void set_normal(const Vec& way, double size, Measured& n) {
  n.distance = length(way);
  n.has_normal = n.distance > kTellingShare * size;
  n.normal = n.has_normal ? Vec(way / n.distance) : Vec::Zero();
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
Measured point_to_simplex(const double* x, const double* const* a, uint32_t count) {
  Measured n;
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

/** The same the other way round. */
void turn_round(Measured& n) {
  std::swap(n.weights, n.obstacle_weights);
  std::swap(n.point, n.obstacle_point);
  n.normal = -n.normal;
}

/** Two edges of space. Shares are found twice, the second time from the points found first: then what nearly parallel
 * edges lose is a share of their distance. */
Measured edge_to_edge(const double* const* p, const double* const* a) {
  Measured n;
  const Vec d = difference<3>(p[1], p[0]), u = difference<3>(a[1], a[0]);
  const Vec along = unit(d), other = unit(u), across = along.cross(other);
  const double sine = length(across), size = std::max(length(d), length(difference<3>(p[0], a[0])));
  const Vec p0 = to_vec<3>(p[0]), p1 = to_vec<3>(p[1]), a0 = to_vec<3>(a[0]), a1 = to_vec<3>(a[1]);
  double s = 0, t = 0;
  n.point = p0;
  n.obstacle_point = a0;
  for (int round = 0; round < 2; ++round) {
    const Vec way = n.obstacle_point - n.point;
    const Vec straight = along - dot(along, other) * other;  // of length `sine`, across the obstacle
    s = std::clamp(s + dot(straight, way) / (sine * sine) / length(d), 0.0, 1.0);
    n.point = between(p0, p1, s);
    t = share_of(u, n.point - a0);
    n.obstacle_point = between(a0, a1, t);
  }
  n.weights[1] = s;
  n.weights[0] = 1 - s;
  n.obstacle_weights[1] = t;
  n.obstacle_weights[0] = 1 - t;
  // The direction by whichever of both ways loses less.
  const Vec way = n.point - n.obstacle_point;
  const double apart = length(way);
  if (apart * sine > size * 0x1p-8) {
    n.distance = apart;
    n.normal = way / apart;
    return n;
  }
  const int side = volume_sign({p[0], p[1]}, {a[0], a[1]}, {a[0], p[0]});
  n.normal = across / sine;
  n.distance = std::fabs(dot(n.normal, difference<3>(p[0], a[0])));
  if (sine < 0x1p-20) n.distance = apart;
  if (side < 0) n.normal = -n.normal;
  if (side == 0) n.distance = 0;
  n.has_normal = side != 0;
  return n;
}

}  // namespace

template <int D>
void PairSearch<D>::bound(const Part<D>& part, double* lower, double* upper) const noexcept {
  for (int k = 0; k < D; ++k) {
    lower[k] = upper[k] = part.points[0][k];
    for (uint32_t i = 1; i < part.corners.count; ++i) {
      lower[k] = std::min(lower[k], part.points[i][k]);
      upper[k] = std::max(upper[k], part.points[i][k]);
    }
    lower[k] -= reach_;
    upper[k] += reach_;
  }
}

template <int D>
bool PairSearch<D>::is_apart(const NearObstacle<D>& o, const double* lower, const double* upper) const noexcept {
  bool apart = false;
  for (int k = 0; k < D; ++k) {
    double low = points_[o.vertices[0]][k], high = low;
    for (uint32_t i = 1; i < o.count; ++i) {
      const double x = points_[o.vertices[i]][k];
      low = x < low ? x : low;
      high = high < x ? x : high;
    }
    apart |= (low > upper[k]) | (high < lower[k]);
  }
  return apart;
}

template <int D>
NearFeature PairSearch<D>::choose(const NearObstacle<D>& o, uint32_t bits) noexcept {
  NearFeature f;
  for (uint32_t i = 0; i < o.count; ++i) {
    if ((bits >> i & 1) != 0) f.vertices[f.count++] = o.vertices[i];
  }
  if (f.count > 1 && f.vertices[0] > f.vertices[1]) std::swap(f.vertices[0], f.vertices[1]);
  if (f.count > 2 && f.vertices[1] > f.vertices[2]) std::swap(f.vertices[1], f.vertices[2]);
  if (f.count > 2 && f.vertices[0] > f.vertices[1]) std::swap(f.vertices[0], f.vertices[1]);
  return f;
}

namespace {

template <int D>
bool has_all(const NearObstacle<D>& o, const NearFeature& f) noexcept {
  bool all = f.count <= o.count;
  for (uint32_t i = 0; all && i < f.count; ++i) all = o.has(f.vertices[i]);
  return all;
}

}  // namespace

template <int D>
bool PairSearch<D>::is_first_with(const NearFeature& f, size_t number) const noexcept {
  for (size_t i = 0; i < number; ++i) {
    if (has_all(obstacles_[i], f)) return false;
  }
  return true;
}

template <int D>
bool PairSearch<D>::are_inside(const Part<D>& part, const NearFeature& f) const noexcept {
  const uint32_t m = part.corners.count;
  if (m + f.count > D + 1) return false;
  const double* a[3] = {};
  for (uint32_t i = 0; i < f.count; ++i) a[i] = points_[f.vertices[i]];
  if (m == 1) return foot_is_inside<D>(part.points[0], a, f.count);
  if (f.count == 1) return foot_is_inside<D>(a[0], part.points, m);
  return feet_are_inside<D>(part.points, a);
}

// With x the point of the part and y that of the feature, a vertex z of an obstacle comes closer if (z - y).(x - y) > 0.
// Here y may be replaced by any vertex of the feature, since the feature is perpendicular to x - y.
template <int D>
bool PairSearch<D>::is_local_minimum(const Part<D>& part, const NearFeature& f) const noexcept {
  const uint32_t m = part.corners.count;
  const double* const* const p = part.points;
  const double* const a = points_[f.vertices[0]];
  int side = 0;
  if constexpr (D == 3) {
    if (m == 2 && f.count == 2) side = volume_sign({p[0], p[1]}, {a, points_[f.vertices[1]]}, {a, p[0]});
    if (m == 3) side = volume_sign({p[0], p[1]}, {p[0], p[2]}, {p[0], a});
  }
  const auto comes_closer = [&](const double* z) {
    if (m == 1 && f.count == 1) return dot_sign<D>({a, z}, {a, p[0]}) > 0;
    if (m == 1) return lean_sign<D>({a, points_[f.vertices[1]]}, {a, z}, {a, p[0]}) > 0;
    if (m == 2 && f.count == 1) return lean_sign<D>({p[0], p[1]}, {a, z}, {p[0], a}) < 0;
    if constexpr (D == 3) {
      if (m == 2) return side * volume_sign({p[0], p[1]}, {a, points_[f.vertices[1]]}, {a, z}) > 0;
      return side * volume_sign({p[0], p[1]}, {p[0], p[2]}, {a, z}) < 0;
    }
    return false;
  };
  for (const NearObstacle<D>& o : obstacles_) {
    if (o.count == f.count || !has_all(o, f)) continue;
    for (uint32_t i = 0; i < o.count; ++i) {
      const uint32_t v = o.vertices[i];
      const bool is_own = v == f.vertices[0] || v == f.vertices[1] || v == f.vertices[2];
      if (!is_own && comes_closer(points_[v])) return false;
    }
  }
  return true;
}

template <int D>
HalfFacet PairSearch<D>::find_wall(const NearFeature& f, const double* point, size_t& number) const noexcept {
  const Map<D>& map = env_.map;
  HalfFacet wall, lowest;
  bool is_seen = false;
  for (size_t i = 0; i < obstacles_.size(); ++i) {
    const NearObstacle<D>& o = obstacles_[i];
    if (!o.facet.valid() || !has_all(o, f)) continue;
    const double* corners[D];
    for (int k = 0; k < D; ++k) corners[k] = points_[o.vertices[k]];
    const bool sees = orient<D>(corners, point) <= 0;
    const HalfFacet name = canonical(map, o.facet);
    const auto key = [&](HalfFacet h) {
      const Cell c = map.cell_of(h);
      return std::pair(map.index(c), map.local_of(h, c));
    };
    const bool is_lower = !wall.valid() || key(name) < key(lowest) || (name == lowest && key(o.facet) < key(wall));
    if (wall.valid() && (is_seen != sees ? is_seen : !is_lower)) continue;
    wall = o.facet;
    lowest = name;
    is_seen = sees;
    number = i;
  }
  return wall;
}

template <int D>
Vec PairSearch<D>::normal_of(size_t number) const noexcept {
  const double* corners[D];
  for (int k = 0; k < D; ++k) corners[k] = points_[obstacles_[number].vertices[k]];
  double outward[3] = {};
  unit_normal<D>(corners, outward);
  return -to_vec<3>(outward);
}

template <int D>
bool PairSearch<D>::measure(const Part<D>& part, const NearFeature& f, size_t number,
                            NearPair<D>& pair) const noexcept {
  const uint32_t m = part.corners.count;
  const double* a[3] = {};
  for (uint32_t i = 0; i < f.count; ++i) a[i] = points_[f.vertices[i]];
  Measured n;
  if (m == 1) {
    n = point_to_simplex<D>(part.points[0], a, f.count);
  } else if (f.count == 1) {
    n = point_to_simplex<D>(a[0], part.points, m);
    turn_round(n);
  } else {
    n = edge_to_edge(part.points, a);
  }
  if (!(n.distance <= reach_)) return false;
  pair.part = part.simplex;
  pair.body.count = m;
  std::copy_n(part.corners.vertices, m, pair.body.vertices);
  pair.obstacle = f;
  std::copy_n(n.weights, 3, pair.weights);
  std::copy_n(n.obstacle_weights, 3, pair.obstacle_weights);
  store<3>(n.point, pair.point);
  store<3>(n.obstacle_point, pair.obstacle_point);
  pair.wall = find_wall(f, pair.point, number);
  pair.cell = obstacles_[number].cell;
  if (!n.has_normal) n.normal = pair.wall.valid() ? normal_of(number) : is_zero(n.normal) ? Vec(1, 0, 0) : n.normal;
  store<3>(n.normal + Vec::Zero(), pair.normal);  // never -0
  pair.distance = n.distance;
  return true;
}

template class PairSearch<2>;
template class PairSearch<3>;

}  // namespace dsw
