#pragma once
// Ways of bodies that end together, just before the first touch.

#include "together/body_ways.h"
#include "together/thick_ways.h"

namespace dsw {

/** One for each thread. Throws std::bad_alloc and WorkOver.
 * @tparam Walls what of the environment is touched: WallWays, or MovingWalls. */
template <int D, class Walls>
class WholeWays {
  const Environment<D>& env_;  // the initializers below use it

 public:
  explicit WholeWays(const Environment<D>& env) : env_(env), walls(env), bodies(env.memory), thick(env) {
    walls.work = bodies.work = &work_;
  }
  WholeWays(const WholeWays&) = delete;
  WholeWays& operator=(const WholeWays&) = delete;

  /** The most work of the next call, as of PairWork. */
  void set_most_work(uint64_t most) noexcept { work_ = {most, 0}; }
  /** Finds what comes near the ways to the targets, which become the goals.
   * @param bodies_meet whether bodies can touch at all.
   * @param drift see BodyWays. */
  void start(Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* drift = nullptr);
  /** Lets all ways end at their goals, and finds what is touched first there. Whether anything is. */
  bool find_touches(Array<Trajectory<D>>& trajectories);
  /** Keeps what find_touches has found in the records, and in those of the walls. */
  void describe(Array<Trajectory<D>>& trajectories);
  /** Keeps it, and lets all ways end just before it. */
  void stop(Array<Trajectory<D>>& trajectories);
  /** Lets all ways end at a time of the ways to the goals. */
  void set_ends(Array<Trajectory<D>>& trajectories, double time);
  /** Whether nothing is touched on the ways, and all distances are kept. */
  bool is_free(Array<Trajectory<D>>& trajectories);
  /** Up to which time, at most `most`, all distances are kept. */
  double find_too_near(const Array<Trajectory<D>>& trajectories, double most) {
    if (!thick.is_needed()) return most;
    thick.set_wall_ends(walls);
    return thick.find_first(trajectories, most);
  }
  /** All go to the ends of their ways. */
  void arrive(Array<Trajectory<D>>& trajectories);
  /** Counts who has come to its target. */
  void finish(Array<Trajectory<D>>& trajectories);
  /** Up to which time of the ways to the goals all go. */
  double time() const noexcept { return time_; }
  /** When what find_touches has found is touched, or comes too near, and by how much to step back from there at first. */
  double touch_time() const noexcept { return first.empty() ? thick.first[0].time : first[0].first.time; }
  double step_from_touch() const noexcept { return first.empty() ? step_back(thick.first[0]) : step_back(first[0]); }

  Walls walls;
  BodyWays<D> bodies;
  ThickWays<D> thick;
  Array<WayTouch<D>> first{env_.memory};  // what was found last
  bool meets_walls = true;                // false: walls were left out, since nothing is near the ways

 private:
  /** Whether something comes too near before anything is touched. */
  bool touched_too_near() const noexcept { return first.empty() && !thick.first.empty(); }
  void drop_covering(const Array<Trajectory<D>>& trajectories);
  void retreat(Array<Trajectory<D>>& trajectories, double time, double step);

  PairWork work_;
  double time_ = 1;
};

}  // namespace dsw
