// A touch says that its two sides come together along a normal. What is allowed is that they end apart along it, by the
// distance of some units in the last place. So each touch is a row: the sum of the goals of its points, by their weights
// at the touch, is at least that much along the normal. This is right to first order; what is left is found by the exact search
// of the next round, with another normal. A pair that keeps a distance turns on its way, and may be nearest between its ends: so its
// row says how far it is apart at that time.
//
// The nearest goals that all rows allow are found by Hildreth's method: one row after the other is satisfied, and gives
// back at most what it has taken before. Rows are taken in the order of the times and places of their touches.

#include "together/touch_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "together/touch_moment.h"

namespace dsw {
namespace {

constexpr uint32_t kMostTouches = 8, kMostSweeps = 200;
constexpr double kApart = 0x1p-48;        // of the largest coordinate
constexpr double kThickApart = 0x1p-45;   // likewise: what certified distances lose by rounding
constexpr double kFarther = 0x1p-20;      // of a distance that is to be kept
constexpr double kAboutAsNear = 0x1p-18;  // likewise
constexpr double kNext = 0x1p-4;          // likewise: of a corner that comes too near to a facet a little later

/** Orders points by where they go. */
template <int D>
void sort_points(const MovingPair<D>& pair, uint32_t* order, uint32_t first, uint32_t end) {
  dsw::sort(order + first, order + end, [&](uint32_t a, uint32_t b) {
    return is_before<D>(pair.start[a], pair.end[a], pair.start[b], pair.end[b]);
  });
}

template <int D>
bool same_way(const MovingPair<D>& pair, uint32_t a, uint32_t b) {
  return is_same_place<D>(pair.start[a], pair.start[b]) && is_same_place<D>(pair.end[a], pair.end[b]);
}

template <int D>
uint32_t first_side_of(const MovingPair<D>& pair) {
  return pair.kind == PairKind::kEdgeEdge ? 2 : 1;
}

/** A pair with its points, and sides that are alike (two edges, two vertices), in an order that depends on where they go alone. */
template <int D>
MovingPair<D> sort_pair(const MovingPair<D>& pair, uint32_t* order) {
  const uint32_t first_count = first_side_of(pair);
  for (uint32_t i = 0; i <= D; ++i) order[i] = i;
  sort_points(pair, order, 0, first_count);
  sort_points(pair, order, first_count, D + 1);
  MovingPair<D> sorted = pair;
  const auto set = [&] {
    for (uint32_t i = 0; i <= D; ++i) {
      sorted.start[i] = pair.start[order[i]];
      sorted.end[i] = pair.end[order[i]];
    }
  };
  set();
  bool are_vertices = first_count == 1;  // the facet is one
  for (uint32_t i = 2; i <= D; ++i) are_vertices = are_vertices && same_way(sorted, 1, i);
  uint32_t ends[2] = {0, 1};
  sort_points(sorted, ends, 0, 2);
  if (are_vertices && ends[0] != 0) {
    std::fill(order + 2, order + D + 1, std::exchange(order[0], order[1]));
    order[1] = order[2];
    set();
  }
  if constexpr (D == 3) {
    uint32_t near_ends[2] = {0, 2}, far_ends[2] = {1, 3};
    sort_points(sorted, near_ends, 0, 2);
    sort_points(sorted, far_ends, 0, 2);
    const bool turns = same_way(sorted, 0, 2) ? far_ends[0] != 1 : near_ends[0] != 0;
    if (first_count == 2 && turns) {
      std::swap(order[0], order[2]);
      std::swap(order[1], order[3]);
      set();
    }
  }
  return sorted;
}

/** The weights of the points of a pair at its touch: they add up to 1 on the first side, to -1 on the second. */
template <int D>
void find_weights(PairKind kind, const TouchMoment<D>& m, double* weights) {
  if constexpr (D == 2) {
    const Vec edge = m.at[2] - m.at[1];
    const double share = clamped_share(dot(m.at[0] - m.at[1], edge), dot(edge, edge));
    weights[0] = 1, weights[1] = share - 1, weights[2] = -share;
  } else if (kind == PairKind::kEdgeEdge) {
    const double a = nearest_share(m.at[0], m.at[1], m.at[2], m.at[3]),
                 b = nearest_share(m.at[2], m.at[3], m.at[0], m.at[1]);
    weights[0] = 1 - a, weights[1] = a, weights[2] = b - 1, weights[3] = -b;
  } else {
    const Vec e = m.at[2] - m.at[1], f = m.at[3] - m.at[1], to = m.at[0] - m.at[1];
    const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), te = dot(to, e), tf = dot(to, f);
    const double whole = ee * ff - ef * ef;
    const double a = clamped_share(te * ff - tf * ef, whole), b = clamped_share(tf * ee - te * ef, whole);
    const double sum = std::max(1.0, a + b);
    weights[0] = 1, weights[1] = (a + b) / sum - 1, weights[2] = -a / sum, weights[3] = -b / sum;
  }
}

}  // namespace

