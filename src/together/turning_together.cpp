// First the exact test says up to when all ways are free, as in turning_move.cpp. Then the bodies go there in steps in which all of their
// vertices go straight, at once: that finds the cells of the vertices, and verifies the rounded places. If a step meets something,
// it is halved: between a chord and its arc something may stand. An environment that moves as well goes along in these steps, and is
// looked at up to where the volumes that the bodies come by stay valid.
//
// Thick bodies keep their distances by hulls where the environment stands (see turning_move.cpp). Where it moves, they keep them at
// every time of a step, by thick_ways.h: from straight ways to straight ways, and as much more as their arcs are beside these.

#include "together/turning_together.h"

#include <algorithm>
#include <cmath>

#include "base/search.h"
#include "base/vec.h"
#include "contact/describe.h"
#include "motion/halving.h"
#include "response/rigid_steps.h"
#include "response/touch_record.h"

namespace dsw {

namespace {

constexpr int kMostStepTries = 400;
constexpr double kStepFromTouch = 0x1p-6, kNoTouchAtAll = 2;

template <int D>
bool has_radius(const Array<Trajectory<D>>& all) noexcept {
  return dsw::any_of(all.begin(), all.end(), [](const Trajectory<D>& each) { return each.motion.body->radius > 0; });
}

}  // namespace

template <int D>
struct TurningTogether<D>::Call {
  Array<RigidTrajectory<D>>& bodies;
  Array<Trajectory<D>>& trajectories;
  bool bodies_meet;
  TogetherSettings settings;
  double least = 1;  // the share of the motion in which no vertex goes further than one unit in the last place
  bool turns = false, is_thick = false;
  int tries = 0;
  double at = 0;
  RoomSteps<D>* room = nullptr;
  double limit = 1;  // up to which part of the motion it is known what happens
  bool stay_valid = true;

