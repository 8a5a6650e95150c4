#pragma once
// Steps of an environment whose points go straight to others, with bodies that have a target for each step, and all that stands.

#include "together/moving_walls.h"
#include "together/settings.h"
#include "together/whole_ways.h"

namespace dsw {

/** For one call. Throws std::bad_alloc, WorkOver and NON_FINITE. */
template <int D>
class RoomSteps {
  Environment<D>& env_;  // the initializers below use it

 public:
  explicit RoomSteps(Environment<D>& env) : env_(env), step_(env), ways_(env) {}
  RoomSteps(const RoomSteps&) = delete;
  RoomSteps& operator=(const RoomSteps&) = delete;

  /** The points go from where they are to `next`. Volumes that do not stay valid are appended to `invalid`. May be called again:
   * from where they have gone. */
  void begin(const double* next, Array<dsw_volume_id>& invalid);
  const double* next() const noexcept { return next_; }
  /** Looks at a part of the whole way, from its start. Returns where the points are at its end. */
  const double* look_to(double until);
  /** Whether cells stay valid on the way to where look_to() has led.
   * @param unit one unit in the last place of what is near them. */
  bool stay_valid(const CellQueue& cells, double unit);
  /** Tells the cells that did not stay valid in the last look. */
  void keep_invalid() { invalid_->assign(met_invalid_.begin(), met_invalid_.end()); }
  /** The share of the way in which nothing goes further than one unit in the last place. */
  double least_step() const noexcept { return least_step_; }
  /** Finds what the walls first touch of things that stand, if that is before `first` and on the way that look_to() has led.
   * @return whether the cells that are met there stay valid. */
  bool find_first(FirstTouch& first);
  /** Appends the things that stand to those that the call moves. They have gone through find_first. */
  void join(Array<Trajectory<D>>& trajectories);

  /** Goes to a part of the whole way, if that is free for all: each body to its targets.
   * @param keeps whether what is touched then goes to the records, and to `contacts`. */
  bool go_to(Array<Trajectory<D>>& trajectories, double fraction, bool bodies_meet, const TogetherSettings& settings,
             bool keeps);
  /** The points, and the cells of what stands, are what they were before the last step; bodies that move are not. */
  void take_back(Array<Trajectory<D>>& trajectories) noexcept;
  /** Keeps what find_first has found as the contacts, where no step has found others. */
  void keep_standing() { contacts.assign(standing_touched_.begin(), standing_touched_.end()); }
  /** Keeps what a part of a body touches of walls, as its last contact says. */
  void keep_wall(const Trajectory<D>& of, const Simplex& part, const uint32_t* corners, uint32_t count);
  /** Sets the time of all contacts, and the whole ways of their points. */
  void set_time(double time) noexcept;

  Array<Trajectory<D>> standing{env_.memory};  // what the call does not move
  Array<dsw_wall_contact> contacts{env_.memory};

 private:
  double* fill(double fraction);

  PointsWay<D> step_;
  WholeWays<D, MovingWalls<D>> ways_;
  const double *start_ = nullptr, *next_ = nullptr;
  Array<dsw_volume_id>* invalid_ = nullptr;
  Array<dsw_volume_id> met_invalid_{env_.memory};  // in the last look, or step
  Array<double> starts_{env_.memory};              // where they had gone when they began again
  Array<double> points_[2] = {Array<double>(env_.memory), Array<double>(env_.memory)};
  Array<dsw_wall_contact> standing_touched_{env_.memory};
  double least_step_ = 1;
};

}  // namespace dsw
