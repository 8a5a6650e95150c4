// The distance of two hulls is at least what one direction shows: how far all points of one lie beyond all points of the other.
// While points go straight and steadily, how far one lies beyond another is linear in time, so what a direction shows is the
// least of linear functions: concave. Where it is enough at two times, it is enough between them. So the way is gone in pieces,
// each as long as the best direction at its begin allows. All numbers are those of the ends of the ways, rounded once: no place
// between is rounded.
//
// Where a wall turns, no fixed direction shows much for long. A direction that goes steadily from one to another shows the least of
// quadratic functions, over its length. The square of that length is 1 - 2 k t (1 - t), with k = 1 - cos of the angle between the
// two, so the length is at most 1 - k t (1 - t). What is left over is of third order.

#include "together/hull_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dimensions.h"
#include "motion/place_on_way.h"
#include "proximity/thick_sweep.h"

namespace dsw {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kLeastPiece = 0x1p-46;  // of a time: what is shorter is left
// What goes along with something loses no more of its distance by rounding than this share of it, in all steps together: the
// distance itself says what is left to lose.
constexpr double kMostLost = 5 * 0x1p-37;
constexpr double kMostBelow = 0x1p-30;  // what is nearer than this share less than wanted waits

/** How far two hulls are apart along a direction, as linear functions of time, and what rounding can lose of each. */
template <int D>
struct LinearGap {
  double start[16], end[16], lost = 0;
  uint32_t count = 0;

  LinearGap(const HullWays<D>& ways, const Vec& direction) noexcept {
    double size = 0;
    for (uint32_t i = 0; i < ways.count[0]; ++i) {
      for (uint32_t k = 0; k < ways.count[1]; ++k, ++count) {
        const Vec from = difference<D>(ways.start[0][i], ways.start[1][k]),
                  to = difference<D>(ways.end[0][i], ways.end[1][k]);
        start[count] = dot(direction, from);
        end[count] = dot(direction, to);
        size = std::max({size, largest(from), largest(to)});
      }
    }
    // A difference, a product and two sums lose at most 4 u of the sum of magnitudes, the mean of two numbers 4 u more, and the
    // length of the direction 2^-50.
    lost = 0x1p-47 * size + 0x1p-1000;
  }
  double at(double time) const noexcept {
    double least = kInf;
    for (uint32_t n = 0; n < count; ++n) least = std::min(least, (1 - time) * start[n] + time * end[n]);
    return least - lost;
  }
  /** The last time from `time` on, at most `most`, at which the gap is enough; `time` has it. */
  double last(double time, double most, double enough) const noexcept {
    if (at(most) >= enough) return most;
    double least = most;
    for (uint32_t n = 0; n < count; ++n) {
      const double goal = enough + lost;
      if (end[n] >= goal || !(start[n] > end[n])) continue;
      least = std::min(least, (start[n] - goal) / (start[n] - end[n]));
    }
    for (double back = 0x1p-52 * least; least > time; least -= back, back *= 2) {
      if (at(least) >= enough) return least;
    }
    return time;
  }
};

/** Whether one direction shows on the whole way that a distance is kept. */
template <int D>
bool shows(const HullWays<D>& ways, const Vec& direction, double most, double enough) noexcept {
  const LinearGap<D> along(ways, direction);
  return along.at(0) >= enough && along.at(most) >= enough;
}

/** Across the facet that is a side, at the start, from the second side to the first. */
template <int D>
Vec across_facet(const HullWays<D>& ways, uint32_t side) noexcept {
  const double* const* const points = ways.start[side];
  const Vec edge = difference<D>(points[1], points[0]);
  Vec normal;
  if constexpr (D == 2) {
    normal = unit(turned(edge));
  } else {
    normal = unit(unit(edge).cross(unit(difference<D>(points[2], points[0]))));
  }
  const bool is_above = dot(normal, difference<D>(ways.start[1 - side][0], points[0])) >= 0;
  return is_above == (side == 1) ? normal : -1 * normal;
}

/** Across the first facet. Zero if there is none. */
template <int D>
Vec across_facet(const HullWays<D>& ways) noexcept {
  for (uint32_t side = 0; side < 2; ++side) {
    if (ways.count[side] == D) return across_facet(ways, side);
  }
  return Vec::Zero();
}

/** No distance of two sides changes by more on their ways. */
template <int D>
double most_change(const HullWays<D>& ways) noexcept {
  double sum = 0;
  for (uint32_t side = 0; side < 2; ++side) {
    double most = 0;
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      most = std::max(most, length(difference<D>(ways.end[side][i], ways.start[side][i])));
    }
    sum += most;
  }
  return sum;
}