template <int D>
void TouchRows<D>::start(const Array<Trajectory<D>>& trajectories, bool carries) {
  rows_.clear();
  known_.clear();
  bases_.clear();
  carries_ = carries;
  far_ = 0;
  for (const Trajectory<D>& of : trajectories) {
    Array<Base>& bases = bases_.emplace_back(of.is_new.size(), Base{}, memory_);
    for (uint32_t v = 0; v < bases.size(); ++v) {
      if (!of.motion.body->has_vertex(v)) continue;
      std::copy_n(of.motion.targets[v], D, bases[v].place);
      for (int k = 0; k < D; ++k) far_ = std::max(far_, kMostLed * std::fabs(bases[v].place[k] - of.start(v)[k]));
    }
  }
}

/** How often this pair has touched. */
template <int D>
template <class Touch>
uint32_t TouchRows<D>::count_again(const Touch& touch) {
  const PairName name = pair_name_of(touch);
  const auto at = std::lower_bound(known_.begin(), known_.end(), name,
                                   [](const Known& known, const PairName& other) { return known.name < other; });
  if (at != known_.end() && at->name == name) return ++at->count;
  known_.insert(at, {name, 1});
  return 1;
}

/** The points of a touch, in the order of its pair. */
template <int D>
void TouchRows<D>::find_points(const Array<Trajectory<D>>& trajectories, const WayTouch<D>& touch,
                               const double* const* wall_goals, Point* points) const {
  const auto name_side = [&](uint32_t first, uint32_t end, uint32_t trajectory, const Body<D>* body,
                             const Simplex& part) {
    for (uint32_t i = first; i < end; ++i) {
      if (trajectory == kNone) {
        points[i] = {kNone, kNone, body == nullptr ? wall_goals[i - first] : touch.pair.end[i], 0, {}, 0};
        continue;
      }
      const SimplexCorners<D> corners(*body, part);
      const uint32_t v = corners.vertices[std::min(i - first, corners.count - 1)];
      points[i] = {trajectory, v, trajectories[trajectory].goal(v), 0, {}, 0};
    }
  };
  const uint32_t first_count = first_side_of(touch.pair);
  const uint32_t part_first = touch.comes_first ? 0 : first_count, part_end = touch.comes_first ? first_count : D + 1;
  const uint32_t other_first = touch.comes_first ? first_count : 0, other_end = touch.comes_first ? D + 1 : first_count;
  name_side(part_first, part_end, touch.trajectory, trajectories[touch.trajectory].motion.body, touch.part);
  name_side(other_first, other_end, touch.other_trajectory, touch.other == nullptr ? nullptr : touch.other->body,
            touch.other_part);
}

/** Where and when a touch is. Returns the largest coordinate of its ways. */
template <int D>
double TouchRows<D>::set_key(const double* const* starts, const double* const* ends, uint32_t count, uint32_t round,
                             double time, Key& key) {
  auto& places = std::get<2>(key);
  std::get<0>(key) = round;
  std::get<1>(key) = time;
  for (uint32_t i = 0; i < count; ++i) {
    std::copy_n(starts[i], D, places.begin() + 2 * D * i);
    std::copy_n(ends[i], D, places.begin() + 2 * D * i + D);
    for (int k = 0; k < D; ++k) far_ = std::max(far_, kMostLed * std::fabs(ends[i][k] - starts[i][k]));
  }
  double largest = 0;
  for (const double each : places) largest = std::max(largest, std::fabs(each));
  return largest;
}

