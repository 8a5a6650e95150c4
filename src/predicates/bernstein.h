// Where a polynomial in time is 0, by the signs of its coefficients in the basis of Bernstein. Every answer is exact; where a
// question takes more, it stays open, and integers of any length answer it. Private to this folder.
//
// A curve of degree n is the sum of c[i] (1-t)^(n-i) t^i, so c[i] has a binomial coefficient as a factor. By Descartes' rule it
// has as many roots strictly inside of [0,1] as its coefficients change their sign, or fewer by an even number. The same is true
// of each part of [0,1] with the coefficients of that part.
//
// A curve, as these templates take it, has
//   degree();
//   sign(i), of c[i];
//   rough(), which returns a RoughCurve;
//   ball(i), c[i] as a Ball;
//   sign_at(t), at a double with 0 < t < 1, or kOpenSign;
//   sure_sign(t), at all times from a double t to the next, or kOpenSign.
#pragma once

#include <cmath>
#include <initializer_list>

#include "predicates/ball.h"
#include "predicates/sharp_root.h"

namespace dsw {
namespace bernstein {

constexpr int kMostDegree = 5;

// A root: `floor`, or a time between it and the next double.
struct Place {
  double floor;
  bool is_exact;
  // Between 1 and the double before it, or between 0 and the double after it, there may be several. Such a root is from low to high
  // times 2^power away from 1, or from 0, and these times are on two sides of it, and of it alone.
  bool is_hidden = false, is_at_end = false;
  bool is_crowded = false;  // several roots are between these doubles, and nothing says where
  double low = 0, high = 0;
  int power = 0;
};

// A curve in doubles; binomial coefficients are divided out. Each coefficient has an error of 8u.
struct RoughCurve {
  int degree;
  double c[kMostDegree + 1];

  // De Casteljau's rule.
  double at(double t, double* slope) const noexcept {
    double value[kMostDegree + 1];
    for (int i = 0; i <= degree; ++i) value[i] = c[i];
    for (int round = degree; round > 1; --round) {
      for (int i = 0; i < round; ++i) value[i] = (1 - t) * value[i] + t * value[i + 1];
    }
    *slope = degree * (value[1] - value[0]);
    return (1 - t) * value[0] + t * value[1];
  }

  // A coefficient errs by 8u, five steps by 4u each, and over the next double the value changes by 20u at most: all of the
  // largest coefficient.
  int sure_sign(double t) const noexcept {
    double size = 0, slope = 0;
    for (int i = 0; i <= degree; ++i) size = std::fabs(c[i]) > size ? std::fabs(c[i]) : size;
    const double value = at(t, &slope), bound = size * 0x1p-46 + 0x1p-1000;
    return value > bound ? 1 : value < -bound ? -1 : kOpenSign;
  }

  // Whether doubles tell only roughly where the root near t is: a value errs by more than it changes over the next doubles.
  bool is_blurred_at(double t) const noexcept {
    double size = 0, slope = 0;
    for (int i = 0; i <= degree; ++i) size = std::fabs(c[i]) > size ? std::fabs(c[i]) : size;
    at(t, &slope);
    return size * 0x1p-52 > std::fabs(slope) * t * 0x1p-51;
  }