/** How much a distance can change by the rounding of places where all points go alike. */
template <int D>
double rounding_of(const HullWays<D>& ways) noexcept {
  double most = 0;
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      most = std::max({most, largest_coordinate<D>(ways.start[side][i]), largest_coordinate<D>(ways.end[side][i])});
    }
  }
  return 0x1p-49 * most;
}

/** Whether the boxes of two sides' ways are so far apart that a distance is kept. */
template <int D>
bool are_boxes_apart(const HullWays<D>& ways, double wanted) noexcept {
  Box<D> boxes[2];
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      boxes[side].add(ways.start[side][i]);
      boxes[side].add(ways.end[side][i]);
    }
  }
  for (int k = 0; k < D; ++k) {
    if (boxes[0].lower[k] - boxes[1].upper[k] >= wanted || boxes[1].lower[k] - boxes[0].upper[k] >= wanted) return true;
  }
  return false;
}

/** Whether a direction that goes from one to another between two times shows that a distance is kept there. */
template <int D>
bool keeps_turning(const HullWays<D>& ways, double begin, double end, const Vec& first, const Vec& last,
                   double accepted) noexcept {
  const Vec turn = last - first;
  const double shorter = accepted * dot(turn, turn) / 4 * (1 - 0x1p-40);  // see above: half of k, as a control value
  for (uint32_t i = 0; i < ways.count[0]; ++i) {
    for (uint32_t k = 0; k < ways.count[1]; ++k) {
      const Vec from = difference<D>(ways.start[0][i], ways.start[1][k]),
                to = difference<D>(ways.end[0][i], ways.end[1][k]);
      const Vec a = (1 - begin) * from + begin * to, b = (1 - end) * from + end * to;
      const double goal = accepted + 0x1p-46 * std::max(largest(from), largest(to)) + 0x1p-1000;
      const double c0 = dot(first, a) - goal, c1 = (dot(first, b) + dot(last, a)) / 2 + shorter - goal,
                   c2 = dot(last, b) - goal;
      if (!(c0 >= 0 && c2 >= 0)) return false;
      if (!(c1 >= 0) && !(c0 * c2 > c1 * c1 * (1 + 0x1p-40))) return false;
    }
  }
  return true;
}

/** Where a parabola that begins at `over` with this slope, and is `under` below zero after a span, is zero. */
double zero_of(double over, double slope, double under, double span) noexcept {
  const double curve = -(over + under + slope * span) / (span * span);
  return 2 * over / (std::sqrt(slope * slope - 4 * curve * over) - slope);
}

/** Up to which time after `begin` such a direction shows that a distance is kept; else `least`.
 * @param gap at the begin. */
template <int D>
double last_turning(const HullWays<D>& ways, double begin, double least, double most, const HullGap& gap,
                    double accepted) noexcept {
  constexpr int kMostTries = 16;
  constexpr double kLeastShare = 0x1p-4, kBefore = 0x1p-10;  // of a span
  const double over = gap.distance - accepted, slope = opening_of(ways, gap);
  double span = most - begin;
  for (int tries = 0; tries < kMostTries && begin + span > least && span >= kLeastPiece * (begin + span); ++tries) {
    const double end = std::min(begin + span, most);
    const HullGap there = HullPlaces<D>(ways, end).gap(kInf, accepted);
    if (!is_zero(there.normal) && there.distance >= accepted) {
      if (keeps_turning(ways, begin, end, gap.normal, there.normal, accepted)) return end;
      span /= 4;
      continue;
    }
    const double under = accepted - there.distance, zero = zero_of(over, slope, under, span);
    if (zero > 0 && zero < span) {
      span = zero * (1 - kBefore);
    } else {
      span *= std::clamp(over / (over + under), kLeastShare, 1.0) * (1 - kBefore);
    }
  }
  return least;
}

