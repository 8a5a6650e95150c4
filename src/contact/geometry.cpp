#include "contact/geometry.h"

#include <algorithm>

#include "base/vec.h"
#include "motion/move.h"
#include "motion/standard_facets.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

/** Across a body's edge and the obstacle's, in the plane across the body's; zero if it has no direction. */
template <int D>
Vec across_edge(const EdgeMotion& m, const double* position, const SweepEvent& event) {
  if constexpr (D == 2) {  // the edge lies on the vertex, which is not rounded, unless that is its other end
    const Vec part = unit(difference<D>(m.q, event.points[1]));
    return turned(is_zero(part) ? unit(difference<D>(m.q, position)) : part);
  }
  return unit(cross(unit(difference<D>(m.q, position)), unit(difference<D>(event.points[2], event.points[1]))));
}

/** Where segment ab pierces the swept plane, by the exact ratio. It does not lie in it: shifted, both ends of a line in that
 * plane are on one side. */
void piercing_point(const EdgeMotion& m, const double* a, const double* b, double* point) {
  const double* const swept[3] = {m.p, m.to, m.q};
  if (swept_side(m, b).sign < 0) std::swap(a, b);
  point_at<3>(a, b, crossing_time<3>(a, b, swept), point);
}

/** Out of the obstacle's triangle or side, which looks out of the cell in front; zero for a wire or a vertex. */
template <int D>
Vec wall_normal(const Environment<D>& env, const SweepContact& contact) {
  if (!contact.facet.valid() || contact.vertex != kNoVertex) return {};
  const double* simplex[D];
  boundary_points(env, contact.front, contact.simplex, simplex);
  double outward[D];
  unit_normal<D>(simplex, outward);
  return Vec{} - to_vec<D>(outward);
}

/** `chosen` turned against the motion, or where it does not lean, as the wall looks. */
Vec against(const Vec& chosen, const Vec& move, const Vec& wall) {
  const double lean = dot(chosen, move);
  const bool turn = lean != 0 ? lean > 0 : dot(chosen, wall) < 0;
  return (turn ? -1.0 : 1.0) * chosen;
}

}  // namespace

template <int D>
double share_along(const double* end, const double* q, const double* point) {
  int axis = 0;
  for (int k = 1; k < D; ++k) {
    if (std::fabs(q[k] - end[k]) > std::fabs(q[axis] - end[axis])) axis = k;
  }
  const double share = (point[axis] - end[axis]) / (q[axis] - end[axis]);
  return share > 0 ? std::min(share, 1.0) : 0;
}

template <int D>
ContactGeometry contact_geometry(const Environment<D>& env, const double* p, const double* to,
                                 const SweepContact& contact) {
  const SweepEvent& event = contact.event;
  ContactGeometry g;
  g.time = event_time<D>(p, to, event);
  point_at<D>(p, to, g.time, g.position);
  std::copy_n(g.position, D, g.point);
  const Vec move = unit(difference<D>(to, p)), wall = wall_normal(env, contact);
  Vec normal = wall;
  if (event.kind == EventKind::kEdge) {
    const EdgeMotion m{p, to, event.points[0]};
    if constexpr (D == 3) {
      piercing_point(m, event.points[1], event.points[2], g.point);
    } else {
      std::copy_n(event.points[1], D, g.point);
    }
    g.along = share_along<D>(g.position, m.q, g.point);
    const Vec across = across_edge<D>(m, g.position, event);
    normal = against(!is_zero(across) ? across : !is_zero(wall) ? wall : -1.0 * move, move, wall);
  } else if (event.kind == EventKind::kFace) {
    std::copy_n(event.points[2], D, g.point);
    const Vec face =
        unit(cross(unit(difference<D>(event.points[0], g.position)), unit(difference<D>(event.points[1], g.position))));
    normal = against(!is_zero(face) ? face : -1.0 * move, move, wall);
  }
  store<D>(normal + Vec{}, g.normal);  // never -0
  return g;
}

#define DSW_GEOMETRY(D)                                                                                   \
  template ContactGeometry contact_geometry(const Environment<D>& env, const double* p, const double* to, \
                                            const SweepContact& contact);                                 \
  template double share_along<D>(const double* end, const double* q, const double* point)
DSW_GEOMETRY(2);
DSW_GEOMETRY(3);
#undef DSW_GEOMETRY

}  // namespace dsw
