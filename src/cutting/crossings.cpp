#include "cutting/crossings.h"

#include "motion/cast.h"
#include "predicates/plane_hit.h"

namespace dsw {
namespace {

constexpr int kUnknown = 2;

/** Whether segment p q, with its ends on both sides of a triangle, q on side `side_of_q`, passes through it. */
bool pierces(const double* p, const double* q, const double* const* triangle, int side_of_q) {
  for (int k = 0; k < 3; ++k) {
    const double* const ridge[2] = {triangle[k], triangle[(k + 1) % 3]};
    if (line_side<3>(p, q, ridge, NoTally{}).sign != side_of_q) return false;
  }
  return true;
}

}  // namespace

Crossings::Crossings(const Environment<3>& env, const Blade& blade)
    : env_(env),
      map_(env.map),
      blade_(blade),
      cells_(Allocator<MetCell>(env.memory)),
      cell_numbers_(env.memory),
      meetings_(env.memory),
      next_(Allocator<uint32_t>(env.memory)),
      crossings_(Allocator<Crossing>(env.memory)),
      edges_(env.memory),
      points_(Allocator<BladePoint>(env.memory)),
      corners_(Allocator<Corner>(env.memory)),
      beyond_(Allocator<Cell>(env.memory)),
      found_(Allocator<BladePoint>(env.memory)) {}

void Crossings::flood(Cell start) {
  for (uint32_t t = 0; t < blade_.triangle_count(); ++t) seed(start, t);
  run();
}

bool Crossings::seed(Cell c, uint32_t triangle) {
  if (!meet(c, triangle, blade_.swept(triangle)).triangle) return false;
  insert(c, triangle);
  return true;
}

void Crossings::run() {
  for (; looked_at_ < meetings_.size(); ++looked_at_) look_at(looked_at_);
}

bool Crossings::is_met(Cell c) {
  for (uint32_t t = 0; t < blade_.triangle_count(); ++t) {
    if (meet(c, t, blade_.swept(t)).triangle) return true;
  }
  return false;
}

void Crossings::insert(Cell c, uint32_t triangle) {
  const uint32_t cell = cell_numbers_.insert(c.unit);
  if (cell == cells_.size()) cells_.push_back({c, KeyTable::kNone, false, !admits(env_, c)});
  const uint32_t meeting = meetings_.insert(uint64_t{cell} << 32 | triangle);
  if (meeting != next_.size()) return;
  next_.push_back(cells_[cell].last_triangle);
  cells_[cell].last_triangle = meeting;
}

void Crossings::look_at(uint32_t meeting) {
  const auto i = static_cast<uint32_t>(meetings_[meeting] >> 32), triangle = static_cast<uint32_t>(meetings_[meeting]);
  if (cells_[i].invalid) return;
  const Cell c = cells_[i].cell;
  const SweptTriangle swept = blade_.swept(triangle);
  const Met met = meet(c, triangle, swept);
  note_crossings(c, triangle, swept);
  for (BladePoint& point : found_) {
    point.cell = i;
    points_.push_back(point);
  }
  for (const Cell beyond : beyond_) insert(beyond, triangle);
  for (int side = 0; side < 3; ++side) {
    if (!met.sides[side]) continue;
    const uint32_t neighbour = blade_.neighbour(triangle, side);
    if (neighbour == Blade::kNone) {
      cells_[i].holds_rim = true;
    } else {
      insert(c, neighbour);
    }
  }
}

void Crossings::read_corners(Cell c, const SweptTriangle& swept) {
  corners_.resize(map_.vertices_of(c));
  for (uint32_t k = 0; k < corners_.size(); ++k) {
    const uint32_t vertex = map_.vertex(c, k);
    const double* const at = env_.point(vertex);
    corners_[k] = {at, vertex, swept.beyond_box(at), kUnknown};
  }
}

int Crossings::side(Corner& corner, const SweptTriangle& swept) const {
  if (corner.side == kUnknown) corner.side = swept.side(corner.at);
  return corner.side;
}

/** Whether the cell that is looked at contains a point. */
bool Crossings::holds(Cell c, const double* point) const {
  for (int axis = 0; axis < 3; ++axis) {
    bool above = false, below = false;
    for (const Corner& corner : corners_) {
      above = above || corner.at[axis] >= point[axis];
      below = below || corner.at[axis] <= point[axis];
    }
    if (!above || !below) return false;
  }
  return contains(env_, c, point);
}

/** Leaves in beyond_ and found_ what there is to be known of a triangle in a cell. */
Crossings::Met Crossings::meet(Cell c, uint32_t triangle, const SweptTriangle& swept) {
  Met met;
  beyond_.clear();
  found_.clear();
  read_corners(c, swept);
  uint32_t common = ~0u;
  for (const Corner& corner : corners_) common &= corner.beyond;
  if (common != 0) return met;
  const double* at[3];
  blade_.corners(triangle, at);
  const Shape shape = map_.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    bool passes = false;
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      passes = meet_simplex(shape.simplices() + 3 * s, swept, at, met) || passes;
    }
    if (!passes) continue;
    met.triangle = true;
    const HalfFacet o = map_.opposite(map_.half_facet(c, f));
    if (o.valid()) beyond_.push_back(map_.cell_of(o));
  }
  for (int k = 0; k < 3; ++k) {
    if (!holds(c, at[k])) continue;
    met.triangle = met.sides[k] = met.sides[(k + 2) % 3] = true;
    found_.push_back({0, {at[k][0], at[k][1], at[k][2]}});
  }
  return met;
}

