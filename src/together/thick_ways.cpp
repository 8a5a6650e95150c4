// What is near is found as in proximity/thick_sweep.cpp: nothing impassable lies between a part and what is nearest to it, at any
// time. So a flood from the part through a region round its whole way finds that.

#include "together/thick_ways.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/position.h"
#include "base/search.h"
#include "proximity/thick_sweep.h"

namespace dsw {

template <int D>
void ThickWays<D>::start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const OuterWalls* found) {
  pairs_.clear();
  others_.clear();
  outers_.clear();
  walls_.clear();
  first.clear();
  found_ = found;
  bodies_meet_ = bodies_meet;
  const auto has_radius = [&](const Trajectory<D>& of) {
    return of.motion.body->radius > 0 || (bodies_meet && of.still != nullptr && of.still->has_thick);
  };
  if (dsw::none_of(trajectories.begin(), trajectories.end(), has_radius)) return;
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    for_each_outer(*trajectories[t].motion.body, [&](const Simplex& part) {
      outers_.push_back({t, part, {}});
      return true;
    });
  }
  for (uint32_t i = 0; i < outers_.size(); ++i) find_walls(trajectories, i);
  if (bodies_meet) find_bodies(trajectories);
}

template <int D>
void ThickWays<D>::start_again(const Array<Trajectory<D>>& trajectories) {
  for (uint32_t i = 0; i < outers_.size(); ++i) {
    const Trajectory<D>& of = trajectories[outers_[i].trajectory];
    if (of.has_new_rooms(SimplexCorners<D>(*of.motion.body, outers_[i].part))) find_walls(trajectories, i);
  }
  if (bodies_meet_) find_bodies(trajectories);
}

/** Finds pairs of parts and of bodies. All within the radius of a part lies in its box. */
template <int D>
void ThickWays<D>::find_bodies(const Array<Trajectory<D>>& trajectories) {
  others_.clear();
  for (; boxed_ > 0; --boxed_) grid_.remove(boxed_ - 1);
  grid_.reserve(outers_.size());
  boxed_ = static_cast<uint32_t>(outers_.size());
  for (uint32_t i = 0; i < outers_.size(); ++i) {
    const Trajectory<D>& of = trajectories[outers_[i].trajectory];
    outers_[i].box = widened(box_of_way(of, outers_[i].part), of.motion.body->radius + of.bend.most);
    grid_.put(i, outers_[i].box);
  }
  for (uint32_t i = 0; i < outers_.size(); ++i) {
    outers_[i].first_other = others_.size();
    find_others(trajectories, i);
    find_still(trajectories, outers_[i]);
    outers_[i].other_end = others_.size();
  }
}

template <int D>
void ThickWays<D>::find_walls(const Array<Trajectory<D>>& trajectories, uint32_t number) {
  Outer& outer = outers_[number];
  const Trajectory<D>& of = trajectories[outer.trajectory];
  const double radius = of.motion.body->radius;
  outer.first_pair = outer.pair_end = pairs_.size();
  if (!(radius > 0)) return;
  if (found_ != nullptr) {
    const OuterWalls::Range range = found_->ranges[number];
    for (size_t i = range.first; i < range.end; ++i) add_wall(outer, found_->walls[i], radius);
    return;
  }
  const SimplexCorners<D> corners(*of.motion.body, outer.part);
  list_.clear();
  flood_.find(&of.motion.body->vertices[corners.vertices[0]].cell, 1,
              region_of_way(of, outer.part, radius + of.bend.most), list_);
  for (const WallFeature& wall : list_.obstacles()) add_wall(outer, wall, radius);
}

template <int D>
void ThickWays<D>::add_wall(Outer& outer, const WallFeature& wall, double radius) {
  pairs_.push_back({outer.trajectory, outer.part, kNone, nullptr, {}, static_cast<uint32_t>(walls_.size()), radius});
  walls_.push_back(wall);
  ++outer.pair_end;
}

