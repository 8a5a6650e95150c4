#include "cutting/crossings.h"

#include <cmath>

#include "base/position.h"
#include "map/dart.h"
#include "predicates/plane_hit.h"
#include "walk/cast.h"

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

template <int D>
Crossings<D>::Crossings(const Environment<D>& env, const Blade<D>& blade)
    : env_(env), map_(env.map), blade_(blade), holders_(blade.point_count(), Cell{}, env.memory) {}

template <int D>
void Crossings<D>::flood(Cell start) {
  for (uint32_t s = 0; s < blade_.simplex_count(); ++s) seed(start, s);
  run();
}

template <int D>
bool Crossings<D>::seed(Cell c, uint32_t simplex) {
  if (!is_met(c, simplex)) return false;
  insert(c, simplex);
  return true;
}

template <int D>
void Crossings<D>::run() {
  for (; looked_at_ < meetings_.size(); ++looked_at_) look_at(looked_at_);
}

template <int D>
bool Crossings<D>::is_met(Cell c) {
  for (uint32_t s = 0; s < blade_.simplex_count(); ++s) {
    if (is_met(c, s)) return true;
  }
  return false;
}

template <int D>
void Crossings<D>::insert(Cell c, uint32_t simplex) {
  const uint32_t cell = cell_numbers_.insert(c.unit);
  if (cell == cells_.size()) cells_.push_back({c, KeyTable::kNone, false, !admits(env_, c)});
  const uint32_t meeting = meetings_.insert(uint64_t{cell} << 32 | simplex);
  if (meeting != next_.size()) return;
  next_.push_back(cells_[cell].last_simplex);
  cells_[cell].last_simplex = meeting;
}

template <int D>
void Crossings<D>::look_at(uint32_t meeting) {
  const auto i = static_cast<uint32_t>(meetings_[meeting] >> 32), simplex = static_cast<uint32_t>(meetings_[meeting]);
  if (cells_[i].invalid) return;
  const Cell c = cells_[i].cell;
  const BladeSimplex<D> blade = blade_.simplex(simplex);
  const Met met = meet(c, simplex, blade);
  note_crossings(c, simplex, blade);
  for (BladePoint<D>& point : found_) {
    point.cell = i;
    points_.push_back(point);
  }
  for (const Cell beyond : beyond_) insert(beyond, simplex);
  for (int side = 0; side < D; ++side) {
    if (!met.sides[side]) continue;
    const uint32_t neighbour = blade_.neighbour(simplex, side);
    if (neighbour == Blade<D>::kNone) {
      cells_[i].holds_rim = true;
    } else {
      insert(c, neighbour);
    }
  }
}

/** Returns the bits of the sides of the simplex's box that all of them lie beyond. */
template <int D>
uint32_t Crossings<D>::read_corners(Cell c, const BladeSimplex<D>& blade) {
  const uint32_t count = map_.vertices_of(c);
  corners_.resize(count);
  sides_.resize(count);
  std::fill_n(lower_, D, HUGE_VAL);
  std::fill_n(upper_, D, -HUGE_VAL);
  Corner* corner = corners_.data();
  uint8_t* side = sides_.data();
  uint32_t common = ~0u;
  map_.for_each_vertex(c, [&](uint32_t vertex) {
    const double* const at = env_.point(vertex);
    *corner++ = {at, vertex, kUnknown, blade.view(at)};
    const uint32_t beyond = blade.beyond_box(at);
    common &= beyond;
    *side++ = static_cast<uint8_t>(beyond);
    for (int axis = 0; axis < D; ++axis) {
      lower_[axis] = std::min(lower_[axis], at[axis]);
      upper_[axis] = std::max(upper_[axis], at[axis]);
    }
  });
  return common;
}

/** See BladeSimplex: of an edge of the cell, or of a facet's triangles, with its ends on two sides of the simplex. That
 * is asked once for all who have the edge. */
