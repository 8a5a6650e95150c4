// A part that starts free touches a wall first where it comes to it through passable cells: at every moment before, each of
// its points is in one. All of these cells may be in the box of the part's way at some time. If they stay valid, a point
// leaves a cell only through a facet, so the flood through passable facets that may be in the box finds them all, and with
// them the wall.
//
// What touches at the start may be free under the shift, and stay so. The determinant of the points of a part and a feature
// is affine in each of them. If it has one sign under the shift for all choices of start or end of each point, part and
// feature never meet. A common translation of all points changes nothing, so it is left out if that is exact.

#include "together/moving_walls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dimensions.h"
#include "contact/describe.h"
#include "environment/validity.h"
#include "predicates/filtered.h"
#include "predicates/sweep_events.h"
#include "together/describe.h"
#include "together/place_on_way.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** An order of ways, each a start and an end, by coordinates. */
template <int D>
bool is_before(const double* const (&a)[2], const double* const (&b)[2]) {
  const bool same_start = std::equal(a[0], a[0] + D, b[0]);
  return std::lexicographical_compare(a[same_start], a[same_start] + D, b[same_start], b[same_start] + D);
}

/** Whether a - b, which was rounded to `difference`, needs no rounding. */
bool is_exact_difference(double a, double b, double difference) {
  const double other = a - difference;
  return std::isfinite(difference) && (a - (difference + other)) + (other - b) == 0;
}

}  // namespace

template <int D>
void MovingWalls<D>::begin(const double* next, Array<dsw_volume_id>& invalid) noexcept {
  next_ = next;
  invalid_ = &invalid;
  flood_.set_next(next);
}

template <int D>
void MovingWalls<D>::start(const Array<Traveller<D>>& travellers) {
  for (const Point& each : points_) places_[each.vertex] = kNone;
  for (const Cell c : checked_) is_checked_[env_.map.index(c)] = 0;
  points_.clear();
  checked_.clear();
  nears_.clear();
  features_.clear();
  cells_.clear();
  places_.resize(env_.map.vertex_count, kNone);
  is_checked_.resize(env_.map.index_count(), 0);
  stay_valid_ = true;
  counts = {};
  contacts.clear();
  for (uint32_t t = 0; t < travellers.size(); ++t) {
    for_each_simplex(*travellers[t].body, [&](const Simplex& part) {
      collect(travellers[t], t, part);
      return true;
    });
  }
}

template <int D>
void MovingWalls<D>::collect(const Traveller<D>& of, uint32_t number, const Simplex& part) {
  const SimplexCorners<D> corners(*of.body, part);
  // The region depends on the order of its points, and results must not depend on numbers.
  const double* ways[3][2];
  for (uint32_t i = 0; i < corners.count; ++i) {
    ways[i][0] = of.start(corners.vertices[i]);
    ways[i][1] = of.target(corners.vertices[i]);
    for (uint32_t k = i; k > 0 && is_before<D>(ways[k], ways[k - 1]); --k) std::swap(ways[k], ways[k - 1]);
  }
  const double* points[6];
  for (uint32_t i = 0; i < corners.count; ++i) {
    points[i] = ways[i][0];
    points[corners.count + i] = ways[i][1];
  }
  list_.clear();
  const uint32_t count = 2 * corners.count;
  const NearRegion<D> region(points, count, room_of_rounding<D>(points, count));
  flood_.find(&of.body->vertices[corners.vertices[0]].cell, 1, region, list_);
  Near near{number, part, static_cast<uint32_t>(features_.size()), 0, static_cast<uint32_t>(cells_.size()), 0};
  add_cells();
  if (part.kind != Simplex::kVertex) cells_.resize(near.first_cell);
  if (!list_.empty()) {
    list_.finish({env_.points, D});
    add_features(part);
  }
  near.feature_end = static_cast<uint32_t>(features_.size());
  near.cell_end = static_cast<uint32_t>(cells_.size());
  if (part.kind == Simplex::kVertex || near.first_feature != near.feature_end) nears_.push_back(near);
}

/** Notes the cells of the last flood, and looks whether they stay valid. */
template <int D>
void MovingWalls<D>::add_cells() {
  for (size_t i = 0; i < flood_.cells().size(); ++i) {
    const Cell c = flood_.cells()[i];
    cells_.push_back(c);
    const uint32_t index = env_.map.index(c);
    if (is_checked_[index] != 0) continue;
    is_checked_[index] = 1;
    checked_.push_back(c);
    env_.map.for_each_vertex(c, [&](uint32_t v) {
      if (!is_finite<D>(next_ + size_t{D} * v)) fail_non_finite({next_, D}, v, D, {"next", true});
    });
    if (stays_valid(env_, c, next_)) continue;
    invalid_->push_back(volume_id(env_.map, c));
    stay_valid_ = false;
  }
}