  void keep(Array<BodyVertex<D>> RigidTrajectory<D>::*where) {
    for (RigidTrajectory<D>& each : bodies) {
      (each.*where).assign(each.body->vertices.begin(), each.body->vertices.end());
    }
  }
  void put(Array<BodyVertex<D>> RigidTrajectory<D>::*where) {
    for (RigidTrajectory<D>& each : bodies) put_vertices(*each.body, (each.*where).data());
  }
};

/** What is touched first. */
template <int D>
struct TurningTogether<D>::Met {
  // Numbers in the call. The same twice: `touch` says what is touched. None of a body: walls touch what stands.
  size_t body = 0, other = 0;
  RigidTouch<D> touch{};  // of `body`
};

/** Looks at the whole motion; while volumes that are met do not stay valid, at 1/2, 1/4, ... of it. */
template <int D>
FirstTouch TurningTogether<D>::look(Call& call, Met* met, bool* is_open) {
  FirstTouch first = find_first(call, met, is_open);
  Halving halving;
  while (!call.stay_valid) {
    call.room->keep_invalid();
    call.limit = halving.next() ? halving.way : 0;
    if (call.limit == 0) return {false, 1};
    call.stay_valid = true;
    first = find_first(call, met, is_open);
  }
  if (first.touches && first.time > call.limit) first.touches = false;
  if (call.room != nullptr) call.least = std::min(call.least, call.room->least_step());
  return first;
}

template <int D>
FirstTouch TurningTogether<D>::find_first(Call& call, Met* met, bool* is_open) {
  FirstTouch first{false, 1};
  *is_open = false;
  touches_.set_next(call.room == nullptr ? nullptr : call.room->next());
  const double* const reached = call.room == nullptr ? nullptr : call.room->look_to(call.limit);
  for (size_t i = 0; i < call.bodies.size(); ++i) {
    const RigidTrajectory<D>& a = call.bodies[i];
    const double beside = call.room == nullptr ? 0 : a.body->radius;
    const FirstTouch touch = touches_.find_first(*a.body, a.way, a.still, call.limit, reached, beside);
    if (call.room != nullptr && !call.room->stay_valid(touches_.cells(), a.way.unit())) call.stay_valid = false;
    *is_open = *is_open || touches_.is_open_at_start();
    if (touch.touches && (!first.touches || touch.time < first.time)) {
      first = touch;
      *met = {i, i, touches_.touched()};
    }
    for (size_t j = 0; call.bodies_meet && j < i; ++j) {
      const RigidTrajectory<D>& b = call.bodies[j];
      if (!a.body->filter.sees(b.body->filter)) continue;
      first = pairs_.find_first(*a.body, a.way, *b.body, b.way, first);
      if (pairs_.touched() != nullptr) {
        *met = {i, j, {}};
        met->touch.part = pairs_.touched()[0];
        met->touch.other = pairs_.touched()[1];
      }
      *is_open = *is_open || pairs_.touches_at_start();
    }
  }
  if (call.room == nullptr) return first;
  const FirstTouch of_bodies = first;
  if (!call.room->find_first(first)) call.stay_valid = false;
  if (first.time != of_bodies.time || first.touches != of_bodies.touches) *met = {call.bodies.size(), 0, {}};
  return first;
}

/** Whether thick bodies keep their distances on the way to the targets of a step: by hulls, as in turning_move.cpp.
 * @param records whether what is too near then goes to the records. */
template <int D>
bool TurningTogether<D>::keeps_distances(Call& call, double fraction, bool records) {
  const auto targets = [&](size_t i) { return PointArray{call.bodies[i].targets, D}; };
  const auto record = [&](size_t i, const TooNear<D>& near, const dsw_contact_partner& partner) {
    const Body<D>& body = *call.bodies[i].body;
    const uint32_t v = SimplexCorners<D>(body, near.part).vertices[0];
    call.trajectories[i].record->add(describe(env_, body, v, targets(i)[v], near), partner);
  };
  TooNear<D> near;
  for (size_t i = 0; i < call.bodies.size(); ++i) {
    const RigidTrajectory<D>& a = call.bodies[i];
    thick_.bend = a.way.sagitta(fraction - call.at);
    thick_.notes = call.trajectories[i].notes;
    if (!thick_.keeps_motion(a.still, *a.body, targets(i), records ? &near : nullptr)) {
      if (records) record(i, near, partner_of(a.still, near));
      return false;
    }
    for (size_t j = 0; call.bodies_meet && j < i; ++j) {
      const RigidTrajectory<D>& b = call.bodies[j];
      const double radii = a.body->radius + b.body->radius;
      if (!(radii > 0) || !a.body->filter.sees(b.body->filter)) continue;
      const double distance = radii + thick_.bend + b.way.sagitta(fraction - call.at);
      if (thick_.keeps_apart(*a.body, targets(i), *b.body, targets(j), distance, records ? &near : nullptr)) continue;
      if (!records) return false;
      near.partner = 0;  // some body
      record(i, near, name_partner(call.trajectories[j].name, near.other));
      thick_.keeps_apart(*b.body, targets(j), *a.body, targets(i), distance, &near);
      near.partner = 0;
      record(j, near, name_partner(call.trajectories[i].name, near.other));
      return false;
    }
  }
  return true;
}

/** Moves all bodies to a fraction of their motions, or none. What was met is in the records then. */
template <int D>
bool TurningTogether<D>::go_to(Call& call, double fraction, bool records) {
  ++call.tries;
  for (Trajectory<D>& each : call.trajectories) each.record->clear();
  call.keep(&RigidTrajectory<D>::here);
  for (RigidTrajectory<D>& each : call.bodies) {
    for (uint32_t v = 0; v < each.start.size(); ++v) {
      double* const to = each.targets + D * size_t{v};
      std::copy_n(each.start[v].position, D, to);
      if (!each.body->has_vertex(v)) continue;
      each.place(each.user, v, each.start[v].position, fraction, to);
      if (!is_finite<D>(to)) return false;  // a part of a motion can lead further than the whole
    }
  }
  if (call.room != nullptr) return go_with_room(call, fraction, records);
  if (call.is_thick && !keeps_distances(call, fraction, records)) return false;
  steps_.move(call.trajectories, call.bodies_meet, call.settings);
  const bool arrives = dsw::all_of(call.trajectories.begin(), call.trajectories.end(),
                                   [](const Trajectory<D>& each) { return each.record->fraction == 1; });
  if (arrives) {
    call.at = fraction;
  } else {
    call.put(&RigidTrajectory<D>::here);
  }
  return arrives;
}

/** Goes to the targets of a step, which are known, while the environment moves. */
template <int D>
bool TurningTogether<D>::go_with_room(Call& call, double fraction, bool records) {
  for (size_t i = 0; call.is_thick && i < call.bodies.size(); ++i) {
    const RigidWay<D>& way = call.bodies[i].way;
    call.trajectories[i].bend = {way.sagitta(fraction - call.at) * (1 + 0x1p-40), way.axis()};
  }
  const bool goes = call.room->go_to(call.trajectories, fraction, call.bodies_meet, call.settings, records);
  if (goes) call.at = fraction;
  return goes;
}

/** Goes as far as it can, or to an end just before `touch`. Returns whether it has come there. */
template <int D>
bool TurningTogether<D>::go(Call& call, double touch, double most_step) {
  struct Steps {
    TurningTogether& move;
    Call& call;
    double& at = call.at;
    int& tries = call.tries;
    bool go_to(double fraction) { return move.go_to(call, fraction); }
    bool go_beside(double) { return false; }
  };
  Steps steps{*this, call};
  RigidSteps<Steps> along{steps, call.least, call.least == RigidWay<D>::kLeastStep, kMostStepTries, call.limit};
  // Finer steps are below what distances of thick bodies may lose.
  if (call.is_thick) along.shortest = 0x1p-44;
  return along.go(touch, most_step);
}

/** Keeps contacts of what is touched first, with the bodies where they are. */
template <int D>
void TurningTogether<D>::record_met(Call& call, Met& met) {
  if (met.body == call.bodies.size()) return call.room->keep_standing();
  const auto record = [&](size_t i, const RigidTouch<D>& touch, const Partner<D>* other) {
    record_touch(env_, *call.bodies[i].body, call.bodies[i].way, touch, other, *call.trajectories[i].record);
  };
  const uint32_t still = met.touch.partner;
  if (met.body == met.other) {
    for (uint32_t i = 0; still == kNone && i < met.touch.count; ++i) {
      met.touch.points[i] = env_.point(met.touch.vertices[i]);  // where it is now
    }
    record(met.body, met.touch, still == kNone ? nullptr : &call.bodies[met.body].still->all[still]);
    if (still == kNone && call.room != nullptr) {
      call.room->keep_wall(call.trajectories[met.body], met.touch.part, met.touch.vertices, met.touch.count);
    }
    return;
  }
  const auto record_one = [&](size_t i, const Simplex& part, size_t j, const Simplex& other) {
    RigidTouch<D> touch;
    touch.part = part;
    touch.other = other;
    touch.partner = 0;  // some body
    for (const uint32_t v : SimplexCorners<D>(*call.bodies[j].body, other)) {
      touch.points[touch.count++] = call.bodies[j].body->position(v);
    }
    record(i, touch, &call.trajectories[j].name);
  };
  record_one(met.body, met.touch.part, met.other, met.touch.other);
  record_one(met.other, met.touch.other, met.body, met.touch.part);
}

/** Tries to go on, and keeps what stops it. Where nothing does, all are taken back, and what is touched first is kept. */
template <int D>
void TurningTogether<D>::record_contacts(Call& call, double touch, Met& met) {
  const double at = call.at;
  call.keep(&RigidTrajectory<D>::before);
  for (double further = 16 * call.least;; further *= 64) {
    const double next = std::min(call.limit, std::max(at, touch <= 1 ? touch : at) + further);
    if (!go_to(call, next, true)) break;
    call.put(&RigidTrajectory<D>::before);
    if (call.room != nullptr) call.room->take_back(call.trajectories);
    call.at = at;
    if (next == call.limit) break;
  }
  const bool is_known = (call.room != nullptr && !call.room->contacts.empty()) ||
                        dsw::any_of(call.trajectories.begin(), call.trajectories.end(),
                                    [](const Trajectory<D>& each) { return !each.record->contacts.empty(); });
  if (!is_known && touch <= 1) record_met(call, met);
  for (size_t i = 0; i < call.bodies.size(); ++i) {
    const RigidTrajectory<D>& of = call.bodies[i];
    for (dsw_body_contact& contact : call.trajectories[i].record->contacts) {
      const uint32_t v = contact.vertex.index;
      double target[D];
      of.place(of.user, v, of.start[v].position, 1, target);
      contact.time = touch <= 1 ? touch : at;
      contact.distance_left = length(difference<D>(target, of.body->position(v)));
    }
  }
}

/** The longest step. With an environment that moves, the way of a thick body bends by no more than a radius beside a chord. */
template <int D>
double TurningTogether<D>::most_step(const Call& call, bool is_open) const noexcept {
  double step = call.turns && is_open ? kStepFromTouch : 1;
  for (const RigidTrajectory<D>& each : call.bodies) {
    const double radius = each.body->radius;
    while (call.room != nullptr && radius > 0 && each.way.sagitta(step) > radius) step *= 0.5;
  }
  return step;
}

template <int D>
double TurningTogether<D>::move(Array<RigidTrajectory<D>>& bodies, Array<Trajectory<D>>& trajectories, bool bodies_meet,
                                const TogetherSettings& settings, RoomSteps<D>* room) {
  Call call{bodies, trajectories, bodies_meet, settings};
  call.room = room;
  call.settings.stop = TogetherStop::kAll;
  call.keep(&RigidTrajectory<D>::start);
  for (RigidTrajectory<D>& each : bodies) {
    each.way.start(*each.body, *each.motion);
    call.least = std::min(call.least, each.way.least_step());
    call.turns = call.turns || each.way.turns();
    call.is_thick = call.is_thick || ThickSweep<D>::is_thick(each.still, *each.body);
  }
  if (room != nullptr && has_radius(room->standing)) call.is_thick = true;
  Met met;
  bool is_open = false;
  const FirstTouch first = look(call, &met, &is_open);
  if (room != nullptr) room->join(trajectories);
  double touch = first.touches ? first.time : kNoTouchAtAll;
  // What stops them much earlier is something that touched at the start, or the next touch is not known.
  if (!go(call, touch, most_step(call, is_open)) && touch - call.at > 0x1p-20) touch = kNoTouchAtAll;
  if (call.at < call.limit) record_contacts(call, touch, met);
  for (size_t i = 0; i < bodies.size(); ++i) {
    MoveRecord& record = *trajectories[i].record;
    if (call.at == call.limit) record.contacts.clear(), record.partners.clear(), record.previous.clear();
    record.fraction = call.at;
    record.moved = static_cast<uint32_t>(bodies[i].body->vertex_slots.alive_count());
    record.stopped = call.at == 1 ? 0 : record.moved;
  }
  if (room != nullptr) room->set_time(touch <= 1 ? touch : call.at);
  return call.at;
}

template class TurningTogether<2>;
template class TurningTogether<3>;

}  // namespace dsw
