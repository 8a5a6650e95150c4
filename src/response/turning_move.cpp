// First the exact test says up to when the rigid way is free. Then the body goes there along chords, its vertices one after
// the other, as in any move: that finds the cells of its vertices, and verifies the rounded places. If a chord meets something, it
// is halved: between the chord and the arc something may stand.
//
// For a few ties at the start the exact test does not know what follows. They are left to the chords, which are short
// then. Thick bodies keep their distance along each chord, with as much more as the way bends beside it: each part stays in the
// hull of its two places.

#include "response/turning_move.h"

#include <algorithm>
#include <cmath>

#include "contact/names.h"
#include "response/touch_record.h"

namespace dsw {

namespace {

constexpr int kMostGap = 16;
constexpr double kStepInTouch = 0x1p-6, kSameTouch = 0x1p-20;
constexpr double kLeastThick = 0x1p-44;  // finer steps are below what distances of thick bodies may lose

/** Places at the next doubles towards the start from those of a PlaceFn. */
struct Beside {
  PlaceFn place;
  const void* user;
};
template <int D>
void place_beside(const void* user, uint32_t vertex, const double* from, double fraction, double* to) noexcept {
  const Beside& of = *static_cast<const Beside*>(user);
  of.place(of.user, vertex, from, fraction, to);
  for (int k = 0; k < D; ++k) to[k] = std::nextafter(to[k], from[k]);
}

}  // namespace

/** The chords of a move. */
template <int D>
struct TurningMove<D>::Steps {
  BodyMove<D>& mover;
  Body<D>& body;
  const RigidWay<D>& way;
  PlaceFn place;
  const void* user;
  MoveOrder order, reversed;
  int tries = 0;
  double at = 0;

  bool go_to(double fraction, MoveRecord* record = nullptr) { return go_by(place, user, fraction, record); }
  /** Not of a body that keeps its shape: its places follow from that. */
  bool go_beside(double fraction) {
    const Beside beside{place, user};
    return !body.is_rigid() && go_by(place_beside<D>, &beside, fraction, nullptr);
  }
  bool go_by(PlaceFn to, const void* of, double fraction, MoveRecord* record) {
    ++tries;
    mover.set_bend(way.sagitta(fraction - at));
    // An edge tilts between the turns of its ends, to the other side if they go in the other order.
    const bool arrives = mover.step(body, to, of, fraction, order, record) ||
                         (record == nullptr && mover.step(body, to, of, fraction, reversed, nullptr));
    mover.set_bend(0);
    if (arrives) at = fraction;
    return arrives;
  }
};

template <int D>
RigidSteps<typename TurningMove<D>::Steps> TurningMove<D>::along(Steps& steps) const noexcept {
  return {steps, way_.least_step(), way_.is_coarse(), most_tries_};
}

/** Thick bodies go in halves of the way, halves of these, and so on: where one is too wide for what it keeps from, it is halved. */
template <int D>
bool TurningMove<D>::go_thick(Steps& steps, double touch, double most_step) {
  const double end = along(steps).end_before(touch), least = std::max(way_.least_step(), kLeastThick);
  double step = most_step;
  while (steps.at < end && steps.tries < most_tries_) {
    const double next = std::min(end, steps.at + step);
    if (steps.go_to(next)) {
      while (2 * step <= most_step && std::floor(steps.at / (2 * step)) * (2 * step) == steps.at) step *= 2;
    } else {
      step *= 0.5;
      if (step < least) return false;
    }
  }
  return steps.at >= end;
}

/** Where the body has stopped too far before a touch, goes nearer. What a long chord met, as its vertices go one after the other,
 * a shorter one from nearer by may not meet. */
template <int D>
void TurningMove<D>::approach(Steps& steps, double touch) {
  RigidSteps<Steps> nearer = along(steps);
  const auto is_near = [&] { return is_at_touch(steps.body, kMostGap * way_.unit()); };
  bool has_come = is_near();
  for (double before = -1; before < steps.at && !has_come;) {
    before = steps.at;
    nearer.go_nearer(nearer.end_before(touch), way_.is_coarse() ? 0 : 2 * way_.least_step());
    if (before < steps.at) has_come = is_near();
  }
  if (has_come) return;
  // All places just before it: on a flat way the rounding of most of them touches already.
  for (int i = 0; i < 4 * kMostGap; ++i) {
    const double next = nearer.end_before(touch) - 0.25 * i * way_.least_step();
    if (!(next > steps.at) || steps.go_to(next)) return;
  }
}

/** Whether what touches first is that near. */
template <int D>
bool TurningMove<D>::is_at_touch(const Body<D>& body, double distance) const {
  return is_surely_near(body, touches_.touched(), distance) ||
         gap_of(body, touches_.touched(), 2 * distance, distance).distance <= distance;
}

/** Tries to go on, and keeps what stops it. Where nothing does, the body is taken back, and what it touches first is kept. */
template <int D>
void TurningMove<D>::record_contact(Steps& steps, const Partners<D>* partners, double touch, MoveRecord& record) {
  const double at = steps.at;
  here_.assign(steps.body.vertices.begin(), steps.body.vertices.end());
  for (double further = 16 * way_.least_step();; further *= 64) {
    const double next = std::min(1.0, std::max(at, touch <= 1 ? touch : at) + further);
    if (!steps.go_to(next, &record)) break;
    put_vertices(steps.body, here_.data());
    steps.at = at;
    if (next == 1) break;
  }
  if (record.contacts.empty() && touch <= 1) {
    const uint32_t partner = touches_.touched().partner;
    record_touch(env_, steps.body, way_, touches_.touched(), partner == kNone ? nullptr : &partners->all[partner],
                 record);
  }
  for (dsw_body_contact& contact : record.contacts) name_lowest_wall(env_, contact.contact);
  if (!record.contacts.empty()) record.contacts[0].time = touch <= 1 ? touch : at;
}

/** Keeps the vertices of a body in the opposite of an order. */
template <int D>
void TurningMove<D>::reverse(const Body<D>& body, MoveOrder order) {
  reversed_.clear();
  if (order.vertices != nullptr) {
    reversed_.assign(order.vertices, order.vertices + order.count);
  } else {
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (body.has_vertex(v)) reversed_.push_back(v);
    }
  }
  std::reverse(reversed_.begin(), reversed_.end());
}

