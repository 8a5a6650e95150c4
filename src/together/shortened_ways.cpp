// All vertices go at once and steadily, at all times of this search. A vertex that touches something gets a new goal: the
// place on its way just before the touch. Then the ways of all parts at it are others, and are looked at again. What is
// left at the end is one steady motion to the goals, which touches nothing.
//
// The touches of a round are taken in the order of time. One is passed over if a vertex of it has got a new goal by an
// earlier one, since its way is another then. At the same time vertices come before edges, and these before faces. So an
// edge that touches with its end stops at that end alone.

#include "together/shortened_ways.h"

#include <algorithm>

#include "predicates/filtered.h"
#include "together/moving_walls.h"
#include "together/wall_ways.h"

namespace dsw {
namespace {

/** Touches with the same key are taken together. Times are those that are reported. */
template <int D>
std::tuple<double, uint32_t> key_of(const WayTouch<D>& touch) {
  return {touch.first.time, touch.other == nullptr ? static_cast<uint32_t>(touch.part.kind) : 0};
}

}  // namespace

template <int D, class Walls>
typename ShortenedWays<D, Walls>::End ShortenedWays<D, Walls>::run(Array<Trajectory<D>>& trajectories,
                                                                   const TogetherSettings& settings,
                                                                   bool may_end_at_walls) {
  const bool leads = settings.response != TogetherResponse::kStop;
  names_.clear();
  watched_.clear();
  cuts_.clear();
  point_cuts_.clear();
  group_ = 0;
  first_time_ = 1;
  for (const Trajectory<D>& of : trajectories) cuts_.emplace_back(of.is_new.size(), Cut{}, env_.memory);
  walls_.held.look_at_all();
  rows_.start(trajectories, settings.response == TogetherResponse::kCarry);
  for (uint32_t round = 0; round < settings.rounds; ++round) {
    find_touches(trajectories);
    if (touches_.empty()) return End::kFree;
    if (round == 0) {
      first_time_ = touches_[0].first.time;
      if (may_end_at_walls && starts_at_walls()) return End::kAtWalls;
    }
    for (Trajectory<D>& of : trajectories) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{0});
    walls_.start_round();
    point_cuts_.resize(walls_.held.count());
    const uint32_t before = group_;
    for (size_t first = 0, end; first < touches_.size(); first = end) {
      end = end_of_group(first);
      chosen_.clear();
      for (size_t i = first; i < end; ++i) {
        bool is_changed = false;
        for_each_cut(trajectories, touches_[i], [&](const Cut& cut) { is_changed = is_changed || cut.group > before; });
        // What is passed over is looked at again, as one of its vertices has a new goal.
        if (!is_changed) chosen_.push_back(touches_[i]);
      }
      describe_chosen(trajectories);
      ++group_;
      // What is led elsewhere may touch again and again: in the last rounds it stops.
      if (leads && round < settings.rounds - settings.rounds / 4) lead_chosen(trajectories, round);
      shorten_chosen(trajectories);
    }
    set_goals(trajectories);
  }
  return End::kRoundsOver;
}

/** Finds all touches that are new, and sorts them by time. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::find_touches(const Array<Trajectory<D>>& trajectories) {
  touches_.clear();
  walls_.find_all(trajectories, touches_);
  bodies_.find_all(trajectories, touches_);
  // A vertex that was stopped by a wall does not come to lie exactly on it, where it would touch it in the next call.
  for (const WayTouch<D>& each : watched_) {
    const Trajectory<D>& of = trajectories[each.trajectory];
    if (of.is_new[each.part.index] == 0 || !of.motion.ways[each.part.index].arrival.valid()) continue;
    WayTouch<D> again = each;
    walls_.find_goals(each, again.pair.end + 1);  // which may lie elsewhere since then
    if (orient<D>(again.pair.end + 1, of.end(each.part.index)) != 0) continue;
    again.first = {true, 1};
    if (of.moves(each.part.index)) touches_.push_back(again);
  }
  std::sort(touches_.begin(), touches_.end(), [](const WayTouch<D>& a, const WayTouch<D>& b) {
    return std::make_tuple(key_of(a), name_of(a)) < std::make_tuple(key_of(b), name_of(b));
  });
}

/** Whether all that is touched at time 0 are walls, by edges and faces. */
template <int D, class Walls>
bool ShortenedWays<D, Walls>::starts_at_walls() const {
  bool any = false;
  for (const WayTouch<D>& each : touches_) {
    if (each.first.time > 0) break;
    if (each.other != nullptr || each.part.kind == Simplex::kVertex) return false;
    any = true;
  }
  return any;
}

template <int D, class Walls>
size_t ShortenedWays<D, Walls>::end_of_group(size_t first) const {
  size_t end = first + 1;
  while (end < touches_.size() && key_of(touches_[end]) == key_of(touches_[first])) ++end;
  return end;
}

