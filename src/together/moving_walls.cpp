// A part that starts free touches a wall first where it comes to it through passable cells: at every moment before, each of
// its points is in one. All of these cells may be in the box of the part's way at some time. If they stay valid, a point
// leaves a cell only through a facet, so the flood through passable facets that may be in the box finds them all, and with
// them the wall.
//
// What touches at the start may be free under the shift, and stay so: see keeps_sides. A common translation of all points
// changes nothing, so it is left out if that is exact.

#include "together/moving_walls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dimensions.h"
#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "contact/describe.h"
#include "environment/validity.h"
#include "motion/place_on_way.h"
#include "together/describe.h"
#include "together/kept_sides.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Whether a - b, which was rounded to `difference`, needs no rounding. */
bool is_exact_difference(double a, double b, double difference) {
  const double other = a - difference;
  return std::isfinite(difference) && (a - (difference + other)) + (other - b) == 0;
}

/** A pair without the translation of one of its points, which changes nothing of whether the two meet. False: rounding would. */
template <int D>
bool leave_out_way_of(uint32_t point, MovingPair<D>& pair, double (&ends)[D + 1][D]) {
  for (int k = 0; k < D; ++k) {
    const double to = pair.end[point][k], from = pair.start[point][k], way = to - from;
    if (!is_exact_difference(to, from, way)) return false;
    for (int i = 0; i <= D; ++i) {
      ends[i][k] = pair.end[i][k] - way;
      if (!is_exact_difference(pair.end[i][k], way, ends[i][k])) return false;
    }
  }
  for (int i = 0; i <= D; ++i) pair.end[i] = ends[i];
  return true;
}

template <int D>
bool any_moves(const MovingPair<D>& pair) {
  for (int i = 0; i <= D; ++i) {
    if (!is_same_place<D>(pair.end[i], pair.start[i])) return true;
  }
  return false;
}

}  // namespace

template <int D>
void MovingWalls<D>::begin(PointsWay<D>& way, Array<dsw_volume_id>& invalid) noexcept {
  held.begin(way);
  next_ = way.nexts();
  invalid_ = &invalid;
  flood_.set_next(next_);
}

template <int D>
void MovingWalls<D>::start(Array<Trajectory<D>>& trajectories) {
  counts = {};
  contacts.clear();
  stay_valid_ = true;
  checked_.clear();
  collect_all(trajectories);
  check_from(0, trajectories);
}

/** Finds out whether cells that are met stay valid, too, from one on. Those count that the ways meet, and not those in the room beside
 * them: if one does not, the rooms are given up. */
template <int D>
void MovingWalls<D>::check_from(size_t first, Array<Trajectory<D>>& trajectories) {
  const size_t invalid_before = invalid_->size();
  stay_valid_ = are_valid_from(first) && stay_valid_;
  const auto has_room = [](const Trajectory<D>& of) { return of.beyond > 0; };
  if (stay_valid_ || dsw::none_of(trajectories.begin(), trajectories.end(), has_room)) return;
  invalid_->resize(invalid_before);
  tighten(trajectories);
}

template <int D>
void MovingWalls<D>::tighten(Array<Trajectory<D>>& trajectories) {
  for (Trajectory<D>& of : trajectories) {
    if (of.is_led) of.set_rooms(0);
  }
  checked_.clear();
  collect_all(trajectories);
  stay_valid_ = are_valid_from(0);
}

template <int D>
void MovingWalls<D>::collect_again(Array<Trajectory<D>>& trajectories) {
  const size_t before = checked_.size();
  for (Near& near : nears_) {
    const Trajectory<D>& of = trajectories[near.trajectory];
    const SimplexCorners<D> corners(*of.motion.body, near.part);
    if (!near.has_edge && of.has_new_rooms(corners)) collect(of, near);
  }
  finish_round();
  check_from(before, trajectories);
}

template <int D>
void MovingWalls<D>::collect_all(const Array<Trajectory<D>>& trajectories) {
  nears_.clear();
  features_.clear();
  walls_.clear();
  ends_.clear();
  cells_.clear();
  near_outers.clear();
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    for_each_simplex(*trajectories[t].motion.body, [&](const Simplex& part) {
      nears_.push_back(Near(t, part));
      return true;
    });
  }
  stand_for_ends(trajectories);
  for (Near& near : nears_) {
    if (!near.has_edge) collect(trajectories[near.trajectory], near);
  }
}

