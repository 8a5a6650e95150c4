#include "corridor/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/processor.h"
#include "base/search.h"
#include "base/sort.h"
#include "corridor/fan.h"
#include "map/dart.h"
#include "map/ridge_walk.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

const FindCellSigns kFindTetrahedronSigns = DSW_WITH_AVX2(find_tetrahedron_signs);
const FindCellSigns kFindPyramidSigns = DSW_WITH_AVX2(find_pyramid_signs);

int side_of_plane(const double* const* triangle, const double* x) noexcept {
  return plane_side<3>(triangle, x, NoTally{}).sign;
}
int side_of_line(const double* p, const double* q, const double* a, const double* b) noexcept {
  const double* const ridge[2] = {a, b};
  return line_side<3>(p, q, ridge, NoTally{}).sign;
}

/** Whether body segment p q passes through a triangle. @pre p is on its negative side. */
bool passes_through(const double* p, const double* q, const double* const* triangle) noexcept {
  if (side_of_plane(triangle, q) < 0) return false;
  for (int k = 0; k < 3; ++k) {
    if (side_of_line(p, q, triangle[k], triangle[(k + 1) % 3]) < 0) return false;
  }
  return true;
}

/** Which point of a triangle that has a line does not lie on that. */
int third_point(const double* const* triangle, const double* const* line) noexcept {
  int i = 0;
  while (i < 2 && (triangle[i] == line[0] || triangle[i] == line[1])) ++i;
  return i;
}

/** The numbers of an event's environment vertices; those of a line in ascending order. */
std::array<ptrdiff_t, 3> event_key(const Environment<3>& env, const SweepContact& c) {
  // The first point of an edge event is the body's.
  const bool of_line = c.event.kind == EventKind::kEdge;
  std::array<ptrdiff_t, 3> key{-1};
  for (size_t i = of_line ? 1 : 0; i < 3; ++i) key[i] = c.event.points[i] - env.points;
  if (of_line && key[2] < key[1]) std::swap(key[1], key[2]);
  return key;
}

}  // namespace

SweepResult SweepFlood<3>::sweep(const EdgeMotion& m, Cell start, uint32_t max_volumes, bool collect) {
  SweptTriangle triangle(m);
  collect_ = collect;
  ends_ = false;
  flood_triangle(triangle, start, max_volumes);
  if (collect_) sort_found();
  return result_;
}

SweepResult SweepFlood<3>::sweep_until(const EdgeMotion& m, Cell start, double end) {
  SweptTriangle triangle(m);
  triangle.end_at(end);
  collect_ = false;
  ends_ = true;
  flood_triangle(triangle, start, 0);
  const SweepContact& first = result_.contact;
  // Where other passable cells meet the line, too, whether they are reached counts: then no end can be made.
  const bool is_whole = result_.end != SweepEnd::kContact || first.event.kind != EventKind::kEdge || is_one_fan(first);
  return is_whole ? result_ : sweep(m, start, 0);
}

void SweepFlood<3>::flood_triangle(SweptTriangle& triangle, Cell start, uint32_t max_volumes) {
  triangle_ = &triangle;
  clear();
  tied_.clear();
  flood(start, max_volumes, [&](Cell c) {
    const Form form = map_.form(c);
    is_signed_ = form == Form::kSimplex || form == Form::kPyramid;
    if (!(is_signed_ ? read_signs(c, form) : read_corners(c))) return;
    is_flat_ = is_signed_ && map_.convex(c);
    const Shape shape = map_.shape(c);
    look_at_facets(c, shape);
    if (env_.marked_edges != 0) look_at_marked_edges(c, shape);
  });
  if (result_.end == SweepEnd::kContact && tied_.size() > 2) decide_ties();
}

/** Reads the vertices of a cell. False for a hexahedron all of whose facets lie beside the triangle's box: the main
 * path, where p, p' and q are in one cell and nothing can be met. It holds for warped cells too. */
