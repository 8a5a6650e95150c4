// The bounds of certified_hit, and its last step. Private to this folder.
//
// Let u = 2^-53; S_k = |e1_i e2_j| + |e1_j e2_i| for component k of n = e1 x e2; m_k the largest |component| on axis k
// of e1, e2, a-p, q-p, and M = mx my mz. Differences of doubles are exact as two doubles. Then
//   n_k: two products (8u^2 each of its own size), an exact difference of the high parts, low parts below 6.02u S_k
//        summed in two additions:                                       error < 22u^2 S_k, |n_k| <= S_k(1 + u)
//   n.w: the errors of n_k, three products of 8u^2, exact sums of the high parts, low parts below 5.1u in four
//        additions: 3 * 22u^2 * 2M + 28u^2 * 3 * 2M                         error < 301u^2 M
// With roundings in M and S_k themselves: kTimeError = 320u^2 and kNormalError = 24u^2. Products of numbers in
// [2^-140, 2^160] that underflow add less than 2^-740, against u^2 M > 2^-526; S_k is tested against 2^-500 for
// the same reason.
//   t = N/d: quotient of the high parts, residual N - t0 d with an error below 9u^2 N, its quotient by the high part of
//        d (6u^2), and the sum: 15u^2, called 32u^2 t. E the error of N and d, t <= 1:  error < 2.01 E / d + 32u^2.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "predicates/double_double.h"
#include "predicates/filter_bounds.h"

namespace dsw {

constexpr double kSquaredRoundoff = kUnitRoundoff * kUnitRoundoff;
constexpr double kTimeError = 320 * kSquaredRoundoff;
constexpr double kNormalError = 24 * kSquaredRoundoff;
constexpr double kLeastProducts = 0x1p-500;

// Largest double <= the time that is high + low, with an error below `error`.
DSW_HOT bool floor_time(const dd::Number& t, double error, double* time) noexcept {
  if (!(t.high > 0 && t.high <= 1) || !(std::fabs(t.low) > error)) return false;
  std::int64_t bits;
  std::memcpy(&bits, &t.high, sizeof bits);
  bits -= t.low < 0 ? 1 : 0;  // the double before a positive one
  std::memcpy(time, &bits, sizeof bits);
  return t.high < 1 || t.low < 0;
}

// Largest double <= numerator / denominator; `volume` is M.
template <class Exact>
DSW_HOT bool floor_ratio(const dd::Number& numerator, const dd::Number& denominator, double volume,
                         double* time) noexcept {
  if (!(denominator.high > 0)) return false;
  const double guess = numerator.high / denominator.high;
  const dd::Number back = Exact::product(guess, denominator.high);
  const double rest = (numerator.high - back.high) + ((numerator.low - back.low) - guess * denominator.low);
  const double error = kTimeSlack * (2.01 * kTimeError * volume / denominator.high + 32 * kSquaredRoundoff);
  return floor_time(dd::fast_sum(guess, rest / denominator.high), error, time);
}

}  // namespace dsw
