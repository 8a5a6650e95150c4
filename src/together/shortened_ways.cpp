// All vertices go at once and steadily, at all times of this search. A vertex that touches something gets a new goal: the
// place on its way just before the touch. Then the ways of all parts at it are others, and are looked at again. What is
// left at the end is one steady motion to the goals, which touches nothing.
//
// The touches of a round are taken in the order of time. One is passed over if a vertex of it has got a new goal by an
// earlier one, since its way is another then. At the same time vertices come before edges, and these before faces. So an
// edge that touches with its end stops at that end alone.

#include "together/shortened_ways.h"

#include <algorithm>
#include <cmath>

#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "predicates/filtered.h"
#include "together/moving_walls.h"
#include "together/wall_ways.h"

namespace dsw {
namespace {

template <int D>
double time_of(const WayTouch<D>& touch) {
  return touch.first.time;
}
template <int D>
double time_of(const TooNearOnWay<D>& near) {
  return near.time;
}

/** Touches with the same key are taken together. Times are those that are reported. */
template <int D>
std::tuple<double, uint32_t> key_of(const WayTouch<D>& touch) {
  return {touch.first.time, touch.other == nullptr ? static_cast<uint32_t>(touch.part.kind) : 0};
}
template <int D>
std::tuple<double, uint32_t> key_of(const TooNearOnWay<D>& near) {
  return {near.time, 0};
}

template <class Touch>
void sort_by_time(Array<Touch>& touches) {
  dsw::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
    return std::make_tuple(key_of(a), name_of(a)) < std::make_tuple(key_of(b), name_of(b));
  });
}

template <int D>
void describe_found(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& touches) {
  describe_touches(env, trajectories, touches);
}
template <int D>
void describe_found(const Environment<D>& env, Array<Trajectory<D>>& trajectories, Array<TooNearOnWay<D>>& touches) {
  describe_too_near(env, trajectories, touches);
}

}  // namespace

template <int D, class Walls>
typename ShortenedWays<D, Walls>::End ShortenedWays<D, Walls>::run(Array<Trajectory<D>>& trajectories,
                                                                   const TogetherSettings& settings,
                                                                   bool may_end_at_walls) {
  names_.clear();
  watched_.clear();
  cuts_.clear();
  point_cuts_.clear();
  group_ = 0;
  first_time_ = 1;
  for (const Trajectory<D>& of : trajectories) cuts_.emplace_back(of.is_new.size(), Cut{}, env_.memory);
  walls_.held.look_at_all();
  leads_ = settings.response != TogetherResponse::kStop;
  if (leads_) rows_.start(trajectories, settings.response == TogetherResponse::kCarry);
  for (uint32_t round = 0; round < settings.rounds; ++round) {
    find_touches(trajectories);
    if (touched_.all.empty() && near_.all.empty()) return End::kFree;
    if (round == 0) {
      if (!touched_.all.empty()) first_time_ = time_of(touched_.all[0]);
      if (!near_.all.empty()) first_time_ = std::min(first_time_, time_of(near_.all[0]));
      if (may_end_at_walls && starts_at_walls()) return End::kAtWalls;
    }
    for (Trajectory<D>& of : trajectories) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{0});
    walls_.start_round();
    // What is led elsewhere may touch again and again: in the last rounds it stops.
    const bool may_lead = leads_ && round < settings.rounds - settings.rounds / 4;
    const uint32_t before = group_;
    // What keeps a distance comes too near before it touches.
    take(near_, trajectories, before, round, may_lead);
    take(touched_, trajectories, before, round, may_lead);
    set_goals(trajectories);
  }
  return End::kRoundsOver;
}

/** Takes what was found in groups, and lets its vertices go elsewhere, or a part of their ways.
 * @param before the last group of the rounds before. */
