#include "together/together_move.h"

#include <algorithm>
#include <tuple>

#include "base/vec.h"
#include "together/describe.h"
#include "walk/retreat.h"

namespace dsw {
template <int D>
void TogetherMove<D>::move(Array<Traveller<D>>& travellers, bool bodies_meet, const TogetherSettings& settings) {
  start(travellers, bodies_meet);
  constexpr uint32_t kMostDepartures = 8;
  double gone = 0;  // of the whole way
  Round round = Round::kDeparted;
  for (uint32_t departures = 0; round == Round::kDeparted; ++departures) {
    const bool may_depart = departures < kMostDepartures;
    round = settings.stop == TogetherStop::kFeature ? shorten_ways(travellers, settings.rounds, may_depart)
                                                    : run_round(travellers, may_depart);
    if (round != Round::kArrived) gone += (1 - gone) * time_;
  }
  for (Traveller<D>& of : travellers) of.record->fraction = round == Round::kArrived ? 1 : gone;
  for (Traveller<D>& of : travellers) {
    const Body<D>& body = *of.body;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      ++of.record->moved;
      of.record->stopped += std::equal(of.start(v), of.start(v) + D, of.targets[v]) ? 0 : 1;
    }
    for (dsw_body_contact& contact : of.record->contacts) {
      contact.distance_left = length(difference<D>(of.targets[contact.vertex.index], body.position(contact.vertex.index)));
    }
  }
  travellers[0].record->sweeps = walls_.counts;
}

template <int D>
void TogetherMove<D>::start(Array<Traveller<D>>& travellers, bool bodies_meet) {
  for (Traveller<D>& of : travellers) {
    const size_t count = of.body->vertices.size();
    of.ends.resize(count * D);
    of.arrivals.assign(count, Cell{});
    of.crossed.assign(count, PathFacets{});
    of.limits.assign(count, 1);
    of.is_new.assign(count, 1);
    of.goals.resize(count * D);
    for (uint32_t v = 0; v < count; ++v) {
      if (of.body->has_vertex(v)) std::copy_n(of.targets[v], D, of.goal(v));
    }
  }
  walls_.start(travellers);
  walls_.limits_parts = false;
  bodies_.start(travellers, bodies_meet);
}

/** Goes on as far as nothing is touched. */
template <int D>
typename TogetherMove<D>::Round TogetherMove<D>::run_round(Array<Traveller<D>>& travellers, bool may_depart) {
  set_ends(travellers, 1);
  walls_.cast_paths(travellers);
  first_.all.clear();
  walls_.find_first(travellers, first_);
  bodies_.find_first(travellers, first_);
  if (first_.all.empty()) {
    arrive(travellers);
    return Round::kArrived;
  }
  drop_covering(travellers);
  if (may_depart && departs(travellers)) {
    arrive(travellers);
    return Round::kDeparted;
  }
  describe_touches(env_, travellers, first_.all);
  retreat(travellers);
  arrive(travellers);
  return Round::kStopped;
}

/** Goes as far as nothing is touched, each vertex for itself. */
template <int D>
typename TogetherMove<D>::Round TogetherMove<D>::shorten_ways(Array<Traveller<D>>& travellers, uint32_t most_rounds,
                                                              bool may_depart) {
  using End = typename ShortenedWays<D>::End;
  walls_.limits_parts = true;
  const auto look_at_all = [&] {
    for (Traveller<D>& of : travellers) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{1});
    set_ends(travellers, 1);
    walls_.cast_paths(travellers);
  };
  look_at_all();
  End end = shortened_.run(travellers, most_rounds, may_depart);
  if (end == End::kAtWalls) {
    first_.all.clear();
    for (const WayTouch<D>& each : shortened_.touches()) {
      if (each.first.time == 0) first_.all.push_back(each);
    }
    walls_.limits_parts = false;
    const bool has_departed = departs(travellers);
    walls_.limits_parts = true;
    if (has_departed) {
      arrive(travellers);
      return Round::kDeparted;
    }
    look_at_all();
    end = shortened_.run(travellers, most_rounds, false);
  }
  walls_.limits_parts = false;
  const bool is_free = end == End::kFree;
  for (Traveller<D>& of : travellers) std::fill(of.is_new.begin(), of.is_new.end(), uint8_t{1});
  if (!is_free) {
    run_round(travellers, false);
    time_ = std::min(time_, shortened_.first_time());
    return Round::kStopped;
  }
  time_ = shortened_.first_time();
  arrive(travellers);
  return shortened_.has_shortened() ? Round::kStopped : Round::kArrived;
}

/** What touches a wall at the start may be free under the shift, and stay so for a part of its way. Then all go that
 * part: what is touched after that is another round's. Whether they do. */
