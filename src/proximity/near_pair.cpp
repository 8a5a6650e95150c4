#include "proximity/near_pair.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "base/search.h"
#include "predicates/filtered.h"
#include "predicates/near_signs.h"
#include "predicates/plane_hit.h"
#include "proximity/near_points.h"
#include "proximity/rough.h"

namespace dsw {
namespace {

// Points of simplices below: one, two or three. D == 2 has no three.

/** Signs with a point of a body at the end of w. The shift counts where the other points are the environment's. Between
 * bodies it cancels. */
template <int D>
struct Signs {
  bool is_shifted;

  int dot(Arrow u, Arrow w) const noexcept { return is_shifted ? shifted_dot_sign<D>(u, w) : dot_sign<D>(u, w); }
  int lean(Arrow u, Arrow v, Arrow w) const noexcept {
    return is_shifted ? shifted_lean_sign<D>(u, v, w) : lean_sign<D>(u, v, w);
  }
  /** Whether the foot of x lies inside of a simplex. */
  bool is_foot_inside(const double* x, const double* const* a, uint32_t count) const noexcept {
    if (count == 1) return true;
    if (count == 2) return dot({a[0], a[1]}, {a[0], x}) > 0 && dot({a[1], a[0]}, {a[1], x}) > 0;
    return lean({a[0], a[1]}, {a[0], a[2]}, {a[0], x}) > 0 && lean({a[1], a[2]}, {a[1], a[0]}, {a[1], x}) > 0 &&
           lean({a[2], a[0]}, {a[2], a[1]}, {a[2], x}) > 0;
  }
};

/** Whether the nearest points of two lines, which are not parallel, lie inside of edges on them. */
template <int D>
bool feet_are_inside(const double* const* p, const double* const* a) noexcept {
  return lean_sign<D>({a[0], a[1]}, {p[0], p[1]}, {p[0], a[0]}) > 0 &&
         lean_sign<D>({a[0], a[1]}, {p[1], p[0]}, {p[1], a[0]}) > 0 &&
         lean_sign<D>({p[0], p[1]}, {a[0], a[1]}, {a[0], p[0]}) > 0 &&
         lean_sign<D>({p[0], p[1]}, {a[1], a[0]}, {a[1], p[0]}) > 0;
}

/** Whether two obstacles are both sides of one wall, or the same side. */
template <int D>
bool is_same_wall(const WallFeature& a, const WallFeature& b) noexcept {
  if (!a.facet.valid() || !b.facet.valid()) return false;
  uint32_t shared = 0;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) shared += a.vertices[i] == b.vertices[k];
  }
  return shared == D;
}

}  // namespace

template <int D>
bool PairSearch<D>::is_far(const Part<D>& part, const NearFeature& f) const noexcept {
  const Vec p = to_vec<D>(part.points[0]), a = to_vec<D>(list_.point(f.corners[0])), w = p - a;
  const auto edge_of_part = [&] { return Vec(to_vec<D>(part.points[1]) - p); };
  const auto edge_of_feature = [&] { return Vec(to_vec<D>(list_.point(f.corners[1])) - a); };
  switch (part.corners.count * 4 + f.count) {
    case 5:
      return rough::is_far_from_point(w, far_);
    case 6:
      return rough::is_far_from_edge(edge_of_feature(), w, far_, 0);
    case 7:
      return rough::Triangle(edge_of_feature(), to_vec<D>(list_.point(f.corners[2])) - a).is_far(w, far_, 0);
    case 9:
      return rough::is_far_from_edge(edge_of_part(), -w, far_, 0);
    case 10:
      return rough::are_far_lines(edge_of_part(), edge_of_feature(), w, far_);
    default:
      return rough::Triangle(edge_of_part(), to_vec<D>(part.points[2]) - p).is_far(-w, far_, 0);
  }
}

template <int D>
bool PairSearch<D>::are_inside(const Part<D>& part, const NearFeature& f) const noexcept {
  const double* a[3] = {};
  corners_of(list_, f, a);
  if (part.corners.count == 1) return Signs<D>{is_shifted_}.is_foot_inside(part.points[0], a, f.count);
  if (f.count == 1) return Signs<D>{false}.is_foot_inside(a[0], part.points, part.corners.count);
  return feet_are_inside<D>(part.points, a);
}

