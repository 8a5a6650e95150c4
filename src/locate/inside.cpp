#include "locate/inside.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/points.h"
#include "locate/distances.h"
#include "locate/locate.h"
#include "predicates/plane_hit.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Keeps the first of the obstacles that are offered at the same distance, or the nearest one. */
template <int D>
struct Best {
  const Distances<D>& distances;
  SeenObstacle seen;
  double distance = HUGE_VAL;
  Vec way{};

  void offer(double at, const Vec& to, const SeenObstacle& next) {
    if (at > distance) return;
    if (at == distance && seen.cell.valid() && !precedes(next)) return;
    distance = at;
    way = to;
    seen = next;
  }

 private:
  /** What is seen from two cells counts as seen from the one with the lower index, in whatever order they were looked at. */
  bool precedes(const SeenObstacle& next) const {
    if (distances.precedes(next.feature, seen.feature)) return true;
    if (distances.precedes(seen.feature, next.feature)) return false;
    const Map<D>& map = distances.environment().map;
    return map.index(next.cell) < map.index(seen.cell);
  }
};

/** Offers the obstacles at a passable cell on which the point lies. */
template <int D>
void look_for_touched(const Environment<D>& env, Cell c, const double* point, Best<D>& best) {
  if (!c.valid() || is_closed(env, c)) return;
  bool inside = false;
  if (classify(env, point, c, &inside).dimension == D) return;
  const Shape shape = env.map.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const HalfFacet h = env.map.half_facet(c, f);
    if (is_impassable(env, h) && lies_on(env, {D - 1, c, f}, point)) best.offer(0, {}, {best.distances.name(h), h, c});
  }
  best.distances.for_each_thin(c, shape, [&](double, const Vec&, const FeatureRef& feature) {
    if (lies_on(env, feature, point)) best.offer(0, {}, {feature, {}, c});
  });
}

/** The nearest wall of a passable cell, by rounded distances. */
template <int D>
SeenObstacle find_nearest_wall(const Environment<D>& env, const double* point, double* place) {
  const Distances<D> distances(env, point);
  Best<D> best{distances, {}};
  const auto look = [&](Cell c) {
    if (!c.valid() || is_closed(env, c)) return;
    const uint32_t facets = env.map.facets_of(c);
    for (uint32_t f = 0; f < facets; ++f) {
      const HalfFacet h = env.map.half_facet(c, f);
      if (!is_impassable(env, h)) continue;
      const FeatureRef name = distances.name(h);
      const Vec way = distances.to_obstacle(name);
      best.offer(Distances<D>::length(way), way, {name, h, c});
    }
  };
  const CellTree<D>* const tree = distances.scale() == 1 ? env.obstacles.find(env) : nullptr;
  const auto visit = [&](uint32_t index) {
    look(env.map.cell(index));
    return best.distance + 0x1p-44 * (best.distance + tree->length());
  };
  bool is_done = false;
  if (tree != nullptr) {
    env.obstacles.for_each_beside(*tree, visit);
    is_done = tree->visit_near(point, HUGE_VAL, visit);
  }
  if (!is_done) {
    for_each_cell(env.map, look);
    env.obstacles.note_flood(env, env.map.cell_count);
  }
  for (int k = 0; k < D; ++k) place[k] = point[k] + best.way[k] / distances.scale();
  return best.seen;
}

/** A unit in the last place of the largest coordinate. */
template <int D>
double rounding(const Environment<D>& env, const double* point) {
  const double size = largest_coordinate<D>(point, env.lower, env.upper);
  return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

/** The unit normal into a cell of the triangle, or side, of its facet that is nearest to a point. */
template <int D>
Vec inward_normal(const Environment<D>& env, HalfFacet h, const double* point) {
  const Cell c = env.map.cell_of(h);
  const Shape shape = env.map.shape(c);
  const uint32_t f = env.map.local_of(h, c);
  const Distances<D> distances(env, point);
  double normal[D] = {}, least = HUGE_VAL;
  for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
    const double distance = Distances<D>::length(distances.to_simplex(c, shape, s));
    const double* simplex[D];
    simplex_points(env, c, shape, s, simplex);
    if (distance < least) unit_normal<D>(simplex, normal);
    least = std::min(least, distance);
  }
  return -to_vec<D>(normal);
}