template <int D, class Walls>
template <class Touch>
void ShortenedWays<D, Walls>::take(Found<Touch>& found, Array<Trajectory<D>>& trajectories, uint32_t before,
                                   uint32_t round, bool may_lead) {
  for (size_t first = 0, end; first < found.all.size(); first = end) {
    for (end = first + 1; end < found.all.size() && key_of(found.all[end]) == key_of(found.all[first]);) ++end;
    found.chosen.clear();
    for (size_t i = first; i < end; ++i) {
      bool is_changed = false;
      for_each_cut(trajectories, found.all[i], [&](const Cut& cut) { is_changed = is_changed || cut.group > before; });
      if (!is_changed) {
        found.chosen.push_back(found.all[i]);
        continue;
      }
      // What is passed over is looked at again: one of its vertices has a new goal. Its parts may touch something else later, which
      // was not told, and which has no new goal itself.
      for_each_touching(trajectories, found.all[i], [](Trajectory<D>& of, uint32_t v) { of.is_new[v] = 1; });
    }
    describe_chosen(found, trajectories);
    ++group_;
    if (may_lead) lead_chosen(found, trajectories, round);
    shorten_chosen(found, trajectories);
  }
}

/** Finds all touches that are new, and sorts them by time. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::find_touches(const Array<Trajectory<D>>& trajectories) {
  touched_.all.clear();
  near_.all.clear();
  if (thick_.is_needed()) {
    thick_.set_wall_ends(walls_);
    thick_.find_all(trajectories, walls_.held, near_.all);
    sort_by_time(near_.all);
  }
  walls_.find_all(trajectories, touched_.all);
  bodies_.find_all(trajectories, touched_.all);
  // A vertex that was stopped by a wall does not come to lie exactly on it, where it would touch it in the next call.
  for (const WayTouch<D>& each : watched_) {
    const Trajectory<D>& of = trajectories[each.trajectory];
    if (of.is_new[each.part.index] == 0 || !of.motion.ways[each.part.index].arrival.valid()) continue;
    WayTouch<D> again = each;
    walls_.find_goals(each, again.pair.end + 1);  // which may lie elsewhere since then
    if (orient<D>(again.pair.end + 1, of.end(each.part.index)) != 0) continue;
    again.first = {true, 1};
    if (of.moves(each.part.index)) touched_.all.push_back(again);
  }
  sort_by_time(touched_.all);
}

/** Whether all that is touched at time 0 are walls, by edges and faces. */
template <int D, class Walls>
bool ShortenedWays<D, Walls>::starts_at_walls() const {
  bool any = false;
  for (const WayTouch<D>& each : touched_.all) {
    if (each.first.time > 0) break;
    if (each.other != nullptr || each.part.kind == Simplex::kVertex) return false;
    any = true;
  }
  return any;
}

/** Adds those to the records that are not there. */
template <int D, class Walls>
template <class Touch>
void ShortenedWays<D, Walls>::describe_chosen(Found<Touch>& found, Array<Trajectory<D>>& trajectories) {
  found.told.clear();
  for (const Touch& each : found.chosen) {
    const PairName name = pair_name_of(each);
    const auto at = std::lower_bound(names_.begin(), names_.end(), name);
    if (at != names_.end() && *at == name) continue;
    names_.insert(at, name);
    found.told.push_back(each);
    watch(each);
  }
  describe_found(env_, trajectories, found.told);
  walls_.describe(trajectories, found.told);
}

template <int D, class Walls>
template <class Touch, class Visit>
void ShortenedWays<D, Walls>::for_each_cut(Array<Trajectory<D>>& trajectories, const Touch& touch, Visit visit) {
  for_each_touching(trajectories, touch, [&](Trajectory<D>& of, uint32_t v) { visit(cut_of(trajectories, of, v)); });
  walls_.held.for_each(touch, [&](uint32_t number) {
    if (number >= point_cuts_.size()) point_cuts_.resize(number + size_t{1});
    visit(point_cuts_[number]);
  });
}

/** Adds rows for touches, which are no longer chosen then: their parts go elsewhere. */
template <int D, class Walls>
template <class Touch>
void ShortenedWays<D, Walls>::lead_chosen(Found<Touch>& found, Array<Trajectory<D>>& trajectories, uint32_t round) {
  size_t left = 0;
  for (const Touch& touch : found.chosen) {
    const double* goals[3] = {};
    if (touch.other == nullptr) walls_.find_goals(touch, goals);
    if (!rows_.add(trajectories, touch, goals, round)) {
      found.chosen[left++] = touch;
      continue;
    }
    for_each_touching(trajectories, touch, [&](Trajectory<D>& of, uint32_t v) {
      cut_of(trajectories, of, v).group = group_;
      of.is_new[v] = 1;
    });
  }
  found.chosen.resize(left);
}

