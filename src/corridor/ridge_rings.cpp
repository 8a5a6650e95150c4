// Finds the ridges of walls that a moving edge may pass first, under the shift. All cells are exactly convex.
//
// What the edge passes changes in two ways: an end passes a facet, or the edge passes a ridge. The facets of the first kind
// are on the paths of the ends. A ridge of the second kind belongs to a facet that the edge passed just before.
//
// So the search starts with the paths and with the facets that the edge passes at its start. Facets that all four lines
// certainly pass are left out: the edge touches none of their ridges. Each ridge of a facet is asked about. It is skipped if
// its box is apart from that of the edge's way, or if all four lines pass it on one side. If there is a wall or a mark at
// the ridge, it is a feature that the edge may touch: nothing behind it matters. Else all facets round it are added.
//
// By induction over these changes, each facet that the edge passes before its first wall was left out or is in the list. So
// the ridge that it passes first is found. What it only touches may not be found: for example a ridge between two walls of
// one cell. The edge cannot pass such a ridge, only an end can reach it.
//
// Where several fans of passable cells meet at a ridge, each one that is reached counts, so nothing depends on the order
// of facets.

#include "corridor/ridge_rings.h"

#include <algorithm>
#include <tuple>

#include "base/memory.h"
#include "base/sort.h"
#include "environment/marking.h"
#include "map/ridge_walk.h"
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

filter::Vec<2> to_filter(const double (&x)[2]) noexcept { return {x[0], x[1]}; }
filter::Vec<3> to_filter(const double (&x)[3]) noexcept { return {x[0], x[1], x[2]}; }

/** The products of this with lines through `from` tell on which side they pass a ridge. */
template <int D>
filter::Vec<D> normal_of(const double* from, const double* x, [[maybe_unused]] const double* y) noexcept {
  const filter::Vec<D> a = filter::difference<D>(x, from);
  if constexpr (D == 3) {
    return filter::cross(a, filter::difference<3>(y, from));
  } else {
    return {a.y, -a.x};
  }
}

}  // namespace

template <int D>
RidgeRings<D>::Lines::Lines(const EdgeWay& edge) noexcept : others{edge.other, edge.other_to} {
  for (int k = 0; k < D; ++k) {
    const auto ends = {edge.first[k], edge.first_to[k], edge.other[k], edge.other_to[k]};
    low[k] = std::min(ends);
    high[k] = std::max(ends);
  }
  for (int k = 0; k < 2; ++k) {
    ways[k][0] = filter::difference<D>(others[k], edge.first);
    ways[k][1] = filter::difference<D>(others[k], edge.first_to);
  }
}

/** One bound holds for all lines: no rounded difference exceeds that of the ends of the box of all points. */
template <int D>
bool RidgeRings<D>::may_touch(const RidgeName& ridge, const Lines& lines) const noexcept {
  const double *const x = env_.point(ridge.vertices[0]), *const y = env_.point(ridge.vertices[1]);
  double reach[D];
  for (int k = 0; k < D; ++k) {
    const double low = filter::smaller(x[k], y[k]), high = filter::larger(x[k], y[k]);
    if (high < lines.low[k] || lines.high[k] < low) return false;
    reach[k] = filter::larger(lines.high[k], high) - filter::smaller(lines.low[k], low);
  }
  double dets[4];
  for (int k = 0; k < 2; ++k) {
    const filter::Vec<D> normal = normal_of<D>(lines.others[k], x, y);
    dets[2 * k] = filter::dot(normal, lines.ways[k][0]);
    dets[2 * k + 1] = filter::dot(normal, lines.ways[k][1]);
  }
  return !have_one_sign(dets, to_filter(reach));
}

/** Goes round a ridge to the first wall, or all round: calls visit(cell, facet that is left). False: not known. */
template <int D>
template <class Visit>
bool RidgeRings<D>::go_round(HalfFacet facet, const RidgeName& ridge, HalfFacet& wall, Visit visit) const {
  constexpr size_t kMostCells = 64;
  const ConvexCells<D> cells{env_.map};
  wall = {};
  const RidgeWalk walk = walk_round(env_.map, facet, kMostCells, [&](Cell c, HalfFacet entered) {
    const HalfFacet next = cells.other(c, entered, ridge);
    const bool is_wall = next.valid() && is_impassable(env_, next);
    if (is_wall) wall = next;
    if (next.valid()) visit(c, is_wall ? HalfFacet{} : next);
    return is_wall ? HalfFacet{} : next;
  });
  return wall.valid() || walk == RidgeWalk::kAllRound;
}

/** Whether a facet at a ridge is in a fan that was found. */
template <int D>
bool RidgeRings<D>::is_in_fan(HalfFacet facet, const RidgeName& ridge) const {
  HalfFacet wall;
  bool any = false;
  for (const Fan& fan : fans_) {
    if (!(fan.ridge == ridge)) continue;
    any = true;
    if (!fan.walls[0].valid()) return true;
    if (!wall.valid() && !go_round(facet, ridge, wall, [](Cell, HalfFacet) {})) return false;
    if (wall == fan.walls[0] || wall == fan.walls[1]) return true;
  }
  return !any;
}

