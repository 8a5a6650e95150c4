// The distance of two hulls is at least what one direction shows: how far all points of one lie beyond all points of the other.
// While points go straight and steadily, how far one lies beyond another is linear in time, so what a direction shows is the
// least of linear functions: concave. Where it is enough at two times, it is enough between them. So the way is gone in pieces,
// each as long as the best direction at its begin allows. All numbers are those of the ends of the ways, rounded once: no place
// between is rounded.
//
// Where a wall turns, no fixed direction shows much for long. A direction that goes steadily from one to another shows the least of
// quadratic functions, over its length. The square of that length is 1 - 2 k t (1 - t), with k = 1 - cos of the angle between the
// two, so the length is at most 1 - k t (1 - t). What is left over is of third order.
//
// What is near is found as in proximity/thick_sweep.cpp: nothing impassable lies between a part and what is nearest to it, at any
// time. So a flood from the part through a region round its whole way finds that.

#include "together/thick_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/dimensions.h"
#include "base/search.h"
#include "motion/place_on_way.h"
#include "proximity/thick_sweep.h"

namespace dsw {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kLeastPiece = 0x1p-46;  // of a time: what is shorter is left

/** How far two hulls are apart along a direction, as linear functions of time, and what rounding can lose of each. */
template <int D>
struct LinearGap {
  double start[16], end[16], lost = 0;
  uint32_t count = 0;

  LinearGap(const HullWays<D>& ways, const Vec& direction) noexcept {
    double size = 0;
    for (uint32_t i = 0; i < ways.count[0]; ++i) {
      for (uint32_t k = 0; k < ways.count[1]; ++k, ++count) {
        const Vec from = difference<D>(ways.start[0][i], ways.start[1][k]),
                  to = difference<D>(ways.end[0][i], ways.end[1][k]);
        start[count] = dot(direction, from);
        end[count] = dot(direction, to);
        size = std::max({size, largest(from), largest(to)});
      }
    }
    // A difference, a product and two sums lose at most 4 u of the sum of magnitudes, the mean of two numbers 4 u more, and the
    // length of the direction 2^-50.
    lost = 0x1p-47 * size + 0x1p-1000;
  }
  double at(double time) const noexcept {
    double least = kInf;
    for (uint32_t n = 0; n < count; ++n) least = std::min(least, (1 - time) * start[n] + time * end[n]);
    return least - lost;
  }
  /** The last time from `time` on, at most `most`, at which the gap is enough; `time` has it. */
  double last(double time, double most, double enough) const noexcept {
    if (at(most) >= enough) return most;
    double least = most;
    for (uint32_t n = 0; n < count; ++n) {
      const double goal = enough + lost;
      if (end[n] >= goal || !(start[n] > end[n])) continue;
      least = std::min(least, (start[n] - goal) / (start[n] - end[n]));
    }
    for (double back = 0x1p-52 * least; least > time; least -= back, back *= 2) {
      if (at(least) >= enough) return least;
    }
    return time;
  }
};

/** Whether one direction shows on the whole way that a distance is kept. */
template <int D>
bool shows(const HullWays<D>& ways, const Vec& direction, double most, double enough) noexcept {
  const LinearGap<D> along(ways, direction);
  return along.at(0) >= enough && along.at(most) >= enough;
}

/** Across a facet of a side, at the start, from the second side to the first. Zero if there is no facet. */
template <int D>
Vec across_facet(const HullWays<D>& ways) noexcept {
  for (uint32_t side = 0; side < 2; ++side) {
    if (ways.count[side] != D) continue;
    const double* const* const points = ways.start[side];
    const Vec edge = difference<D>(points[1], points[0]);
    Vec normal;
    if constexpr (D == 2) {
      normal = unit(turned(edge));
    } else {
      normal = unit(unit(edge).cross(unit(difference<D>(points[2], points[0]))));
    }
    const bool is_above = dot(normal, difference<D>(ways.start[1 - side][0], points[0])) >= 0;
    return is_above == (side == 1) ? normal : -1 * normal;
  }
  return Vec::Zero();
}

/** No distance of two sides changes by more on their ways. */
template <int D>
double most_change(const HullWays<D>& ways) noexcept {
  double sum = 0;
  for (uint32_t side = 0; side < 2; ++side) {
    double most = 0;
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      most = std::max(most, length(difference<D>(ways.end[side][i], ways.start[side][i])));
    }
    sum += most;
  }
  return sum;
}