  // Near to the root between low and high; `rising` says how the sign changes there. Newton's method, with bisection where a
  // step leaves the interval.
  double guess_root(double low, double high, bool rising) const noexcept {
    double t = 0.5 * (low + high);
    if (low == 0 && high == 1) {
      t = c[0] / (c[0] - c[degree]);
      if (!(t > 0 && t < 1)) t = 0.5;
    }
    for (int i = 0; i < 60 && low < t && t < high; ++i) {
      double slope = 0;
      const double value = at(t, &slope);
      if (value == 0) break;
      ((value > 0) == rising ? high : low) = t;
      const double next = t - value / slope;
      const double to = next > low && next < high ? next : 0.5 * (low + high);
      const bool is_near = std::fabs(to - t) <= 0x1p-50 * t;
      t = to;
      if (is_near) break;
    }
    return t;
  }
};

// Its value at a time; rest is 1 - time.
template <class Curve>
Ball value_at(const Curve& curve, const Ball& time, const Ball& rest) {
  Ball sum = curve.ball(curve.degree()), weight = rest;
  for (int i = curve.degree() - 1; i >= 0; --i) {
    sum = sum * time + curve.ball(i) * weight;
    if (i > 0) weight = weight * rest;
  }
  return sum;
}

template <class Curve>
Ball value_at(const Curve& curve, const Ball& time) {
  return value_at(curve, time, ball_of(1) - time);
}

// A time between t and the next double.
inline Ball ball_from(double t) noexcept {
  Ball time = ball_of(t);
  time.error = balls::power_of_two(integers::decode(t).exponent - 1075 - time.exponent);
  return time;
}

template <class Curve>
bool is_zero(const Curve& curve) noexcept {
  for (int i = 0; i <= curve.degree(); ++i) {
    if (curve.sign(i) != 0) return false;
  }
  return true;
}

// The only root between low and high, where the sign was `before`; false if it is open where it is.
template <class Curve>
bool find_only_root(const Curve& curve, double low, double high, int before, Place* place) {
  std::uint64_t a = integers::bits_of(low), b = integers::bits_of(high);
  double guess = curve.rough().guess_root(low, high, before < 0);
  if (curve.degree() > 1 && curve.rough().is_blurred_at(guess))
    guess = SharpCurve(curve).near_root(guess, low, high, before < 0);
  const std::uint64_t at = integers::bits_of(guess);
  const int sign = integers::narrow_sign_change(&a, &b, at, before, [&](double t) { return curve.sign_at(t); });
  *place = {integers::of_bits(a), sign == 0};
  return sign != kOpenSign;
}

// Where [0,1] is divided: at time / (time + rest). This is a double, `below` and `above`; or it is length 2^power away from 1,
// or from 0, where no doubles are, and lies between the doubles below and above it.
struct Cut {
  Ball time, rest;
  double below, above;
  double log;  // about that of time / rest to the base of 2; larger where this quotient is
  double length;
  int power;

