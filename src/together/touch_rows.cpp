// A touch says that its two sides come together along a normal. What is allowed is that they end apart along it, by the
// distance of some units in the last place. So each touch is a row: the sum of the goals of its points, by their weights
// at the touch, is at least that much along the normal. This is right to first order; what is left is found by the exact search
// of the next round, with another normal.
//
// The nearest goals that all rows allow are found by Hildreth's method: one row after the other is satisfied, and gives
// back at most what it has taken before. Rows are taken in the order of the times and places of their touches.

#include "together/touch_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "together/touch_moment.h"

namespace dsw {
namespace {

constexpr uint32_t kMostTouches = 8, kMostSweeps = 200;
constexpr double kApart = 0x1p-48;       // of the largest coordinate
constexpr double kThickApart = 0x1p-45;  // likewise: what certified distances lose by rounding
constexpr double kFar = 4;               // times the longest way, vertices are led

/** Orders the points of a side, and the sides of two edges, by where they go. */
template <int D>
void sort_points(const MovingPair<D>& pair, uint32_t* order, uint32_t first, uint32_t end) {
  const auto is_before = [&](uint32_t a, uint32_t b) {
    for (const double* const* places : {pair.start, pair.end}) {
      for (int k = 0; k < D; ++k) {
        if (places[a][k] != places[b][k]) return places[a][k] < places[b][k];
      }
    }
    return false;
  };
  std::sort(order + first, order + end, is_before);
}

template <int D>
bool same_way(const MovingPair<D>& pair, uint32_t a, uint32_t b) {
  return std::equal(pair.start[a], pair.start[a] + D, pair.start[b]) &&
         std::equal(pair.end[a], pair.end[a] + D, pair.end[b]);
}

template <int D>
uint32_t first_side_of(const MovingPair<D>& pair) {
  return pair.kind == PairKind::kEdgeEdge ? 2 : 1;
}

/** A pair with its points, and the sides of two edges, in an order that depends on where they go alone. */
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
      for (int k = 0; k < D; ++k) far_ = std::max(far_, kFar * std::fabs(bases[v].place[k] - of.start(v)[k]));
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
        points[i] = {kNone, kNone, body == nullptr ? wall_goals[i - first] : touch.pair.end[i], 0, {}};
        continue;
      }
      const SimplexCorners<D> corners(*body, part);
      const uint32_t v = corners.vertices[std::min(i - first, corners.count - 1)];
      points[i] = {trajectory, v, trajectories[trajectory].goal(v), 0, {}};
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
    for (int k = 0; k < D; ++k) far_ = std::max(far_, kFar * std::fabs(ends[i][k] - starts[i][k]));
  }
  double largest = 0;
  for (const double each : places) largest = std::max(largest, std::fabs(each));
  return largest;
}

/** Adds a point to a row; a vertex that stands there already gets its weight, too. */
template <int D>
void TouchRows<D>::add_point(const Point& point, Row& row) {
  Point* const same = std::find_if(row.points, row.points + row.count, [&](const Point& each) {
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
  row.least = row.apart = kApart * std::ldexp(1, 3 * static_cast<int>(count - 1)) * largest_coordinate;
  row.carries = carries_ && touch.other == nullptr;
  double weights[D + 1];
  find_weights<D>(sorted.kind, moment, weights);
  Point ordered[D + 1];
  for (uint32_t i = 0; i <= D; ++i) {
    ordered[i] = points[order[i]];
    ordered[i].weight = weights[i];
    ordered[i].at = moment.at[i];
  }
  return add_row(trajectories, ordered, D + 1, row);
}

template <int D>
bool TouchRows<D>::add(Array<Trajectory<D>>& trajectories, const TooNearOnWay<D>& near, const double* const* wall_goals,
                       uint32_t round) {
  const uint32_t times = count_again(near);
  if (times > kMostTouches) return false;
  const HullWays<D>& ways = near.ways;
  Point points[kMostPoints];
  const double *starts[kMostPoints], *ends[kMostPoints];
  uint32_t count = 0;
  for (uint32_t side = 0; side < 2; ++side) {
    const uint32_t trajectory = side == ways.first ? near.trajectory : near.other_trajectory;
    for (uint32_t i = 0; i < ways.count[side]; ++i, ++count) {
      const uint32_t corner = ways.corner[side][i];
      starts[count] = ways.start[side][i];
      ends[count] = ways.end[side][i];
      double at[D];
      point_at<D>(starts[count], ends[count], near.time, at);
      const double weight = (side == 0 ? 1 : -1) * near.weights[side][i];
      if (trajectory == kNone) {
        points[count] = {kNone, kNone, near.other == nullptr ? wall_goals[corner] : ends[count], weight, to_vec<D>(at)};
      } else {
        points[count] = {trajectory, corner, trajectories[trajectory].goal(corner), weight, to_vec<D>(at)};
      }
    }
  }
  Row row{};
  const double largest_coordinate = set_key(starts, ends, count, round, near.time, row.key);
  row.normal = (ways.first == 0 ? 1 : -1) * near.normal;
  row.apart = kThickApart * std::ldexp(1, 3 * static_cast<int>(times - 1)) * largest_coordinate;
  row.least = near.wanted + row.apart;
  row.carries = carries_ && near.other == nullptr;
  return add_row(trajectories, points, count, row);
}

/** Adds a row, if somebody can give way. */
template <int D>
bool TouchRows<D>::add_row(const Array<Trajectory<D>>& trajectories, const Point* points, uint32_t count, Row& row) {
  if (!std::isfinite(dot(row.normal, row.normal)) || is_zero(row.normal) || !std::isfinite(row.least)) return false;
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
  return row.least - dot(row.normal, sum);
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
  std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.key < b.key; });
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
      for (size_t i = first; i < end; ++i) give_way(trajectories, rows_[i]);
    }
    if (is_done) break;
  }
  for_each_held(trajectories, [&](Trajectory<D>& of, uint32_t v, const Base&) {
    double* const goal = of.goal(v);
    const double* const start = of.start(v);
    for (int k = 0; k < D; ++k)
      goal[k] = std::isfinite(goal[k]) ? std::clamp(goal[k], start[k] - far_, start[k] + far_) : start[k];
    if (std::equal(goal, goal + D, of.end(v))) return;
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