/** Whether the triangle meets a simplex of the cell's boundary: an edge of one passes through the other. */
bool Crossings::meet_simplex(const uint16_t* local, const SweptTriangle& swept, const double* const* at, Met& met) {
  Corner* const corner[3] = {&corners_[local[0]], &corners_[local[1]], &corners_[local[2]]};
  if ((corner[0]->beyond & corner[1]->beyond & corner[2]->beyond) != 0) return false;
  const int sides[3] = {side(*corner[0], swept), side(*corner[1], swept), side(*corner[2], swept)};
  if (sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2]) return false;  // 0: the triangle is flat
  bool passes = false;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (sides[k] == sides[next]) continue;
    passes = passes || swept.outside(corner[k]->at, corner[next]->at, sides[next]) == 0;
  }
  const double* const simplex[3] = {corner[0]->at, corner[1]->at, corner[2]->at};
  int of_blade[3];
  for (int k = 0; k < 3; ++k) of_blade[k] = plane_side<3>(simplex, at[k], NoTally{}).sign;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (of_blade[k] == of_blade[next] || !pierces(at[k], at[next], simplex, of_blade[next])) continue;
    passes = met.sides[k] = true;
    const bool outwards = of_blade[next] > 0;
    const double *const inner = at[outwards ? k : next], *const outer = at[outwards ? next : k];
    BladePoint point{};
    point_at<3>(inner, outer, crossing_time<3>(inner, outer, simplex), point.at);
    found_.push_back(point);
  }
  return passes;
}

/** Edges of the cell that the triangle crosses. */
void Crossings::note_crossings(Cell c, uint32_t triangle, const SweptTriangle& swept) {
  const double* at[3];
  blade_.corners(triangle, at);
  const Shape shape = map_.shape(c);
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    if (shape.dart_beta2(d) < d) continue;
    Corner *inner = &corners_[shape.dart_vertex(d)], *outer = &corners_[shape.dart_vertex(shape.beta1(d))];
    if ((inner->beyond & outer->beyond) != 0 || side(*inner, swept) == side(*outer, swept)) continue;
    if (swept.outside(inner->at, outer->at, outer->side) != 0) continue;
    if (inner->side > 0) std::swap(inner, outer);
    const uint32_t i = edges_.insert(pair_key(inner->vertex, outer->vertex));
    if (i == crossings_.size()) {
      const double share = crossing_time<3>(inner->at, outer->at, at);
      crossings_.push_back({inner->vertex, outer->vertex, share, triangle, true});
    } else if (crossings_[i].triangle != triangle) {
      crossings_[i].once = false;
    }
  }
}

}  // namespace dsw