  bool is_double() const noexcept { return below == above; }
};

inline double log_of(const Ball& ball) noexcept {
  return ball.exponent + static_cast<double>(static_cast<std::uint64_t>(ball.magnitude >> 64)) * 0x1p-63;
}

inline Cut double_cut(double t) noexcept {
  const Ball time = ball_of(t), rest = ball_of(1) - time;
  return {time, rest, t, t, log_of(time) - log_of(rest), 0, 0};
}

inline Cut hidden_cut(bool is_at_end, double length, int power) noexcept {
  Ball near = ball_of(length);
  near.exponent += power;
  const Ball far = ball_of(1) - near;
  const double log = log_of(near) - log_of(far);
  return is_at_end ? Cut{far, near, 1 - 0x1p-53, 1, -log, length, power}
                   : Cut{near, far, 0, 0x1p-1074, log, length, power};
}

// Near to where time / rest is x 2^power; 1/8 < x < 8.
inline Cut cut_at(double x, int power) noexcept {
  if (power < -1070) return hidden_cut(false, x, power < -1080 ? power : -1080);
  if (power > 49) return hidden_cut(true, 1 / x, power > 57 ? -power : -57);
  const double quotient = x * balls::power_of_two(power / 2) * balls::power_of_two(power - power / 2);
  return double_cut(quotient / (1 + quotient));
}

// Signs of a curve's coefficients between two cuts, where time is low.time a + high.time b, and the rest accordingly.
template <class Curve>
void find_signs(const Curve& curve, const Cut& low, const Cut& high, int (&signs)[kMostDegree + 1]) {
  // A form of degree - 1 becomes its product with first a + last b.
  const auto multiply = [](Ball* form, int degree, const Ball& first, const Ball& last) {
    form[degree] = form[degree - 1] * last;
    for (int i = degree - 1; i > 0; --i) form[i] = form[i] * first + form[i - 1] * last;
    form[0] = form[0] * first;
  };
  const int n = curve.degree();
  Ball sum[kMostDegree + 1], power[kMostDegree + 1];  // of a and b
  sum[0] = curve.ball(n);
  power[0] = ball_of(1);
  for (int degree = 1; degree <= n; ++degree) {
    multiply(sum, degree, low.time, high.time);
    multiply(power, degree, low.rest, high.rest);
    const Ball next = curve.ball(n - degree);
    for (int i = 0; i <= degree; ++i) sum[i] = sum[i] + next * power[i];
  }
  for (int i = 0; i <= n; ++i) signs[i] = sum[i].sign();
}

// The sign from one end of a hidden place to the other.
template <class Curve>
int hidden_sign(const Curve& curve, const Place& place) {
  const Cut first = hidden_cut(place.is_at_end, place.is_at_end ? place.high : place.low, place.power),
            last = hidden_cut(place.is_at_end, place.is_at_end ? place.low : place.high, place.power);
  int signs[kMostDegree + 1];
  find_signs(curve, first, last, signs);
  for (int i = 0; i <= curve.degree(); ++i) {
    if (signs[i] != signs[0]) return kOpenSign;
  }
  return signs[0];
}

// The sign of a curve at a root of another one, or at 0 or 1.
template <class Curve>
int sign_at(const Curve& curve, const Place& place) {
  const int n = curve.degree();
  if (place.is_exact && place.floor == 0) return curve.sign(0);
  if (place.is_exact && place.floor == 1) return curve.sign(n);
  bool rises = false, falls = false;
  for (int i = 0; i <= n; ++i) {
    rises = rises || curve.sign(i) > 0;
    falls = falls || curve.sign(i) < 0;
  }
  if (!(rises && falls)) return rises ? 1 : falls ? -1 : 0;
  if (place.is_hidden) return hidden_sign(curve, place);
  const int sure = curve.sure_sign(place.floor);
  return sure != kOpenSign || !place.is_exact ? sure : curve.sign_at(place.floor);
}

// The roots of a curve strictly inside of [0,1].
template <class Curve>
class Isolation {
 public:
  // Room for kMostDegree places. For degrees up to 3 the sign of the discriminant, where it is known, says how many roots are real;
  // if all are, there are as many as signs change.
  Isolation(const Curve& curve, Place* places, int discriminant = kOpenSign)
      : curve_(curve), places_(places), discriminant_(discriminant) {}

  // Whether they are found; the curve is not 0.
  bool find() {
    const int n = curve_.degree();
    int before = 0, count = 0;
    for (int i = 0; i <= n; ++i) {
      const int sign = curve_.sign(i);
      if (sign == 0) continue;
      count += sign * before < 0 ? 1 : 0;
      before = sign;
    }
    if (count == 0) return true;
    const Ball zero, one = ball_of(1);
    const Cut start = {zero, one, 0, 0, -kFar, 0, 0}, end = {one, zero, 1, 1, kFar, 0, 0};
    if (is_paired(&count)) return true;
    if (count == 1) return add_root(start, end, -before);
    for (int i = 0; i <= n; ++i) ball_[i] = curve_.ball(i);
    find_sizes();
    return divide(start, end, 0);
  }

  int found() const noexcept { return found_; }

 private:
  static constexpr int kMostCuts = 5, kMostCutsOfReal = 90;
  static constexpr double kFar = 1e9;
  static constexpr double kOffCentre = 1.0625;  // roots are often powers of 2

  bool add_root(const Cut& low, const Cut& high, int before) {
    Place& place = places_[found_];
    place = {};
    if (!find_only_root(curve_, low.below, high.above, before, &place)) return false;
    ++found_;
    if (place.is_exact || (place.floor != 0 && place.floor != 1 - 0x1p-53)) return true;
    return uncover(low, high, before, &place);
  }

