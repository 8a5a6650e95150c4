#include "contact/geometry.h"

#include <algorithm>

#include "base/dimensions.h"
#include "contact/names.h"
#include "contact/normals.h"
#include "environment/marking.h"
#include "predicates/filtered.h"
#include "predicates/plane_hit.h"
#include "walk/move.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** Across a body's edge and the obstacle's; zero if they have no such direction. */
Vec across_edges(const EdgeMotion& m, const double* position, const SweepEvent& event) {
  return unit_across(difference<3>(m.q, position), difference<3>(event.points[2], event.points[1]));
}

/** Where segment ab pierces the swept plane, by the exact ratio. It does not lie in it: shifted, both ends of a line in
 * that plane are on one side. */
void piercing_point(const EdgeMotion& m, const double* a, const double* b, double* point) {
  const double* const swept[3] = {m.p, m.to, m.q};
  if (swept_side(m, b).sign < 0) std::swap(a, b);
  point_at<3>(a, b, crossing_time<3>(a, b, swept), point);
}

/** Out of the obstacle's triangle or side, which looks out of the cell in front; zero for a marked edge or a vertex. */
template <int D>
DSW_NOINLINE Vec wall_normal(const Environment<D>& env, const SweepContact& contact) {
  if (!contact.facet.valid() || contact.vertex != kNoVertex) return {};
  const double* simplex[D];
  boundary_points(env, contact.front, contact.simplex, simplex);
  double outward[D];
  unit_normal<D>(simplex, outward);
  return Vec::Zero() - to_vec<D>(outward);
}

/** `chosen` turned against the motion, or where it does not lean, as the wall looks. */
template <class Wall>
Vec against(const Vec& chosen, const Vec& move, Wall wall) {
  const double lean = dot(chosen, move);
  const bool turn = lean != 0 ? lean > 0 : dot(chosen, wall()) < 0;
  return (turn ? -1.0 : 1.0) * chosen;
}

/** Names what a sweep has met in a contact, which has its normal. */
template <int D>
void name_met(const Environment<D>& env, const SweepContact& met, dsw_contact& contact) noexcept {
  const bool has_wall = met.facet.valid();
  if (has_wall) name_wall(env, seen_wall(env, met.front, met.facet, contact.normal), contact);
  contact.front = volume_id(env.map, met.front);
  switch (kind_of(met)) {
    case ContactKind::kVertex:
      name_vertex(env.map, met.vertex, contact);
      if (!has_wall) contact.marked_kind = vertex_marked(env, met.vertex) ? DSW_CELL_VERTEX : DSW_CELL_EDGE;
      break;
    case ContactKind::kEdge:
      if constexpr (D == 3) {
        const bool is_named = met.lowest.cell.valid();
        name_edge(is_named ? id_of_lowest(env.map, met.lowest) : edge_id(env.map, {met.front, met.dart}), contact);
      }
      if (!has_wall) contact.marked_kind = DSW_CELL_EDGE;
      break;
    case ContactKind::kPlane:
      break;
  }
}

}  // namespace

Vec against(const Vec& chosen, const Vec& move) {
  if (is_zero(chosen)) return -1.0 * unit(move);
  return (dot(chosen, move) > 0 ? -1.0 : 1.0) * chosen;
}

template <int D>
Vec normal_on(int side, const double* const* corners, const Vec& move) {
  double normal[D];
  unit_normal<D>(corners, normal);
  // What moves along an edge in the plane meets its end.
  if (side == 0) return against(D == 3 ? to_vec<D>(normal) : Vec::Zero(), move);
  return (side < 0 ? -1.0 : 1.0) * to_vec<D>(normal);
}

Vec swing_normal(const EdgeMotion& m, const double* position, const double* at) {
  const double* const start[2] = {m.p, m.q};
  // What it lies on is not rounded, but at q it says nothing; nor does an end that comes as near to q.
  const double* const edge[2] = {std::equal(at, at + 2, m.q) ? position : at, m.q};
  const int side = std::equal(edge[0], edge[0] + 2, m.q) ? 0 : -orient<2>(start, m.to);
  return normal_on<2>(side, edge, difference<2>(m.to, m.p));
}