/** Adds a point to a row; a vertex that stands there already gets its weight, too. */
template <int D>
void TouchRows<D>::add_point(const Point& point, Row& row) {
  Point* const same = dsw::find_if(row.points, row.points + row.count, [&](const Point& each) {
    return each.trajectory != kNone && each.trajectory == point.trajectory && each.vertex == point.vertex;
  });
  if (same != row.points + row.count) {
    same->weight += point.weight;
  } else {
    row.points[row.count++] = point;
  }
}

template <int D>
bool TouchRows<D>::add(Array<Trajectory<D>>& trajectories, const WayTouch<D>& touch, const double* const* wall_goals,
                       uint32_t round) {
  const uint32_t count = count_again(touch);
  if (count > kMostTouches) return false;
  Point points[D + 1];
  find_points(trajectories, touch, wall_goals, points);
  uint32_t order[D + 1];
  const MovingPair<D> sorted = sort_pair(touch.pair, order);
  Row row{};
  const double largest_coordinate = set_key(sorted.start, sorted.end, D + 1, round, touch.first.time, row.key);
  const TouchMoment<D> moment(sorted, touch.first.time);
  row.normal = moment.normal(sorted.kind);
  row.apart = kApart * std::ldexp(1, 3 * static_cast<int>(count - 1)) * largest_coordinate;
  row.carries = carries_ && touch.other == nullptr;
  double weights[D + 1];
  find_weights<D>(sorted.kind, moment, weights);
  if (order[1] != order[2]) {
    Point ordered[D + 1];
    for (uint32_t i = 0; i <= D; ++i) {
      ordered[i] = points[order[i]];
      ordered[i].weight = weights[i];
      ordered[i].at = moment.at[i];
    }
    const uint32_t first_count = first_side_of(sorted);
    share_weights(sorted.start, sorted.end, 0, first_count, ordered);
    share_weights(sorted.start, sorted.end, first_count, D + 1, ordered);
    return add_row(trajectories, ordered, D + 1, row);
  }
  // The facet is a vertex, and comes first.
  for (uint32_t i = 0; i <= D; ++i) {
    points[i].weight = i == 0 ? -1 : 1.0 / D;
    points[i].at = moment.at[i == 0 ? 1 : 0];
  }
  return add_row(trajectories, points, D + 1, row);
}

/** Two hulls can be nearest along a whole edge or face, as where an edge lies along a wall. So each corner and each pair of edges has a
 * row if it is as near as it may be, and a corner also if it comes so near to a facet next. */
template <int D>
bool TouchRows<D>::add(Array<Trajectory<D>>& trajectories, const TooNearOnWay<D>& near, const double* const* wall_goals,
                       uint32_t round) {
  const uint32_t times = count_again(near);
  if (times > kMostTouches) return false;
  const uint32_t count = near.ways.count[0], other_count = near.ways.count[1];
  const TimeOfGap worst = worst_time(near.ways, near.time, near.wanted);
  bool has_row = false;
  const auto add_side = [&](const Corners& side, const Corners& other) {
    has_row = add_near_row(trajectories, near, worst, side, other, wall_goals, round, times) || has_row;
  };
  const auto all = [](uint32_t n) { return Corners{{0, 1, 2}, n}; };
  for (uint32_t i = 0; (other_count > 1 || count == 1) && i < count; ++i) add_side({{i}, 1}, all(other_count));
  for (uint32_t k = 0; count > 1 && k < other_count; ++k) add_side(all(count), {{k}, 1});
  if (count == 1 || other_count == 1) return has_row;
  static constexpr uint32_t kEdges[3][2] = {{0, 1}, {1, 2}, {0, 2}};  // of corners that are in order
  const uint32_t edges = count == 2 ? 1 : 3, other_edges = other_count == 2 ? 1 : 3;
  for (uint32_t e = 0; e < edges; ++e) {
    for (uint32_t f = 0; f < other_edges; ++f) {
      add_side({{kEdges[e][0], kEdges[e][1]}, 2}, {{kEdges[f][0], kEdges[f][1]}, 2});
    }
  }
  return has_row;
}

