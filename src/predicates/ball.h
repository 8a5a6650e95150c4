// Numbers of 128 bits with an exponent of any size and a bound of their error: the stage between doubles and integers of any
// length. What fits 128 bits is exact, and its 0 is certain. Private to this folder.
#pragma once

#include <cstdint>

#include "base/compiler.h"
#include "predicates/integers.h"

namespace dsw {

// What a sign is if it is not known.
constexpr int kOpenSign = 2;

// The true value differs by at most error * 2^exponent from magnitude * 2^exponent with its sign. The highest bit of a
// magnitude that is not 0 is set. Bounds of errors are doubles, and a factor pays for their own roundings; a bound that
// is infinite or no number makes the sign open.
struct Ball {
  Uint128 magnitude = 0;
  int exponent = 0;
  bool negative = false;
  double error = 0;

  int sign() const noexcept {
    const auto high = static_cast<std::uint64_t>(magnitude >> 64);
    if (error == 0) return high == 0 ? 0 : negative ? -1 : 1;
    return static_cast<double>(high) * 0x1p64 > error * (1 + 0x1p-40) ? (negative ? -1 : 1) : kOpenSign;
  }
};

namespace balls {

// 2^power, or a bound of it from above where that is no double.
inline double power_of_two(int power) noexcept {
  if (power > 1000) return HUGE_VAL;
  return integers::of_bits(static_cast<std::uint64_t>((power < -1000 ? -1000 : power) + 1023) << 52);
}

inline int leading_zeros(const Uint128& x) noexcept {
  const auto high = static_cast<std::uint64_t>(x >> 64);
  if (high != 0) return 63 - static_cast<int>(highest_bit(high));
  return 127 - static_cast<int>(highest_bit(static_cast<std::uint64_t>(x)));
}

// The highest bit of the magnitude may be 0.
inline Ball normal(Uint128 magnitude, int exponent, bool negative, double error) noexcept {
  if (magnitude == Uint128(0)) return {magnitude, exponent, false, error};
  const int zeros = leading_zeros(magnitude);
  return {magnitude << zeros, exponent - zeros, negative, error == 0 ? 0 : error * power_of_two(zeros)};
}

inline bool is_less(const Uint128& a, const Uint128& b) noexcept {
  const auto a_high = static_cast<std::uint64_t>(a >> 64), b_high = static_cast<std::uint64_t>(b >> 64);
  return a_high != b_high ? a_high < b_high : static_cast<std::uint64_t>(a) < static_cast<std::uint64_t>(b);
}

}  // namespace balls

inline Ball ball_of(double x) noexcept {
  const integers::Decoded d = integers::decode(x);
  return balls::normal(d.magnitude, d.exponent - 1075, d.negative, 0);
}

inline Ball operator-(Ball a) noexcept {
  a.negative = !a.negative;
  return a;
}

inline Ball operator+(const Ball& a, const Ball& b) noexcept {
  const Uint128 zero = 0;
  const bool b_first = a.magnitude == zero || (!(b.magnitude == zero) && b.exponent > a.exponent);
  const Ball &first = b_first ? b : a, &second = b_first ? a : b;
  const int gap = first.exponent - second.exponent;
  double error = first.error;
  if (second.error != 0) error += second.error * balls::power_of_two(-gap);
  if (second.magnitude == zero) return {first.magnitude, first.exponent, first.negative, error};
  Uint128 part = 0;
  if (gap < 128) part = second.magnitude >> gap;
  if (gap >= 128 || !(part << gap == second.magnitude)) error += 1;
  if (first.negative == second.negative) {
    const Uint128 sum = first.magnitude + part;
    if (!balls::is_less(sum, part)) return {sum, first.exponent, first.negative, error};
    const bool is_odd = (static_cast<std::uint64_t>(sum) & 1) != 0;
    const Uint128 half = sum >> 1 | Uint128(1) << 127;
    return {half, first.exponent + 1, first.negative, error * 0.5 + (is_odd ? 1 : 0)};
  }
  if (balls::is_less(first.magnitude, part))
    return balls::normal(part - first.magnitude, first.exponent, second.negative, error);
  return balls::normal(first.magnitude - part, first.exponent, first.negative, error);
}
inline Ball operator-(const Ball& a, const Ball& b) noexcept { return a + -b; }

// A magnitude is at most 2^128, so an error of a factor counts no more than once in units of the product's last place.
inline Ball operator*(const Ball& a, const Ball& b) noexcept {
  const auto a_high = static_cast<std::uint64_t>(a.magnitude >> 64), a_low = static_cast<std::uint64_t>(a.magnitude);
  const auto b_high = static_cast<std::uint64_t>(b.magnitude >> 64), b_low = static_cast<std::uint64_t>(b.magnitude);
  const Uint128 low = static_cast<Uint128>(a_low) * b_low, one = static_cast<Uint128>(a_high) * b_low,
                other = static_cast<Uint128>(a_low) * b_high;
  const Uint128 middle = (low >> 64) + static_cast<std::uint64_t>(one) + static_cast<std::uint64_t>(other);
  const Uint128 high = static_cast<Uint128>(a_high) * b_high + (one >> 64) + (other >> 64) + (middle >> 64);
  const bool is_exact = static_cast<std::uint64_t>(middle) == 0 && static_cast<std::uint64_t>(low) == 0;
  double error = is_exact ? 0 : 1;
  if (a.error != 0 || b.error != 0) {
    error += a.error * b.error * 0x1p-128;
    if (b_high != 0) error += a.error;
    if (a_high != 0) error += b.error;
  }
  return balls::normal(high, a.exponent + b.exponent + 128, a.negative != b.negative, error);
}

}  // namespace dsw