/** How much a distance can change by the rounding of places where all points go alike. */
template <int D>
double rounding_of(const HullWays<D>& ways) noexcept {
  double most = 0;
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      most = std::max({most, largest_coordinate<D>(ways.start[side][i]), largest_coordinate<D>(ways.end[side][i])});
    }
  }
  return 0x1p-49 * most;
}

/** Whether the boxes of two sides' ways are so far apart that a distance is kept. */
template <int D>
bool are_boxes_apart(const HullWays<D>& ways, double wanted) noexcept {
  Box<D> boxes[2];
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      boxes[side].add(ways.start[side][i]);
      boxes[side].add(ways.end[side][i]);
    }
  }
  for (int k = 0; k < D; ++k) {
    if (boxes[0].lower[k] - boxes[1].upper[k] >= wanted || boxes[1].lower[k] - boxes[0].upper[k] >= wanted) return true;
  }
  return false;
}

/** The hulls at a time of their ways. */
template <int D>
void place(const HullWays<D>& ways, double time, double (&places)[2][4][D], ConvexHull (&hulls)[2]) noexcept {
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      point_on_way<D>(ways.start[side][i], ways.end[side][i], time, places[side][i]);
      hulls[side].points[i] = places[side][i];
    }
    hulls[side].count = ways.count[side];
  }
}

/** Whether a direction that goes from one to another between two times shows that a distance is kept there. */
template <int D>
bool keeps_turning(const HullWays<D>& ways, double begin, double end, const Vec& first, const Vec& last,
                   double accepted) noexcept {
  const Vec turn = last - first;
  const double shorter = accepted * dot(turn, turn) / 4 * (1 - 0x1p-40);  // see above: half of k, as a control value
  for (uint32_t i = 0; i < ways.count[0]; ++i) {
    for (uint32_t k = 0; k < ways.count[1]; ++k) {
      const Vec from = difference<D>(ways.start[0][i], ways.start[1][k]),
                to = difference<D>(ways.end[0][i], ways.end[1][k]);
      const Vec a = (1 - begin) * from + begin * to, b = (1 - end) * from + end * to;
      const double goal = accepted + 0x1p-46 * std::max(largest(from), largest(to)) + 0x1p-1000;
      const double c0 = dot(first, a) - goal, c1 = (dot(first, b) + dot(last, a)) / 2 + shorter - goal,
                   c2 = dot(last, b) - goal;
      if (!(c0 >= 0 && c2 >= 0)) return false;
      if (!(c1 >= 0) && !(c0 * c2 > c1 * c1 * (1 + 0x1p-40))) return false;
    }
  }
  return true;
}

/** Up to which time after `begin` such a direction shows that a distance is kept; else `least`.
 * @param gap at the begin. */
template <int D>
double last_turning(const HullWays<D>& ways, double begin, double least, double most, const HullGap& gap,
                    double accepted) noexcept {
  constexpr int kMostTries = 16;
  constexpr double kLeastShare = 0x1p-4;  // another part of the hulls may be the one that comes nearer
  const auto gap_at = [&](double time) {
    double places[2][4][D];
    ConvexHull hulls[2];
    place(ways, time, places, hulls);
    return find_gap<D>(hulls[0], hulls[1], kInf, accepted);
  };
  double span = most - begin;
  for (int tries = 0; tries < kMostTries && begin + span > least && span >= kLeastPiece * (begin + span); ++tries) {
    const double end = std::min(begin + span, most);
    const HullGap there = gap_at(end);
    if (!is_zero(there.normal) && there.distance >= accepted) {
      if (keeps_turning(ways, begin, end, gap.normal, there.normal, accepted)) return end;
      span /= 4;
    } else {
      const double share = (gap.distance - accepted) / (gap.distance - there.distance);
      span *= std::clamp(share, kLeastShare, 1.0) * (1 - 0x1p-10);
    }
  }
  return least;
}