  // Narrows the place of a root where no doubles are.
  bool uncover(const Cut& low, const Cut& high, int before, Place* place) {
    const bool is_at_end = place->floor != 0;
    const Cut &nearer = is_at_end ? high : low, &further = is_at_end ? low : high;
    double length = nearer.length, most = further.is_double() ? 1 : further.length;
    int power = nearer.power, most_power = further.is_double() ? (is_at_end ? -53 : -1074) : further.power;
    const int when_nearer = is_at_end ? -before : before;  // the sign between the end and the root
    for (int step = 1, steps = 0;; ++steps) {
      double middle = kOffCentre;
      int middle_power = (power + most_power) / 2;
      if (length == 0) {
        if (steps > 20) return false;
        middle_power = most_power - step;
        step *= 2;
      } else if (most_power - power <= 3) {
        most *= balls::power_of_two(most_power - power);
        most_power = middle_power = power;
        if (most - length < length * 0x1p-40) break;
        middle = length + (most - length) * (0.5 * kOffCentre);
      }
      const Cut cut = hidden_cut(is_at_end, middle, middle_power);
      const int sign = value_at(curve_, cut.time, cut.rest).sign();
      if (sign == kOpenSign) return false;
      if (sign == 0) {
        length = middle * (1 - 0x1p-45);
        most = middle * (1 + 0x1p-45);
        power = most_power = middle_power;
      } else if (sign == when_nearer) {
        length = middle;
        power = middle_power;
      } else {
        most = middle;
        most_power = middle_power;
      }
    }
    place->is_hidden = true;
    place->is_at_end = is_at_end;
    place->low = length;
    place->high = most;
    place->power = power;
    return true;
  }

  // About the sizes of roots, as of time / rest: the slopes of Newton's polygon.
  void find_sizes() noexcept {
    int at[kMostDegree + 1], corners = 0;
    const auto slope = [&](int i, int j) {
      return static_cast<double>(ball_[i].exponent - ball_[j].exponent) / (j - i);
    };
    for (int i = 0; i <= curve_.degree(); ++i) {
      if (ball_[i].sign() == 0) continue;
      while (corners > 1 && slope(at[corners - 2], at[corners - 1]) >= slope(at[corners - 1], i)) --corners;
      at[corners++] = i;
    }
    sizes_ = corners - 1;
    for (int i = 0; i < sizes_; ++i) size_[i] = slope(at[i], at[i + 1]);
  }

  // Both parts of what lies between two cuts.
  bool divide(const Cut& low, const Cut& high, int cuts) {
    Cut cut;
    return cuts < (discriminant_ == 1 ? kMostCutsOfReal : kMostCuts) && find_cut(low, high, &cut) &&
           find_within(low, cut, cuts + 1) && find_within(cut, high, cuts + 1);
  }

  bool find_cut(const Cut& low, const Cut& high, Cut* cut) const noexcept {
    const auto is_inside = [&] {
      if (!cut->is_double()) return cut->log > low.log && cut->log < high.log;
      return cut->below > low.below && cut->below >= low.above && cut->below < high.above && cut->below <= high.below;
    };
    // Where roots of different sizes part.
    double gap = 4, least = kFar, most = -kFar;
    int at = 0;
    for (int i = 0; i < sizes_; ++i) {
      if (size_[i] < low.log - 3 || size_[i] > high.log + 3) continue;
      if (most > -kFar && size_[i] - most > gap) {
        gap = size_[i] - most;
        at = static_cast<int>(std::floor(0.5 * (size_[i] + most)));
      }
      least = size_[i] < least ? size_[i] : least;
      most = size_[i];
    }
    if (least > most) return false;
    if (gap > 4) {
      *cut = cut_at(kOffCentre, at);
      if (is_inside()) return true;
    }
    const int size = static_cast<int>(std::floor(0.5 * (least + most)));
    for (int which = 0; which < 2; ++which) {
      const double turn = turning_point(size, which);
      if (!(turn > 0.125 && turn < 8)) continue;
      *cut = cut_at(turn, size);
      if (is_inside()) return true;
      if (discriminant_ != 1 || !cut->is_double()) continue;
      // Roots next to each other: on both sides of them.
      const std::uint64_t bits = integers::bits_of(cut->below);
      for (const std::uint64_t beside : {bits - 3, bits + 3}) {
        *cut = double_cut(integers::of_bits(beside));
        if (is_inside()) return true;
      }
    }
    *cut = cut_at(kOffCentre, static_cast<int>(std::floor(least)) - 3);
    if (is_inside()) return true;
    *cut = cut_at(kOffCentre, static_cast<int>(std::floor(most)) + 4);
    if (is_inside()) return true;
    if (low.log < -1000 || high.log > 50) return false;
    *cut = double_cut(0.5 * (low.above + high.below));
    return is_inside();
  }