/** The triangles of walls for a vertex, their sides for an edge, and their corners for a face; in the plane their segments
 * for a vertex, and their ends for an edge. */
template <int D>
void MovingWalls<D>::add_features(const Simplex& part) {
  const uint32_t wanted = D - static_cast<uint32_t>(part.kind);
  for (const NearFeature& f : list_.features()) {
    if (f.count != wanted) continue;
    WallFeature feature{{kNone, kNone, kNone}, wanted, {}, {}};
    for (uint32_t i = 0; i < wanted; ++i) {
      feature.vertices[i] = list_.name(f.corners[i]);
      place_of(feature.vertices[i]);
    }
    list_.for_each_obstacle(f, [&](uint32_t number) {
      const NearObstacle<D>& o = list_.obstacles()[number];
      if (!o.facet.valid()) {
        feature.cell = o.cell;
      } else if (!feature.facet.valid() ||
                 canonical(env_.map, o.facet).word < canonical(env_.map, feature.facet).word) {
        feature.facet = o.facet;
      }
    });
    features_.push_back(feature);
  }
}

template <int D>
uint32_t MovingWalls<D>::place_of(uint32_t vertex) {
  if (places_[vertex] == kNone) {
    places_[vertex] = static_cast<uint32_t>(points_.size());
    Point& added = points_.emplace_back();
    added.vertex = vertex;
    std::copy_n(next_ + size_t{D} * vertex, D, added.end);
  }
  return places_[vertex];
}

template <int D>
void MovingWalls<D>::set_end(double time) {
  for (Point& each : points_) place_on_way<D>(env_.point(each.vertex), next_ + size_t{D} * each.vertex, time, each.end);
}

template <int D>
bool MovingWalls<D>::is_free(const Array<Traveller<D>>& travellers) {
  return visit_touches(travellers, [](const WayTouch<D>&) { return false; });
}

template <int D>
void MovingWalls<D>::find_first(const Array<Traveller<D>>& travellers, FirstTouches<D>& first) {
  visit_touches(travellers, [&](const WayTouch<D>& touch) {
    first.add(touch);
    return true;
  });
}

/** Calls visit(touch) for what touches on its way, until it returns false. */
template <int D>
template <class Visit>
bool MovingWalls<D>::visit_touches(const Array<Traveller<D>>& travellers, Visit visit) {
  for (const Near& near : nears_) {
    const Traveller<D>& of = travellers[near.traveller];
    ++counts.swept;
    for (uint32_t i = near.first_feature; i < near.feature_end; ++i) {
      WayTouch<D> touch{};
      if (!set_pair(of, near, features_[i], touch) || !boxes_overlap(touch.pair)) continue;
      touch.first = first_touch(touch.pair);
      if (!touch.first.touches || stays_free(touch, 1 + static_cast<uint32_t>(near.part.kind))) continue;
      touch.traveller = near.traveller;
      touch.part = near.part;
      touch.wall = features_[i];
      if (!visit(touch)) return false;
    }
  }
  return true;
}

/** The points of a part and a feature; whether any of them moves. */
template <int D>
bool MovingWalls<D>::set_pair(const Traveller<D>& of, const Near& near, const WallFeature& feature,
                              WayTouch<D>& touch) const {
  const SimplexCorners<D> corners(*of.body, near.part);
  touch.pair.kind = D == 2                             ? PairKind::kVertexEdge
                    : near.part.kind == Simplex::kEdge ? PairKind::kEdgeEdge
                                                       : PairKind::kVertexFace;
  // Who has fewer points comes first.
  touch.comes_first = corners.count <= feature.count;
  const uint32_t first_corner = touch.comes_first ? 0 : feature.count,
                 first_wall = touch.comes_first ? corners.count : 0;
  bool moves = false;
  for (uint32_t i = 0; i < corners.count; ++i) {
    touch.pair.start[first_corner + i] = of.start(corners.vertices[i]);
    touch.pair.end[first_corner + i] = of.end(corners.vertices[i]);
    moves = moves || of.moves(corners.vertices[i]);
  }
  for (uint32_t i = 0; i < feature.count; ++i) {
    const double* const start = touch.pair.start[first_wall + i] = env_.point(feature.vertices[i]);
    const double* const end = touch.pair.end[first_wall + i] = points_[places_[feature.vertices[i]]].end;
    moves = moves || !std::equal(start, start + D, end);
  }
  return moves;
}