/** Finds other parts that move, and come before in the list; of a body that is thick those alone that are not joined to it. */
template <int D>
void ThickWays<D>::find_others(const Array<Trajectory<D>>& trajectories, uint32_t number) {
  const Outer& outer = outers_[number];
  const Trajectory<D>& of = trajectories[outer.trajectory];
  const Body<D>& body = *of.motion.body;
  bool has_joined = false;
  grid_.visit(outer.box, [&](uint32_t k) {
    if (k >= number || (of.stands && trajectories[outers_[k].trajectory].stands)) return true;
    const Outer& other = outers_[k];
    const Trajectory<D>& second = trajectories[other.trajectory];
    const Body<D>& partner = *second.motion.body;
    const bool is_own = other.trajectory == outer.trajectory;
    const double wanted = body.radius + partner.radius;
    if (!(wanted > 0) || (is_own ? !body.filter.self : !body.filter.sees(partner.filter))) return true;
    if (is_own) {
      const SimplexCorners<D> corners(body, outer.part), others(body, other.part);
      if (!has_joined) {
        WayAlong from[3];
        for (uint32_t i = 0; i < corners.count; ++i) from[i] = {corners.vertices[i], 0};
        joined_.find(body, from, corners.count);
        has_joined = true;
      }
      if (dsw::any_of(others.begin(), others.end(), [&](uint32_t v) { return joined_.has(v); })) return true;
    }
    others_.push_back({outer.trajectory, outer.part, other.trajectory, &second.name, other.part, 0, wanted});
    return true;
  });
}

template <int D>
void ThickWays<D>::find_still(const Array<Trajectory<D>>& trajectories, const Outer& outer) {
  const Trajectory<D>& of = trajectories[outer.trajectory];
  if (of.still == nullptr) return;
  for (const Partner<D>& each : of.still->all) {
    const Body<D>& other = *each.body;
    const double wanted = of.motion.body->radius + other.radius;
    if (!(wanted > 0)) continue;
    const Box<D> box = widened(outer.box, other.radius);
    const auto add = [&](const Simplex& part) {
      if (!is_covered(other, part)) {
        others_.push_back({outer.trajectory, outer.part, kNone, &each, part, 0, wanted});
      }
      return true;
    };
    const BodyBoxes<D>& boxes = fresh_boxes(other);
    single_vertices(other, other.level).visit(box, [&](uint32_t v) { return add({Simplex::kVertex, v}); });
    if (covers_edges(other.level)) boxes.edges.visit(box, [&](uint32_t e) { return add({Simplex::kEdge, e}); });
    if (covers_faces(other.level)) boxes.faces.visit(box, [&](uint32_t f) { return add({Simplex::kFace, f}); });
  }
}