template <int D>
uint32_t Crossings<D>::outside(uint32_t a, uint32_t b, const BladeSimplex<D>& blade) {
  const Corner &from = corners_[std::min(a, b)], &to = corners_[std::max(a, b)];
  const auto ask = [&] { return blade.outside(from.at, to.at, from.view, to.view, to.side, bound_); };
  if (D == 2 || outside_.empty()) return ask();
  uint8_t& known = outside_[std::min(a, b) * corners_.size() + std::max(a, b)];
  if (known == kUnasked) known = static_cast<uint8_t>(ask());
  return known;
}

/** Whether the cell that is looked at contains a point of the blade. Where it was found before is noted. */
template <int D>
bool Crossings<D>::holds(Cell c, uint32_t number) {
  if (holders_[number] == c) return true;
  const double* const point = blade_.point(number);
  for (int axis = 0; axis < D; ++axis) {
    if (!(lower_[axis] <= point[axis] && point[axis] <= upper_[axis])) return false;
  }
  if (!contains(env_, c, point)) return false;
  holders_[number] = c;
  return true;
}

/** Leaves in beyond_ and found_ what there is to be known of a simplex in a cell. */
template <int D>
typename Crossings<D>::Met Crossings<D>::meet(Cell c, uint32_t simplex, const BladeSimplex<D>& blade) {
  Met met;
  beyond_.clear();
  found_.clear();
  if (read_corners(c, blade) != 0) return met;
  const size_t count = corners_.size();
  bound_ = blade.bound(lower_, upper_);
  if (D == 3) outside_.assign(count <= kMostKept ? count * count : 0, kUnasked);
  for (size_t i = 0; i < count; ++i) {
    Corner& corner = corners_[i];
    corner.side = blade.side(corner.at, corner.view, bound_);
    sides_[i] = static_cast<uint8_t>(sides_[i] | (corner.side > 0 ? kBefore : 0u) | (corner.side < 0 ? kBehind : 0u));
  }
  const double* at[D];
  blade_.corners(simplex, at);
  const Shape shape = map_.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    bool passes = false;
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const uint16_t* const local = shape.simplices() + D * s;
      if (!are_apart(local)) passes = meet_boundary(local, simplex, blade, at, met) || passes;
    }
    if (!passes) continue;
    met.simplex = true;
    const HalfFacet o = map_.opposite(map_.half_facet(c, f));
    if (o.valid()) beyond_.push_back(map_.cell_of(o));
  }
  for (int k = 0; k < D; ++k) {
    if (!holds(c, blade_.corner(simplex, k))) continue;
    met.simplex = met.sides[k] = true;
    if constexpr (D == 3) met.sides[(k + 2) % 3] = true;
    found_.emplace_back();
    std::copy_n(at[k], D, found_.back().at);
  }
  return met;
}

/** Whether a simplex of the cell's boundary lies beyond one side of the simplex's box, or on one side of its plane.
 * Where the blade is flat its points are on no side. */
template <int D>
bool Crossings<D>::are_apart(const uint16_t* local) const {
  uint32_t common = sides_[local[0]];
  for (int k = 1; k < D; ++k) common &= sides_[local[k]];
  return common != 0;
}

/** Whether the blade's simplex meets one of the cell's boundary that is not apart from it: an edge of one passes
 * through the other. In the plane both are edges, so asking once is enough. */