template <int D>
bool TogetherMove<D>::departs(Array<Traveller<D>>& travellers) {
  constexpr int kMostHalvings = 10;
  const bool starts_at_walls = std::all_of(first_.all.begin(), first_.all.end(), [](const WayTouch<D>& each) {
    return each.first.time == 0 && each.other == nullptr && each.part.kind != Simplex::kVertex;
  });
  time_ = 1;
  for (int k = 0; starts_at_walls && k < kMostHalvings; ++k) {
    time_ /= 2;
    set_ends(travellers, time_);
    walls_.cast_paths(travellers);
    if (walls_.is_free(travellers) && bodies_.is_free(travellers)) return true;
  }
  set_ends(travellers, 1);
  return false;
}

/** Of what touches the environment, drops edges and faces with a corner or a side that touches it at the same time. These
 * may go on as soon as that corner has stopped. If they touch something else, too, the next round finds that. */
template <int D>
void TogetherMove<D>::drop_covering(const Array<Traveller<D>>& travellers) {
  using Name = std::tuple<uint32_t, uint32_t, uint32_t>;
  const auto name = [](uint32_t traveller, Simplex::Kind kind, uint32_t index) {
    return Name(traveller, static_cast<uint32_t>(kind), index);
  };
  Array<Name> names(env_.memory);
  for (const WayTouch<D>& each : first_.all) {
    if (each.other == nullptr) names.push_back(name(each.traveller, each.part.kind, each.part.index));
  }
  std::sort(names.begin(), names.end());
  const auto touches = [&](uint32_t traveller, Simplex::Kind kind, uint32_t index) {
    return std::binary_search(names.begin(), names.end(), name(traveller, kind, index));
  };
  const auto covers = [&](const WayTouch<D>& each) {
    if (each.other != nullptr || each.part.kind == Simplex::kVertex) return false;
    const Body<D>& body = *travellers[each.traveller].body;
    const SimplexCorners<D> corners(body, each.part);
    for (uint32_t i = 0; i < corners.count; ++i) {
      const uint32_t v = corners.vertices[i], w = corners.vertices[(i + 1) % corners.count];
      if (touches(each.traveller, Simplex::kVertex, v)) return true;
      if (corners.count == 3 && touches(each.traveller, Simplex::kEdge, find_edge(body, v, w))) return true;
    }
    return false;
  };
  first_.all.erase(std::remove_if(first_.all.begin(), first_.all.end(), covers), first_.all.end());
}

/** The ends of all ways come nearer, until nothing is touched. The steps depend on no order of vertices. */
template <int D>
void TogetherMove<D>::retreat(Array<Traveller<D>>& travellers) {
  const double time = first_.all[0].first.time;
  double step = 0;
  for (const WayTouch<D>& touch : first_.all) {
    for_each_touching(travellers, touch, [&](Traveller<D>& of, uint32_t v) {
      if (of.moves(v)) step = std::max(step, first_step<D>(of.start(v), of.end(v), time));
    });
  }
  constexpr int kMostTries = 60;
  for (int tries = 0; tries < kMostTries && step < time; ++tries, step *= 2) {
    time_ = time - step;
    set_ends(travellers, time_);
    if (is_free(travellers)) return;
  }
  time_ = 0;
  set_ends(travellers, 0);
  walls_.cast_paths(travellers);
}

/** Whether nothing is touched on the ways to the ends. What was touched has to stay apart even without the shift. So a
 * vertex does not come to lie exactly on a wall, where it would touch that wall at the start of the next way. */
template <int D>
bool TogetherMove<D>::is_free(Array<Traveller<D>>& travellers) {
  const auto touches = [](const WayTouch<D>& each) { return first_touch(each.pair).touches; };
  if (std::any_of(first_.all.begin(), first_.all.end(), touches)) return false;
  walls_.cast_paths(travellers);
  return walls_.is_free(travellers) && bodies_.is_free(travellers);
}

template <int D>
void TogetherMove<D>::set_ends(Array<Traveller<D>>& travellers, double time) {
  for (Traveller<D>& of : travellers) {
    for (uint32_t v = 0; v < of.body->vertices.size(); ++v) {
      if (!of.body->has_vertex(v)) continue;
      const double *const from = of.start(v), *const to = of.goal(v);
      if (time == 0 || time == 1) {
        std::copy_n(time == 0 ? from : to, D, of.end(v));
      } else {
        place_on_way<D>(from, to, time, of.end(v));
      }
    }
  }
}

template <int D>
void TogetherMove<D>::arrive(Array<Traveller<D>>& travellers) {
  for (Traveller<D>& of : travellers) {
    for (uint32_t v = 0; v < of.body->vertices.size(); ++v) {
      if (of.body->has_vertex(v) && of.moves(v)) put_vertex(*of.body, v, of.end(v), of.arrivals[v]);
    }
  }
}

template class TogetherMove<2>;
template class TogetherMove<3>;

}  // namespace dsw