/** Edges that are led find what comes near their ends, too: the rooms of these are in the region of the edge. */
template <int D>
void MovingWalls<D>::stand_for_ends(const Array<Trajectory<D>>& trajectories) {
  Array<uint32_t> numbers(env_.memory);  // by vertex
  for (uint32_t i = 0; i < nears_.size(); ++i) {
    const auto& [kind, index] = nears_[i].part;
    const Trajectory<D>& of = trajectories[nears_[i].trajectory];
    const Body<D>& body = *of.motion.body;
    if (!of.is_led || !covers_edges(body.level)) continue;
    if (kind == Simplex::kVertex) {
      numbers.resize(body.vertices.size());
      numbers[index] = i;
    }
    for (uint32_t k = 0; kind == Simplex::kEdge && k < 2; ++k) {
      const uint32_t v = body.edges[index].ends[k];
      if (body.vertices[v].first_edge != index) continue;
      nears_[i].ends[k] = numbers[v];
      nears_[numbers[v]].has_edge = true;
    }
  }
}

/** Whether cells that are met stay valid, from one on. Those that do not are told. */
template <int D>
bool MovingWalls<D>::are_valid_from(size_t first) {
  const size_t before = invalid_->size();
  for (size_t i = first; i < checked_.size(); ++i) {
    if (!stays_valid(env_, checked_[i], next_)) invalid_->push_back(volume_id(env_.map, checked_[i]));
  }
  return invalid_->size() == before;
}

template <int D>
void MovingWalls<D>::collect(const Trajectory<D>& of, Near& near) {
  const Body<D>& body = *of.motion.body;
  const SimplexCorners<D> corners(body, near.part);
  // Outer parts keep their distances for those that they cover.
  const bool is_outer = !is_covered(body, near.part);
  const double radius = is_outer || !of.is_led ? body.radius : 0;
  list_.clear();
  flood_.find(&body.vertices[corners.vertices[0]].cell, 1,
              region_of_way(of, near.part, radius > 0 ? radius + of.bend.most : 0), list_);
  near.first_feature = static_cast<uint32_t>(features_.size());
  near.first_cell = static_cast<uint32_t>(cells_.size());
  check_cells();
  if (near.part.kind == Simplex::kVertex) {
    for (size_t i = 0; i < flood_.cells().size(); ++i) cells_.push_back(flood_.cells()[i]);
  }
  if (!list_.empty()) {
    list_.finish({env_.points, D});
    add_features(of, near.part);
  }
  near.feature_end = static_cast<uint32_t>(features_.size());
  for (const uint32_t number : near.ends) {
    if (number == kNone) continue;
    Near& end = nears_[number];
    end.first_feature = static_cast<uint32_t>(features_.size());
    if (!list_.empty()) add_features(of, end.part);
    end.feature_end = static_cast<uint32_t>(features_.size());
  }
  if (is_outer) near.outer = add_obstacles(near.outer, body.radius > 0);
  near.cell_end = static_cast<uint32_t>(cells_.size());
}

/** Notes the obstacles of the last flood. */
template <int D>
uint32_t MovingWalls<D>::add_obstacles(uint32_t outer, bool is_thick) {
  if (outer == kNone) {
    outer = static_cast<uint32_t>(near_outers.ranges.size());
    near_outers.ranges.emplace_back();
  }
  const size_t first = near_outers.walls.size();
  for (size_t i = 0; is_thick && i < list_.obstacles().size(); ++i) {
    WallFeature& wall = near_outers.walls.emplace_back(list_.obstacles()[i]);
    for (uint32_t k = 0; k < wall.count; ++k) wall.vertices[k] = list_.name(wall.vertices[k]);
  }
  near_outers.ranges[outer] = {first, near_outers.walls.size()};
  return outer;
}

/** Notes that the cells of the last flood have to stay valid. Throws if one of their points goes to a place that is not finite. */
template <int D>
void MovingWalls<D>::check_cells() {
  for (size_t i = 0; i < flood_.cells().size(); ++i) {
    const Cell c = flood_.cells()[i];
    checked_.insert_if(c, [&] {
      env_.map.for_each_vertex(c, [&](uint32_t v) {
        if (!is_finite<D>(next_ + size_t{D} * v)) fail_non_finite({next_, D}, v, D, {"next", true});
      });
      return true;
    });
  }
}

