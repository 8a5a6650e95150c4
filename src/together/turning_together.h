#pragma once
// Bodies that move rigidly, all at once, until something is touched.

#include "proximity/thick_sweep.h"
#include "response/rigid_touches.h"
#include "together/rigid_pairs.h"
#include "together/room_steps.h"
#include "together/together_move.h"

namespace dsw {

/** A body of a call with its motion. */
template <int D>
struct RigidTrajectory {
  Body<D>* body;
  const RigidMove<D>* motion;
  PlaceFn place;  // where its vertices are at a fraction, rounded
  const void* user;
  const Partners<D>* still;  // bodies that it may meet and that do not move in this call; null: none
  RigidWay<D> way;
  Array<BodyVertex<D>> start, here,
      before;       // where it began, where a step began, and where it stops
  double* targets;  // of a step: D for each vertex slot
};

/** Moves bodies; one for each thread. */
template <int D>
class TurningTogether {
 public:
  explicit TurningTogether(const Environment<D>& env)
      : env_(env), touches_(env), pairs_(env.memory), thick_(env), steps_(env) {}

  /** Moves bodies that depend on nobody else that moves. What has become of them is in the records of `trajectories`, which are
   * those of `bodies`, with the steps' targets. Throws std::bad_alloc and WorkOver with some vertices moved.
   * @param bodies_meet whether bodies can touch at all.
   * @param room an environment that moves with them, or null. What stands in `room` is met, too: it follows the others in
   * `trajectories` then.
   * @return up to which part of the motion all have gone. */
  double move(Array<RigidTrajectory<D>>& bodies, Array<Trajectory<D>>& trajectories, bool bodies_meet,
              const TogetherSettings& settings, RoomSteps<D>* room = nullptr);

  void set_counters(CastCounters* counters) { steps_.set_counters(counters); }

 private:
  struct Call;
  struct Met;
  FirstTouch look(Call& call, Met* met, bool* is_open);
  FirstTouch find_first(Call& call, Met* met, bool* is_open);
  bool go_to(Call& call, double fraction, bool records = false);
  bool go_with_room(Call& call, double fraction, bool records);
  bool keeps_distances(Call& call, double fraction, bool records);
  bool go(Call& call, double touch, double most_step);
  double most_step(const Call& call, bool is_open) const noexcept;
  void record_contacts(Call& call, double touch, Met& met);
  void record_met(Call& call, Met& met);

  const Environment<D>& env_;
  RigidTouches<D> touches_;
  RigidPairs<D> pairs_;
  ThickSweep<D> thick_;
  TogetherMove<D> steps_;
};

}  // namespace dsw
