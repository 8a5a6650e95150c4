// First the exact test says up to when the rigid way is free. Then the body goes there along chords, its vertices one after
// the other, as in any move: that finds the cells of its vertices, and verifies the rounded places. If a chord meets something, it
// is halved: between the chord and the arc something may stand.
//
// The exact test does not know what pairs do later that touch at the start: touching is decided by the shift there. So in a
// motion that begins in touch chords are short. Thick bodies keep their distance along each chord, with as much more as the
// way bends beside it.

#include "turning/turning_move.h"

#include <algorithm>
#include <cmath>

namespace dsw {

namespace {

constexpr int kMostTries = 400, kMostRetreats = 6, kMostGrazes = 64;
constexpr double kStepInTouch = 0x1p-6;

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
  bool is_widened;  // the distance that it keeps
  double radius;
  int tries = 0;
  double at = 0;

  bool go_to(double fraction, MoveRecord* record = nullptr) {
    ++tries;
    if (is_widened) body.radius = radius + way.sagitta(fraction - at);
    // An edge tilts between the turns of its ends, to the other side if they go in the other order.
    const bool arrives = mover.step(body, place, user, fraction, order, record) ||
                         (record == nullptr && mover.step(body, place, user, fraction, reversed, nullptr));
    body.radius = radius;
    if (arrives) at = fraction;
    return arrives;
  }
};

/** Goes on by bisection, up to where the body can't go. */
template <int D>
void TurningMove<D>::go_nearer(Steps& steps, double limit, double least) {
  while (limit - steps.at > 2 * least) {
    const double next = 0.5 * (steps.at + limit);
    if (!(next > steps.at && next < limit)) break;
    if (!steps.go_to(next)) limit = next;
  }
}

/** Goes as far as it can, or to an end just before `touch`. The first step is `first_step`. Returns whether it has come
 * there. */
template <int D>
bool TurningMove<D>::go(Steps& steps, double touch, double first_step, double most_step) {
  const double least = way_.least_step(), end = touch <= 1 ? touch - least : 1;
  double step = first_step;
  while (steps.at < end && steps.tries < kMostTries) {
    const bool is_last = end - steps.at <= step;
    const double from = steps.at, next = is_last ? end : from + step;
    if (steps.go_to(next)) {
      step = std::min(2 * step, most_step);
      continue;
    }
    // Where only the rounding of the last place touches, one a little before it does not.
    for (int i = 1; is_last && touch <= 1 && i <= kMostRetreats; ++i) {
      const double before = end - std::ldexp(least, 2 * i);
      if (!(before > from)) break;
      if (!steps.go_to(before)) continue;
      go_nearer(steps, end - std::ldexp(least, 2 * i - 2), least);
      return true;
    }
    step = 0.5 * (next - from);
    if (!(step >= least) || from + step == from) return false;
  }
  return steps.at >= end;
}

/** Tries to go on, and keeps what stops it. Where nothing does, the body is taken back. */
template <int D>
void TurningMove<D>::record_contact(Steps& steps, double touch, MoveRecord& record) {
  const double at = steps.at;
  here_.assign(steps.body.vertices.begin(), steps.body.vertices.end());
  for (double further = 16 * way_.least_step();; further *= 64) {
    const double next = std::min(1.0, std::max(at, touch <= 1 ? touch : at) + further);
    if (!steps.go_to(next, &record)) break;
    put_vertices(steps.body, here_.data());
    steps.at = at;
    if (next == 1) break;
  }
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
    Steps chords{
        steps, body, way_, place, user, order, {reversed_.data(), reversed_.size()}, radius > 0 && !body.filter.self,
        radius};
    double touch = kNoTouch, place_before = 0;
    bool is_in_touch = false;  // at the begin of the way that is looked at
    for (int grazes = 0;; ++grazes) {
      const double touch_before = touch;
      const bool was_in_touch = is_in_touch;
      const FirstTouch first = touches_.find_first(body, way_, partners);
      touch = first.touches ? way_.fraction(first.time) : kNoTouch;
      is_in_touch = touches_.touches_at_start();
      double most_step = 1;
      if (way_.turns() && (is_thick || is_in_touch)) most_step = kStepInTouch;
      // The way bends by no more than a radius beside a chord.
      while (way_.turns() && radius > 0 && way_.sagitta(most_step) > radius) most_step *= 0.5;
      // What a way touches it may also enter, at first by less than a place of rounding. The exact touch that is found next
      // is where it comes out again, so the steps behind a touch begin small: one of them ends inside, and is not free.
      const double first_step = grazes == 0 ? most_step : std::min(16 * way_.least_step(), most_step);
      if (!go(chords, touch, first_step, most_step)) {
        if (grazes == 0) {
          touch = kNoTouch;  // something that touched at the start is met again
        } else {
          put_vertices(body, before_.data());
          chords.at = place_before;
          touch = touch_before;
          is_in_touch = was_in_touch;
        }
        break;
      }
      if (touch == kNoTouch || grazes == kMostGrazes) break;
      // What only touches, and is free under the shift, is passed by a step so small that its chord is the arc.
      before_.assign(body.vertices.begin(), body.vertices.end());
      place_before = chords.at;
      const double beyond = std::min(1.0, touch + 16 * way_.least_step());
      if (!chords.go_to(beyond)) break;
      if (chords.at == 1) break;
      way_.go_on(body, motion, chords.at);
    }
    // It need not have left what it touched at the start.
    if (is_in_touch && touch - chords.at < 64 * way_.least_step()) touch = kNoTouch;
    if (chords.at < 1) record_contact(chords, touch, record);
    steps.end_steps(body, chords.at, record);
  } catch (...) {
    body.radius = radius;
    steps.undo_steps(body);
    throw;
  }
}

template class TurningMove<2>;
template class TurningMove<3>;

}  // namespace dsw
