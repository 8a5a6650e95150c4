#include "together/whole_ways.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "base/vec.h"
#include "motion/place_on_way.h"
#include "together/describe.h"
#include "together/moving_walls.h"
#include "together/wall_ways.h"

namespace dsw {

namespace {

template <int D>
const OuterWalls* walls_found(const WallWays<D>&) noexcept {
  return nullptr;
}
template <int D>
const OuterWalls* walls_found(const MovingWalls<D>& walls) noexcept {
  return &walls.near_outers;
}

/** Gives vertices that rows lead some room beside their ways. Rows lead no vertex farther than some times the longest way, and mostly
 * much less far; what is small beside a part costs little. */
template <int D>
void set_rooms(Array<Trajectory<D>>& trajectories) {
  constexpr double kShare = 0.125;  // of the longest way and the sizes
  if (dsw::none_of(trajectories.begin(), trajectories.end(), [](const Trajectory<D>& of) { return of.is_led; })) return;
  double way = 0;
  for (const Trajectory<D>& of : trajectories) {
    for (uint32_t v = 0; v < of.is_new.size(); ++v) {
      if (of.motion.body->has_vertex(v)) way = std::max(way, largest(difference<D>(of.motion.targets[v], of.start(v))));
    }
  }
  for (Trajectory<D>& of : trajectories) {
    if (!of.is_led) continue;
    const Body<D>& body = *of.motion.body;
    double size = body.radius;
    for (uint32_t e = 0; e < body.edges.size(); ++e) {
      const uint32_t* const ends = body.edges[e].ends;
      if (body.has_edge(e)) size = std::max(size, largest(difference<D>(of.start(ends[0]), of.start(ends[1]))));
    }
    const double room = std::min(kMostLed * way, kShare * (way + size));
    of.set_rooms(std::isfinite(room) ? room : 0);
  }
}

}  // namespace

template <int D, class Walls>
void WholeWays<D, Walls>::start(Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* drift) {
  meets_walls = drift == nullptr || !walls.are_alone(trajectories);
  for (Trajectory<D>& of : trajectories) {
    of.motion.start(*of.motion.body, of.motion.targets, meets_walls && Walls::notes_paths(*of.motion.body));
    const size_t count = of.motion.body->vertices.size();
    of.ends.resize(count * D);
    of.reaches.clear();
    of.record->ways_left.reserve(of.stands ? 0 : D * count);
    of.limits.assign(count, 1);
    of.is_new.assign(count, 1);
    of.goals.resize(count * D);
    for (uint32_t v = 0; v < count; ++v) {
      if (!of.motion.body->has_vertex(v)) continue;
      for (int k = 0; k < D; ++k) of.goal(v)[k] = of.motion.targets[v][k];
    }
  }
  set_rooms(trajectories);
  if (meets_walls) walls.start(trajectories);
  bodies.start(trajectories, bodies_meet, drift);
  thick.start(trajectories, bodies_meet, walls_found(walls));
}

template <int D, class Walls>
bool WholeWays<D, Walls>::find_touches(Array<Trajectory<D>>& trajectories) {
  set_ends(trajectories, 1);
  walls.cast_paths(trajectories);
  first.clear();
  walls.find_first(trajectories, first);
  bodies.find_first(trajectories, first);
  const double touched = first.empty() ? 1 : first[0].first.time;
  if (find_too_near(trajectories, touched) < touched) first.clear();
  if (!first.empty()) drop_covering(trajectories);
  return !first.empty() || touched_too_near();
}

template <int D, class Walls>
void WholeWays<D, Walls>::describe(Array<Trajectory<D>>& trajectories) {
  if (touched_too_near()) {
    describe_too_near(env_, trajectories, thick.first);
    walls.describe(trajectories, thick.first);
  } else {
    describe_touches(env_, trajectories, first);
    walls.describe(trajectories, first);
  }
}

template <int D, class Walls>
void WholeWays<D, Walls>::stop(Array<Trajectory<D>>& trajectories) {
  double step = 0;
  describe(trajectories);
  if (touched_too_near()) {
    const double time = thick.first[0].time;
    for (const TooNearOnWay<D>& near : thick.first) {
      for_each_touching(trajectories, near, [&](const Trajectory<D>& of, uint32_t v) {
        if (of.moves(v)) step = std::max(step, first_step<D>(of.start(v), of.end(v), time));
      });
    }
    return retreat(trajectories, time, step > 0 ? step : 0x1p-52);
  }
  for (const WayTouch<D>& touch : first) step = std::max(step, step_back(touch));
  retreat(trajectories, first[0].first.time, step);
}

template <int D, class Walls>
bool WholeWays<D, Walls>::is_free(Array<Trajectory<D>>& trajectories) {
  walls.cast_paths(trajectories);
  return walls.is_free(trajectories) && bodies.is_free(trajectories) && find_too_near(trajectories, 1) == 1;
}

/** Drops those touches of the environment by edges and faces of which a corner or a side touches it at the same time.
 * Such edges and faces may go on as soon as that corner has stopped. If they touch something else, too, the next round
 * finds that. */
template <int D, class Walls>
void WholeWays<D, Walls>::drop_covering(const Array<Trajectory<D>>& trajectories) {
  using Name = std::tuple<uint32_t, uint32_t, uint32_t>;
  const auto name = [](uint32_t trajectory, Simplex::Kind kind, uint32_t index) {
    return Name(trajectory, static_cast<uint32_t>(kind), index);
  };
  Array<Name> names(env_.memory);
  for (const WayTouch<D>& each : first) {
    if (each.other == nullptr) names.push_back(name(each.trajectory, each.part.kind, each.part.index));
  }
  dsw::sort(names.begin(), names.end());
  const auto touches = [&](uint32_t trajectory, Simplex::Kind kind, uint32_t index) {
    return std::binary_search(names.begin(), names.end(), name(trajectory, kind, index));
  };
  const auto covers = [&](const WayTouch<D>& each) {
    if (each.other != nullptr || each.part.kind == Simplex::kVertex) return false;
    const Body<D>& body = *trajectories[each.trajectory].motion.body;
    const SimplexCorners<D> corners(body, each.part);
    for (uint32_t i = 0; i < corners.count; ++i) {
      const uint32_t v = corners.vertices[i], w = corners.vertices[(i + 1) % corners.count];
      if (touches(each.trajectory, Simplex::kVertex, v)) return true;
      if (corners.count == 3 && touches(each.trajectory, Simplex::kEdge, find_edge(body, v, w))) return true;
    }
    return false;
  };
  first.erase(std::remove_if(first.begin(), first.end(), covers), first.end());
}

/** The ends of all ways come nearer, until nothing is touched. The steps depend on no order of vertices. */
template <int D, class Walls>
void WholeWays<D, Walls>::retreat(Array<Trajectory<D>>& trajectories, double time, double step) {
  constexpr int kMostTries = 60;
  // What was touched has to stay apart even without the shift. So a vertex does not come to lie exactly on a wall, where it
  // would touch that wall at the start of the next way.
  const auto touches = [&](const WayTouch<D>& each) { return first_touch(each.pair, &work_).touches; };
  for (int tries = 0; tries < kMostTries && step < time; ++tries, step *= 2) {
    set_ends(trajectories, time - step);
    if (dsw::any_of(first.begin(), first.end(), touches)) continue;
    if (is_free(trajectories)) return;
  }
  set_ends(trajectories, 0);
  walls.cast_paths(trajectories);
}

template <int D, class Walls>
void WholeWays<D, Walls>::set_ends(Array<Trajectory<D>>& trajectories, double time) {
  time_ = time;
  walls.set_end(time);
  for (Trajectory<D>& of : trajectories) {
    if (time == 1) {
      std::copy(of.goals.begin(), of.goals.end(), of.ends.begin());
      continue;
    }
    for (uint32_t v = 0; v < of.motion.body->vertices.size(); ++v) {
      if (of.motion.body->has_vertex(v)) place_on_way<D>(of.start(v), of.goal(v), time, of.end(v));
    }
  }
}

template <int D, class Walls>
void WholeWays<D, Walls>::arrive(Array<Trajectory<D>>& trajectories) {
  for (Trajectory<D>& of : trajectories) {
    for (uint32_t v = 0; v < of.motion.body->vertices.size(); ++v) {
      if (!of.motion.body->has_vertex(v)) continue;
      if (of.moves(v) || of.motion.ways[v].arrival != of.motion.body->vertices[v].cell) of.motion.arrive(v, of.end(v));
    }
  }
}

template <int D, class Walls>
void WholeWays<D, Walls>::finish(Array<Trajectory<D>>& trajectories) {
  for (Trajectory<D>& of : trajectories) {
    const Body<D>& body = *of.motion.body;
    of.record->ways_left.assign(of.stands ? 0 : D * body.vertices.size(), 0.0);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      for (size_t k = 0; !of.stands && k < D; ++k) {
        of.record->ways_left[D * v + k] = of.motion.targets[v][k] - body.position(v)[k];
      }
      ++of.record->moved;
      of.record->stopped += is_same_place<D>(of.start(v), of.motion.targets[v]) ? 0 : 1;
    }
    for (dsw_body_contact& contact : of.record->contacts) {
      const uint32_t v = contact.vertex.index;
      contact.distance_left = length(difference<D>(of.motion.targets[v], body.position(v)));
    }
  }
  trajectories[0].record->sweeps = walls.counts;
}

template class WholeWays<2, WallWays<2>>;
template class WholeWays<3, WallWays<3>>;
template class WholeWays<2, MovingWalls<2>>;
template class WholeWays<3, MovingWalls<3>>;

}  // namespace dsw