  // Where the slope of the sum of c[i] x^i is 0, with x as a multiple of 2^size; 0 if it is not known.
  double turning_point(int size, int which) const noexcept {
    const int n = curve_.degree();
    if (n > 3) return which == 0 ? 1 : 0;
    double c[kMostDegree + 1] = {0};
    const int scale = ball_[n].exponent + n * size;
    for (int i = 0; i <= n; ++i) {
      if (ball_[i].sign() == 0) continue;
      const double high = static_cast<double>(static_cast<std::uint64_t>(ball_[i].magnitude >> 64));
      c[i] = high * balls::power_of_two(ball_[i].exponent + i * size - scale) * (ball_[i].negative ? -1 : 1);
    }
    if (n == 2) return which == 0 ? -c[1] / (2 * c[2]) : 0;
    const double square = c[2] * c[2] - 3 * c[1] * c[3];
    const double q = -(c[2] + std::copysign(std::sqrt(square > 0 ? square : 0), c[2]));
    return which == 0 ? c[1] / q : q / (3 * c[3]);
  }

  // At cuts there are no roots.
  bool find_within(const Cut& low, const Cut& high, int cuts) {
    const int n = curve_.degree();
    const bool is_first = low.log == -kFar, is_last = high.log == kFar;
    int signs[kMostDegree + 1];
    find_signs(curve_, low, high, signs);
    if (is_first) signs[0] = curve_.sign(0);
    if (is_last) signs[n] = curve_.sign(n);
    if (signs[0] == kOpenSign && low.is_double()) signs[0] = curve_.sign_at(low.below);
    if (signs[n] == kOpenSign && high.is_double()) signs[n] = curve_.sign_at(high.below);
    const auto is_known = [](int sign) { return sign != 0 && sign != kOpenSign; };
    if ((!is_first && !is_known(signs[0])) || (!is_last && !is_known(signs[n]))) return false;
    // Open signs count like those with the most changes.
    int before = 0, after_low = 0, count = 0, open = 0;
    bool any_open = false;
    for (int i = 0; i <= n; ++i) {
      if (signs[i] == 0) continue;
      if (signs[i] == kOpenSign) {
        if (before == 0) return false;
        any_open = true;
        ++open;
        continue;
      }
      if (before == 0) after_low = signs[i];
      const int parity = before == 0 || signs[i] == before ? 0 : 1;
      count += open % 2 == parity ? open : open + 1;
      before = signs[i];
      open = 0;
    }
    if (open != 0) return false;
    if (is_paired(&count)) return true;
    if (count == 1) return add_root(low, high, after_low);
    return (!any_open && add_crowd(low, high, count)) || divide(low, high, cuts);
  }

  // Two roots less if they are not real; whether none is left.
  bool is_paired(int* count) const noexcept {
    if (discriminant_ == -1 && *count > 1) *count -= 2;
    return *count == 0;
  }

  // Real roots between two neighbouring doubles.
  bool add_crowd(const Cut& low, const Cut& high, int count) {
    if (discriminant_ != 1 || !low.is_double() || !high.is_double()) return false;
    if (integers::bits_of(high.below) - integers::bits_of(low.below) != 1) return false;
    for (int i = 0; i < count; ++i) {
      places_[found_] = {low.below, false};
      places_[found_++].is_crowded = true;
    }
    return true;
  }

  const Curve& curve_;
  Place* places_;
  int discriminant_;
  Ball ball_[kMostDegree + 1];
  double size_[kMostDegree];
  int sizes_ = 0;
  int found_ = 0;
};

}  // namespace bernstein
}  // namespace dsw
