#include "proximity/thick_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/search.h"
#include "base/sort.h"

namespace dsw {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** The box of all that is within a distance of a hull. */
template <int D>
Box<D> box_round(const ConvexHull& hull, double reach) noexcept {
  Box<D> box;
  for (uint32_t i = 0; i < hull.count; ++i) box.add(hull.points[i]);
  return widened(box, reach);
}

template <int D>
bool is_in(const Box<D>& box, const ConvexHull& hull) noexcept {
  return box.overlaps(hull.points, static_cast<int>(hull.count));
}

template <int D>
bool precedes(const TooNear<D>& a, const TooNear<D>& b) noexcept {
  if (a.time != b.time) return a.time < b.time;
  if (a.part.kind != b.part.kind) return a.part.kind < b.part.kind;
  if (a.part.index != b.part.index) return a.part.index < b.part.index;
  if (a.partner != b.partner) return a.partner + 1 < b.partner + 1;  // the environment first
  if (a.other.kind != b.other.kind) return a.other.kind < b.other.kind;
  if (a.other.index != b.other.index) return a.other.index < b.other.index;
  return std::lexicographical_compare(a.vertices, a.vertices + 3, b.vertices, b.vertices + 3);
}

}  // namespace

/** The corners of a part with v first, and `to` if that is not null. */
template <int D>
typename ThickSweep<D>::Swept ThickSweep<D>::sweep_of(const Body<D>& body, const Simplex& part, uint32_t v,
                                                      const double* to) const noexcept {
  Swept swept;
  swept.part = part;
  swept.start = body.vertices[v].cell;
  const auto add = [&](uint32_t corner, const double* at) {
    swept.from[swept.from_count++] = {corner, 0};
    swept.hull.points[swept.hull.count++] = at;
  };
  add(v, body.position(v));
  for (const uint32_t corner : SimplexCorners<D>(body, part)) {
    if (corner != v) add(corner, body.position(corner));
  }
  if (to == nullptr) return swept;
  swept.hull.points[swept.hull.count++] = to;
  double way = 0;
  for (int k = 0; k < D; ++k) way = std::max(way, std::fabs(to[k] - body.position(v)[k]));
  swept.way = 1.8 * way;  // more than the square root of 3
  swept.is_at_rest = false;
  return swept;
}

template <int D>
double ThickSweep<D>::least_of(const Swept& swept, double wanted) noexcept {
  return swept.is_at_rest ? least_at_rest(wanted) : least_kept(wanted);
}

/** Visits the sweeps of the parts at a vertex that no other part covers. */
template <int D>
template <class Visit>
bool ThickSweep<D>::for_each_swept(const Body<D>& body, uint32_t v, const double* to, Visit visit) const {
  return for_each_simplex_at(
      body, v, [&](const Simplex& part) { return is_covered(body, part) || visit(sweep_of(body, part, v, to)); });
}

template <int D>
bool ThickSweep<D>::visit_walls(const Body<D>& body, const Swept& swept, double distance, double limit,
                                VisitThing visit) {
  const double reach = distance + limit, wanted = least_of(swept, distance);
  const Box<D> box = box_round<D>(swept.hull, reach);
  const auto look = [&](const NearList<D>& list, const WallFeature& obstacle) {
    Thing thing{{{}, obstacle.count}, wanted, kNone, {}, &obstacle, &list};
    for (uint32_t i = 0; i < obstacle.count; ++i) thing.hull.points[i] = list.point(obstacle.vertices[i]);
    return !is_in(box, thing.hull) || visit(thing);
  };
  // Floods that are remembered go round the part, others only round what it sweeps.
  if (notes != nullptr && swept.way <= reach) {
    const NearView<D> view = lists_.near(body, Part<D>(body, swept.part), 0, reach + swept.way, *notes);
    return dsw::all_of(view.near.obstacles().begin(), view.near.obstacles().end(),
                       [&](uint32_t i) { return look(view.list, view.list.obstacles()[i]); });
  }
  const NearList<D>& list = lists_.in(swept.start, NearRegion<D>(swept.hull.points, swept.hull.count, reach));
  return dsw::all_of(list.obstacles().begin(), list.obstacles().end(),
                     [&](const WallFeature& obstacle) { return look(list, obstacle); });
}