template <int D>
HalfFacet facing(const Environment<D>& env, HalfFacet wall, const double* normal) noexcept {
  const HalfFacet o = wall.valid() ? env.map.opposite(wall) : wall;
  if (!o.valid() || env.map.marked(env.map.cell_of(o))) return wall;
  const Cell c = env.map.cell_of(wall);
  const Shape shape = env.map.shape(c);
  const double* simplex[D];
  simplex_points(env, c, shape, shape.simplex_first(env.map.local_of(wall, c)), simplex);
  double outward[D];
  unit_normal<D>(simplex, outward);
  return dot(to_vec<D>(outward), to_vec<D>(normal)) > 0 ? o : wall;
}

template <int D>
HalfFacet seen_wall(const Environment<D>& env, Cell front, HalfFacet wall, const double* normal) noexcept {
  const HalfFacet seen = seen_from(env.map, front, wall);
  return env.map.cell_of(seen) == front ? seen : facing(env, wall, normal);
}

template <int D>
double share_along(const double* end, const double* q, const double* point) {
  int axis = 0;
  for (int k = 1; k < D; ++k) {
    if (std::fabs(q[k] - end[k]) > std::fabs(q[axis] - end[axis])) axis = k;
  }
  const double share = (point[axis] - end[axis]) / (q[axis] - end[axis]);
  return share > 0 ? std::min(share, 1.0) : 0;
}

DSW_COLD Vec unit_across(const Vec& a, const Vec& b) { return unit(unit(a).cross(unit(b))); }

template <int D>
Touch touch_of(const Environment<D>& env, const double* p, const double* to, const SweepContact& met) {
  const SweepEvent& event = met.event;
  Touch g;
  PlaneHit<D> quick;  // of a vertex: the event's points are those of the wall
  const bool is_quick = event.kind == EventKind::kVertex && quick_plane_hit(p, to, event.points, &quick);
  g.time = is_quick ? quick.time : event_time<D>(p, to, event);
  point_at<D>(p, to, g.time, g.position);
  std::copy_n(g.position, D, g.point);
  const Vec move = unit(difference<D>(to, p));
  const auto wall = [&] { return wall_normal(env, met); };
  Vec normal;
  if (event.kind == EventKind::kEdge) {
    const EdgeMotion m{p, to, event.points[0]};
    if constexpr (D == 3) {
      piercing_point(m, event.points[1], event.points[2], g.point);
      const Vec across = across_edges(m, g.position, event);
      const Vec chosen = is_zero(across) ? wall() : across;
      normal = against(is_zero(chosen) ? Vec(-1.0 * move) : chosen, move, wall);
    } else {
      std::copy_n(event.points[1], D, g.point);
      normal = swing_normal(m, g.position, g.point);
    }
    g.along = share_along<D>(g.position, m.q, g.point);
  } else if (event.kind == EventKind::kFace) {
    std::copy_n(event.points[2], D, g.point);
    const Vec face =
        unit_across(difference<D>(event.points[0], g.position), difference<D>(event.points[1], g.position));
    normal = against(!is_zero(face) ? face : Vec(-1.0 * move), move, wall);
  } else {
    normal = is_quick ? to_vec<D>(quick.normal) : wall();
  }
  store<D>(normal + Vec::Zero(), g.other.normal);  // never -0
  name_met(env, met, g.other);
  return g;
}

template Touch touch_of(const Environment<2>& env, const double* p, const double* to, const SweepContact& met);
template Touch touch_of(const Environment<3>& env, const double* p, const double* to, const SweepContact& met);
DSW_INSTANTIATE(normal_on);
DSW_INSTANTIATE(facing);
DSW_INSTANTIATE(seen_wall);
DSW_INSTANTIATE(share_along);

}  // namespace dsw
