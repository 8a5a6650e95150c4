#include "corridor/sweep_contact.h"

#include <algorithm>
#include <tuple>

#include "base/dimensions.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** Order of contacts at one time and of one kind: vertices by number; facets before marked edges; those that p sees;
 * then by the canonical name of the facet, the cell it is seen from, and inside that. */
template <int D>
auto order_of(const Map<D>& map, const SweepContact& c) {
  const HalfFacet h = c.facet.valid() ? canonical(map, c.facet) : HalfFacet{};
  const Cell owner = h.valid() ? map.cell_of(h) : c.front;
  return std::make_tuple(c.vertex, h.valid() ? 0 : 1, c.faces_start ? 0 : 1, map.index(owner),
                         h.valid() ? map.local_of(h, owner) : c.dart, map.index(c.front), c.simplex, c.dart);
}

/** Whether the moving end passes the plane of one flat facet in both: what a path and an edge say of it may name two of
 * its triangles, and that their times are equal would be found last of all. */
template <int D>
bool same_plane(const Map<D>& map, const SweepContact& a, const SweepContact& b) noexcept {
  return a.event.kind == EventKind::kVertex && b.event.kind == EventKind::kVertex && a.facet.valid() &&
         a.facet == b.facet && map.convex(a.front);
}

}  // namespace

template <int D>
SweepContact path_contact(const Environment<D>& env, const CastResult& path) noexcept {
  SweepContact found;
  found.front = path.cell;
  found.facet = path.facet;
  found.faces_start = true;
  found.simplex = path.simplex;
  const double* simplex[D];
  boundary_points(env, path.cell, path.simplex, simplex);
  std::copy_n(simplex, D, found.event.points);
  return found;
}

bool same_event(const SweepContact& a, const SweepContact& b) noexcept {
  const double *const *x = a.event.points, *const *y = b.event.points;
  if (a.event.kind != b.event.kind) return false;
  if (a.event.kind != EventKind::kEdge) return x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
  return x[0] == y[0] && ((x[1] == y[1] && x[2] == y[2]) || (x[1] == y[2] && x[2] == y[1]));
}

template <int D>
bool comes_before(const Map<D>& map, const double* p, const double* to, const SweepContact& a,
                  const SweepContact& b) noexcept {
  const int sign = same_event(a, b) || same_plane(map, a, b) ? 0 : compare_events<D>(p, to, a.event, b.event).sign;
  if (sign != 0) return sign < 0;
  if (kind_of(a) != kind_of(b)) return kind_of(a) < kind_of(b);
  return order_of(map, a) < order_of(map, b);
}

DSW_INSTANTIATE(path_contact);
DSW_INSTANTIATE(comes_before);

}  // namespace dsw