template <int D>
bool ThickSweep<D>::visit_partner(const Partners<D>& partners, uint32_t number, const Body<D>& body, const Box<D>& box,
                                  double wanted, VisitThing visit) const {
  const Body<D>& other = *partners.all[number].body;
  const auto look = [&](const Simplex& part) {
    const SimplexCorners<D> corners(other, part);
    const auto is_joined = [&](uint32_t v) { return joined_.has(v); };
    if (is_covered(other, part)) return true;
    if (&other == &body && dsw::any_of(corners.begin(), corners.end(), is_joined)) return true;
    Thing thing{{{}, corners.count}, wanted, number, part, nullptr, nullptr};
    for (uint32_t i = 0; i < corners.count; ++i) thing.hull.points[i] = other.position(corners.vertices[i]);
    return !is_in(box, thing.hull) || visit(thing);
  };
  const BodyBoxes<D>& boxes = fresh_boxes(other);
  if (!single_vertices(other, other.level).visit(box, [&](uint32_t v) { return look({Simplex::kVertex, v}); })) {
    return false;
  }
  if (covers_edges(other.level) && !boxes.edges.visit(box, [&](uint32_t e) { return look({Simplex::kEdge, e}); })) {
    return false;
  }
  return !covers_faces(other.level) || boxes.faces.visit(box, [&](uint32_t f) { return look({Simplex::kFace, f}); });
}

template <int D>
bool ThickSweep<D>::visit_near(const Partners<D>* partners, const Body<D>& body, const Swept& swept, double limit,
                               VisitThing visit) {
  const double of_walls = body.radius > 0 ? body.radius + bend : 0;
  if (of_walls + limit > 0 && !visit_walls(body, swept, of_walls, limit, visit)) return false;
  if (partners == nullptr) return true;
  for (uint32_t i = 0; i < partners->all.size(); ++i) {
    const Body<D>& other = *partners->all[i].body;
    if (&other == &body ? !body.filter.self || swept.is_rigid : !body.filter.sees(other.filter)) continue;
    const double radii = body.radius + other.radius, wanted = radii > 0 && &other != &body ? radii + bend : radii;
    if (!(wanted + limit > 0)) continue;
    if (&other == &body) joined_.find(body, swept.from, swept.from_count);
    const Box<D> box = box_round<D>(swept.hull, wanted + limit);
    if (!visit_partner(*partners, i, body, box, least_of(swept, wanted), visit)) return false;
  }
  return true;
}

template <int D>
bool ThickSweep<D>::keeps_swept(const Partners<D>* partners, const Body<D>& body, const Swept& swept) {
  return visit_near(partners, body, swept, 0,
                    [&](const Thing& thing) { return are_far_apart<D>(swept.hull, thing.hull, thing.wanted); });
}

template <int D>
bool ThickSweep<D>::keeps(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to) {
  if (!is_thick(partners, body)) return true;
  return for_each_swept(body, v, to, [&](const Swept& swept) { return keeps_swept(partners, body, swept); });
}

template <int D>
bool ThickSweep<D>::keeps_motion(const Partners<D>* partners, const Body<D>& body, PointArray targets,
                                 TooNear<D>* near) {
  if (!is_thick(partners, body)) return true;
  bool keeps = true;
  double least = kInfinity;
  for_each_outer(body, [&](const Simplex& part) {
    const SimplexCorners<D> corners(body, part);
    Swept swept = sweep_of(body, part, corners.vertices[0], nullptr);
    double way = 0;
    for (const uint32_t v : corners) {
      for (int k = 0; k < D; ++k) way = std::max(way, std::fabs(targets[v][k] - body.position(v)[k]));
      swept.hull.points[swept.hull.count++] = targets[v];
    }
    swept.way = 1.8 * way;  // more than the square root of 3
    swept.is_at_rest = false;
    swept.is_rigid = true;
    return visit_near(partners, body, swept, 0, [&](const Thing& thing) {
      if (are_far_apart<D>(swept.hull, thing.hull, thing.wanted)) return true;
      keeps = false;
      if (near == nullptr) return false;
      const HullGap gap = find_gap<D>(swept.hull, thing.hull, kInfinity, thing.wanted);
      const double left = gap.distance - thing.wanted;
      TooNear<D> found;
      name_thing(swept, gap, thing, &found);
      for (uint32_t i = 0; i < corners.count; ++i) found.shares[i] = gap.weights[i] + gap.weights[corners.count + i];
      const uint32_t v = corners.vertices[0];
      if (is_zero(found.normal)) found.normal = unit(difference<D>(body.position(v), targets[v]));
      // Walls that meet in the nearest point are equally near but for rounding.
      const double tie = 0x1p-40 * gap.distance;
      if (left > least + tie || (left > least - tie && !precedes(found, *near))) return true;
      least = left;
      *near = found;
      return true;
    });
  });
  return keeps;
}

