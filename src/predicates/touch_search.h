// The search for the first touch of a pair by doubles: its volume and what says whether a flat pair touches are polynomials in
// time, given by their coefficients in the basis of Bernstein and bounds of their errors. The values lie between the least
// and the greatest coefficient. Time is halved until each piece is decided: the volume keeps its sign, or the conditions say
// that the pair is apart, or the volume has one root. This root is refined. Private to this folder.
#pragma once

#include <cmath>

#include "predicates/double_double.h"
#include "predicates/integers.h"
#include "predicates/moving_pair.h"

namespace dsw {

enum class Filtered { kApart, kTouches, kUnknown };

namespace touch_search {

constexpr int kMostHalvings = 24;

// The least time with digits that end at 2^-20 that is after this one; at most 1.
inline double end_after(double time) noexcept {
  constexpr double kParts = 0x1p20;
  return time < 1 - 1 / kParts ? (std::floor(time * kParts) + 1) / kParts : 1;
}

// Coefficients in the basis of Bernstein.
template <int N>
struct Curve {
  double c[N];

  // 1 or -1 if all values surely have this sign, else 0.
  int sign(double error) const noexcept {
    double least = c[0], most = c[0];
    for (int i = 1; i < N; ++i) {
      least = c[i] < least ? c[i] : least;
      most = c[i] > most ? c[i] : most;
    }
    return least > error ? 1 : most < -error ? -1 : 0;
  }

  // Changes into the first half, and returns the second.
  Curve halve() noexcept {
    Curve second = *this;
    for (int round = N - 1; round > 0; --round) {
      c[N - 1 - round] = second.c[0];
      for (int i = 0; i < round; ++i) second.c[i] = 0.5 * (second.c[i] + second.c[i + 1]);
    }
    c[N - 1] = second.c[0];
    return second;
  }

  // Returns the part between two times. Both are multiples of 2^-20, so 1 - time is exact.
  DSW_NOINLINE Curve part(double low, double high) const noexcept {
    Curve part;
    for (int i = 0; i < N; ++i) {
      double value[N];
      for (int k = 0; k < N; ++k) value[k] = c[k];
      for (int round = N - 1; round > 0; --round) {
        const double t = round > i ? low : high;
        for (int k = 0; k < round; ++k) value[k] = (1 - t) * value[k] + t * value[k + 1];
      }
      part.c[i] = value[0];
    }
    return part;
  }

  double at(double t) const noexcept {
    double value[N];
    for (int i = 0; i < N; ++i) value[i] = c[i];
    for (int round = N - 1; round > 0; --round) {
      for (int i = 0; i < round; ++i) value[i] = (1 - t) * value[i] + t * value[i + 1];
    }
    return value[0];
  }
};

// Whether conditions of these signs part the pair, join it, or leave it open. The rule is that of exact_touch.h, but here 0 is
// unknown.
inline Filtered judge(PairKind kind, const int (&s)[4]) noexcept {
  if (kind == PairKind::kEdgeEdge) {
    if (s[0] * s[1] > 0 || s[2] * s[3] > 0) return Filtered::kApart;
    return s[0] * s[1] < 0 && s[2] * s[3] < 0 ? Filtered::kTouches : Filtered::kUnknown;
  }
  const int a = s[0] * s[3], b = -s[1] * s[3], c = s[2] * s[3];
  if (a < 0 || b < 0 || c < 0) return Filtered::kApart;
  return a > 0 && b > 0 && c > 0 ? Filtered::kTouches : Filtered::kUnknown;
}
inline Filtered judge(PairKind, const int (&s)[2]) noexcept {
  return s[0] * s[1] > 0 ? Filtered::kApart : s[0] * s[1] < 0 ? Filtered::kTouches : Filtered::kUnknown;
}

// A volume of degree V, and kConditions conditions of degree C.
template <int V, int C, int kConditions>
class Search {
 public:
  explicit Search(PairKind kind) noexcept : kind_(kind) {}

  struct Piece {
    double low, high;
    int halvings;
    Curve<V + 1> volume;
    Curve<C + 1> condition[kConditions];
  };
  Piece whole;
  // Bounds of errors, for halved pieces, too. root_error is that of volume_at plus what its first differences err by over
  // most_steps + 1 doubles: so far from a guess of a root the volume is taken as straight.
  double volume_error = 0, condition_error = 0, root_error = 0, most_steps = 3;

