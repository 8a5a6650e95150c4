#pragma once
// How bodies are led along their rigid ways in steps that are verified, each along chords: up to a fraction that the exact test has
// found. If a step meets something, it is halved: between a chord and its arc something may stand.

#include <algorithm>
#include <cmath>

namespace dsw {

/** @tparam Steps has `at`, the fraction up to which all have gone, `tries`, and `bool go_to(fraction)`, which goes there or nowhere;
 * `go_beside` goes to places one unit nearer to the start. */
template <class Steps>
struct RigidSteps {
  static constexpr int kMostRetreats = 6, kMostLeap = 16;

  Steps& steps;
  double least;    // the share of the motion in which nothing goes further than one unit in the last place
  bool is_coarse;  // neighbouring fractions may be further apart than that
  int most_tries;
  double limit = 1;     // the end of the way, without a touch
  double shortest = 0;  // no step is halved further; 0: to `least`, and past what only touches by rounding

  /** The place to go to before a touch. Fractions next to each other may be many units apart. */
  double end_before(double touch) const noexcept { return touch > 1 ? limit : is_coarse ? touch : touch - least; }

  /** Goes as far as it can, or to an end just before `touch`. Returns whether it has come there. */
  bool go(double touch, double most_step) {
    const double end = end_before(touch);
    double step = most_step;
    while (steps.at < end && steps.tries < most_tries) {
      const bool is_last = end - steps.at <= step;
      const double from = steps.at, next = is_last ? end : from + step;
      if (steps.go_to(next)) {
        step = std::min(2 * step, most_step);
        continue;
      }
      if (is_last && touch <= 1 && retreat(end)) return true;
      step = 0.5 * (next - from);
      const bool is_short = !(step >= std::max(least, shortest)) || from + step == from;
      if (is_short && (shortest > 0 || !leap(end))) return false;
    }
    return steps.at >= end;
  }

  /** Goes on by bisection, up to where the body can't go. */
  void go_nearer(double end, double room) {
    while (end - steps.at > room) {
      const double next = 0.5 * (steps.at + end);
      if (!(next > steps.at && next < end)) break;
      if (!steps.go_to(next)) end = next;
    }
  }

 private:
  /** Where only the rounding of the last place touches, one a little before it does not. */
  bool retreat(double end) {
    const double from = steps.at;
    double beyond = end;
    for (int i = 1; i <= kMostRetreats; ++i) {
      const double before = end - std::ldexp(least, 2 * i);
      if (!(before > from)) break;
      if (steps.go_to(before)) {
        if (is_coarse || i > 1) go_nearer(beyond, is_coarse ? 0 : 2 * least);
        return true;
      }
      beyond = before;
    }
    // What goes along a wall may be nearer to it than to the doubles before it, and be rounded to the wall for long.
    return steps.go_beside(end);
  }

  /** Goes past places whose rounding touches something, though the way does not. */
  bool leap(double end) {
    for (int i = 1; i <= kMostLeap; ++i) {
      const double next = steps.at + std::ldexp(least, i);
      if (next >= end) break;
      if (steps.go_to(next)) return true;
    }
    return false;
  }
};

}  // namespace dsw
