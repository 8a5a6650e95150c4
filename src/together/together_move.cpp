#include "together/together_move.h"

#include <algorithm>

#include "base/search.h"
#include "motion/halving.h"

namespace dsw {
namespace {

template <int D>
uint64_t most_work(const Array<Trajectory<D>>& trajectories, const TogetherSettings& settings) noexcept {
  uint64_t vertices = 0;
  for (const Trajectory<D>& of : trajectories) vertices += of.motion.body->vertices.size();
  return 1000 * uint64_t{settings.kilo_products} * vertices;
}

}  // namespace

template <int D>
void TogetherMove<D>::move(Array<Trajectory<D>>& trajectories, bool bodies_meet, const TogetherSettings& settings) {
  ways_.set_most_work(most_work(trajectories, settings));
  ways_.start(trajectories, bodies_meet);
  ways_.walls.limits_parts = false;
  constexpr uint32_t kMostDepartures = 8;
  double gone = 0;  // of the whole way
  Round round = Round::kDeparted;
  for (uint32_t departures = 0; round == Round::kDeparted; ++departures) {
    const bool may_depart = departures < kMostDepartures;
    round = settings.stop == TogetherStop::kFeature ? shorten_ways(trajectories, settings, may_depart)
                                                    : run_round(trajectories, may_depart);
    if (round != Round::kArrived) gone += (1 - gone) * time_;
  }
  for (Trajectory<D>& of : trajectories) of.record->fraction = round == Round::kArrived ? 1 : gone;
  ways_.finish(trajectories);
}

/** Goes on as far as nothing is touched. */
template <int D>
typename TogetherMove<D>::Round TogetherMove<D>::run_round(Array<Trajectory<D>>& trajectories, bool may_depart) {
  Round round = Round::kArrived;
  if (ways_.find_touches(trajectories)) {
    round = may_depart && departs(trajectories) ? Round::kDeparted : Round::kStopped;
    if (round == Round::kStopped) ways_.stop(trajectories);
  }
  time_ = ways_.time();
  ways_.arrive(trajectories);
  return round;
}

/** Goes as far as nothing is touched, each vertex for itself. */
template <int D>
typename TogetherMove<D>::Round TogetherMove<D>::shorten_ways(Array<Trajectory<D>>& trajectories,
                                                              const TogetherSettings& settings, bool may_depart) {
  using End = typename ShortenedWays<D, WallWays<D>>::End;
  ways_.walls.limits_parts = true;
  const auto look_at_all = [&] {
    for (Trajectory<D>& of : trajectories) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{1});
    ways_.set_ends(trajectories, 1);
    ways_.walls.cast_paths(trajectories);
  };
  look_at_all();
  End end = shortened_.run(trajectories, settings, may_depart);
  if (end == End::kAtWalls) {
    ways_.first.clear();
    for (const WayTouch<D>& each : shortened_.touches()) {
      if (each.first.time == 0) ways_.first.push_back(each);
    }
    ways_.walls.limits_parts = false;
    const bool has_departed = departs(trajectories);
    ways_.walls.limits_parts = true;
    if (has_departed) {
      ways_.arrive(trajectories);
      return Round::kDeparted;
    }
    look_at_all();
    end = shortened_.run(trajectories, settings, false);
  }
  ways_.walls.limits_parts = false;
  const bool is_free = end == End::kFree;
  for (Trajectory<D>& of : trajectories) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{1});
  if (!is_free) {
    if (ways_.find_touches(trajectories)) {
      for (Trajectory<D>& of : trajectories)
        of.record->clear();  // what stopped single vertices is not what stops them all
      ways_.stop(trajectories);
    }
    time_ = std::min(ways_.time(), shortened_.first_time());
    ways_.arrive(trajectories);
    return Round::kStopped;
  }
  time_ = shortened_.first_time();
  ways_.arrive(trajectories);
  return shortened_.has_shortened() ? Round::kStopped : Round::kArrived;
}

/** What touches a wall at the start may be free under the shift, and stay so for a part of its way. Then all go that
 * part: what is touched after that is another round's. Whether they do. */
template <int D>
bool TogetherMove<D>::departs(Array<Trajectory<D>>& trajectories) {
  constexpr int kMostHalvings = 10;
  Halving halving;
  const Array<WayTouch<D>>& touches = ways_.first;
  const bool starts_at_walls =
      !touches.empty() && dsw::all_of(touches.begin(), touches.end(), [](const WayTouch<D>& each) {
        return each.first.time == 0 && each.other == nullptr && each.part.kind != Simplex::kVertex;
      });
  while (starts_at_walls && halving.count < kMostHalvings && halving.next()) {
    ways_.set_ends(trajectories, halving.way);
    if (!ways_.is_free(trajectories)) continue;
    time_ = halving.way;
    return true;
  }
  ways_.set_ends(trajectories, 1);
  return false;
}

template class TogetherMove<2>;
template class TogetherMove<3>;

}  // namespace dsw