template <int D>
bool ThickSweep<D>::keeps_apart(const Body<D>& a, PointArray to_a, const Body<D>& b, PointArray to_b, double distance,
                                TooNear<D>* near) const {
  struct Way {
    Simplex part;
    ConvexHull hull;
  };
  const auto way_of = [](const Body<D>& body, const Simplex& part, PointArray to) {
    Way way{part, {}};
    const SimplexCorners<D> corners(body, part);
    for (const uint32_t v : corners) way.hull.points[way.hull.count++] = body.position(v);
    for (const uint32_t v : corners) way.hull.points[way.hull.count++] = to[v];
    return way;
  };
  const double wanted = least_kept(distance);
  Array<Way> ways(env_.memory);
  for_each_outer(b, [&](const Simplex& part) {
    ways.push_back(way_of(b, part, to_b));
    return true;
  });
  bool keeps = true;
  double least = kInfinity;
  for_each_outer(a, [&](const Simplex& part) {
    const Way way = way_of(a, part, to_a);
    const Box<D> box = box_round<D>(way.hull, distance);
    return dsw::all_of(ways.begin(), ways.end(), [&](const Way& other) {
      if (!is_in(box, other.hull) || are_far_apart<D>(way.hull, other.hull, wanted)) return true;
      keeps = false;
      if (near == nullptr) return false;
      const HullGap gap = find_gap<D>(way.hull, other.hull, kInfinity, wanted);
      if (!(gap.distance < least)) return true;
      least = gap.distance;
      *near = TooNear<D>();
      near->part = part;
      near->other = other.part;
      const uint32_t count = way.hull.count / 2, other_count = other.hull.count / 2;
      for (uint32_t i = 0; i < count; ++i) near->shares[i] = gap.weights[i] + gap.weights[count + i];
      for (uint32_t i = 0; i < other_count; ++i) {
        near->weights[i] = gap.other_weights[i] + gap.other_weights[other_count + i];
      }
      const uint32_t v = SimplexCorners<D>(a, part).vertices[0];
      near->normal = is_zero(gap.normal) ? unit(difference<D>(a.position(v), to_a[v])) : gap.normal;
      return true;
    });
  });
  return keeps;
}

/** Says what is too near where, but not when. */
template <int D>
void ThickSweep<D>::name_thing(const Swept& swept, const HullGap& gap, const Thing& thing, TooNear<D>* found) {
  found->part = swept.part;
  found->normal = gap.normal;
  found->partner = thing.partner;
  found->other = thing.other;
  if (const WallFeature* const obstacle = thing.obstacle) {
    for (uint32_t& i = found->count; i < obstacle->count; ++i) {
      found->vertices[i] = thing.list->name(obstacle->vertices[i]);
    }
    found->facet = obstacle->facet;
    found->cell = obstacle->cell;
  }
  std::copy_n(gap.other_weights, 3, found->weights);
}

/** Whether something surely comes too near later than at some time: with room, so that it does not matter what is asked
 * first. */
template <int D>
bool ThickSweep<D>::keeps_until(ConvexHull start, const double* to, double time, const Thing& thing) noexcept {
  constexpr double kRoom = 0x1p-20;
  return time + kRoom < 1 && are_far_apart_until<D>(start, to, time + kRoom, thing.hull, thing.wanted);
}

template <int D>
template <class Visit>
void ThickSweep<D>::visit_too_near(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to,
                                   const TooNear<D>* first, Visit visit) {
  if (!is_thick(partners, body)) return;
  for_each_swept(body, v, to, [&](const Swept& swept) {
    return visit_near(partners, body, swept, 0, [&](const Thing& thing) {
      ConvexHull start = swept.hull;
      --start.count;
      if (first != nullptr && keeps_until(start, to, first->time, thing)) return true;
      HullGap gap;
      TooNear<D> found;
      found.time = time_apart<D>(start, to, thing.hull, thing.wanted, &gap);
      if (found.time == 1) return true;
      name_thing(swept, gap, thing, &found);
      std::copy_n(gap.weights, start.count, found.shares);
      found.shares[0] += gap.weights[start.count];
      if (is_zero(found.normal)) found.normal = unit(difference<D>(body.position(v), to));
      visit(found);
      return true;
    });
  });
}

template <int D>
bool ThickSweep<D>::find_first(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to,
                               TooNear<D>* first) {
  first->time = 1;
  visit_too_near(partners, body, v, to, first, [&](const TooNear<D>& found) {
    if (precedes(found, *first)) *first = found;
  });
  return first->time < 1;
}

template <int D>
void ThickSweep<D>::find_all(const Partners<D>* partners, const Body<D>& body, uint32_t v, const double* to,
                             Array<TooNear<D>>& all) {
  all.clear();
  visit_too_near(partners, body, v, to, nullptr, [&](const TooNear<D>& found) { all.push_back(found); });
  dsw::sort(all.begin(), all.end(), precedes<D>);
}