/** Adds a row for some corners of both sides, if they are about as near as they may be. */
template <int D>
bool TouchRows<D>::add_near_row(const Array<Trajectory<D>>& trajectories, const TooNearOnWay<D>& near,
                                const TimeOfGap& worst, const Corners& side, const Corners& other,
                                const double* const* wall_goals, uint32_t round, uint32_t times) {
  const HullWays<D>& ways = near.ways;
  // The sides of a pair are in the order of all of their corners: here in that of those that are in the row.
  const uint32_t a = side.numbers[0], b = other.numbers[0];
  const bool turns = side.count != other.count
                         ? other.count < side.count
                         : is_before<D>(ways.start[1][b], ways.end[1][b], ways.start[0][a], ways.end[0][a]);
  Point points[kMostPoints];
  const double *starts[kMostPoints], *ends[kMostPoints];
  double places[kMostPoints][D];
  ConvexHull hulls[2];
  uint32_t count = 0;
  const uint32_t first_count = (turns ? other : side).count;
  for (uint32_t k = 0; k < 2; ++k) {
    const uint32_t s = turns ? 1 - k : k;
    const uint32_t trajectory = s == ways.first ? near.trajectory : near.other_trajectory;
    const Corners& corners = s == 0 ? side : other;
    for (uint32_t n = 0; n < corners.count; ++n, ++count) {
      const uint32_t i = corners.numbers[n], corner = ways.corner[s][i];
      starts[count] = ways.start[s][i];
      ends[count] = ways.end[s][i];
      point_at<D>(starts[count], ends[count], worst.time, places[count]);
      hulls[k].points[hulls[k].count++] = places[count];
      const double* const goal = trajectory != kNone     ? trajectories[trajectory].goal(corner)
                                 : near.other == nullptr ? wall_goals[corner]
                                                         : ends[count];
      double at[D];
      point_at<D>(starts[count], ends[count], near.time, at);
      points[count] = {trajectory, trajectory == kNone ? kNone : corner, goal, 0, to_vec<D>(at), 0};
      points[count].name = trajectory == kNone && near.other == nullptr ? near.wall.vertices[corner] : corner;
    }
  }
  const HullGap gap = find_gap<D>(hulls[0], hulls[1], std::numeric_limits<double>::infinity(), near.wanted);
  double begin = 0, end = 0;  // of the ways, along the normal
  bool is_over_facet = count == D + 1 && (side.count == 1 || other.count == 1);
  for (uint32_t i = 0; i < count; ++i) {
    points[i].weight = i < first_count ? gap.weights[i] : -gap.other_weights[i - first_count];
    begin += points[i].weight * dot(gap.normal, to_vec<D>(starts[i]));
    end += points[i].weight * dot(gap.normal, to_vec<D>(ends[i]));
    is_over_facet = is_over_facet && std::fabs(points[i].weight) > kAboutAsNear;
  }
  share_weights(starts, ends, 0, first_count, points);
  share_weights(starts, ends, first_count, count, points);
  const double least = std::max(near.wanted, worst.distance);
  const bool comes_next = is_over_facet && gap.distance <= (1 + kNext) * least && end < near.wanted;
  if (!(gap.distance <= (1 + kAboutAsNear) * least) && !comes_next) return false;
  Row row{};
  const double largest_coordinate = set_key(starts, ends, count, round, near.time, row.key);
  row.normal = gap.normal;
  row.apart = std::max(kThickApart * largest_coordinate, kFarther * near.wanted) *
              std::ldexp(1, 3 * static_cast<int>(times - 1));
  row.time = worst.is_later ? worst.time : 1;
  row.begin = begin;
  row.distance = gap.distance;
  row.wanted = near.wanted;
  row.carries = carries_ && near.other == nullptr;
  row.name = near_name_of(near, turns, points, first_count, count);
  return join_row(trajectories, points, count, row);
}

