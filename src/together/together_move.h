#pragma once
// Bodies of which all vertices move at once, until something is touched.

#include "together/settings.h"
#include "together/shortened_ways.h"
#include "together/wall_ways.h"
#include "together/whole_ways.h"

namespace dsw {

/** Moves bodies; one for each thread. */
template <int D>
class TogetherMove {
 public:
  explicit TogetherMove(const Environment<D>& env)
      : ways_(env), shortened_(env, ways_.walls, ways_.bodies, ways_.thick) {}
  TogetherMove(const TogetherMove&) = delete;
  TogetherMove& operator=(const TogetherMove&) = delete;

  /** Moves bodies that depend on nobody else that moves. They begin with their records cleared. Throws std::bad_alloc
   * and WorkOver with some vertices moved.
   * @param bodies_meet whether bodies can touch at all. */
  void move(Array<Trajectory<D>>& trajectories, bool bodies_meet, const TogetherSettings& settings);

  /** What serves other ways of bodies in this environment, too. */
  WholeWays<D, WallWays<D>>& ways() noexcept { return ways_; }
  void set_counters(CastCounters* counters) { ways_.walls.set_counters(counters); }

 private:
  /** How a round ended. kDeparted: before anything was touched. */
  enum class Round { kArrived, kDeparted, kStopped };
  Round run_round(Array<Trajectory<D>>& trajectories, bool may_depart);
  Round shorten_ways(Array<Trajectory<D>>& trajectories, const TogetherSettings& settings, bool may_depart);
  bool departs(Array<Trajectory<D>>& trajectories);

  WholeWays<D, WallWays<D>> ways_;
  ShortenedWays<D, WallWays<D>> shortened_;
  double time_ = 1;  // of a round, up to which all have gone
};

}  // namespace dsw
