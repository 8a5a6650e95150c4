#include "motion/sweep.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "predicates/filtered.h"
#include "predicates/tally.h"

namespace dsw {
namespace {

int side_of_plane(const double* const* triangle, const double* x) noexcept {
  return plane_side<3>(triangle, x, NoTally{}).sign;
}
int side_of_line(const double* p, const double* q, const double* a, const double* b) noexcept {
  const double* const ridge[2] = {a, b};
  return line_side<3>(p, q, ridge, NoTally{}).sign;
}

/** Whether body segment p q passes through a triangle, in either direction. */
bool passes_through(const double* p, const double* q, const double* const* triangle) noexcept {
  const int after = side_of_plane(triangle, q);
  if (side_of_plane(triangle, p) == after) return false;
  for (int k = 0; k < 3; ++k) {
    if (side_of_line(p, q, triangle[k], triangle[(k + 1) % 3]) != after) return false;
  }
  return true;
}

/** The numbers of an event's environment vertices; those of a line in ascending order. */
std::array<ptrdiff_t, 3> event_key(const Environment<3>& env, const SweepContact& c) {
  std::array<ptrdiff_t, 3> key;
  for (size_t i = 0; i < 3; ++i) key[i] = c.event.points[i] - env.points;
  if (c.event.kind == EventKind::kEdge) {
    key[0] = -1;
    if (key[2] < key[1]) std::swap(key[1], key[2]);
  }
  return key;
}

}  // namespace

SweepFlood::SweepFlood(const Environment<3>& env)
    : env_(env),
      map_(env.map),
      cells_(env.memory),
      around_(env.memory),
      sides_(Allocator<int8_t>(env.memory)),
      found_(Allocator<SweepContact>(env.memory)),
      judged_(Allocator<uint32_t>(env.memory)) {}

SweepResult SweepFlood::sweep(const EdgeMotion& m, Cell start, uint32_t max_cells, bool collect) {
  cells_.clear();
  found_.clear();
  m_ = m;
  collect_ = collect;
  result_ = {};
  cells_.insert(start);
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (max_cells != 0 && i == max_cells) {
      result_.end = SweepEnd::kWorkLimit;
      result_.contact = {};
      break;
    }
    ++result_.cells_visited;
    const Cell c = cells_[i];
    if (!look_at_vertices(c)) continue;
    look_at_facets(c);
    if (env_.marked_edges != 0) look_at_wires(c);
  }
  if (collect_) sort_found();
  return result_;
}

/** Whether the cell's vertices lie on both sides of the swept plane. */
bool SweepFlood::look_at_vertices(Cell c) {
  const uint32_t count = map_.vertices_of(c);
  sides_.resize(count);
  int seen = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const int side = swept_side(m_, env_.point(c, i)).sign;
    sides_[i] = static_cast<int8_t>(side);
    seen |= side < 0 ? 1 : side > 0 ? 2 : 0;
  }
  return seen == 3;
}

void SweepFlood::look_at_facets(Cell c) {
  const Shape shape = map_.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const HalfFacet h = map_.half_facet(c, f);
    if (is_impassable(map_, h)) {
      look_at_obstacle(c, shape, f);
    } else if (facet_met(c, shape, f)) {
      cells_.insert(map_.cell_of(map_.opposite(h)));
    }
  }
}

/** Whether the swept triangle meets a facet: what they have in common ends where an edge or diagonal of the facet pierces the
 * swept triangle, or at two sides of that, so that two of the three need be asked. */
bool SweepFlood::facet_met(Cell c, const Shape& shape, uint32_t facet) const {
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    const uint16_t* const local = shape.simplices() + 3 * s;
    const int sides[3] = {sides_[local[0]], sides_[local[1]], sides_[local[2]]};
    if (sides[0] == sides[1] && sides[1] == sides[2]) continue;
    const double* triangle[3];
    simplex_points(env_, c, shape, s, triangle);
    for (int k = 0; k < 3; ++k) {
      if (sides[k] != sides[(k + 1) % 3] && edge_pierces(triangle[k], triangle[(k + 1) % 3])) return true;
    }
    if (passes_through(m_.p, m_.to, triangle) || passes_through(m_.to, m_.q, triangle)) return true;
  }
  return false;
}