/** Adds a row, unless another part has one for the same corners in this round. Then the row is that of the part that comes nearer. */
template <int D>
bool TouchRows<D>::join_row(const Array<Trajectory<D>>& trajectories, const Point* points, uint32_t count, Row& row) {
  const auto same = dsw::find_if(rows_.begin(), rows_.end(), [&](const Row& each) {
    return each.name == row.name && std::get<0>(each.key) == std::get<0>(row.key);
  });
  if (same == rows_.end()) return add_row(trajectories, points, count, row);
  const auto rank = [](const Row& of) {
    return std::make_tuple(of.distance, of.time, of.normal.x(), of.normal.y(), of.normal.z());
  };
  const auto at = static_cast<size_t>(same - rows_.begin());
  row.apart = rows_[at].apart = std::max(rows_[at].apart, row.apart);
  row.key = rows_[at].key = std::min(rows_[at].key, row.key);
  if (rank(row) < rank(rows_[at]) && add_row(trajectories, points, count, row)) {
    rows_[at] = rows_.back();
    rows_.pop_back();
  }
  return true;
}

/** The corners that a row of something too near keeps apart, whatever parts have them.
 * @param turns whether the points of the second side come first. */
template <int D>
typename TouchRows<D>::NearName TouchRows<D>::near_name_of(const TooNearOnWay<D>& near, bool turns, const Point* points,
                                                           uint32_t first_count, uint32_t count) {
  std::array<uint32_t, 5> sides[2];
  for (uint32_t s = 0; s < 2; ++s) {
    const bool is_part = (turns ? 1 - s : s) == near.ways.first;
    const uint32_t trajectory = is_part ? near.trajectory : near.other_trajectory;
    const bool is_still = trajectory == kNone && near.other != nullptr;
    sides[s] = {trajectory, is_still ? near.other->index : kNone, kNone, kNone, kNone};
    uint32_t at = 2;
    for (uint32_t i = s == 0 ? 0 : first_count; i < (s == 0 ? first_count : count); ++i)
      sides[s][at++] = points[i].name;
    dsw::sort(sides[s].begin() + 2, sides[s].end());
  }
  const auto& [first, second] = std::minmax(sides[0], sides[1]);
  NearName name;
  std::copy(first.begin(), first.end(), name.begin());
  std::copy(second.begin(), second.end(), name.begin() + 5);
  return name;
}

/** Points of a side that go the same way share their weights: nothing but numbers tells them apart. */
template <int D>
void TouchRows<D>::share_weights(const double* const* starts, const double* const* ends, uint32_t first, uint32_t end,
                                 Point* points) {
  for (uint32_t i = first; i < end; ++i) {
    uint32_t same = i + 1;
    double sum = points[i].weight;
    while (same < end && is_same_place<D>(starts[i], starts[same]) && is_same_place<D>(ends[i], ends[same]))
      sum += points[same++].weight;
    const double each = sum / (same - i);
    for (; i + 1 < same; ++i) points[i].weight = each;
    points[i].weight = each;
  }
}

/** Adds a row, if somebody can give way. */
template <int D>
bool TouchRows<D>::add_row(const Array<Trajectory<D>>& trajectories, const Point* points, uint32_t count, Row& row) {
  if (!std::isfinite(dot(row.normal, row.normal)) || is_zero(row.normal) || !std::isfinite(row.least())) return false;
  bool gives_way = false;
  for (uint32_t i = 0; i < count; ++i) {
    const Point& point = points[i];
    if (!std::isfinite(point.weight)) return false;
    gives_way = gives_way || (point.weight != 0 && can_move(trajectories, point));
    add_point(point, row);
  }
  if (!gives_way) return false;
  for (uint32_t i = 0; i < row.count; ++i) {
    const Point& point = row.points[i];
    if (point.trajectory != kNone) bases_[point.trajectory][point.vertex].has_row = true;
  }
  rows_.push_back(row);
  return true;
}

/** The vertices of a row go from where they touched as far as the wall still goes there, unless an earlier row carries them. */
template <int D>
void TouchRows<D>::carry(const Row& row) {
  Vec way = Vec::Zero();
  double whole = 0;
  for (uint32_t i = 0; i < row.count; ++i) {
    const Point& point = row.points[i];
    if (point.trajectory != kNone) continue;
    way = way + point.weight * (to_vec<D>(point.goal) - point.at);
    whole += point.weight;
  }
  for (uint32_t i = 0; i < row.count; ++i) {
    const Point& point = row.points[i];
    if (point.trajectory == kNone) continue;
    Base& base = bases_[point.trajectory][point.vertex];
    if (base.is_carried) continue;
    base.is_carried = true;
    store<D>(point.at + way / whole, base.place);
  }
}