/** The triangles of walls for a vertex, their sides for an edge, and their corners for a face; in the plane their segments
 * for a vertex, and their ends for an edge. */
template <int D>
void MovingWalls<D>::add_features(const Trajectory<D>& of, const Simplex& part) {
  const uint32_t wanted = D - static_cast<uint32_t>(part.kind);
  const Box<D> box = of.is_led ? box_of_rooms(of, part) : Box<D>::everything();
  for (const NearFeature& f : list_.features()) {
    if (f.count != wanted) continue;
    Box<D> way;
    for (uint32_t i = 0; i < wanted; ++i) {
      way.add(list_.point(f.corners[i]));
      way.add(next_ + size_t{D} * list_.name(f.corners[i]));
    }
    if (of.is_led && !box.overlaps(way)) continue;
    Feature feature{{{kNone, kNone, kNone}, wanted, {}, {}}, ends_.size(), walls_.size(), 0};
    for (uint32_t i = 0; i < wanted; ++i) {
      feature.name.vertices[i] = list_.name(f.corners[i]);
      const double* const end = next_ + size_t{D} * feature.name.vertices[i];
      ends_.insert(ends_.end(), end, end + D);
    }
    list_.for_each_obstacle(f, [&](uint32_t number) {
      const WallFeature& obstacle = list_.obstacles()[number];
      feature.name.add_name(env_.map, obstacle.facet, obstacle.cell);
      if (wanted == D || obstacle.count != D) return;
      Wall& wall = walls_.emplace_back();
      for (uint32_t i = 0; i < D; ++i) wall.vertices[i] = list_.name(obstacle.vertices[i]);
    });
    feature.wall_end = walls_.size();
    features_.push_back(feature);
  }
}

template <int D>
void MovingWalls<D>::set_end(double time) {
  time_ = time;
  for (const Feature& feature : features_) {
    for (uint32_t i = 0; i < feature.name.count; ++i) {
      const uint32_t v = feature.name.vertices[i];
      place_on_way<D>(env_.point(v), next_ + size_t{D} * v, time, &ends_[feature.first_end + size_t{D} * i]);
    }
  }
}

template <int D>
void MovingWalls<D>::begin_steps(const double* steps, const double* next, Array<dsw_volume_id>& invalid) {
  next_ = next;
  invalid_ = &invalid;
  flood_.set_next(next);
  steps_ = steps;
  places_.assign(env_.points, env_.points + size_t{D} * env_.map.vertex_count);
  met_.clear();
}

template <int D>
void MovingWalls<D>::set_step_end(double fraction) {
  time_ = fraction;
  if (met_.empty()) {
    for (size_t i = 0; i < checked_.size(); ++i) {
      env_.map.for_each_vertex(checked_[i], [&](uint32_t v) { met_.push_back(v); });
    }
    dsw::sort(met_.begin(), met_.end());
    met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
  }
  for (const uint32_t v : met_) {
    const size_t at = size_t{D} * v;
    place_of_step<D>(env_.point(v), steps_ + at, fraction, &places_[at]);
  }
  for (const Feature& feature : features_) {
    for (uint32_t i = 0; i < feature.name.count; ++i) {
      std::copy_n(&places_[size_t{D} * feature.name.vertices[i]], D, &ends_[feature.first_end + size_t{D} * i]);
    }
  }
}

template <int D>
bool MovingWalls<D>::stays_valid_to_ends() const {
  for (size_t i = 0; i < checked_.size(); ++i) {
    if (!stays_valid(env_, checked_[i], places_.data())) return false;
  }
  return true;
}

template <int D>
bool MovingWalls<D>::is_free(const Array<Trajectory<D>>& trajectories) {
  return visit_touches(trajectories, [](const WayTouch<D>&) { return false; });
}

template <int D>
void MovingWalls<D>::find_first(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& first) {
  visit_touches(trajectories, [&](const WayTouch<D>& touch) {
    add_first(touch, first, work);
    return true;
  });
}

template <int D>
void MovingWalls<D>::find_all(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& all) {
  visit_touches(trajectories, [&](const WayTouch<D>& touch) {
    all.push_back(touch);
    return true;
  });
}

