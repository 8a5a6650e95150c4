#pragma once
// A body of which all vertices move at once, and what its parts touch on their way.

#include <algorithm>
#include <array>
#include <utility>

#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "body/simplices.h"
#include "contact/way_touch.h"
#include "motion/moving_body.h"
#include "motion/place_on_way.h"
#include "proximity/near_lists.h"
#include "proximity/near_region.h"
#include "proximity/partners.h"
#include "response/settings.h"
#include "walk/retreat.h"

namespace dsw {

/** No vertex is led farther along an axis than so many times the longest way. */
constexpr double kMostLed = 4;

/** How points that turn about an axis are beside straight ways between two of their places. */
struct Bend {
  double most = 0;         // how far at most, at any time; nothing at both ends
  Vec axis = Vec::Zero();  // a unit vector: they are across it alone; zero: any way

  /** How far at most along a unit vector. */
  double along(const Vec& direction) const noexcept {
    constexpr double kRounding = 0x1p-48;
    return most > 0 ? most * std::min(1.0, length(direction.cross(axis)) + kRounding) : 0;
  }
};

/** A body of a call. Every vertex goes straight and steadily from its position to its end. */
template <int D>
struct Trajectory {
  MovingBody<D> motion;
  Partner<D> name{nullptr, 0, 0};
  NearNotes<D>* notes = nullptr;  // what is remembered of what is near the body
  MoveRecord* record = nullptr;
  const Partners<D>* still = nullptr;  // bodies that it may meet and that do not move in this call; null: none
  Array<double> goals;    // where its vertices go, as far as that is known to be free, or not known to be blocked
  Array<double> ends;     // where they go in the way that is looked at
  Array<double> reaches;  // empty, or ends of the ways that parts are collected for; then these are not the targets
  bool stands = false;    // nothing moves it
  Bend bend;              // of its points beside their straight ways
  bool is_led = false;    // rows may lead its vertices aside
  Array<Box<D>> rooms;    // if it is led: the places of each vertex that walls are collected for
  double beyond = 0;      // how far these lie beyond the ways
  Array<uint8_t> has_new_room;  // vertices for which walls have to be collected again
  Array<double> limits;         // times up to which edges and faces at a vertex are looked at
  Array<uint8_t> is_new;        // vertices whose ways have not been looked at; parts without one are passed over

  explicit Trajectory(const Memory* memory)
      : motion(memory),
        goals(memory),
        ends(memory),
        reaches(memory),
        rooms(memory),
        has_new_room(memory),
        limits(memory),
        is_new(memory) {}

  const double* start(uint32_t v) const { return motion.body->position(v); }
  const double* end(uint32_t v) const { return ends.data() + size_t{v} * D; }
  double* end(uint32_t v) { return ends.data() + size_t{v} * D; }
  const double* goal(uint32_t v) const { return goals.data() + size_t{v} * D; }
  double* goal(uint32_t v) { return goals.data() + size_t{v} * D; }
  /** All places on the ways of a vertex are in the box of its start and this place, in most calls its target. */
  const double* reach(uint32_t v) const { return reaches.empty() ? motion.targets[v] : &reaches[size_t{v} * D]; }
  bool moves(uint32_t v) const { return !is_same_place<D>(start(v), end(v)); }
  /** Gives all vertices of a led trajectory their rooms: the boxes of their ways, and that much beyond. */
  void set_rooms(double room_beyond) {
    beyond = room_beyond;
    rooms.assign(is_new.size(), Box<D>());
    has_new_room.assign(is_new.size(), 1);
    for (uint32_t v = 0; v < rooms.size(); ++v) {
      if (motion.body->has_vertex(v)) set_room(v);
    }
  }
  bool has_new_rooms(const SimplexCorners<D>& corners) const {
    return !is_led || dsw::any_of(corners.begin(), corners.end(), [&](uint32_t v) { return has_new_room[v] != 0; });
  }
  /** Gives those vertices another room whose goals are not in theirs. */
  void renew_rooms() {
    for (uint32_t v = 0; v < rooms.size(); ++v) {
      has_new_room[v] = motion.body->has_vertex(v) && !rooms[v].contains(goal(v)) ? 1 : 0;
      if (has_new_room[v] != 0) set_room(v);
    }
  }

