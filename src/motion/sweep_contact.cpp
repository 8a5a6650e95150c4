#include "motion/sweep_contact.h"

#include <tuple>

namespace dsw {
namespace {

/** Order of contacts at one time and of one kind: vertices by number; facets before wires; those that p sees; then by the
 * canonical name of the facet, the cell it is seen from, and inside that. */
auto order_of(const Map<3>& map, const SweepContact& c) {
  const HalfFacet h = c.facet.valid() ? canonical(map, c.facet) : HalfFacet{};
  const Cell owner = h.valid() ? map.cell_of(h) : c.front;
  return std::make_tuple(c.vertex, h.valid() ? 0 : 1, c.faces_start ? 0 : 1, map.index(owner),
                         h.valid() ? map.local_of(h, owner) : c.dart, map.index(c.front), c.simplex, c.dart);
}

/** How many facets of `from` lead to `to`. */
uint32_t facets_between(const Map<3>& map, Cell from, Cell to) noexcept {
  uint32_t count = 0;
  for (uint32_t f = 0, facets = map.facets_of(from); f < facets; ++f) {
    const HalfFacet o = map.opposite(map.half_facet(from, f));
    count += o.valid() && map.cell_of(o) == to ? 1u : 0u;
  }
  return count;
}

}  // namespace

bool same_event(const SweepContact& a, const SweepContact& b) noexcept {
  const double *const *x = a.event.points, *const *y = b.event.points;
  if (a.event.kind != b.event.kind) return false;
  if (a.event.kind != EventKind::kEdge) return x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
  return x[0] == y[0] && ((x[1] == y[1] && x[2] == y[2]) || (x[1] == y[2] && x[2] == y[1]));
}

bool comes_before(const Map<3>& map, const double* p, const double* to, const SweepContact& a,
                  const SweepContact& b) noexcept {
  const int sign = same_event(a, b) ? 0 : compare_events(p, to, a.event, b.event).sign;
  if (sign != 0) return sign < 0;
  if (kind_of(a) != kind_of(b)) return kind_of(a) < kind_of(b);
  return order_of(map, a) < order_of(map, b);
}

// Both edges cross the cells c_0 .. c_n, convex ones, so that what lies between them in one cell, the quad of the points in
// which they enter and leave it, lies in that cell; and the quads fill the triangle p p' q. Shifted, the triangle lies in no
// facet's plane, so a quad meets its cell's boundary only along the segments in which it meets the next quads. Each of them
// lies in what c_i and c_i+1 share, with its ends inside of facets. Two convex cells share a convex set in one plane. If that is
// a single facet, then it is convex and the segment runs inside of it: a facet that both edges cross, so a passable one,
// and no edge or other facet is met.
bool same_sequence_settles(const Map<3>& map, const Cell* old_cells, size_t old_count, const Cell* new_cells,
                           size_t new_count) noexcept {
  if (old_count != new_count) return false;
  for (size_t i = 0; i < old_count; ++i) {
    if (old_cells[i] != new_cells[i] || !map.convex(old_cells[i])) return false;
    if (i > 0 && map.form(old_cells[i]) != Form::kSimplex && facets_between(map, old_cells[i - 1], old_cells[i]) != 1) {
      return false;
    }
  }
  return old_count != 0;
}

}  // namespace dsw