/** The points of a pair, in an order that depends on no numbers; whether any moves. */
template <int D>
bool ThickWays<D>::set_ways(const Array<Trajectory<D>>& trajectories, const Pair& pair, HullWays<D>& ways) const {
  bool moves = false;
  const auto add = [&](uint32_t side, uint32_t corner, const double* start, const double* end) {
    uint32_t at = ways.count[side]++;
    for (; at > 0 && is_before<D>(start, end, ways.start[side][at - 1], ways.end[side][at - 1]); --at) {
      ways.start[side][at] = ways.start[side][at - 1];
      ways.end[side][at] = ways.end[side][at - 1];
      ways.corner[side][at] = ways.corner[side][at - 1];
    }
    ways.start[side][at] = start;
    ways.end[side][at] = end;
    ways.corner[side][at] = corner;
    moves = moves || !is_same_place<D>(start, end);
  };
  const Trajectory<D>& of = trajectories[pair.trajectory];
  ways.bends[0] = of.bend;
  for (const uint32_t v : SimplexCorners<D>(*of.motion.body, pair.part)) add(0, v, of.start(v), of.end(v));
  if (pair.other == nullptr) {
    const WallFeature& wall = walls_[pair.wall];
    for (uint32_t i = 0; i < wall.count; ++i) {
      add(1, i, env_.point(wall.vertices[i]), &wall_ends_[D * (3 * size_t{pair.wall} + i)]);
    }
    return moves;
  }
  // A body that bends as a whole keeps its own distances.
  if (pair.other_trajectory == pair.trajectory) {
    ways.bends[0] = {};
  } else if (pair.other_trajectory != kNone) {
    ways.bends[1] = trajectories[pair.other_trajectory].bend;
  }
  for (const uint32_t v : SimplexCorners<D>(*pair.other->body, pair.other_part)) {
    const double* const start = pair.other->body->position(v);
    add(1, v, start, pair.other_trajectory == kNone ? start : trajectories[pair.other_trajectory].end(v));
  }
  if (is_before<D>(ways.start[1][0], ways.end[1][0], ways.start[0][0], ways.end[0][0])) {
    std::swap(ways.start[0], ways.start[1]);
    std::swap(ways.end[0], ways.end[1]);
    std::swap(ways.corner[0], ways.corner[1]);
    std::swap(ways.count[0], ways.count[1]);
    std::swap(ways.bends[0], ways.bends[1]);
    ways.first = 1;
  }
  return moves;
}

template <int D>
double ThickWays<D>::find_first(const Array<Trajectory<D>>& trajectories, double most) {
  first.clear();
  // The limit is the same for all: where a piece ends may depend on it in the last bits.
  const double limit = most;
  const auto time_of = [&](const Pair& pair, HullWays<D>& ways) {
    return set_ways(trajectories, pair, ways) ? pair_time_kept(pair, ways, limit) : limit;
  };
  for_each_pair([&](const Pair& pair) {
    HullWays<D> ways{};
    most = std::min(most, time_of(pair, ways));
  });
  if (most >= limit) return limit;
  for_each_pair([&](const Pair& pair) {
    HullWays<D> ways{};
    if (time_of(pair, ways) == most) describe(pair, ways, most, first);
  });
  return most;
}

/** See time_kept. What shows a distance mostly shows it again, on another way of the same pair. */
template <int D>
double ThickWays<D>::pair_time_kept(const Pair& pair, const HullWays<D>& ways, double most) const {
  const double sign = ways.first == 0 ? 1 : -1;
  Vec known = sign * pair.known;
  const double time = time_kept(ways, pair.wanted, most, &known);
  pair.known = sign * known;
  return time;
}

/** Adds what has come too near. */
template <int D>
void ThickWays<D>::describe(const Pair& pair, const HullWays<D>& ways, double time, Array<TooNearOnWay<D>>& all) const {
  const HullPlaces<D> at(ways, time);
  const HullGap gap = at.gap(std::numeric_limits<double>::infinity(), least_kept(pair.wanted));
  TooNearOnWay<D> near;
  near.time = time;
  near.trajectory = pair.trajectory;
  near.part = pair.part;
  near.other_trajectory = pair.other_trajectory;
  near.other = pair.other;
  near.other_part = pair.other_part;
  near.ways = ways;
  near.wanted = pair.wanted;
  near.distance = gap.distance;
  near.normal = (ways.first == 0 ? 1 : -1) * gap.normal;
  near.points[0] = near.points[1] = Vec::Zero();
  for (uint32_t side = 0; side < 2; ++side) {
    const double* const weights = side == 0 ? gap.weights : gap.other_weights;
    Vec& point = near.points[side == ways.first ? 0 : 1];
    for (uint32_t i = 0; i < ways.count[side]; ++i) point += weights[i] * to_vec<D>(at.places[side][i]);
  }
  if (is_zero(near.normal)) near.normal = unit(near.points[0] - near.points[1]);
  if (pair.other == nullptr) near.wall = walls_[pair.wall];
  all.push_back(near);
}

template class ThickWays<2>;
template class ThickWays<3>;

}  // namespace dsw