  // What comes after a time in (0,1] is left out. Its digits end at 2^-20, so that the ends of all halves are exact.
  void end_at(double time) noexcept { end_ = time; }

  // The volume in whole is known. Calls find_conditions() once before others are read, and volume_at(time), which returns
  // a dd::Number. For kTouches, *time is that of FirstTouch.
  template <class FindConditions, class VolumeAt>
  Filtered first_touch(FindConditions find_conditions, VolumeAt volume_at, double* time) noexcept {
    const bool is_cut = end_ < 1;
    const Curve<V + 1> volume = is_cut ? whole.volume.part(0, end_) : whole.volume;
    if (volume.sign(volume_error) != 0) return Filtered::kApart;
    find_conditions();
    return first_touch_in(0, end_, 0, volume_at, time);
  }

  // Does what first_touch does, between two times that are multiples of 2^-20. The conditions are known, too. `halvings`: as many as add
  // to the errors what taking this part adds.
  template <class VolumeAt>
  DSW_NOINLINE Filtered first_touch_in(double low, double high, int halvings, VolumeAt volume_at,
                                       double* time) noexcept {
    Piece left[kMostHalvings + 1];
    int count = 1;
    if (low > 0 || high < 1) {
      left[0].volume = whole.volume.part(low, high);
      for (int i = 0; i < kConditions; ++i) left[0].condition[i] = whole.condition[i].part(low, high);
    } else {
      left[0] = whole;
    }
    left[0].low = low;
    left[0].high = high;
    left[0].halvings = halvings;
    while (count > 0) {
      Piece& piece = left[--count];
      if (piece.volume.sign(volume_error) != 0) continue;
      const Filtered conditions = judge_piece(piece);
      if (conditions == Filtered::kApart) continue;
      if (has_one_root(piece.volume)) {
        const Filtered root = judge_root(piece, conditions, volume_at, time);
        if (root == Filtered::kApart) continue;
        return root;
      }
      if (piece.halvings == kMostHalvings || stays_unknown(piece)) return Filtered::kUnknown;
      halve(left, &count);
    }
    return Filtered::kApart;
  }

 private:
  Filtered judge_piece(const Piece& piece) const noexcept {
    int signs[kConditions];
    for (int i = 0; i < kConditions; ++i) signs[i] = piece.condition[i].sign(condition_error);
    return judge(kind_, signs);
  }

  // Whether halving can't help: the volume may be 0 at an end, and the pair may touch there.
  bool stays_unknown(const Piece& piece) const noexcept {
    for (int end = 0; end < 2; ++end) {
      if (std::fabs(piece.volume.c[end * V]) > volume_error) continue;
      int signs[kConditions];
      for (int i = 0; i < kConditions; ++i) {
        const double value = piece.condition[i].c[end * C];
        signs[i] = value > condition_error ? 1 : value < -condition_error ? -1 : 0;
      }
      if (judge(kind_, signs) != Filtered::kApart) return true;
    }
    return false;
  }

  // The signs at the ends differ, and the coefficients change their sign once, whatever their errors: none that may have the
  // last sign comes before another one that may have the first.
  bool has_one_root(const Curve<V + 1>& v) const noexcept {
    const double first = v.c[0], last = v.c[V];
    if (!(std::fabs(first) > volume_error && std::fabs(last) > volume_error) || (first > 0) == (last > 0)) return false;
    const double s = first > 0 ? 1 : -1;
    int changed = 1, kept = V - 1;
    while (changed < V && s * v.c[changed] > volume_error) ++changed;
    while (kept > 0 && s * v.c[kept] < -volume_error) --kept;
    return changed >= kept;
  }

  // The root of the whole volume in this piece; `conditions` are those of the piece.
  template <class VolumeAt>
  Filtered judge_root(const Piece& piece, Filtered conditions, VolumeAt& volume_at, double* time) const noexcept {
    const bool rising = piece.volume.c[0] < 0;
    const double guess = guess_root(piece, rising);
    if (conditions == Filtered::kUnknown && is_apart_round(piece, guess)) return Filtered::kApart;
    if (!find_root(guess, piece, volume_at, time)) return Filtered::kUnknown;
    if (conditions != Filtered::kUnknown) return conditions;
    int signs[kConditions];
    for (int i = 0; i < kConditions; ++i) {
      const double value = whole.condition[i].at(*time);
      signs[i] = value > condition_error ? 1 : value < -condition_error ? -1 : 0;
    }
    return judge(kind_, signs);
  }

