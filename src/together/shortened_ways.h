#pragma once
// Ways that are shortened where they touch something, each for itself, until nothing is touched.

#include <tuple>

#include "together/body_ways.h"
#include "together/describe.h"
#include "together/settings.h"
#include "together/touch_rows.h"

namespace dsw {

/** One for each thread. Throws std::bad_alloc and WorkOver.
 * @tparam Walls see WholeWays. */
template <int D, class Walls>
class ShortenedWays {
 public:
  /** How it ended. kRoundsOver: something may still be touched. kAtWalls: nothing was done, since edges or faces touch
   * walls at the start. */
  enum class End { kFree, kRoundsOver, kAtWalls };

  ShortenedWays(const Environment<D>& env, Walls& walls, BodyWays<D>& bodies, ThickWays<D>& thick)
      : env_(env), walls_(walls), bodies_(bodies), thick_(thick), rows_(env.memory) {}

  /** Shortens the ways to the goals, which are those of the call, or leads them to other goals beside what they touch.
   * @param may_end_at_walls whether kAtWalls is an answer. */
  End run(Array<Trajectory<D>>& trajectories, const TogetherSettings& settings, bool may_end_at_walls);

  bool has_shortened() const { return group_ != 0; }
  double first_time() const { return first_time_; }  // at which something was touched in the first round
  const Array<WayTouch<D>>& touches() const { return touched_.all; }  // of the last round

 private:
  void find_touches(const Array<Trajectory<D>>& trajectories);
  bool starts_at_walls() const;
  /** Touches, or what comes too near, of a round. */
  template <class Touch>
  struct Found {
    Array<Touch> all, chosen, told;
    explicit Found(const Memory* memory) : all(memory), chosen(memory), told(memory) {}
  };
  template <class Touch>
  void take(Found<Touch>& found, Array<Trajectory<D>>& trajectories, uint32_t before, uint32_t round, bool may_lead);
  template <class Touch>
  void describe_chosen(Found<Touch>& found, Array<Trajectory<D>>& trajectories);
  template <class Touch>
  void lead_chosen(Found<Touch>& found, Array<Trajectory<D>>& trajectories, uint32_t round);
  template <class Touch>
  void shorten_chosen(const Found<Touch>& found, Array<Trajectory<D>>& trajectories);
  void watch(const WayTouch<D>& touch) {
    if (touch.other == nullptr && touch.part.kind == Simplex::kVertex) watched_.push_back(touch);
  }
  void watch(const TooNearOnWay<D>&) const noexcept {}
  void set_goals(Array<Trajectory<D>>& trajectories);
  void collect_again(Array<Trajectory<D>>& trajectories);

  /** A vertex whose way is shortened in this round. */
  struct Cut {
    uint32_t group = 0;  // of touches; 0: none
    uint32_t count = 0;  // how often its way has been shortened in the call
    double time = 1;     // up to which it goes
    bool is_shortened = false;
  };
  /** Calls visit(cut) for the points of a touch: vertices of the call's bodies, and points of the environment that go. */
  template <class Touch, class Visit>
  void for_each_cut(Array<Trajectory<D>>& trajectories, const Touch& touch, Visit visit);
  Cut& cut_of(const Array<Trajectory<D>>& trajectories, const Trajectory<D>& of, uint32_t v) {
    return cuts_[static_cast<size_t>(&of - trajectories.data())][v];
  }

  const Environment<D>& env_;
  Walls& walls_;
  BodyWays<D>& bodies_;
  ThickWays<D>& thick_;
  Found<WayTouch<D>> touched_{env_.memory};
  Found<TooNearOnWay<D>> near_{env_.memory};
  Array<WayTouch<D>> watched_{env_.memory};
  Array<PairName> names_{env_.memory};   // of contacts that have been described, sorted
  Array<Array<Cut>> cuts_{env_.memory};  // by trajectory and vertex
  Array<Cut> point_cuts_{env_.memory};   // of the environment's points, by the walls' numbers
  TouchRows<D> rows_;
  bool leads_ = false;  // rows lead what touches elsewhere
  uint32_t group_ = 0;
  double first_time_ = 1;
};

}  // namespace dsw