template <int D>
bool ThickSweep<D>::keeps_at_rest(const Partners<D>* partners, const Body<D>& body, const ConvexHull& part, Cell start,
                                  const WayAlong* from, uint32_t from_count) {
  if (!is_thick(partners, body)) return true;
  Swept swept;
  swept.hull = part;
  swept.start = start;
  swept.way = kInfinity;
  swept.is_at_rest = false;
  swept.from_count = from_count;
  std::copy_n(from, from_count, swept.from);
  return keeps_swept(partners, body, swept);
}

template <int D>
bool ThickSweep<D>::keeps_at_rest(const Partners<D>* partners, const Body<D>& body, const Simplex& part) {
  if (!is_thick(partners, body)) return true;
  return keeps_swept(partners, body, sweep_of(body, part, SimplexCorners<D>(body, part).vertices[0], nullptr));
}

template <int D>
bool ThickSweep<D>::keep_at_rest(const Partners<D>* partners, const Body<D>& body) {
  return !is_thick(partners, body) ||
         for_each_outer(body, [&](const Simplex& part) { return keeps_at_rest(partners, body, part); });
}

template <int D>
void ThickSweep<D>::find_walls(const Body<D>& body, const Simplex& part, Array<HalfFacet>& walls) {
  const Swept swept = sweep_of(body, part, SimplexCorners<D>(body, part).vertices[0], nullptr);
  visit_near(nullptr, body, swept, 0, [&](const Thing& thing) {
    if (thing.obstacle->facet.valid() && !are_far_apart<D>(swept.hull, thing.hull, thing.wanted)) {
      walls.push_back(thing.obstacle->facet);
    }
    return true;
  });
}

template <int D>
double ThickSweep<D>::least_gap(const Partners<D>* partners, const Body<D>& body, const Simplex& part, double limit) {
  double least = limit;
  const Swept swept = sweep_of(body, part, SimplexCorners<D>(body, part).vertices[0], nullptr);
  visit_near(partners, body, swept, limit, [&](const Thing& thing) {
    const double wanted = body.radius + (thing.partner == kNone ? 0 : partners->all[thing.partner].body->radius);
    const double gap = find_gap<D>(swept.hull, thing.hull, kInfinity, thing.wanted).bound - wanted;
    least = std::min(least, std::nextafter(gap, -kInfinity));
    return true;
  });
  return least;
}

template <int D>
bool ThickSweep<D>::keeps_bend(const Partners<D>* partners, const Body<D>& body, uint32_t edge, const double* point,
                               Cell cell) {
  if (!is_thick(partners, body)) return true;
  const uint32_t a = body.edges[edge].ends[0], b = body.edges[edge].ends[1];
  const double *const at_a = body.position(a), *const at_b = body.position(b);
  const auto keeps = [&](const ConvexHull& hull, std::initializer_list<WayAlong> from) {
    return keeps_at_rest(partners, body, hull, cell, from.begin(), static_cast<uint32_t>(from.size()));
  };
  // What the new vertex is joined to.
  double to_a = 0, to_b = 0;
  if (body.keeps_lengths()) {
    const double first = length(difference<D>(point, at_a)), second = length(difference<D>(at_b, point));
    to_a = body.lengths[edge] * (first + second > 0 ? first / (first + second) : 0.5);
    to_b = body.lengths[edge] - to_a;
  }
  if (!covers_edges(body.level)) return keeps({{point}, 1}, {{a, to_a}, {b, to_b}});
  // The way of the edge, and both halves where they are then: each is joined to less than the whole edge.
  if (!keeps({{at_a, at_b, point}, 3}, {{a, 0}, {b, 0}})) return false;
  if (body.keeps_lengths() &&
      (!keeps({{at_a, point}, 2}, {{a, 0}, {b, to_b}}) || !keeps({{point, at_b}, 2}, {{a, to_a}, {b, 0}}))) {
    return false;
  }
  for (const uint32_t f : body.edges[edge].faces) {
    if (D == 2 || f == kNone) continue;
    const BodyFace& face = body.faces[f];
    const uint32_t far = face.after(a) == b ? face.before(a) : face.after(a);
    const double* const at_far = body.position(far);
    if (!keeps({{point, at_far}, 2}, {{a, to_a}, {b, to_b}, {far, 0}})) return false;
    if (!covers_faces(body.level)) continue;
    if (!keeps({{at_a, at_b, at_far, point}, 4}, {{a, 0}, {b, 0}, {far, 0}})) return false;
    if (body.keeps_lengths() && (!keeps({{at_a, point, at_far}, 3}, {{a, 0}, {b, to_b}, {far, 0}}) ||
                                 !keeps({{point, at_b, at_far}, 3}, {{a, to_a}, {b, 0}, {far, 0}}))) {
      return false;
    }
  }
  return true;
}

template class ThickSweep<2>;
template class ThickSweep<3>;

}  // namespace dsw
