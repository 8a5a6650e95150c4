// A guess of a root that is good also where doubles do not tell the root from another one near it. Private to this folder.
#pragma once

#include <cmath>

#include "predicates/ball.h"
#include "predicates/double_double.h"

namespace dsw {
namespace bernstein {

// A curve whose coefficients are sums of two doubles, all times one power of two; binomial coefficients are divided out.
struct SharpCurve {
  int degree;
  dd::Number c[6];

  template <class Curve>
  explicit SharpCurve(const Curve& curve) noexcept : degree(curve.degree()) {
    int top = INT32_MIN, binomial = 1;
    for (int i = 0; i <= degree; ++i) {
      const Ball ball = curve.ball(i);
      if (!(ball.magnitude == Uint128(0)) && ball.exponent > top) top = ball.exponent;
    }
    for (int i = 0; i <= degree; ++i) {
      c[i] = quotient(rounded(curve.ball(i), top), binomial);
      binomial = binomial * (degree - i) / (i + 1);
    }
  }

  // By Euler's method, which takes the nearer root of the parabola that touches the curve: it is quick also next to a turning
  // point, where Newton's is not. `rising` says how the sign changes at the root between low and high.
  double near_root(double t, double low, double high, bool rising) const noexcept {
    for (int step = 0; step < 12; ++step) {
      double slope, bend;
      const double value = at(t, &slope, &bend);
      const double square = slope * slope - 2 * value * bend, size = std::sqrt(square > 0 ? square : 0);
      const double there = rising ? size : -size;  // the slope at the root
      const double move = slope * there > 0 ? -2 * value / (slope + there) : (there - slope) / bend;
      const double to = t + move;
      if (!(to > low && to < high) || to == t) return t;
      t = to;
      if (std::fabs(move) <= 0x1p-53 * t) return t;
    }
    return t;
  }

 private:
  static dd::Number quotient(const dd::Number& a, double divisor) noexcept {
    const double q = a.high / divisor;
    const dd::Number back = dd::Split::product(q, divisor);
    return dd::fast_sum(q, ((a.high - back.high) - back.low + a.low) / divisor);
  }

  static dd::Number rounded(const Ball& ball, int top) noexcept {
    const auto high = static_cast<std::uint64_t>(ball.magnitude >> 64);
    if (high == 0) return {0, 0};
    const double scale = balls::power_of_two(ball.exponent - top) * (ball.negative ? -0x1p-127 : 0x1p-127);
    constexpr std::uint64_t kBelow = 0x7ff;
    const auto rest = static_cast<std::uint64_t>(ball.magnitude >> 11);
    return dd::fast_sum(static_cast<double>(high & ~kBelow) * 0x1p64 * scale,
                        static_cast<double>(rest) * 0x1p11 * scale);
  }

  // De Casteljau's rule.
  double at(double t, double* slope, double* bend) const noexcept {
    const dd::Number time = {t, 0}, rest = dd::sum(1, -t);
    dd::Number v[6] = {c[0]};
    for (int i = 1; i <= degree; ++i) v[i] = c[i];
    *slope = *bend = 0;
    const auto less = [](const dd::Number& a, const dd::Number& b) { return dd::add(a, dd::negative(b)); };
    for (int round = degree; round > 0; --round) {
      if (round == 2) *bend = degree * (degree - 1) * less(less(v[2], v[1]), less(v[1], v[0])).high;
      if (round == 1) *slope = degree * less(v[1], v[0]).high;
      for (int i = 0; i < round; ++i) v[i] = dd::add(dd::multiply(rest, v[i]), dd::multiply(time, v[i + 1]));
    }
    return v[0].high;
  }
};

}  // namespace bernstein
}  // namespace dsw