/** Adds those to the records that are not there. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::describe_chosen(Array<Trajectory<D>>& trajectories) {
  told_.clear();
  for (const WayTouch<D>& each : chosen_) {
    const PairName name = pair_name_of(each);
    const auto at = std::lower_bound(names_.begin(), names_.end(), name);
    if (at != names_.end() && *at == name) continue;
    names_.insert(at, name);
    told_.push_back(each);
    if (each.other == nullptr && each.part.kind == Simplex::kVertex) watched_.push_back(each);
  }
  describe_touches(env_, trajectories, told_);
  walls_.describe(trajectories, told_);
}

template <int D, class Walls>
template <class Visit>
void ShortenedWays<D, Walls>::for_each_cut(Array<Trajectory<D>>& trajectories, const WayTouch<D>& touch, Visit visit) {
  for_each_touching(trajectories, touch, [&](Trajectory<D>& of, uint32_t v) { visit(cut_of(trajectories, of, v)); });
  walls_.held.for_each(touch, [&](uint32_t number) { visit(point_cuts_[number]); });
}

/** Adds rows for touches, which are no longer chosen then: their parts go elsewhere. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::lead_chosen(Array<Trajectory<D>>& trajectories, uint32_t round) {
  size_t left = 0;
  for (const WayTouch<D>& touch : chosen_) {
    const double* goals[D] = {};
    if (touch.other == nullptr) walls_.find_goals(touch, goals);
    if (!rows_.add(trajectories, touch, goals, round)) {
      chosen_[left++] = touch;
      continue;
    }
    for_each_touching(trajectories, touch, [&](Trajectory<D>& of, uint32_t v) {
      cut_of(trajectories, of, v).group = group_;
      of.is_new[v] = 1;
    });
  }
  chosen_.resize(left);
}

/** Lets all vertices of a touch go up to a time before it. The more often their ways were shortened, the longer before. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::shorten_chosen(Array<Trajectory<D>>& trajectories) {
  constexpr uint32_t kMostDoublings = 60;
  for (const WayTouch<D>& touch : chosen_) {
    double step = step_back(touch);
    uint32_t doublings = 0;
    for_each_cut(trajectories, touch, [&](const Cut& cut) { doublings = std::max(doublings, cut.count); });
    for (uint32_t k = 0; k < std::min(doublings, kMostDoublings); ++k) step *= 2;
    for_each_cut(trajectories, touch, [&](Cut& cut) {
      const double time = touch.first.time - step;
      cut.time = cut.is_shortened ? std::min(cut.time, time) : time;
      cut.group = group_;
      cut.is_shortened = true;
    });
  }
  // Only now, as touches of one group may share vertices.
  for (const WayTouch<D>& touch : chosen_) {
    for_each_touching(trajectories, touch, [&](Trajectory<D>& of, uint32_t v) { of.is_new[v] = 1; });
    walls_.held.for_each(touch, [&](uint32_t number) { walls_.held.set_new(number); });
  }
}

template <int D, class Walls>
void ShortenedWays<D, Walls>::set_goals(Array<Trajectory<D>>& trajectories) {
  for (Trajectory<D>& of : trajectories) {
    for (uint32_t v = 0; v < of.is_new.size(); ++v) {
      Cut& cut = cut_of(trajectories, of, v);
      if (!cut.is_shortened) continue;
      ++cut.count;
      cut.is_shortened = false;
      if (cut.time > 0) {
        place_on_way<D>(of.start(v), of.end(v), cut.time, of.goal(v));
      } else {
        std::copy_n(of.start(v), D, of.goal(v));
      }
      std::copy_n(of.goal(v), D, of.end(v));
      rows_.keep_goal(trajectories, of, v);
    }
  }
  for (uint32_t number = 0; number < point_cuts_.size(); ++number) {
    Cut& cut = point_cuts_[number];
    if (!cut.is_shortened) continue;
    ++cut.count;
    cut.is_shortened = false;
    walls_.held.shorten(number, cut.time);
  }
  walls_.finish_round();
  if (!rows_.empty()) {
    rows_.solve(trajectories);
    collect_again(trajectories);
  }
  walls_.cast_paths(trajectories);
}

/** Parts that are led out of where they were collected for are collected again. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::collect_again(Array<Trajectory<D>>& trajectories) {
  const auto leaves = [](const Trajectory<D>& of) {
    for (uint32_t v = 0; v < of.is_new.size(); ++v) {
      if (!of.motion.body->has_vertex(v)) continue;
      const double *const from = of.start(v), *const to = of.reach(v), *const goal = of.goal(v);
      for (int k = 0; k < D; ++k) {
        if (goal[k] < std::min(from[k], to[k]) || goal[k] > std::max(from[k], to[k])) return true;
      }
    }
    return false;
  };
  if (std::none_of(trajectories.begin(), trajectories.end(), leaves)) return;
  for (Trajectory<D>& of : trajectories) of.reaches = of.goals;
  walls_.collect_again(trajectories);
  bodies_.start_again(trajectories);
}

template class ShortenedWays<2, WallWays<2>>;
template class ShortenedWays<3, WallWays<3>>;
template class ShortenedWays<2, MovingWalls<2>>;
template class ShortenedWays<3, MovingWalls<3>>;

}  // namespace dsw