// Let x be the point of the part and y that of the feature. A vertex z of an obstacle comes closer if
// (z - y).(x - y) > 0. Any corner of the feature may stand for y, since the feature is perpendicular to x - y.
template <int D>
bool PairSearch<D>::is_local_minimum(const Part<D>& part, const NearFeature& f, const uint32_t* around,
                                     const uint32_t* around_end) const noexcept {
  if (around == around_end) return true;
  const uint32_t m = part.corners.count;
  const double* const* const p = part.points;
  const double* a[3] = {};
  corners_of(list_, f, a);
  const Signs<D> signs{is_shifted_};
  int side = 0;
  if constexpr (D == 3) {
    if (m == 2 && f.count == 2) side = volume_sign({p[0], p[1]}, {a[0], a[1]}, {a[0], p[0]});
    if (m == 3) side = volume_sign({p[0], p[1]}, {p[0], p[2]}, {p[0], a[0]});
  }
  bool is_flat_before = false, is_flat_behind = false;
  const auto comes_closer = [&](uint32_t vertex) {
    const Arrow z{a[0], list_.point(vertex)};
    if (m == 1 && f.count == 1) return signs.dot(z, {a[0], p[0]}) > 0;
    if (m == 1) return signs.lean({a[0], a[1]}, z, {a[0], p[0]}) > 0;
    if (m == 2 && f.count == 1) return lean_sign<D>({p[0], p[1]}, z, {p[0], a[0]}) < 0;
    if constexpr (D == 3) {
      if (m == 2) {
        const int closer = side * volume_sign({p[0], p[1]}, {a[0], a[1]}, z);
        // The part runs parallel to the triangle of z, before or behind the edge.
        if (closer == 0 && side != 0) {
          (lean_sign<D>({a[0], a[1]}, z, {p[0], p[1]}) > 0 ? is_flat_before : is_flat_behind) = true;
        }
        return closer > 0;
      }
      return side * volume_sign({p[0], p[1]}, {p[0], p[2]}, z) < 0;
    }
    return false;
  };
  return dsw::none_of(around, around_end, comes_closer) && !(is_flat_before && is_flat_behind);
}

template <int D>
bool PairSearch<D>::is_least_in_fan(const Part<D>& part, PassableFan<D>& fan, const NearPair<D>& pair) const {
  const NearFeature& f = pair.feature;
  Array<uint32_t> around(env_.memory);
  list_.for_each_obstacle(f, [&](uint32_t i) {
    const WallFeature& o = list_.obstacles()[i];
    if (!fan.reaches(cell_at(o))) return;
    for (uint32_t k = 0; k < o.count; ++k) {
      if (dsw::find(f.corners, f.corners + f.count, o.vertices[k]) == f.corners + f.count)
        around.push_back(o.vertices[k]);
    }
  });
  return is_local_minimum(part, f, around.begin(), around.end());
}

template <int D>
bool PairSearch<D>::has_fans(uint32_t feature) const {
  const NearFeature& f = list_.features()[feature];
  if (!f.has_fans || f.is_counted) return f.has_fans;
  uint32_t names[3];
  for (uint32_t i = 0; i < f.count; ++i) names[i] = list_.name(f.corners[i]);
  CellQueue cells(env_.memory);
  std::optional<PassableFan<D>> fan;
  bool is_one = true;
  list_.for_each_obstacle(f, [&](uint32_t i) {
    const Cell c = cell_at(list_.obstacles()[i]);
    if (!fan) fan.emplace(env_, c, names, f.count, cells);
    is_one = is_one && fan->reaches(c);
  });
  list_.set_fans(feature, !is_one);
  return !is_one;
}

template <int D>
ObstaclesAtFeature& PairSearch<D>::obstacles_at(uint32_t feature) const {
  ObstaclesAtFeature& known = list_.known_of(feature);
  if (known.count != 0) return known;
  Array<uint32_t>& all = list_.obstacles_at();
  const size_t begin = all.size();
  list_.for_each_obstacle(list_.features()[feature], [&](uint32_t i) { all.push_back(i); });
  known.begin = static_cast<uint32_t>(begin);
  known.is_one_wall = dsw::all_of(all.data() + begin, all.data() + all.size(), [&](uint32_t i) {
    return is_same_wall<D>(list_.obstacles()[all[begin]], list_.obstacles()[i]);
  });
  known.count = static_cast<uint32_t>(all.size() - begin);
  return known;
}