template <int D>
void TurningMove<D>::move(BodyMove<D>& steps, Body<D>& body, const RigidMove<D>& motion, PlaceFn place,
                          const void* user, MoveOrder order, const Partners<D>* partners, MoveRecord& record) {
  constexpr double kNoTouch = 2;
  steps.begin_steps(body, record);
  const double radius = body.radius;
  try {
    way_.start(body, motion);
    const bool is_thick = radius > 0 || (partners != nullptr && partners->has_thick);
    reverse(body, order);
    Steps chords{steps, body, way_, place, user, order, {reversed_.data(), reversed_.size()}};
    const FirstTouch first = touches_.find_first(body, way_, partners);
    const KnownObstacles<D> known{touches_.obstacles(), way_.box()};
    steps.set_known(&known);
    double touch = first.touches ? first.time : kNoTouch, most_step = 1;
    if (way_.turns() && touches_.is_open_at_start()) most_step = kStepInTouch;
    // The way bends by no more than a radius beside a chord.
    while (way_.turns() && radius > 0 && way_.sagitta(most_step) > radius) most_step *= 0.5;
    // What stops the body much earlier is something else. A flat way is within the last place of what it touches for as much
    // as the root of that.
    bool arrives = is_thick && go_thick(chords, touch, most_step);
    if (!arrives && radius == 0) arrives = along(chords).go(touch, is_thick ? kStepInTouch : most_step);
    if (!arrives && touch <= 1 && !is_at_touch(body, kSameTouch * way_.largest())) touch = kNoTouch;
    if (!is_thick && touch <= 1) approach(chords, touch);
    if (chords.at < 1) record_contact(chords, partners, touch, record);
    steps.set_known(nullptr);
    steps.end_steps(body, chords.at, record);
    tries_ = chords.tries;
    for (dsw_body_contact& contact : record.contacts) {  // of the motion, not of a chord
      const double* const to = way_.place(way_.pieces(), contact.vertex.index);
      contact.distance_left = length(difference<D>(to, body.position(contact.vertex.index)));
    }
  } catch (...) {
    steps.set_bend(0);
    steps.set_known(nullptr);
    steps.undo_steps(body);
    throw;
  }
}

template class TurningMove<2>;
template class TurningMove<3>;

}  // namespace dsw