/** Whether a direction shows on the whole way that a distance is kept while points are beside their straight ways. At a time t
 * they are by at most 4 t (1 - t) of the bend there, as the error of a linear interpolation. */
template <int D>
bool keeps_bent(const LinearGap<D>& along, double bend, double kept) noexcept {
  for (uint32_t n = 0; n < along.count; ++n) {
    const double c0 = (along.start[n] - along.lost) - kept, c2 = (along.end[n] - along.lost) - kept,
                 c1 = (c0 + c2) / 2 - 2 * bend;  // control values of a quadratic function
    if (!(c0 >= 0 && c2 >= 0)) return false;
    if (!(c1 >= 0) && !(c0 * c2 > c1 * c1 * (1 + 0x1p-40))) return false;
  }
  return true;
}

}  // namespace

template <int D>
double time_kept(const HullWays<D>& ways, double wanted, double most, Vec* known) noexcept {
  constexpr int kMostPieces = 100, kMostNearPieces = 12;
  constexpr double kNear = 0x1p-37;
  if (are_boxes_apart(ways, wanted + ways.bend())) return most;
  double time = 0, kept = least_kept(wanted);
  if (shows(ways, *known, most, kept + ways.bend(*known))) return most;
  *known = across_facet(ways);
  if (shows(ways, *known, most, kept + ways.bend(*known))) return most;
  const auto gap_at = [&](double at, double enough) {
    double places[2][4][D];
    ConvexHull hulls[2];
    place(ways, at, places, hulls);
    return find_gap<D>(hulls[0], hulls[1], enough, kept);
  };
  const double far = kept + ways.bend() + most_change(ways);
  HullGap gap = gap_at(0, far);
  *known = gap.normal;
  if (gap.bound >= far) {
    if (shows(ways, *known, most, kept + ways.bend(*known))) return most;
    gap = gap_at(0, kInf);
  }
  for (int piece = 0, near_pieces = 0; piece < kMostPieces; ++piece) {
    if (piece > 0) gap = gap_at(time, kInf);
    if (is_zero(gap.normal) || !is_finite<3>(gap.normal.data())) return time;
    *known = gap.normal;
    const LinearGap<D> along(ways, gap.normal);
    const double bend = ways.bend(gap.normal);
    double accepted = kept + bend;
    if (piece == 0) {
      const double at_start = along.at(0);
      if (!(at_start >= less_share(wanted, 0x1p-30))) return 0;
      const double slack = std::clamp((at_start - bend - least_at_rest(wanted)) / 2, 0.0, rounding_of(ways));
      if (bend > 0 && at_start < accepted) return keeps_bent(along, bend, std::min(kept, at_start - slack)) ? most : 0;
      if (at_start - slack < accepted && along.at(most) >= at_start - slack) return most;
      kept = std::min(kept, at_start);
      accepted = kept + bend;
    }
    if (!(along.at(time) >= accepted)) return time;
    double last = along.last(time, most, accepted);
    if (last < most) last = last_turning(ways, time, last, most, gap, kept + ways.bend());
    if (last >= most) return most;
    // Pieces become short where a wall turns as fast as it comes nearer.
    near_pieces += gap.distance - accepted < kNear * wanted ? 1 : 0;
    if (last - time < kLeastPiece * last || near_pieces > kMostNearPieces) return time;
    time = last;
  }
  return time;
}

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
    moves = moves || !std::equal(start, start + D, end);
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
  double places[2][4][D];
  ConvexHull hulls[2];
  place(ways, time, places, hulls);
  const HullGap gap = find_gap<D>(hulls[0], hulls[1], kInf, least_kept(pair.wanted));
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
    for (uint32_t i = 0; i < hulls[side].count; ++i) point += weights[i] * to_vec<D>(hulls[side].points[i]);
  }
  if (is_zero(near.normal)) near.normal = unit(near.points[0] - near.points[1]);
  if (pair.other == nullptr) near.wall = walls_[pair.wall];
  all.push_back(near);
}

template class ThickWays<2>;
template class ThickWays<3>;
DSW_INSTANTIATE(time_kept);

}  // namespace dsw