bool SweepFlood<3>::read_corners(Cell c) {
  read_vertices(c, *triangle_);
  if (map_.form(c) != Form::kBox) return true;
  for (const auto& f : kBoxFacets) {
    const uint32_t beyond =
        corners_[f[0]].beyond & corners_[f[1]].beyond & corners_[f[2]].beyond & corners_[f[3]].beyond;
    if (beyond == 0) return true;
  }
  return false;
}

/** Reads a tetrahedron or a pyramid and finds its signs. False: nothing of it is met, as it lies beside the swept plane. */
bool SweepFlood<3>::read_signs(Cell c, Form form) {
  const bool is_tetrahedron = form == Form::kSimplex;
  const uint32_t* const w = map_.record(c) + (is_tetrahedron ? 0 : kUnitWords<3>);
  const uint32_t count = is_tetrahedron ? 4 : 5;
  const double* at[5];
  for (uint32_t i = 0; i < count; ++i) at[i] = env_.point(w[i] & kVertexMask);
  if (!(is_tetrahedron ? kFindTetrahedronSigns : kFindPyramidSigns)(*triangle_, at, signs_)) return false;
  corners_.resize(count);
  for (uint32_t i = 0; i < count; ++i) corners_[i] = {at[i], w[i] & kVertexMask, 0, signs_.side[i]};
  return true;
}

int SweepFlood<3>::side(Corner& corner) const {
  if (corner.side == kUnknown) corner.side = triangle_->side(corner.at);
  return corner.side;
}

/** See SweptTriangle; the sides of both are known, and differ. A diagonal of a pyramid's base is asked apart. */
uint32_t SweepFlood<3>::outside(const Corner& a, const Corner& b) {
  const uint32_t known = is_signed_ ? signs_.lines[&a - corners_.data()][&b - corners_.data()] : CellSigns::kNotAsked;
  if (known != CellSigns::kNotAsked) return known;
  return lines_.value(a.vertex, b.vertex, [&] { return triangle_->outside(a.at, b.at, b.side); });
}

/** Enters what lies behind passable facets that the triangle meets. A cell that it does not meet is not read, and one
 * that has been entered is not marked. */
void SweepFlood<3>::look_at_facets(Cell c, const Shape& shape) {
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const HalfFacet h = map_.half_facet(c, f), o = map_.opposite(h);
    const bool wall = !o.valid() || map_.facet_marked(h);
    if (!wall && cells_.contains(Cell{o.word / kUnitWords<3>})) continue;
    if (!(is_flat_ ? flat_facet_met(shape, f) : facet_met(shape, f))) continue;
    if (wall || is_impassable(env_, h)) {
      look_at_obstacle(c, shape, f);
    } else {
      cells_.insert(map_.cell_of(o));
    }
  }
}

bool SweepFlood<3>::facet_met(const Shape& shape, uint32_t facet) {
  const uint32_t first = shape.simplex_first(facet), last = shape.simplex_first(facet + 1);
  if (last > first + 1 && !is_signed_) {  // nothing is known to lie beyond corners of a cell that is signed
    uint32_t beyond = ~0u;
    for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
      beyond &= corners_[shape.dart_vertex(d)].beyond;
    }
    if (beyond != 0) return false;
  }
  for (uint32_t s = first; s < last; ++s) {
    if (simplex_met(shape.simplices() + 3 * s)) return true;
  }
  return false;
}

/** Finds what facet_met finds, for a facet that is a flat convex polygon. The swept plane passes two of its sides, or none. See
 * simplex_met. */
bool SweepFlood<3>::flat_facet_met(const Shape& shape, uint32_t facet) const {
  const uint16_t* const corners = shape.dart_vertices() + shape.facet_first(facet);
  const uint32_t count = shape.facet_size(facet);
  uint32_t both = ~0u;
  bool pierces = false;
  for (uint32_t i = 0, a = corners[count - 1]; i < count; ++i) {
    const uint32_t b = corners[i];
    if (signs_.side[a] != signs_.side[b]) {
      const uint32_t line = signs_.lines[a][b];
      both &= line;
      pierces = pierces || (line & SweptTriangle::kSides) == 0;
    }
    a = b;
  }
  if (both != 0) return false;
  return pierces || passes_plane(shape.simplices() + 3 * shape.simplex_first(facet));
}