/** Whether what is that much over at the start and at the end is never less than nothing while points are beside their straight ways.
 * At a time t they are by at most 4 t (1 - t) of the bend there, as the error of a linear interpolation. */
bool stays_over(double c0, double c2, double bend) noexcept {
  const double c1 = (c0 + c2) / 2 - 2 * bend;  // control values of a quadratic function
  return c0 >= 0 && c2 >= 0 && (c1 >= 0 || c0 * c2 > c1 * c1 * (1 + 0x1p-40));
}

/** Whether a direction shows on the whole way that a distance is kept while points are beside their straight ways. */
template <int D>
bool keeps_bent(const LinearGap<D>& along, double bend, double kept) noexcept {
  for (uint32_t n = 0; n < along.count; ++n) {
    if (!stays_over((along.start[n] - along.lost) - kept, (along.end[n] - along.lost) - kept, bend)) return false;
  }
  return true;
}

/** See time_kept: for what begins so near that doubles do not tell whether it may still lose anything. A pair that is at the least
 * distance, or nearer, comes no nearer by any rounding but that of double-doubles.
 * @param least the distance below which nothing may come. */
template <int D>
double time_kept_sharply(const HullWays<D>& ways, double wanted, double least, double most) noexcept {
  ConvexHull start[2], end[2];
  for (uint32_t side = 0; side < 2; ++side) {
    start[side].count = end[side].count = ways.count[side];
    std::copy_n(ways.start[side], ways.count[side], start[side].points);
    std::copy_n(ways.end[side], ways.count[side], end[side].points);
  }
  const GapAtEnds gap = find_gap_at_ends<D>(start, end);
  if (!(gap.start >= less_share(wanted, kMostBelow))) return 0;
  const double kept = std::min(gap.start, least);
  if (stays_over(gap.start - kept, gap.end - kept, ways.bend())) return most;
  if (ways.bend() > 0 || !(gap.start > gap.end)) return 0;
  return std::min(most, (gap.start - kept) / (gap.start - gap.end) * (1 - 0x1p-50));
}

}  // namespace

template <int D>
double opening_of(const HullWays<D>& ways, const HullGap& gap) noexcept {
  double sum = 0;
  for (uint32_t side = 0; side < 2; ++side) {
    const double* const weights = side == 0 ? gap.weights : gap.other_weights;
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      const double along = dot(gap.normal, difference<D>(ways.end[side][i], ways.start[side][i]));
      sum += side == 0 ? weights[i] * along : -weights[i] * along;
    }
  }
  return sum;
}

template <int D>
HullPlaces<D>::HullPlaces(const HullWays<D>& ways, double time) noexcept {
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < ways.count[side]; ++i) {
      point_on_way<D>(ways.start[side][i], ways.end[side][i], time, places[side][i]);
      hulls[side].points[i] = places[side][i];
    }
    hulls[side].count = ways.count[side];
  }
}

