// The facets that an edge passes change only where the edge touches a ridge of one of them, or where one of its ends passes
// one. Some ridges are never touched: their boxes are apart from that of the edge's way, or the lines through all choices
// of start or end of both ends certainly pass them on the same side. At all others, all facets are taken in up to the
// walls, and their other ridges are asked about, and so on. Then these facets are all that the edge passes before it
// passes a wall's ridge, and all such ridges that it may touch first are found.
//
// What the edge touches in a cell without passing it lies in a facet of the cell, at a ridge that the edge touches. So that
// facet is one of these, too. At a vertex that the edge touches all ridges are touched, so all facets there are found.

#include "together/ridge_rings.h"

#include <algorithm>

#include "environment/marking.h"
#include "flood/edge_turn.h"
#include "walk/shear.h"

namespace dsw {
namespace {

/** Whether four determinants certainly have the same sign. */
template <class V>
bool have_one_sign(const double (&dets)[4], const V& reach) noexcept {
  double low = dets[0], high = dets[0];
  for (int i = 1; i < 4; ++i) {
    low = filter::smaller(low, dets[i]);
    high = filter::larger(high, dets[i]);
  }
  return (low > 0 && filter::certain(low, reach)) || (high < 0 && filter::certain(high, reach));
}

}  // namespace

template <int D>
RidgeRings<D>::Lines::Lines(const EdgeTravel& edge) noexcept : last{edge.last, edge.last_to} {
  for (int k = 0; k < D; ++k) {
    const auto ends = {edge.first[k], edge.first_to[k], edge.last[k], edge.last_to[k]};
    low[k] = std::min(ends);
    high[k] = std::max(ends);
  }
  for (int k = 0; k < 2; ++k) {
    ways[k][0] = filter::difference<D>(last[k], edge.first);
    ways[k][1] = filter::difference<D>(last[k], edge.first_to);
  }
}

/** Whether a ridge was not asked about before. */
template <int D>
bool RidgeRings<D>::is_new(const Ridge& ridge) noexcept {
  const uint64_t key = uint64_t{ridge.vertices[0]} << 32 | ridge.vertices[1];
  for (uint64_t at = (key * 0x9e3779b97f4a7c15u) >> 56;; at = (at + 1) % kSlots) {
    if (ridges_[at] == key) return false;
    if (ridges_[at] != kNoRidge) continue;
    ridges_[at] = key;
    ++ridge_count_;
    return true;
  }
}

/** One bound holds for all lines: no rounded difference exceeds that of the ends of the box of all points. */
template <int D>
bool RidgeRings<D>::may_touch(const Ridge& ridge, const Lines& lines) const noexcept {
  const double *const x = env_.point(ridge.vertices[0]), *const y = env_.point(ridge.vertices[1]);
  double reach[D];
  for (int k = 0; k < D; ++k) {
    const double low = filter::smaller(x[k], y[k]), high = filter::larger(x[k], y[k]);
    if (high < lines.low[k] || lines.high[k] < low) return false;
    reach[k] = filter::larger(lines.high[k], high) - filter::smaller(lines.low[k], low);
  }
  double dets[4];
  for (int k = 0; k < 2; ++k) {
    const filter::Vec<D> a = filter::difference<D>(x, lines.last[k]);
    filter::Vec<D> normal;
    if constexpr (D == 3) {
      normal = filter::cross(a, filter::difference<3>(y, lines.last[k]));
    } else {
      normal = {a.y, -a.x};
    }
    dets[2 * k] = filter::dot(normal, lines.ways[k][0]);
    dets[2 * k + 1] = filter::dot(normal, lines.ways[k][1]);
  }
  if constexpr (D == 3) {
    return !have_one_sign(dets, filter::Vec<3>{reach[0], reach[1], reach[2]});
  } else {
    return !have_one_sign(dets, filter::Vec<2>{reach[0], reach[1]});
  }
}

/** Takes in the facets that follow one round a ridge, to the first wall. False: not known. */
template <int D>
bool RidgeRings<D>::go_round(HalfFacet facet, const Ridge& ridge, WallRidge& met) {
  constexpr size_t kMostCells = 64;
  const Map<D>& map = env_.map;
  const ConvexCells<D> cells{map};
  Pivot<D> pivot;
  std::copy_n(ridge.vertices, D - 1, pivot.vertices);
  HalfFacet entered = facet;
  for (size_t count = 0; count < kMostCells; ++count) {
    const Cell c = map.cell_of(entered);
    if (!cells.suits(c)) return false;
    if (!met.name.cell.valid() || c.unit < met.name.cell.unit) met.name.cell = c;
    const HalfFacet next = cells.other(c, entered, pivot);
    if (is_impassable(env_, next)) {
      met.walls[met.walls[0].valid() ? 1 : 0] = next;
      return true;
    }
    facets_.push_back(next.word);
    entered = map.opposite(next);
    if (entered.word == facet.word) return true;
  }
  return false;
}

/** Takes in all facets at a ridge of one, up to walls. False: not known. */
template <int D>
bool RidgeRings<D>::add_ring(HalfFacet facet, const Ridge& ridge) {
  WallRidge met{{{ridge.vertices[0], ridge.vertices[1], kNone}, D - 1, {}, {}}, {}};
  if (!go_round(facet, ridge, met)) return false;
  if (met.walls[0].valid() && !go_round(env_.map.opposite(facet), ridge, met)) return false;
  const bool is_marked = D == 3 ? env_.marked_edges != 0 && edge_marked(env_, ridge.vertices[0], ridge.vertices[1])
                                : vertex_marked(env_, ridge.vertices[0]);
  for (const HalfFacet wall : met.walls) {
    if (wall.valid()) name_obstacle(env_.map, NearObstacle<D>{{}, D, wall, {}}, met.name);
  }
  if (is_marked || met.walls[0].valid()) walls_.push_back(met);
  return true;
}

/** Takes in the facets of a sequence that the lines of the edge do not pass for certain. */
template <int D>
void RidgeRings<D>::add_missed(const EdgeSequence<D>& sequence, const EdgeTravel& edge) {
  uint64_t missed = ~uint64_t{0} >> (kMostMissed - sequence.facets.size());
  if (sequence.in_rows) {
    missed = 0;
    for (const double* from : {edge.first, edge.first_to}) {
      for (const double* to : {edge.last, edge.last_to}) missed |= missed_facets(sequence, from, to);
    }
  }
  for (; missed != 0; missed &= missed - 1) facets_.push_back(sequence.facets[lowest_bit(missed)]);
}

template <int D>
bool RidgeRings<D>::find(const EdgeSequence<D>& sequence, const EdgeTravel& edge) {
  if (sequence.facets.size() > kMostMissed) return false;
  facets_.clear();
  std::fill_n(ridges_, kSlots, kNoRidge);
  ridge_count_ = 0;
  walls_.clear();
  for (const Array<uint32_t>* path : {edge.first_path, edge.last_path}) {
    facets_.insert(facets_.end(), path->begin(), path->end());
  }
  if (!sequence.facets.empty()) add_missed(sequence, edge);
  const Lines lines(edge);
  const ConvexCells<D> cells{env_.map};
  for (size_t i = 0; i < facets_.size(); ++i) {
    const HalfFacet facet{facets_[i]};
    if (!cells.suits(env_.map.cell_of(facet))) return false;
    uint32_t vertices[4];
    const uint32_t count = cells.corners(facet, vertices);
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t a = vertices[k], b = D == 3 ? vertices[k + 1 == count ? 0 : k + 1] : a;
      const Ridge ridge{{std::min(a, b), std::max(a, b)}};
      if (!is_new(ridge) || !may_touch(ridge, lines)) continue;
      if (ridge_count_ > kMostRidges || !add_ring(facet, ridge)) return false;
    }
  }
  return true;
}

template class RidgeRings<2>;
template class RidgeRings<3>;

}  // namespace dsw