/** Whether the swept triangle meets a simplex before the end; may be true of simplices that are met later. The swept
 * plane cuts the simplex in a segment. If an end of the segment is inside of the triangle, they meet. If both ends are
 * outside of the same side, they do not. Otherwise they meet if the segment's line meets the triangle, that is if the
 * triangle's corners are on both sides of the simplex's plane: beyond its exit the line is outside of one side. */
bool SweepFlood<3>::simplex_met(const uint16_t* local) {
  Corner* const corner[3] = {&corners_[local[0]], &corners_[local[1]], &corners_[local[2]]};
  if ((corner[0]->beyond & corner[1]->beyond & corner[2]->beyond) != 0) return false;
  const int sides[3] = {side(*corner[0]), side(*corner[1]), side(*corner[2])};
  if (sides[0] == sides[1] && sides[1] == sides[2]) return false;
  const int alone = sides[0] == sides[1] ? 2 : sides[1] == sides[2] ? 0 : 1;
  const Corner& tip = *corner[alone];
  const uint32_t a = outside(tip, *corner[(alone + 1) % 3]), b = outside(tip, *corner[(alone + 2) % 3]);
  if ((a & b) != 0) return false;
  return (a & SweptTriangle::kSides) == 0 || (b & SweptTriangle::kSides) == 0 || passes_plane(local);
}

/** Whether the swept triangle's corners are on both sides of a simplex's plane. */
bool SweepFlood<3>::passes_plane(const uint16_t* local) const {
  const double* const simplex[3] = {corners_[local[0]].at, corners_[local[1]].at, corners_[local[2]].at};
  const EdgeMotion& m = triangle_->motion();
  const int first = side_of_plane(simplex, m.q);
  return side_of_plane(simplex, m.p) != first || side_of_plane(simplex, m.to) != first;
}

/** All events of an impassable facet. */
void SweepFlood<3>::look_at_obstacle(Cell c, const Shape& shape, uint32_t facet) {
  const EdgeMotion& m = triangle_->motion();
  SweepContact found;
  found.front = c;
  found.facet = map_.half_facet(c, facet);
  for (found.simplex = shape.simplex_first(facet); found.simplex < shape.simplex_first(facet + 1); ++found.simplex) {
    const uint16_t* const local = shape.simplices() + 3 * found.simplex;
    Corner* const corner[3] = {&corners_[local[0]], &corners_[local[1]], &corners_[local[2]]};
    if ((corner[0]->beyond & corner[1]->beyond & corner[2]->beyond) != 0) continue;
    const int sides[3] = {side(*corner[0]), side(*corner[1]), side(*corner[2])};
    if (sides[0] == sides[1] && sides[1] == sides[2]) continue;
    const double* const simplex[3] = {corner[0]->at, corner[1]->at, corner[2]->at};
    found.faces_start = side_of_plane(simplex, m.p) < 0;
    for (int k = 0; k < 3; ++k) {
      const int next = k == 2 ? 0 : k + 1;
      if (sides[k] == sides[next] || outside(*corner[k], *corner[next]) != 0) continue;
      found.event = {{m.q, simplex[k], simplex[next]}, EventKind::kEdge};
      found.dart = kNoFacet;
      for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
        if (shape.dart_vertex(d) == local[k] && shape.dart_vertex(shape.beta1(d)) == local[next]) found.dart = d;
      }
      consider(found);
    }
    // Seen from the side it comes from; from the other the same event belongs to the cell on this side.
    if (found.faces_start && passes_through(m.p, m.to, simplex)) {
      found.event = {{simplex[0], simplex[1], simplex[2]}, EventKind::kVertex};
      found.dart = kNoFacet;
      consider(found);
    }
  }
}