 private:
  void set_room(uint32_t v) {
    Box<D> way;
    way.add(start(v));
    way.add(reach(v));
    way.add(goal(v));
    rooms[v] = widened(way, beyond);
  }
};

/** A pair, whichever of its sides moves, and in whatever order its points are found: the same all through a call. */
using PairName = std::array<uint32_t, 9>;
template <class Touch>
PairName pair_name_of(const Touch& t) noexcept {
  PairName name = {t.trajectory, static_cast<uint32_t>(t.part.kind), t.part.index, kNone, kNone, kNone, kNone, kNone,
                   kNone};
  if (t.other == nullptr) {
    std::copy_n(t.wall.vertices, 3, name.begin() + 6);
    dsw::sort(name.begin() + 6, name.end());
    return name;
  }
  const std::array<uint32_t, 3> own = {t.trajectory, name[1], name[2]},
                                other = {t.other_trajectory, static_cast<uint32_t>(t.other_part.kind),
                                         t.other_part.index};
  const auto& [first, second] = std::minmax(own, other);
  std::copy(first.begin(), first.end(), name.begin());
  std::copy(second.begin(), second.end(), name.begin() + 3);
  name[6] = t.other_trajectory == kNone ? t.other->index : kNone;
  return name;
}

/** Whether the way of a part has not been looked at. */
template <int D>
bool is_new(const Trajectory<D>& of, const SimplexCorners<D>& corners) noexcept {
  return dsw::any_of(corners.begin(), corners.end(), [&](uint32_t v) { return of.is_new[v] != 0; });
}

/** Calls visit(trajectory, vertex) for the vertices of the call's bodies that touch. */
template <int D, class Touch, class Visit>
void for_each_touching(Array<Trajectory<D>>& trajectories, const Touch& touch, Visit visit) {
  Trajectory<D>& of = trajectories[touch.trajectory];
  for (const uint32_t v : SimplexCorners<D>(*of.motion.body, touch.part)) visit(of, v);
  if (touch.other_trajectory == kNone) return;
  Trajectory<D>& other = trajectories[touch.other_trajectory];
  for (const uint32_t v : SimplexCorners<D>(*other.motion.body, touch.other_part)) visit(other, v);
}

/** First step back from a touch, as a fraction of the ways: that of the point that moves most. Others may hardly move. */
template <int D>
double step_back(const WayTouch<D>& touch) noexcept {
  double step = 1;
  for (int i = 0; i <= D; ++i) {
    const double *const from = touch.pair.start[i], *const to = touch.pair.end[i];
    if (!is_same_place<D>(from, to)) step = std::min(step, first_step<D>(from, to, touch.first.time));
  }
  return step;
}

/** The box of the way of a part, up to where it goes in the call. */
template <int D>
Box<D> box_of_way(const Trajectory<D>& of, const Simplex& part) noexcept {
  Box<D> box;
  for (const uint32_t v : SimplexCorners<D>(*of.motion.body, part)) {
    box.add(of.start(v));
    box.add(of.reach(v));
  }
  return box;
}

/** The box of the rooms of a part that is led. */
template <int D>
Box<D> box_of_rooms(const Trajectory<D>& of, const Simplex& part) noexcept {
  Box<D> box;
  for (const uint32_t v : SimplexCorners<D>(*of.motion.body, part)) box.add(of.rooms[v]);
  return box;
}

/** Orders ways by where they begin, then by where they end: so nothing depends on numbers. */
template <int D>
bool is_before(const double* start, const double* end, const double* other_start, const double* other_end) noexcept {
  const bool same = is_same_place<D>(start, other_start);
  return same ? std::lexicographical_compare(end, end + D, other_end, other_end + D)
              : std::lexicographical_compare(start, start + D, other_start, other_start + D);
}

/** The points of the way of a part, up to where it goes in the call: starts, then ends, in an order that depends on no numbers. */
template <int D>
uint32_t points_of_way(const Trajectory<D>& of, const Simplex& part, const double* (&points)[6]) noexcept {
  const SimplexCorners<D> corners(*of.motion.body, part);
  const double* ways[3][2];
  for (uint32_t i = 0; i < corners.count; ++i) {
    ways[i][0] = of.start(corners.vertices[i]);
    ways[i][1] = of.reach(corners.vertices[i]);
    for (uint32_t k = i; k > 0 && is_before<D>(ways[k][0], ways[k][1], ways[k - 1][0], ways[k - 1][1]); --k)
      std::swap(ways[k], ways[k - 1]);
  }
  for (uint32_t i = 0; i < corners.count; ++i) {
    points[i] = ways[i][0];
    points[corners.count + i] = ways[i][1];
  }
  return 2 * corners.count;
}

/** All that comes within a distance of a part on its way, or, if it is led, in the rooms of its vertices. It depends on no
 * numbers. */
template <int D>
NearRegion<D> region_of_way(const Trajectory<D>& of, const Simplex& part, double distance) noexcept {
  const double* points[6] = {};
  const uint32_t count = points_of_way(of, part, points);
  const SimplexCorners<D> corners(*of.motion.body, part);
  double rounding = room_of_rounding<D>(points, count);
  for (uint32_t i = 0; of.is_led && i < corners.count; ++i) {
    const Box<D>& room = of.rooms[corners.vertices[i]];
    const double* const ends[2] = {room.lower, room.upper};
    rounding = std::max(rounding, room_of_rounding<D>(ends, 2));
  }
  NearRegion<D> region(points, count, distance + rounding);
  for (uint32_t i = 0; of.is_led && i < corners.count; ++i) {
    const Box<D>& room = of.rooms[corners.vertices[i]];
    region.add_box(room.lower, room.upper);
  }
  return region;
}

/** Whether what two parts sweep in this round lies in boxes that overlap.
 * @param shifted which of the two is shifted: upwards along each axis, so that boxes with a side in common may be apart;
 * kNone: neither. */
template <int D>
bool boxes_overlap(const MovingPair<D>& pair, uint32_t shifted = kNone) noexcept {
  const int first = pair.kind == PairKind::kEdgeEdge ? 2 : 1;
  for (int k = 0; k < D; ++k) {
    double low[2] = {Box<D>::kInfinity, Box<D>::kInfinity}, high[2] = {-Box<D>::kInfinity, -Box<D>::kInfinity};
    for (int i = 0; i <= D; ++i) {
      const int side = i < first ? 0 : 1;
      low[side] = std::min({low[side], pair.start[i][k], pair.end[i][k]});
      high[side] = std::max({high[side], pair.start[i][k], pair.end[i][k]});
    }
    if (low[0] > high[1] || low[1] > high[0]) return false;
    if (shifted != kNone && low[shifted] == high[1 - shifted]) return false;
  }
  return true;
}

}  // namespace dsw