  // Whether the pair is apart at the only root of a piece, wherever near the guess that is. Most roots are those of planes that
  // meet beside the pair, and need not be refined.
  bool is_apart_round(const Piece& piece, double guess) const noexcept {
    constexpr double kRoom = 0x1p-16;
    const double low = guess - kRoom > piece.low ? guess - kRoom : piece.low,
                 high = guess + kRoom < piece.high ? guess + kRoom : piece.high;
    const double first = whole.volume.at(low), last = whole.volume.at(high);
    const double s = piece.volume.c[0] < 0 ? -1 : 1;
    if (!(s * first > volume_error && s * last < -volume_error)) return false;
    int signs[kConditions];
    for (int i = 0; i < kConditions; ++i) {
      const Curve<C + 1>& condition = whole.condition[i];
      double steepest = 0;
      for (int k = 0; k < C; ++k) {
        const double rise = std::fabs(condition.c[k + 1] - condition.c[k]);
        steepest = rise > steepest ? rise : steepest;
      }
      // Coefficients differ by rounding, too: so does what they rise by.
      const double error = condition_error + 2 * kRoom * C * (steepest + 2 * condition_error);
      const double value = condition.at(0.5 * (low + high));
      signs[i] = value > error ? 1 : value < -error ? -1 : 0;
    }
    return judge(kind_, signs) == Filtered::kApart;
  }

  template <class VolumeAt>
  bool find_root(double guess, const Piece& piece, VolumeAt& volume_at, double* floor) const noexcept {
    const bool rising = piece.volume.c[0] < 0;
    for (int tries = 0; tries < 3; ++tries) {
      const double step = next(guess) - guess;
      const dd::Number value = volume_at(guess);
      // The volume rises with this slope; the root is where it has made up for `here`.
      const double here = rising ? value.high + value.low : -(value.high + value.low);
      const double slope = rising ? slope_at(guess) : -slope_at(guess);
      const double steps = std::floor(-here / (slope * step)), to = guess + steps * step;
      if (!(to >= piece.low && to < piece.high)) return false;
      // Doubles below and above the guess have the same step, unless there is a power of two between them.
      if (std::fabs(steps) <= most_steps && to - guess == steps * step && next(to) - to == step) {
        *floor = to;
        return here + slope * (to - guess) < -root_error && here + slope * (to + step - guess) > root_error;
      }
      guess = to;
    }
    return false;
  }

  static double next(double x) noexcept { return integers::of_bits(integers::bits_of(x) + 1); }

  // Newton's method, with bisection where a step leaves the interval.
  double guess_root(const Piece& piece, bool rising) const noexcept {
    double low = piece.low, high = piece.high;
    double t = low + (high - low) * (piece.volume.c[0] / (piece.volume.c[0] - piece.volume.c[V]));
    for (int i = 0; i < 60; ++i) {
      const double value = whole.volume.at(t);
      if ((value > 0) == rising) {
        high = t;
      } else {
        low = t;
      }
      double to = t - value / slope_at(t);
      if (!(to >= low && to <= high)) to = 0.5 * (low + high);
      const double move = std::fabs(to - t);
      t = to;
      if (move <= 0x1p-48 * t) break;
    }
    return t;
  }

  double slope_at(double t) const noexcept {
    Curve<V> slope;
    for (int i = 0; i < V; ++i) slope.c[i] = V * (whole.volume.c[i + 1] - whole.volume.c[i]);
    return slope.at(t);
  }

  // The last piece becomes two, the first of them last.
  static void halve(Piece* left, int* count) noexcept {
    Piece& second = left[*count];
    Piece& first = left[*count + 1];
    first = second;
    ++first.halvings;
    second.halvings = first.halvings;
    first.high = second.low = 0.5 * (first.low + first.high);
    second.volume = first.volume.halve();
    for (int i = 0; i < kConditions; ++i) second.condition[i] = first.condition[i].halve();
    *count += 2;
  }

  PairKind kind_;
  double end_ = 1;
};

}  // namespace touch_search
}  // namespace dsw
