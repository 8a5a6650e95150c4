#pragma once
// The largest part of common straight ways that is free, while nothing moves.

#include "together/whole_ways.h"

namespace dsw {

/** Looks for fractions of steps of which the way to the rounded end is free; one for each thread. Throws std::bad_alloc and
 * WorkOver. The targets of trajectories are where their whole steps lead; trajectories without a step stand still.
 * @tparam Walls as of WholeWays. */
template <int D, class Walls>
class StepSearch {
 public:
  StepSearch(WholeWays<D, Walls>& ways, const Memory* memory) : ways_(ways), touches_(memory) {}

  /** The steps of the trajectories, which have been started, one array for each; without data: it stands still. */
  void begin(Array<Trajectory<D>>& trajectories, const Array<PointArray>& steps) noexcept {
    trajectories_ = &trajectories;
    steps_ = &steps;
    touches_.clear();
  }
  /** The largest fraction found, up to `most`: it is free, and the next double up to `most` is not. */
  double find(double most);

 private:
  void set_ends(double fraction);
  void set_ends_of_touches(double fraction);
  void set_end(Trajectory<D>& of, uint32_t v, double fraction) const;
  bool find_touches();
  bool are_apart(double fraction);
  bool are_met_before(double fraction, double most);
  template <class IsFree>
  static double last_free(double high, double guess, double step, IsFree is_free);

  WholeWays<D, Walls>& ways_;
  Array<Trajectory<D>>* trajectories_ = nullptr;
  const Array<PointArray>* steps_ = nullptr;
  Array<WayTouch<D>> touches_;  // all that some way has touched first
};

}  // namespace dsw