/** Calls visit(touch) for what touches on its way, if that is new, until it returns false. */
template <int D>
template <class Visit>
bool MovingWalls<D>::visit_touches(const Array<Trajectory<D>>& trajectories, Visit visit) {
  for (const Near& near : nears_) {
    if (near.part.kind != Simplex::kVertex && near.first_feature == near.feature_end) continue;
    const Trajectory<D>& of = trajectories[near.trajectory];
    const bool is_new_part = is_new(of, SimplexCorners<D>(*of.motion.body, near.part));
    ++counts.swept;
    double until = 1;  // nobody asks what a part touches later than something else
    for (uint32_t i = near.first_feature; i < near.feature_end; ++i) {
      WayTouch<D> touch{};
      if (!is_new_part && !held.has_new(features_[i].name.vertices, features_[i].name.count)) continue;
      if (!set_pair(of, near, features_[i], touch) || !boxes_overlap(touch.pair)) continue;
      touch.part = near.part;
      touch.first = first_touch(touch.pair, work, until);
      if (!touch.first.touches || touch.first.time > until || stays_free(touch, features_[i])) continue;
      until = touch.first.time;
      touch.trajectory = near.trajectory;
      touch.wall = features_[i].name;
      if (!visit(touch)) return false;
    }
  }
  return true;
}

/** The points of a part and a feature; whether any of them moves. */
template <int D>
bool MovingWalls<D>::set_pair(const Trajectory<D>& of, const Near& near, const Feature& feature,
                              WayTouch<D>& touch) const {
  const SimplexCorners<D> corners(*of.motion.body, near.part);
  touch.pair.kind = D == 2                             ? PairKind::kVertexEdge
                    : near.part.kind == Simplex::kEdge ? PairKind::kEdgeEdge
                                                       : PairKind::kVertexFace;
  // Who has fewer points comes first.
  touch.comes_first = corners.count <= feature.name.count;
  const uint32_t first_corner = touch.comes_first ? 0 : feature.name.count,
                 first_wall = touch.comes_first ? corners.count : 0;
  bool moves = false;
  for (uint32_t i = 0; i < corners.count; ++i) {
    touch.pair.start[first_corner + i] = of.start(corners.vertices[i]);
    touch.pair.end[first_corner + i] = of.end(corners.vertices[i]);
    moves = moves || of.moves(corners.vertices[i]);
  }
  for (uint32_t i = 0; i < feature.name.count; ++i) {
    const double* const start = touch.pair.start[first_wall + i] = env_.point(feature.name.vertices[i]);
    const double* const end = touch.pair.end[first_wall + i] = &ends_[feature.first_end + size_t{D} * i];
    moves = moves || !is_same_place<D>(start, end);
  }
  return moves;
}

/** Whether what touches on its way is free under the shift of the part, all the way. It is at the start. */
template <int D>
bool MovingWalls<D>::stays_free(const WayTouch<D>& touch, const Feature& feature) const {
  const uint32_t count = 1 + static_cast<uint32_t>(touch.part.kind);
  if (keeps_sides(touch.pair, count, touch.comes_first)) return true;
  // Each corner of the feature is tried, so that no answer depends on how the environment is numbered.
  for (uint32_t corner = 0; corner < D + 1 - count; ++corner) {
    MovingPair<D> rest = touch.pair;
    double ends[D + 1][D];
    const bool is_exact = leave_out_way_of((touch.comes_first ? count : 0) + corner, rest, ends);
    if (is_exact && (!any_moves(rest) || keeps_sides(rest, count, touch.comes_first))) return true;
  }
  const auto walls = walls_.begin();
  return dsw::any_of(walls + static_cast<std::ptrdiff_t>(feature.first_wall),
                     walls + static_cast<std::ptrdiff_t>(feature.wall_end),
                     [&](const Wall& wall) { return is_beside(touch, wall); });
}

/** Whether all corners of the part stay on one side of a wall of the feature, under their shift. */
template <int D>
bool MovingWalls<D>::is_beside(const WayTouch<D>& touch, const Wall& wall) const {
  const uint32_t count = 1 + static_cast<uint32_t>(touch.part.kind), first = touch.comes_first ? 0 : D + 1 - count;
  double ends[D][D];
  MovingPair<D> pair{D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge, {}, {}};
  for (int i = 0; i < D; ++i) {
    place(wall.vertices[i], ends[i]);
    pair.start[i + 1] = env_.point(wall.vertices[i]);
    pair.end[i + 1] = ends[i];
  }
  int side = 0;
  for (uint32_t i = 0; i < count; ++i) {
    pair.start[0] = touch.pair.start[first + i];
    pair.end[0] = touch.pair.end[first + i];
    int own = side_kept(pair, 1, true);
    for (uint32_t corner = 1; own == 0 && corner <= D; ++corner) {
      MovingPair<D> rest = pair;
      double without[D + 1][D];
      if (leave_out_way_of(corner, rest, without)) own = side_kept(rest, 1, true);
    }
    if (own == 0 || (side != 0 && own != side)) return false;
    side = own;
  }
  return true;
}