/** Whether what touches on its way is free under the shift of the part, all the way. It is at the start. */
template <int D>
bool MovingWalls<D>::stays_free(const WayTouch<D>& touch, uint32_t part_count) const {
  if (keeps_sides(touch.pair, part_count, touch.comes_first)) return true;
  MovingPair<D> rest = touch.pair;  // without the translation of the wall's first point
  const double* const from = touch.pair.start[touch.comes_first ? part_count : 0];
  const double* const to = touch.pair.end[touch.comes_first ? part_count : 0];
  double ends[D + 1][D];
  for (int k = 0; k < D; ++k) {
    const double way = to[k] - from[k];
    if (!is_exact_difference(to[k], from[k], way)) return false;
    for (int i = 0; i <= D; ++i) {
      ends[i][k] = touch.pair.end[i][k] - way;
      if (!is_exact_difference(touch.pair.end[i][k], way, ends[i][k])) return false;
    }
  }
  bool moves = false;
  for (int i = 0; i <= D; ++i) {
    rest.end[i] = ends[i];
    moves = moves || !std::equal(ends[i], ends[i] + D, rest.start[i]);
  }
  return !moves || keeps_sides(rest, part_count, touch.comes_first);
}

/** Under the shift of the part, which has the first or the last points of the pair. */
template <int D>
bool MovingWalls<D>::keeps_sides(const MovingPair<D>& pair, uint32_t part_count, bool part_first) const {
  const uint32_t first_corner = part_first ? 0 : D + 1 - part_count, first_wall = part_first ? part_count : 0;
  int side = 0;
  for (uint32_t choice = 0; choice < 1u << (D + 1); ++choice) {
    const double* at[D + 1];
    bool is_new = true;
    for (int i = 0; i <= D; ++i) {
      const bool is_end = (choice >> i & 1u) != 0;
      at[i] = is_end ? pair.end[i] : pair.start[i];
      is_new = is_new && !(is_end && std::equal(pair.start[i], pair.start[i] + D, pair.end[i]));
    }
    if (!is_new) continue;
    const double *const *const part = at + first_corner, *const *const wall = at + first_wall;
    int sign;
    if (part_count == 1) {
      sign = plane_side<D>(wall, part[0], NoTally{}).sign;
    } else if (part_count == D) {
      if constexpr (D == 3) {
        sign = swept_side({part[0], part[1], part[2]}, wall[0]).sign;
      } else {
        const double* const ridge[2] = {wall[0], nullptr};
        sign = line_side<2>(part[0], part[1], ridge, NoTally{}).sign;
      }
    } else {
      sign = line_side<D>(part[0], part[1], wall, NoTally{}).sign;
    }
    if (sign == 0 || (side != 0 && sign != side)) return false;
    side = sign;
  }
  return true;
}

template <int D>
void MovingWalls<D>::describe(const Array<Traveller<D>>& travellers, const FirstTouches<D>& first) {
  contacts.clear();
  for (const WayTouch<D>& touch : first.all) {
    if (touch.other != nullptr) continue;
    const Traveller<D>& of = travellers[touch.traveller];
    dsw_wall_contact& contact = contacts.emplace_back(describe_wall(env_, travellers, touch));
    contact.body = {of.name.index, of.name.generation};
    if (touch.part.kind == Simplex::kVertex) contact.vertex = vertex_id(*of.body, touch.part.index);
    if (touch.part.kind == Simplex::kEdge) contact.edge = edge_id(*of.body, touch.part.index);
    if (touch.part.kind == Simplex::kFace) contact.face = face_id(*of.body, touch.part.index);
  }
}

template <int D>
bool MovingWalls<D>::stayed_valid(const double* start) {
  for (const Cell c : checked_) {
    if (stays_valid(env_, c, start)) continue;  // a way back is as good
    invalid_->push_back(volume_id(env_.map, c));
    stay_valid_ = false;
  }
  return stay_valid_;
}

template <int D>
bool MovingWalls<D>::find_arrivals(Array<Traveller<D>>& travellers) const {
  for (const Near& near : nears_) {
    if (near.part.kind != Simplex::kVertex) continue;
    Traveller<D>& of = travellers[near.traveller];
    const double* const at = of.end(near.part.index);
    Cell& arrival = of.arrivals[near.part.index];
    arrival = {};
    for (uint32_t i = near.first_cell; i < near.cell_end && !arrival.valid(); ++i) {
      if (admits(env_, cells_[i]) && contains(env_, cells_[i], at)) arrival = cells_[i];
    }
    if (!arrival.valid()) return false;
  }
  return true;
}

template class MovingWalls<2>;
template class MovingWalls<3>;

}  // namespace dsw