template <int D>
bool Crossings<D>::meet_boundary(const uint16_t* local, [[maybe_unused]] uint32_t simplex, const BladeSimplex<D>& blade,
                                 [[maybe_unused]] const double* const (&at)[D], [[maybe_unused]] Met& met) {
  int sides[D];
  for (int k = 0; k < D; ++k) sides[k] = corners_[local[k]].side;
  if constexpr (D == 2) {
    return sides[0] != sides[1] && outside(local[0], local[1], blade) == 0;
  } else {
    const bool flat = sides[0] == 0;  // of the blade: then all are
    // Where two edges of the boundary pass through the blade's plane are the ends of a segment. It is what lies in both
    // planes, and the blade's sides that have one end outside and the other inside are those whose lines cross it.
    uint32_t ends[2] = {}, count = 0;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (sides[k] != sides[next]) ends[count++] = outside(local[k], local[next], blade);
    }
    if ((ends[0] & ends[1]) != 0) return false;  // all of it is on the outside of one line
    bool passes = !flat && (ends[0] == 0 || ends[1] == 0);
    const uint32_t crossed = flat ? BladeSimplex<3>::kSides : ends[0] | ends[1];
    if (crossed == 0) return true;
    const double* const facet[3] = {corners_[local[0]].at, corners_[local[1]].at, corners_[local[2]].at};
    int of_blade[3] = {kUnknown, kUnknown, kUnknown};
    const auto side_of_blade = [&](int k) {
      if (of_blade[k] == kUnknown) of_blade[k] = plane_side<3>(facet, at[k], NoTally{}).sign;
      return of_blade[k];
    };
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if ((crossed >> k & 1u) == 0 || side_of_blade(k) == side_of_blade(next)) continue;
      if (flat && !pierces(at[k], at[next], facet, of_blade[next])) continue;
      passes = met.sides[k] = true;
      if (blade_.neighbour(simplex, k) < simplex) continue;  // the neighbour finds the same point
      const bool outwards = of_blade[next] > 0;
      const uint32_t ends_of_side[2] = {blade_.corner(simplex, k), blade_.corner(simplex, next)};
      found_.push_back({0,
                        ends_of_side[outwards ? 0 : 1],
                        ends_of_side[outwards ? 1 : 0],
                        {corners_[local[0]].vertex, corners_[local[1]].vertex, corners_[local[2]].vertex},
                        {}});
    }
    return passes;
  }
}

template <int D>
void Crossings<D>::place(const BladePoint<D>& point, double* out) const {
  if (D == 2 || point.inner == point.outer) {
    std::copy_n(point.at, D, out);
    return;
  }
  if constexpr (D == 3) {
    const double *const inner = blade_.point(point.inner), *const outer = blade_.point(point.outer);
    const double* const facet[3] = {env_.point(point.corners[0]), env_.point(point.corners[1]),
                                    env_.point(point.corners[2])};
    point_at<3>(inner, outer, crossing_time<3>(inner, outer, facet), out);
  }
}

/** Edges of the cell that the simplex crosses. */
template <int D>
void Crossings<D>::note_crossings(Cell c, uint32_t simplex, const BladeSimplex<D>& blade) {
  const double* at[D];
  blade_.corners(simplex, at);
  const Shape shape = map_.shape(c);
  const uint32_t count = shape.dart_count();
  const uint16_t *const vertices = shape.dart_vertices(), *const facets = vertices + count,
                        *const beta2 = facets + count;
  for (uint32_t d = 0; d < count; ++d) {
    if (beta2[d] < d) continue;
    const uint32_t end = D == 3 ? shape.facet_first(facets[d] + 1u) : count;  // of the facet, or of the polygon
    const uint32_t from = vertices[d], to = vertices[d + 1 < end ? d + 1 : D == 3 ? shape.facet_first(facets[d]) : 0];
    Corner *inner = &corners_[from], *outer = &corners_[to];
    if ((sides_[from] & sides_[to]) != 0 || inner->side == outer->side) continue;
    if (outside(from, to, blade) != 0) continue;
    if (inner->side > 0) std::swap(inner, outer);
    const uint32_t i = edges_.insert(pair_key(inner->vertex, outer->vertex));
    if (i == crossings_.size()) {
      const double share = crossing_time<D>(inner->at, outer->at, at);
      crossings_.push_back({inner->vertex, outer->vertex, share, simplex, true});
    } else if (crossings_[i].simplex != simplex) {
      crossings_[i].once = false;
    }
    if constexpr (D == 2) {  // here the segment leaves the cell; where a vertex will come
      found_.emplace_back();
      point_at<2>(inner->at, outer->at, crossings_[i].share, found_.back().at);
    }
  }
}

template class Crossings<2>;
template class Crossings<3>;

}  // namespace dsw