template <int D>
void MovingWalls<D>::place(uint32_t v, double* at) const {
  if (steps_ != nullptr) {
    place_of_step<D>(env_.point(v), steps_ + size_t{D} * v, time_, at);
  } else {
    place_on_way<D>(env_.point(v), next_ + size_t{D} * v, time_, at);
  }
}

template <int D>
bool MovingWalls<D>::is_kept_free(const WayTouch<D>& touch) const {
  return dsw::any_of(features_.begin(), features_.end(), [&](const Feature& feature) {
    return feature.name.count == touch.wall.count &&
           std::equal(feature.name.vertices, feature.name.vertices + 3, touch.wall.vertices) &&
           stays_free(touch, feature);
  });
}

template <int D>
void MovingWalls<D>::describe(const Array<Trajectory<D>>& trajectories, const Array<WayTouch<D>>& touches) {
  for (const WayTouch<D>& touch : touches) {
    if (touch.other != nullptr) continue;
    const Trajectory<D>& of = trajectories[touch.trajectory];
    dsw_wall_contact& contact = contacts.emplace_back(describe_wall(env_, trajectories, touch));
    contact.body = {of.name.index, of.name.generation};
    name_part(*of.motion.body, touch.part, contact);
  }
}

template <int D>
void MovingWalls<D>::describe(const Array<Trajectory<D>>& trajectories, const Array<TooNearOnWay<D>>& first) {
  for (const TooNearOnWay<D>& near : first) {
    if (near.other != nullptr) continue;
    const Trajectory<D>& of = trajectories[near.trajectory];
    double end[D];
    place(near.wall.vertices[0], end);
    dsw_wall_contact& contact = contacts.emplace_back(dsw::describe(env_, near.wall, env_.point(near.wall.vertices[0]),
                                                                    end, touch_of(env_, of, near), DSW_WALL_STOP));
    contact.body = {of.name.index, of.name.generation};
    name_part(*of.motion.body, near.part, contact);
  }
}

template <int D>
bool MovingWalls<D>::stayed_valid(const double* start) {
  for (size_t i = 0; i < checked_.size(); ++i) {
    if (stays_valid(env_, checked_[i], start)) continue;  // a way back is as good
    invalid_->push_back(volume_id(env_.map, checked_[i]));
    stay_valid_ = false;
  }
  return stay_valid_;
}

template <int D>
bool MovingWalls<D>::find_arrivals(Array<Trajectory<D>>& trajectories, const double* start) {
  arrival_flood_.set_next(start);
  for (const Near& near : nears_) {
    if (near.part.kind != Simplex::kVertex) continue;
    Trajectory<D>& of = trajectories[near.trajectory];
    const double* const at = of.end(near.part.index);
    Cell& arrival = of.motion.ways[near.part.index].arrival;
    const auto is_in = [&](Cell c) { return admits(env_, c) && contains(env_, c, at); };
    const Cell before = of.motion.body->vertices[near.part.index].cell;
    arrival = {};
    if (!near.has_edge) {
      for (uint32_t i = near.first_cell; i < near.cell_end && !arrival.valid(); ++i) {
        if (is_in(cells_[i])) arrival = cells_[i];
      }
    } else if (is_in(before)) {
      arrival = before;
    } else {
      // The way back goes through the same cells.
      list_.clear();
      arrival_flood_.find(&before, 1, region_of_way(of, near.part, 0), list_);
      const CellQueue& cells = arrival_flood_.cells();
      for (size_t i = 1; i < cells.size() && !arrival.valid(); ++i) {
        if (checked_.contains(cells[i]) && is_in(cells[i])) arrival = cells[i];
      }
    }
    if (!arrival.valid()) return false;
  }
  return true;
}

template class MovingWalls<2>;
template class MovingWalls<3>;

}  // namespace dsw
