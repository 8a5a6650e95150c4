#pragma once
// What touches allow of the ways to the targets: goals that keep apart what touched.

#include <array>
#include <tuple>

#include "base/vec.h"
#include "together/thick_ways.h"

namespace dsw {

/** One for each thread. Nothing depends on the order of vertices, bodies or touches. Throws std::bad_alloc. */
template <int D>
class TouchRows {
 public:
  explicit TouchRows(const Memory* memory) : memory_(memory), rows_(memory), bases_(memory), known_(memory) {}

  /** Forgets what touched in another call.
   * @param carries whether parts that touch a wall go with it; else they slide along it. */
  void start(const Array<Trajectory<D>>& trajectories, bool carries);
  bool empty() const noexcept { return rows_.empty(); }
  /** Adds a row for a touch. False: this pair has touched too often, or has no normal, or nobody of it can give way.
   * @param wall_goals where the points of the environment go, which have to live on.
   * @param round in which it touched. */
  bool add(Array<Trajectory<D>>& trajectories, const WayTouch<D>& touch, const double* const* wall_goals,
           uint32_t round);
  /** Adds a row for something that comes too near, likewise. */
  bool add(Array<Trajectory<D>>& trajectories, const TooNearOnWay<D>& near, const double* const* wall_goals,
           uint32_t round);
  /** A vertex keeps the goal that it has. */
  void keep_goal(const Array<Trajectory<D>>& trajectories, const Trajectory<D>& of, uint32_t v) {
    base_of(trajectories, of, v).is_kept = true;
  }
  /** Finds the goals that are nearest to the targets, in the sum of squares, among those that all rows allow. Goals that
   * change are new. */
  void solve(Array<Trajectory<D>>& trajectories);

 private:
  /** Where a vertex would go if no row held it. */
  struct Base {
    double place[D];
    bool is_kept = false, is_carried = false, has_row = false;
  };
  struct Point {
    uint32_t trajectory;  // kNone: it goes to `goal`, whatever the rows say
    uint32_t vertex;
    const double* goal;
    double weight;
    Vec at;         // where it touched
    uint32_t name;  // of the vertex, also where it is not one of a trajectory
  };
  using NearName = std::array<uint32_t, 10>;
  static NearName near_name_of(const TooNearOnWay<D>& near, bool turns, const Point* points, uint32_t first_count,
                               uint32_t count);
  static constexpr uint32_t kMostPoints = 2 * D;  // two edges in the plane, two faces in space
  using Key = std::tuple<uint32_t, double, std::array<double, 2 * D * kMostPoints>>;
  /** dot(normal, sum of weights times places) is `begin` at the start of the ways, and has to be at least the sum of `wanted` and
   * `apart` at `time`. */
  struct Row {
    Key key;
    NearName name;  // of a distance; else zeros
    Vec normal;
    double time = 1, begin = 0, wanted = 0, distance = 0;  // distance: at that time, before the row
    double apart, force, step;                             // apart: room for rounding
    bool carries;
    uint32_t count;
    Point points[kMostPoints];

    /** What the sum of weights times goals has to be: it is linear in time. */
    double least() const noexcept { return (wanted + apart - (1 - time) * begin) / time; }
  };
  struct Known {
    PairName name;
    uint32_t count;
  };
  Base& base_of(const Array<Trajectory<D>>& trajectories, const Trajectory<D>& of, uint32_t v) {
    return bases_[static_cast<size_t>(&of - trajectories.data())][v];
  }
  bool can_move(const Array<Trajectory<D>>& trajectories, const Point& point) const {
    return point.trajectory != kNone && !trajectories[point.trajectory].stands &&
           !bases_[point.trajectory][point.vertex].is_kept;
  }
  template <class Touch>
  uint32_t count_again(const Touch& touch);
  void find_points(const Array<Trajectory<D>>& trajectories, const WayTouch<D>& touch, const double* const* wall_goals,
                   Point* points) const;
  double set_key(const double* const* starts, const double* const* ends, uint32_t count, uint32_t round, double time,
                 Key& key);
  /** Some points of a side of a pair. */
  struct Corners {
    uint32_t numbers[3];
    uint32_t count;
  };
  bool add_near_row(const Array<Trajectory<D>>& trajectories, const TooNearOnWay<D>& near, const TimeOfGap& worst,
                    const Corners& side, const Corners& other, const double* const* wall_goals, uint32_t round,
                    uint32_t times);
  bool join_row(const Array<Trajectory<D>>& trajectories, const Point* points, uint32_t count, Row& row);
  bool add_row(const Array<Trajectory<D>>& trajectories, const Point* points, uint32_t count, Row& row);
  static void share_weights(const double* const* starts, const double* const* ends, uint32_t first, uint32_t end,
                            Point* points);
  static void add_point(const Point& point, Row& row);
  void carry(const Row& row);
  /** Where a point goes: goals of vertices change. */
  static const double* goal_of(const Array<Trajectory<D>>& trajectories, const Point& point) {
    return point.trajectory == kNone ? point.goal : trajectories[point.trajectory].goal(point.vertex);
  }
  void give_way(Array<Trajectory<D>>& trajectories, Row& row);
  double missing(const Array<Trajectory<D>>& trajectories, const Row& row, double* resistance) const;
  template <class Visit>
  void for_each_held(Array<Trajectory<D>>& trajectories, Visit visit);

  const Memory* memory_;
  Array<Row> rows_;
  Array<Array<Base>> bases_;
  Array<Known> known_;
  bool carries_ = false;
  double far_ = 0;  // no vertex goes farther along an axis
};

}  // namespace dsw