/** Whether an environment edge with its ends on different sides of the swept plane passes through the swept triangle. */
bool SweepFlood::edge_pierces(const double* a, const double* b) const {
  const int side = side_of_line(m_.p, m_.to, a, b);
  return side_of_line(m_.to, m_.q, a, b) == side && side_of_line(m_.q, m_.p, a, b) == side;
}

/** All events of an impassable facet. */
void SweepFlood::look_at_obstacle(Cell c, const Shape& shape, uint32_t facet) {
  SweepContact found;
  found.front = c;
  found.facet = map_.half_facet(c, facet);
  for (found.simplex = shape.simplex_first(facet); found.simplex < shape.simplex_first(facet + 1); ++found.simplex) {
    const uint16_t* const local = shape.simplices() + 3 * found.simplex;
    const int sides[3] = {sides_[local[0]], sides_[local[1]], sides_[local[2]]};
    if (sides[0] == sides[1] && sides[1] == sides[2]) continue;
    const double* triangle[3];
    simplex_points(env_, c, shape, found.simplex, triangle);
    found.faces_start = side_of_plane(triangle, m_.p) < 0;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (sides[k] == sides[next] || !edge_pierces(triangle[k], triangle[next])) continue;
      found.event = {{m_.q, triangle[k], triangle[next]}, EventKind::kEdge};
      found.dart = kNoFacet;
      for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
        if (shape.dart_vertex(d) == local[k] && shape.dart_vertex(shape.beta1(d)) == local[next]) found.dart = d;
      }
      consider(found);
    }
    // Seen from the side it comes from; from the other the same event belongs to the cell on this side.
    if (found.faces_start && passes_through(m_.p, m_.to, triangle)) {
      found.event = {{triangle[0], triangle[1], triangle[2]}, EventKind::kVertex};
      found.dart = kNoFacet;
      consider(found);
    }
  }
}

void SweepFlood::look_at_wires(Cell c) {
  const Shape shape = map_.shape(c);
  SweepContact found;
  found.front = c;
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    if (d > shape.dart_beta2(d)) continue;  // once an edge
    const uint32_t from = shape.dart_vertex(d), to = shape.dart_vertex(shape.beta1(d));
    if (sides_[from] == sides_[to] || !env_.edge_marks.contains(map_.vertex(c, from), map_.vertex(c, to))) continue;
    const double *a = env_.point(c, from), *b = env_.point(c, to);
    if (!edge_pierces(a, b)) continue;
    found.event = {{m_.q, a, b}, EventKind::kEdge};
    found.dart = d;
    consider(found);
  }
}

void SweepFlood::consider(const SweepContact& found) {
  if (collect_) found_.push_back(found);
  if (result_.end == SweepEnd::kContact && !comes_before(map_, m_.p, m_.to, found, result_.contact)) return;
  result_.end = SweepEnd::kContact;
  result_.contact = found;
}

/** Of each event the contact that counts, and these in their order. No two are equivalent in either, so no result depends on
 * how they are sorted. */
void SweepFlood::sort_found() {
  const auto before = [this](const SweepContact& a, const SweepContact& b) {
    return comes_before(map_, m_.p, m_.to, a, b);
  };
  const auto by_event = [&](const SweepContact& a, const SweepContact& b) {
    if (same_event(a, b)) return before(a, b);
    return event_key(env_, a) < event_key(env_, b);
  };
  std::sort(found_.begin(), found_.end(), by_event);
  found_.erase(std::unique(found_.begin(), found_.end(), same_event), found_.end());
  std::sort(found_.begin(), found_.end(), before);
}

}  // namespace dsw