void SweepFlood<3>::look_at_marked_edges(Cell c, const Shape& shape) {
  SweepContact found;
  found.front = c;
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    if (d > shape.dart_beta2(d)) continue;  // once an edge
    Corner &a = corners_[shape.dart_vertex(d)], &b = corners_[shape.dart_vertex(shape.beta1(d))];
    if ((a.beyond & b.beyond) != 0 || side(a) == side(b)) continue;
    if (!env_.edge_marks.contains(a.vertex, b.vertex) || outside(a, b) != 0) continue;
    found.event = {{triangle_->motion().q, a.at, b.at}, EventKind::kEdge};
    found.dart = d;
    consider(found);
  }
}

/** Keeps the earlier contact; one line seen from several cells, or another in its place, is compared by names alone. */
void SweepFlood<3>::consider(const SweepContact& found) {
  if (collect_) found_.push_back(found);
  const EdgeMotion& m = triangle_->motion();
  const SweepContact& first = result_.contact;
  bool tied = false;
  if (result_.end == SweepEnd::kContact) {
    const bool of_lines = found.event.kind == EventKind::kEdge && first.event.kind == EventKind::kEdge;
    const int order =
        !of_lines || same_event(found, first) ? 0 : compare_events<3>(m.p, m.to, found.event, first.event).sign;
    tied = of_lines && order == 0;
    if (tied) tied_.push_back(found);
    if (order > 0 || (order == 0 && !comes_before(map_, m.p, m.to, found, first))) return;
  }
  if (!tied) tied_.assign(1, found);
  result_.end = SweepEnd::kContact;
  result_.contact = found;
  if (ends_) triangle_->end_at(std::min(triangle_->end(), time_after<3>(m.p, m.to, found.event)));
}

/** Whether p lies in one of the passable cells between this wall and the next one round the line: just before the
 * contact the edge passes there. Each cell is a wedge between two of its triangles, which may be those of one facet
 * with the line as its diagonal. */
bool SweepFlood<3>::comes_from(const SweepContact& wall) const {
  constexpr size_t kMostCells = 256;
  const double* const* const line = wall.event.points + 1;
  if (!wall.facet.valid()) return false;  // a marked edge has no side
  const double* from[3];
  boundary_points(env_, wall.front, wall.simplex, from);
  bool comes = false;
  walk_round(map_, wall.facet, kMostCells, [&](Cell c, HalfFacet entered) {
    const uint32_t other = other_at_line(c, from, line);
    if (other == kNoFacet) return HalfFacet{};
    const double* to[3];
    boundary_points(env_, c, other, to);
    const double* const tip = to[third_point(to, line)];
    const bool sees_first = side_of_plane(from, triangle_->motion().p) < 0,
               sees_second = side_of_plane(to, triangle_->motion().p) < 0;
    const bool narrow = side_of_plane(from, tip) < 0;
    comes = narrow ? sees_first && sees_second : sees_first || sees_second;
    const HalfFacet left = map_.half_facet(c, map_.shape(c).simplex_facets(3)[other]);
    if (comes || left == entered || is_impassable(env_, left)) return HalfFacet{};
    std::copy_n(to, 3, from);
    std::swap(from[1], from[2]);  // as the next cell has it
    return left;
  });
  return comes;
}

/** The other triangle of a cell at a line. */
uint32_t SweepFlood<3>::other_at_line(Cell c, const double* const* triangle, const double* const* line) const {
  const uint32_t count = map_.shape(c).simplex_count();
  const double* const tip = triangle[third_point(triangle, line)];
  for (uint32_t s = 0; s < count; ++s) {
    const double* at[3];
    boundary_points(env_, c, s, at);
    const auto is_of = [&](const double* point) { return dsw::find(at, at + 3, point) != at + 3; };
    if (is_of(line[0]) && is_of(line[1]) && at[third_point(at, line)] != tip) return s;
  }
  return kNoFacet;
}