template <int D>
bool PairSearch<D>::find_wall(PassableFan<D>& fan, NearPair<D>& pair) const {
  const Map<D>& map = env_.map;
  const NearFeature& f = pair.feature;
  // The lowest one: by its canonical name, then the canonical side.
  const auto key = [&](HalfFacet h) {
    const HalfFacet first = canonical(map, h);
    const Cell c = map.cell_of(first);
    return std::tuple(map.index(c), map.local_of(first, c), first != h);
  };
  Vec way, along;
  /** The cosine of the least angle between the way and a side of a triangle at the feature. */
  const auto closeness = [&](const WallFeature& o) {
    double most = -2;
    for (uint32_t i = 0; i < o.count; ++i) {
      if (dsw::find(f.corners, f.corners + f.count, o.vertices[i]) != f.corners + f.count) continue;
      const Vec to = to_vec<D>(list_.point(o.vertices[i])) - to_vec<D>(list_.point(f.corners[0]));
      most = std::max(most, dot(unit(to - dot(to, along) * along), way));
    }
    return most;
  };
  ObstaclesAtFeature& known = obstacles_at(pair.feature_number);
  const uint32_t* const at = list_.obstacles_at().data() + known.begin;
  const uint32_t* const at_end = at + known.count;
  // If all of them are sides of one wall, they make the same angle.
  const bool is_one = known.is_one_wall;
  if (!is_one) {
    way = unit(to_vec<3>(pair.point) - to_vec<3>(pair.obstacle_point));
    if (f.count == 2) along = unit(to_vec<D>(list_.point(f.corners[1])) - to_vec<D>(list_.point(f.corners[0])));
  }
  uint32_t found = kNone;
  double most = 0;
  const auto offer = [&](uint32_t i) {
    const WallFeature& o = list_.obstacles()[i];
    if (!o.facet.valid()) {
      if (found == kNone) found = i;
      return;
    }
    const double close = is_one ? 0 : closeness(o);
    if (pair.wall.valid() && close < most) return;
    const double* corners[D];
    for (int k = 0; k < D; ++k) corners[k] = list_.point(o.vertices[k]);
    const int side = orient<D>(corners, pair.point);
    const bool is_seen = (side != 0 ? side : exact::plane_side<D>(corners, pair.point).sign) <= 0;
    if (pair.wall.valid() && close == most) {
      if (is_seen != pair.is_wall_seen ? !is_seen : key(pair.wall) < key(o.facet)) return;
    }
    found = i;
    most = close;
    pair.wall = o.facet;
    pair.is_wall_seen = is_seen;
  };
  // What is nearest in angle is nearly always in the fan. So the fan is asked once, and not for each obstacle.
  for (const uint32_t* i = at; i != at_end; ++i) offer(*i);
  const Cell cell = cell_at(list_.obstacles()[found]);
  if ((known.from == fan.first() && known.to == cell) || fan.reaches(cell)) {
    known.from = fan.first();
    known.to = cell;
  } else {
    found = kNone;
    pair.wall = {};
    for (const uint32_t* i = at; i != at_end; ++i) {
      if (fan.reaches(cell_at(list_.obstacles()[*i]))) offer(*i);
    }
    if (found == kNone) return false;
  }
  pair.cell = fan.first();
  if (!pair.has_normal && pair.wall.valid()) store<3>(normal_of(found) + Vec::Zero(), pair.normal);  // never -0
  return true;
}

template <int D>
Vec PairSearch<D>::normal_of(uint32_t obstacle) const noexcept {
  const double* corners[D];
  for (int k = 0; k < D; ++k) corners[k] = list_.point(list_.obstacles()[obstacle].vertices[k]);
  double outward[3] = {};
  unit_normal<D>(corners, outward);
  return -to_vec<3>(outward);
}

template <int D>
bool PairSearch<D>::measure(const Part<D>& part, const NearFeature& f, NearPair<D>& pair) const noexcept {
  const uint32_t m = part.corners.count;
  const double* a[3] = {};
  corners_of(list_, f, a);
  NearPoints n = find_near_points<D>(part.points, m, a, f.count);
  if (!(n.distance <= reach_)) return false;
  pair.part = part.simplex;
  std::copy_n(part.corners.vertices, m, pair.vertices);
  pair.feature = f;
  for (uint32_t i = 0; i < f.count; ++i) pair.obstacle_vertices[i] = list_.name(f.corners[i]);
  std::copy_n(n.weights, 3, pair.weights);
  std::copy_n(n.obstacle_weights, 3, pair.obstacle_weights);
  store<3>(n.point, pair.point);
  store<3>(n.obstacle_point, pair.obstacle_point);
  pair.has_normal = n.has_normal;
  if (!n.has_normal && is_zero(n.normal)) n.normal = Vec(1, 0, 0);
  store<3>(n.normal + Vec::Zero(), pair.normal);  // never -0
  pair.distance = n.distance;
  return true;
}

template class PairSearch<2>;
template class PairSearch<3>;

}  // namespace dsw