/** Lets all vertices of a touch go up to a time before it. The more often their ways were shortened, the longer before. */
template <int D, class Walls>
template <class Touch>
void ShortenedWays<D, Walls>::shorten_chosen(const Found<Touch>& found, Array<Trajectory<D>>& trajectories) {
  constexpr uint32_t kMostDoublings = 60;
  for (const Touch& touch : found.chosen) {
    double step = step_back(touch);
    uint32_t doublings = 0;
    for_each_cut(trajectories, touch, [&](const Cut& cut) { doublings = std::max(doublings, cut.count); });
    for (uint32_t k = 0; k < std::min(doublings, kMostDoublings); ++k) step *= 2;
    for_each_cut(trajectories, touch, [&](Cut& cut) {
      const double time = time_of(touch) - step;
      cut.time = cut.is_shortened ? std::min(cut.time, time) : time;
      cut.group = group_;
      cut.is_shortened = true;
    });
  }
  // Only now, as touches of one group may share vertices.
  for (const Touch& touch : found.chosen) {
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
      if (leads_) rows_.keep_goal(trajectories, of, v);
    }
  }
  const auto is_shortened = [](const Cut& cut) { return cut.is_shortened; };
  if (dsw::any_of(point_cuts_.begin(), point_cuts_.end(), is_shortened)) walls_.tighten(trajectories);
  for (uint32_t number = 0; number < point_cuts_.size(); ++number) {
    Cut& cut = point_cuts_[number];
    if (!cut.is_shortened) continue;
    ++cut.count;
    cut.is_shortened = false;
    walls_.held.shorten(number, cut.time);
  }
  walls_.finish_round();
  if (leads_ && !rows_.empty()) {
    rows_.solve(trajectories);
    collect_again(trajectories);
  }
  walls_.cast_paths(trajectories);
}

/** Whether a place is beside the straight way between two points by more than what rounding does. What was collected for a
 * way lies along it: rows lead aside, also within the box of the way. True where the numbers are too large or too small. */
template <int D>
bool is_beside(const double* from, const double* to, const double* place) noexcept {
  if (is_same_place<D>(place, to) || is_same_place<D>(place, from)) return false;
  double along = 0, length = 0;
  for (int k = 0; k < D; ++k) {
    along += (place[k] - from[k]) * (to[k] - from[k]);
    length += (to[k] - from[k]) * (to[k] - from[k]);
  }
  const double part = along / length, room = 0x1p-50 * std::max(largest_coordinate<D>(from), largest_coordinate<D>(to));
  if (!(part >= 0 && part <= 1)) return true;
  for (int k = 0; k < D; ++k) {
    if (!(std::fabs(from[k] + part * (to[k] - from[k]) - place[k]) <= room)) return true;
  }
  return false;
}

/** Parts that are led out of where they were collected for are collected again. */
template <int D, class Walls>
void ShortenedWays<D, Walls>::collect_again(Array<Trajectory<D>>& trajectories) {
  const auto leaves = [](const Trajectory<D>& of) {
    for (uint32_t v = 0; v < of.is_new.size(); ++v) {
      if (!of.motion.body->has_vertex(v)) continue;
      if (is_beside<D>(of.start(v), of.reach(v), of.goal(v))) return true;
    }
    return false;
  };
  if (dsw::none_of(trajectories.begin(), trajectories.end(), leaves)) return;
  for (Trajectory<D>& of : trajectories) {
    of.reaches = of.goals;
    of.renew_rooms();
  }
  walls_.collect_again(trajectories);
  bodies_.start_again(trajectories);
  thick_.start_again(trajectories);
}

template class ShortenedWays<2, WallWays<2>>;
template class ShortenedWays<3, WallWays<3>>;
template class ShortenedWays<2, MovingWalls<2>>;
template class ShortenedWays<3, MovingWalls<3>>;

}  // namespace dsw
