// What is touched first on the whole ways bounds the fraction. The pairs that touch are few, so the largest fraction at which
// these stay apart is found by bisection among doubles. Then all ways to the places at this fraction are looked at. Rounding may
// have led them to something else: that joins the pairs, and the search goes on below. So what is found is free, and the next
// double is not.

#include "together/step_search.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/search.h"
#include "together/moving_walls.h"
#include "together/wall_ways.h"

namespace dsw {
namespace {

/** Positive doubles are in the order of their bits. */
double middle_of(double low, double high) noexcept {
  uint64_t bits[2];
  std::memcpy(&bits[0], &low, sizeof low);
  std::memcpy(&bits[1], &high, sizeof high);
  bits[0] += (bits[1] - bits[0]) / 2;
  std::memcpy(&low, &bits[0], sizeof low);
  return low;
}

}  // namespace

/** A number below `high`, or 0, at which is_free, while the next double is not free or is `high`. At `high` it is not.
 * @param guess,step where to begin, and by how much to go from there at first. */
template <int D, class Walls>
template <class IsFree>
double StepSearch<D, Walls>::last_free(double high, double guess, double step, IsFree is_free) {
  double low = 0;
  guess = std::min(guess, std::nextafter(high, 0));
  if (guess > 0) {
    if (is_free(guess)) {
      low = guess;
      for (double next; next = low + step, next < high; step *= 2) {
        if (next == low) continue;
        if (!is_free(next)) {
          high = next;
          break;
        }
        low = next;
      }
    } else {
      high = guess;
      for (double next; next = high - step, next > 0; step *= 2) {
        if (next == high) continue;
        if (is_free(next)) {
          low = next;
          break;
        }
        high = next;
      }
    }
  }
  while (std::nextafter(low, high) < high) {
    const double middle = middle_of(low, high);
    (is_free(middle) ? low : high) = middle;
  }
  return low;
}

template <int D, class Walls>
double StepSearch<D, Walls>::find(double most) {
  constexpr int kMostTries = 60;
  if (!ways_.meets_walls && ways_.bodies.are_alone() && !ways_.thick.is_needed()) return most;
  double fraction = most, back = 0, near = 0;
  for (int tries = 0; tries < kMostTries && fraction > 0; ++tries) {
    set_ends(fraction);
    if (!ways_.walls.stays_valid_to_ends()) {
      fraction = last_free(fraction, fraction / 2, fraction / 4, [&](double part) {
        set_ends(part);
        return ways_.walls.stays_valid_to_ends();
      });
      continue;
    }
    if (!find_touches()) {
      const double kept = ways_.find_too_near(*trajectories_, 1);
      if (kept == 1) return fraction;
      // Rounded places may come nearer than the straight way to them.
      near = near == 0 ? 0x1p-53 : 2 * near;
      fraction = (kept - near) * fraction;
      continue;
    }
    const Array<WayTouch<D>>& first = ways_.first;
    double step = 0;
    for (const WayTouch<D>& each : first) step = std::max(step, step_back(each));
    const double guess = first[0].first.time * fraction;
    touches_.insert(touches_.end(), first.begin(), first.end());
    if (are_apart(fraction)) {
      // The shift stops what the pairs do not tell of.
      back = std::max(2 * back, step);
      fraction = std::min(fraction, guess) - back;
    } else {
      const bool is_rounding = fraction < most && !are_met_before(fraction, most);
      fraction = last_free(fraction, is_rounding ? fraction : guess, step * fraction,
                           [&](double part) { return are_apart(part); });
    }
  }
  return 0;
}

template <int D, class Walls>
void StepSearch<D, Walls>::set_end(Trajectory<D>& of, uint32_t v, double fraction) const {
  const PointArray steps = (*steps_)[static_cast<size_t>(&of - trajectories_->data())];
  if (steps.data != nullptr) place_of_step<D>(of.start(v), steps[v], fraction, of.end(v));
}

template <int D, class Walls>
void StepSearch<D, Walls>::set_ends(double fraction) {
  ways_.walls.set_step_end(fraction);
  for (Trajectory<D>& of : *trajectories_) {
    for (uint32_t v = 0; v < of.motion.body->vertices.size(); ++v) {
      if (!of.motion.body->has_vertex(v)) continue;
      for (int k = 0; k < D; ++k) of.end(v)[k] = of.start(v)[k];
      set_end(of, v, fraction);
    }
  }
}

template <int D, class Walls>
void StepSearch<D, Walls>::set_ends_of_touches(double fraction) {
  ways_.walls.set_step_end(fraction);
  for (const WayTouch<D>& each : touches_) {
    for_each_touching(*trajectories_, each, [&](Trajectory<D>& of, uint32_t v) { set_end(of, v, fraction); });
  }
}

/** Finds what is touched first on the ways to the ends. Whether anything is. */
template <int D, class Walls>
bool StepSearch<D, Walls>::find_touches() {
  ways_.first.clear();
  if (ways_.meets_walls) {
    ways_.walls.cast_paths(*trajectories_);
    ways_.walls.find_first(*trajectories_, ways_.first);
  }
  ways_.bodies.find_first(*trajectories_, ways_.first);
  return !ways_.first.empty();
}

/** Whether all pairs that have touched stay apart on the ways to the places at a fraction. What touched a wall at the start is
 * apart if it is so under the shift. */
template <int D, class Walls>
bool StepSearch<D, Walls>::are_apart(double fraction) {
  set_ends_of_touches(fraction);
  return dsw::all_of(touches_.begin(), touches_.end(), [&](const WayTouch<D>& each) {
    if (!first_touch(each.pair, ways_.walls.work).touches) return true;
    return each.first.time == 0 && each.other == nullptr && ways_.walls.is_kept_free(each);
  });
}

/** Whether the whole ways lead what was met first to each other before a fraction of the step. Else only the rounding of the
 * places at this fraction does. */
template <int D, class Walls>
bool StepSearch<D, Walls>::are_met_before(double fraction, double most) {
  set_ends_of_touches(most);
  return dsw::any_of(ways_.first.begin(), ways_.first.end(), [&](const WayTouch<D>& each) {
    const FirstTouch touch = first_touch(each.pair, ways_.walls.work);
    return touch.touches && touch.time * most < fraction;
  });
}

template class StepSearch<2, WallWays<2>>;
template class StepSearch<3, WallWays<3>>;
template class StepSearch<2, MovingWalls<2>>;
template class StepSearch<3, MovingWalls<3>>;

}  // namespace dsw