/** Calls visit(cell) for the cells that are linked round the line of a wall, passable or not. */
template <class Visit>
void SweepFlood<3>::for_each_cell_round(const SweepContact& wall, Visit visit) const {
  if (wall.dart != kNoFacet) {
    for_each_volume_round_edge(map_, {wall.front, wall.dart}, [&](Dart d) {
      visit(d.cell);
      return true;
    });
    return;
  }
  visit(wall.front);  // a diagonal has the cells on both sides of its facet
  const HalfFacet beyond = map_.opposite(wall.facet);
  if (beyond.valid()) visit(map_.cell_of(beyond));
}

/** More walls than two at the line of the first contact. Only walls count that are linked, round the line, with the
 * side from which the edge comes. Parts of the environment that touch each other in the line alone are not. */
void SweepFlood<3>::decide_ties() {
  const EdgeMotion& m = triangle_->motion();
  const auto before = [&](const SweepContact& a, const SweepContact& b) { return comes_before(map_, m.p, m.to, a, b); };
  dsw::sort(tied_.begin(), tied_.end(), before);  // the order in which cells were entered does not count
  const auto near =
      dsw::find_if(tied_.begin(), tied_.end(), [&](const SweepContact& each) { return comes_from(each); });
  if (near == tied_.end()) return;
  const auto is_linked = [&](const SweepContact& each) {
    bool linked = false;
    for_each_cell_round(*near, [&](Cell c) { linked = linked || c == each.front; });
    return linked && same_event(each, *near);
  };
  result_.contact = *dsw::find_if(tied_.begin(), tied_.end(), is_linked);
}

/** Whether a flood that ends at a contact with an edge of the environment has seen all walls that count there: other
 * passable cells round that cannot be reached, or there are none. */
bool SweepFlood<3>::is_one_fan(const SweepContact& contact) const {
  if (contact.facet.valid() && contact.dart != kNoFacet && map_.form(contact.front) == Form::kSimplex) {
    const Dart d{contact.front, contact.dart};
    const uint32_t edge[2] = {dart_vertex(map_, d), dart_target(map_, d)};
    const HalfFacet walls[2] = {contact.facet, find_wall(env_, contact.facet, edge)};
    if (walls[1].valid() && comes_from(contact) && sees_only_fan(env_, *triangle_, walls, edge)) return true;
  }
  if (contact.dart == kNoFacet) {
    int passable = 0;
    for_each_cell_round(contact, [&](Cell c) { passable += is_closed(env_, c) ? 0 : 1; });
    return passable == 1;
  }
  bool is_one = true;
  // Goes from the front across the facet of d, and on round the edge. Returns false if it comes to the boundary.
  const auto go_round = [&](Dart d) {
    for (bool is_linked = true;;) {
      is_linked = is_linked && !is_impassable(env_, half_facet(map_, d));
      const Dart e = beta3(map_, d);
      if (!e.cell.valid() || e.cell == contact.front) return e.cell.valid();
      is_one = is_linked || is_closed(env_, e.cell);
      if (!is_one) return true;
      d = beta2(map_, e);
    }
  };
  const Dart d{contact.front, contact.dart};
  if (!go_round(beta2(map_, d))) go_round(d);
  return is_one;
}

/** Keeps for each event the contact that counts, and sorts these contacts. No two are equivalent in either order, so no
 * result depends on the way of sorting. */
void SweepFlood<3>::sort_found() {
  const auto before = [this](const SweepContact& a, const SweepContact& b) {
    return comes_before(map_, triangle_->motion().p, triangle_->motion().to, a, b);
  };
  const auto by_event = [&](const SweepContact& a, const SweepContact& b) {
    if (same_event(a, b)) return before(a, b);
    return event_key(env_, a) < event_key(env_, b);
  };
  dsw::sort(found_.begin(), found_.end(), by_event);
  found_.erase(std::unique(found_.begin(), found_.end(), same_event), found_.end());
  dsw::sort(found_.begin(), found_.end(), before);
  // Ties have been decided for the first.
  const auto first = dsw::find_if(found_.begin(), found_.end(),
                                  [&](const SweepContact& each) { return same_event(each, result_.contact); });
  if (first == found_.end()) return;
  *first = result_.contact;
  std::rotate(found_.begin(), first, first + 1);
}

}  // namespace dsw