/** Looks for a place near one on the boundary of passable space. */
template <int D>
class Inward {
 public:
  Inward(const Environment<D>& env, const SeenObstacle& seen, const double* place)
      : env_(env), cell_(seen.cell), place_(to_vec<D>(place)) {
    double middle[D];
    centre(env, cell_, middle);
    to_centre_ = to_vec<D>(middle) - place_;
    normal_ = seen.side.valid() ? inward_normal(env, seen.side, place) : Vec::Zero();
  }

  /** The place's cell, or an invalid one. */
  Cell find(double by, double* inside) const {
    const double most = length(to_centre_);
    for (double step = std::max(by, rounding(env_, place_.data()));; step *= 2) {
      for (const Vec& way : {Vec(step * normal_), Vec(std::min(step, most) * unit(to_centre_))}) {
        const Cell c = is_zero(way) ? Cell{} : free_cell(place_ + way, inside);
        if (c.valid()) return c;
      }
      if (!(step < most)) return free_cell(place_ + to_centre_, inside);
    }
  }

 private:
  /** The cell of a place that is free and can be seen from the centre; else an invalid one. */
  Cell free_cell(const Vec& at, double* inside) const {
    double point[D], middle[D];
    store<D>(at, point);
    if (!is_finite<D>(point)) return {};
    centre(env_, cell_, middle);
    Cell c;
    if (contains(env_, cell_, middle)) {
      const CastResult path = cast(env_, middle, point, cell_);
      if (path.end == CastEnd::kReached) c = path.cell;
    } else {  // a sliver, from whose rounded centre nothing may be cast
      c = locate(env_, point, Cell{}, nullptr).cell;
    }
    if (!c.valid() || is_closed(env_, c) || find_touched(env_, point, c).cell.valid()) return {};
    std::copy_n(point, D, inside);
    return c;
  }

  const Environment<D>& env_;
  Cell cell_;
  Vec place_, to_centre_, normal_;
};

}  // namespace

template <int D>
SeenObstacle find_touched(const Environment<D>& env, const double* point) noexcept {
  const Distances<D> distances(env, point);
  Best<D> best{distances, {}};
  const auto look = [&](uint32_t index) {
    const Cell c = env.map.cell(index);
    if (c.valid() && box_holds(env, c, point)) look_for_touched(env, c, point, best);
  };
  if (!env.index.visit(env, point, look)) {
    for (uint32_t i = 0, count = env.map.index_count(); i < count; ++i) look(i);
  }
  return best.seen;
}

template <int D>
SeenObstacle find_touched(const Environment<D>& env, const double* point, Cell c) noexcept {
  bool inside = false;
  if (c.valid() && classify(env, point, c, &inside).dimension == D) return {};
  return find_touched(env, point);
}

template <int D>
SeenObstacle find_touched_near(const Environment<D>& env, const double* point, Cell c, double distance) noexcept {
  return distance <= 0x1p12 * rounding(env, point) ? find_touched(env, point, c) : SeenObstacle{};
}

template <int D>
Cell find_inside(const Environment<D>& env, const double* point, Cell hint, double by, double* inside) {
  const Cell c = locate(env, point, hint, nullptr).cell;
  SeenObstacle seen = find_touched(env, point, c);
  std::copy_n(point, D, inside);
  if (!seen.cell.valid()) {
    if (c.valid() && !is_closed(env, c)) return c;
    double place[D];
    seen = find_nearest_wall(env, point, place);
    return seen.cell.valid() ? Inward<D>(env, seen, place).find(by, inside) : Cell{};
  }
  return Inward<D>(env, seen, point).find(by, inside);
}

#define DSW_INSIDE(D)                                                                                   \
  template SeenObstacle find_touched(const Environment<D>&, const double*) noexcept;                    \
  template SeenObstacle find_touched(const Environment<D>&, const double*, Cell) noexcept;              \
  template SeenObstacle find_touched_near(const Environment<D>&, const double*, Cell, double) noexcept; \
  template Cell find_inside(const Environment<D>&, const double*, Cell, double, double*)
DSW_INSIDE(2);
DSW_INSIDE(3);
#undef DSW_INSIDE

}  // namespace dsw