template <int D>
double time_kept(const HullWays<D>& ways, double wanted, double most, Vec* known) noexcept {
  constexpr int kMostPieces = 100, kMostNearPieces = 12;
  constexpr double kNear = 0x1p-37, kThere = 0x1p-40;
  if (are_boxes_apart(ways, wanted + ways.bend())) return most;
  double time = 0, kept = least_kept(wanted);
  if (shows(ways, *known, most, kept + ways.bend(*known))) return most;
  *known = across_facet(ways);
  if (shows(ways, *known, most, kept + ways.bend(*known))) return most;
  const auto gap_at = [&](double at, double enough) { return HullPlaces<D>(ways, at).gap(enough, kept); };
  const double far = kept + ways.bend() + most_change(ways);
  HullGap gap = gap_at(0, far);
  *known = gap.normal;
  if (gap.bound >= far) {
    if (shows(ways, *known, most, kept + ways.bend(*known))) return most;
    gap = gap_at(0, kInf);
  }
  for (int piece = 0, near_pieces = 0; piece < kMostPieces; ++piece) {
    if (piece > 0) gap = gap_at(time, kInf);
    if (is_zero(gap.normal) || !is_finite<3>(gap.normal.data())) return time;
    LinearGap<D> along(ways, gap.normal);
    // The direction across a short gap is known badly, across a facet well.
    for (uint32_t side = 0; piece == 0 && side < 2; ++side) {
      if (ways.count[side] != D) continue;
      const Vec facet = across_facet(ways, side);
      const LinearGap<D> across(ways, facet);
      if (!(across.at(0) > along.at(0))) continue;
      along = across;
      gap.normal = facet;
    }
    *known = gap.normal;
    const double bend = ways.bend(gap.normal);
    double accepted = kept + bend;
    if (piece == 0) {
      const double at_start = along.at(0), least = less_share(wanted, kMostLost);
      if (at_start < least) return time_kept_sharply(ways, wanted, least, most);
      const double slack = std::clamp((at_start - bend - least) / 2, 0.0, rounding_of(ways));
      if (bend > 0 && at_start < accepted) return keeps_bent(along, bend, std::min(kept, at_start - slack)) ? most : 0;
      if (at_start - slack < accepted && along.at(most) >= at_start - slack) return most;
      kept = std::min(kept, at_start);
      accepted = kept + bend;
    }
    if (!(along.at(time) >= accepted)) return time;
    double last = along.last(time, most, accepted);
    const double over = gap.distance - accepted;
    // Nothing is gained by going nearer: the end of the fixed direction is close enough.
    const bool is_there = over < kThere * wanted && over + (most - time) * opening_of(ways, gap) < 0;
    if (is_there) return last;
    if (last < most) last = last_turning(ways, time, last, most, gap, kept + ways.bend());
    if (last >= most) return most;
    // Pieces become short where a wall turns as fast as it comes nearer.
    near_pieces += over < kNear * wanted ? 1 : 0;
    if (last - time < kLeastPiece * last || near_pieces > kMostNearPieces) return time;
    time = last;
  }
  return time;
}

template <int D>
TimeOfGap worst_time(const HullWays<D>& ways, double time, double wanted) noexcept {
  constexpr int kMostTries = 8;
  constexpr double kLeastTime = 0x1p-10, kLeastDistance = 0.5, kLeastCosine = 0.9;
  constexpr double kLeastShare = 0x1p-3, kDepth = 0x1p-4;
  const HullGap first = HullPlaces<D>(ways, time).gap(kInf, wanted);
  TimeOfGap worst{time, first.distance, false};
  double slope = 0;
  const auto look_at = [&](double at) {
    const HullGap gap = HullPlaces<D>(ways, at).gap(kInf, wanted);
    slope = opening_of(ways, gap);
    const bool is_like = gap.distance >= kLeastDistance * wanted && dot(gap.normal, first.normal) >= kLeastCosine;
    if (at >= kLeastTime && is_like && gap.distance < worst.distance) worst = {at, gap.distance, true};
    return first.distance - gap.distance;
  };
  look_at(1);
  double low = time, high = 1, falling = opening_of(ways, first), rising = slope;
  for (int tries = 0; tries < kMostTries && falling < 0 && rising > 0; ++tries) {
    const double share = std::clamp(falling / (falling - rising), kLeastShare, 1 - kLeastShare);
    const double at = low + (high - low) * share, depth = look_at(at);
    if (std::fabs(slope) * (high - low) <= kDepth * depth) break;
    (slope < 0 ? low : high) = at;
    (slope < 0 ? falling : rising) = slope;
  }
  return worst;
}

template struct HullPlaces<2>;
template struct HullPlaces<3>;
DSW_INSTANTIATE(time_kept);
DSW_INSTANTIATE(opening_of);
DSW_INSTANTIATE(worst_time);

}  // namespace dsw