template <int D>
double TouchRows<D>::missing(const Array<Trajectory<D>>& trajectories, const Row& row, double* resistance) const {
  Vec sum = Vec::Zero();
  *resistance = 0;
  for (uint32_t i = 0; i < row.count; ++i) {
    const Point& point = row.points[i];
    sum = sum + point.weight * to_vec<D>(goal_of(trajectories, point));
    if (can_move(trajectories, point)) *resistance += point.weight * point.weight;
  }
  return row.least() - dot(row.normal, sum);
}

/** The points of a row go by its step along the normal. */
template <int D>
void TouchRows<D>::give_way(Array<Trajectory<D>>& trajectories, Row& row) {
  if (row.step == 0) return;
  row.force += row.step;
  for (uint32_t i = 0; i < row.count; ++i) {
    const Point& point = row.points[i];
    if (!can_move(trajectories, point)) continue;
    double* const goal = trajectories[point.trajectory].goal(point.vertex);
    store<D>(to_vec<D>(goal) + (row.step * point.weight) * row.normal, goal);
  }
}

template <int D>
void TouchRows<D>::solve(Array<Trajectory<D>>& trajectories) {
  dsw::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.key < b.key; });
  for (Array<Base>& bases : bases_) {
    for (Base& base : bases) base.is_carried = false;
  }
  for (const Row& row : rows_) {
    if (row.carries) carry(row);
  }
  for_each_held(trajectories,
                [&](Trajectory<D>& of, uint32_t v, const Base& base) { std::copy_n(base.place, D, of.goal(v)); });
  for (Row& row : rows_) row.force = 0;
  for (uint32_t sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool is_done = true;
    for (size_t first = 0, end; first < rows_.size(); first = end) {
      for (end = first + 1; end < rows_.size() && rows_[end].key == rows_[first].key;) ++end;
      // Touches at the same time and place can share vertices. They are satisfied side by side, each in part.
      for (size_t i = first; i < end; ++i) {
        Row& row = rows_[i];
        double resistance;
        const double short_of = missing(trajectories, row, &resistance);
        row.step = resistance > 0 ? std::max(short_of / resistance / static_cast<double>(end - first), -row.force) : 0;
        is_done = is_done && std::fabs(row.step) * resistance <= row.apart / 4;
      }
      // Sums of numbers depend on their order.
      if (end - first > 1) {
        dsw::sort(&rows_[first], &rows_[first] + (end - first), [](const Row& a, const Row& b) {
          return std::make_tuple(a.step, a.normal.x(), a.normal.y(), a.normal.z()) <
                 std::make_tuple(b.step, b.normal.x(), b.normal.y(), b.normal.z());
        });
      }
      for (size_t i = first; i < end; ++i) give_way(trajectories, rows_[i]);
    }
    if (is_done) break;
  }
  for_each_held(trajectories, [&](Trajectory<D>& of, uint32_t v, const Base&) {
    double* const goal = of.goal(v);
    const double* const start = of.start(v);
    for (int k = 0; k < D; ++k)
      goal[k] = std::isfinite(goal[k]) ? std::clamp(goal[k], start[k] - far_, start[k] + far_) : start[k];
    if (is_same_place<D>(goal, of.end(v))) return;
    of.is_new[v] = 1;
    std::copy_n(goal, D, of.end(v));
  });
}

/** Calls visit(trajectory, vertex, base) for the vertices that rows move. */
template <int D>
template <class Visit>
void TouchRows<D>::for_each_held(Array<Trajectory<D>>& trajectories, Visit visit) {
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    if (trajectories[t].stands) continue;
    for (uint32_t v = 0; v < bases_[t].size(); ++v) {
      if (bases_[t][v].has_row && !bases_[t][v].is_kept) visit(trajectories[t], v, bases_[t][v]);
    }
  }
}

template class TouchRows<2>;
template class TouchRows<3>;

}  // namespace dsw