/** Notes the fan of a facet, or takes in all facets round a ridge that has no walls or marks. False: not known. */
template <int D>
bool RidgeRings<D>::add_fan(HalfFacet facet, const RidgeName& ridge) {
  const Map<D>& map = env_.map;
  const size_t known = facets_.size();
  Fan fan{ridge, {}, map.cell_of(facet)};
  const auto take_in = [&](Cell c, HalfFacet left) {
    if (map.index(c) < map.index(fan.cell)) fan.cell = c;
    if (left.valid()) facets_.push_back(left.word);
  };
  if (!go_round(facet, ridge, fan.walls[0], take_in)) return false;
  const bool has_walls = fan.walls[0].valid();
  if (has_walls && !go_round(map.opposite(facet), ridge, fan.walls[1], take_in)) return false;
  const bool is_marked = D == 3 ? env_.marked_edges != 0 && edge_marked(env_, ridge.vertices[0], ridge.vertices[1])
                                : vertex_marked(env_, ridge.vertices[0]);
  if (has_walls || is_marked) {
    fans_.push_back(fan);
    facets_.resize(known);
  }
  return true;
}

/** Asks about the ridges of a facet. False: not known. */
template <int D>
bool RidgeRings<D>::add_ridges(HalfFacet facet, const Lines& lines) {
  constexpr uint32_t kMostAsked = 160;
  const ConvexCells<D> cells{env_.map};
  if (!env_.map.convex(env_.map.cell_of(facet))) return false;
  return cells.for_each_ridge(facet, [&](uint32_t a, uint32_t b) {
    const RidgeName ridge{{std::min(a, b), std::max(a, b)}};
    const uint32_t before = ridges_.size();
    if (ridges_.insert(pair_key(a, b)) < before) return is_in_fan(facet, ridge) || add_fan(facet, ridge);
    return before < kMostAsked && (!may_touch(ridge, lines) || add_fan(facet, ridge));
  });
}

template <int D>
bool RidgeRings<D>::find(const Corridor<D>& corridor, const EdgeWay& edge, const Array<uint32_t> (&paths)[2]) {
  facets_.clear();
  ridges_.clear();
  fans_.clear();
  if (corridor.facets.size() > kMostMissed) return false;
  for (const Array<uint32_t>& path : paths) facets_.insert(facets_.end(), path.begin(), path.end());
  for (uint64_t missed = missed_facets(env_, corridor, edge); missed != 0; missed &= missed - 1) {
    facets_.push_back(corridor.facets[lowest_bit(missed)]);
  }
  const Lines lines(edge);
  for (size_t i = 0; i < facets_.size(); ++i) {
    if (!add_ridges({facets_[i]}, lines)) return false;
  }
  add_features();
  return true;
}

/** A feature for each ridge of the fans. */
template <int D>
void RidgeRings<D>::add_features() {
  features_.clear();
  planes_.clear();
  numbers_.clear();
  const auto name = [](const Fan& fan) { return std::make_tuple(fan.ridge.vertices[0], fan.ridge.vertices[1]); };
  dsw::sort(fans_.begin(), fans_.end(), [&](const Fan& a, const Fan& b) { return name(a) < name(b); });
  for (size_t i = 0; i < fans_.size();) {
    const Fan& first = fans_[i];
    Candidate feature{{{first.ridge.vertices[0], first.ridge.vertices[1], KeyTable::kNone}, D - 1, {}, {}}, 0, 0};
    feature.first_plane = static_cast<uint32_t>(planes_.size());
    for (; i < fans_.size() && name(fans_[i]) == name(first); ++i) {
      const Fan& fan = fans_[i];
      if (!fan.walls[0].valid()) feature.name.add_name(env_.map, {}, fan.cell);
      for (const HalfFacet wall : fan.walls) {
        if (!wall.valid()) continue;
        feature.name.add_name(env_.map, wall, {});
        const Cell c = env_.map.cell_of(wall);
        numbers_.push_back(static_cast<uint32_t>(planes_.size()));
        const Shape shape = env_.map.shape(c);
        boundary_points(env_, c, shape.simplex_first(env_.map.local_of(wall, c)), planes_.emplace_back().corners);
      }
    }
    feature.plane_end = static_cast<uint32_t>(planes_.size());
    features_.push_back(feature);
  }
}

template <int D>
CandidateView<D> RidgeRings<D>::features() const noexcept {
  return {features_.data(), features_.data() + features_.size(), numbers_.data(), planes_.data(),
          static_cast<uint32_t>(planes_.size())};
}

template class RidgeRings<2>;
template class RidgeRings<3>;

}  // namespace dsw
